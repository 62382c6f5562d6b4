// stage.change: whether it is possible, and which laws of joints follow from it.
#include "model/completion/complete_changes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>

#include "model/table/nearest.hpp"

namespace edda {

void names_nothing(Reading& reading, const Value& value, const std::string& path,
                   const std::string& name, const std::string& what,
                   const std::vector<std::string_view>& known) {
  add_fault(reading, value.place, path, '"' + name + "\" names no " + what,
            known.empty() ? "the model has none that has a name" : suggestion(name, known));
}

Opening* opening_called(Model& model, const std::string& name) {
  const auto found = std::find_if(model.openings.begin(), model.openings.end(),
                                  [&](const Opening& o) { return o.name == name; });
  return found == model.openings.end() ? nullptr : &*found;
}

namespace {

/// Whether linings have this material at some time: one of their own, or one that they change to.
bool is_of_linings(const Model& model, Index row) {
  std::set<Index> rows;
  for (const Lining& lining : model.linings) rows.insert(lining.material);
  for (const Stage& stage : model.stages) {
    for (const PropertyChange& change : stage.change) {
      if (change.material != none && rows.contains(change.material)) rows.insert(change.row);
    }
  }
  return rows.contains(row);
}

/// What a lining cannot do: have another mass, or yield as rock.
void check_materials_of_linings(const Material& from, const Material& to, const Value* own,
                                const Where& where, Reading& reading) {
  if (from.density != to.density) {
    add_fault(reading, place_of(own, "to"), where.key + ".to",
              fmt::format("\"{}\" has another density than \"{}\"", to.name, from.name),
              "a lining keeps its mass: give both the same density");
  } else if (to.yield || to.foliation) {
    add_fault(
        reading, place_of(own, "to"), where.key + ".to",
        fmt::format("\"{}\" has a yield or a foliation, which beams do not have", to.name),
        "give the lining a material without, and its strength = { ucs = ..., tension = ... }");
  }
}

/// What a change asks for that the rest of the run cannot give: material that deforms otherwise,
/// laws that remember more than slip.
void check_materials(const Material& from, const Material& to, const Value* own, const Where& where,
                     Reading& reading) {
  if (!from.deforms_as(to)) {
    add_fault(reading, place_of(own, "to"), where.key + ".to",
              fmt::format("\"{}\" has another density, young, poisson, foliation, damping, "
                          "rayleigh, pore_pressure or deformation than \"{}\"",
                          to.name, from.name),
              "a change is one of strength: give both the same of these");
  } else if (!from.yield || !to.yield) {
    const std::string& name = from.yield ? to.name : from.name;
    add_fault(
        reading, place_of(own, "to"), where.key + ".to",
        fmt::format("\"{}\" has no yield, and the strength of rock counts in zones that have one",
                    name),
        "give both materials a yield; a large cohesion leaves rock elastic");
  }
}

/// Whether two laws differ in no more than strength and stiffness.
bool change_gradually(const JointLaw& a, const JointLaw& b) {
  const bool has_strength = a.type == LawType::coulomb || a.type == LawType::slip_weakening;
  return has_strength && a.type == b.type && a.dilation_angle == b.dilation_angle &&
         a.slip_distance == b.slip_distance && a.kn.has_value() == b.kn.has_value() &&
         a.ks.has_value() == b.ks.has_value() && a.aperture == b.aperture &&
         a.residual_aperture == b.residual_aperture && a.largest_aperture == b.largest_aperture &&
         !a.restitution && !b.restitution;
}

/// A change that is not made at once.
void check_gradual(const Value* own, const Stage& stage, const PropertyChange& change,
                   Reading& reading) {
  const Model& model = reading.model;
  const bool over = change.over > 0.0;
  if (!over && !is_ramped(stage)) return;
  const std::string key = change.where.key + (over ? ".over" : "");
  const auto refuse = [&](std::string problem, std::string remedy) {
    add_fault(reading, over ? place_of(own, "over") : own->place, key, std::move(problem),
              std::move(remedy));
  };
  if (over && stage.to_equilibrium())
    return refuse("belongs to a stage with a duration, and this one has none of its own",
                  "give ramp = { change = [0, 1] }, or until = \"time\"");
  if (over && change.over > stage.duration)
    return refuse(fmt::format("is longer than the {:.6g} s of the stage", stage.duration),
                  "give the stage a longer duration");
  if (change.material != none)
    return refuse("a material changes at once",
                  over ? "leave out over" : "make this change in a stage of its own");
  if (change.joints == none || change.row == none) return;
  const JointLaw &a = model.joints[static_cast<std::size_t>(change.joints)],
                 &b = model.joints[static_cast<std::size_t>(change.row)];
  if (!change_gradually(a, b))
    return refuse(fmt::format("\"{}\" and \"{}\" differ in more than the numbers of strength, kn "
                              "and ks, or have a restitution, and change at once alone",
                              a.name, b.name),
                  over ? "leave out over" : "make this change in a stage of its own");
  for (const ContactPair& pair : model.pairs) {
    if (pair.joints[0] != change.joints && pair.joints[1] != change.joints &&
        pair.joints[0] != change.row && pair.joints[1] != change.row)
      continue;
    return refuse("a [[contact_pair]] names these joints, which change at once alone",
                  over ? "leave out over" : "make this change in a stage of its own");
  }
}

void check_set(const Value* own, const PropertyChange& change, Reading& reading) {
  if (change.set.empty()) return;
  if (!given(own, "joints")) {
    add_fault(reading, place_of(own, "set"), change.where.key + ".set",
              "is given with a material: it chooses among joints", "leave it out, or give joints");
    return;
  }
  std::vector<std::string_view> known = names_in(reading.model.joint_sets);
  for (const std::string_view name : names_in(reading.model.networks)) known.push_back(name);
  if (std::find(known.begin(), known.end(), change.set) != known.end()) return;
  names_nothing(reading, *find(own, "set"), change.where.key + ".set", change.set,
                "joint set or fracture network", known);
}

void check_laws(const JointLaw& from, const JointLaw& to, const Value* own, const Where& where,
                Reading& reading) {
  const JointLaw& one = from.fracture_energy ? from : to;
  if (!one.fracture_energy) return;
  add_fault(reading, place_of(own, &one == &from ? "joints" : "to"), where.key,
            fmt::format("\"{}\" has fracture energy, whose cracks belong to it", one.name),
            "change from and to joints without fracture_energy");
}

void complete_change(const Value* own, PropertyChange& change, Reading& reading) {
  const Model& model = reading.model;
  if (!one_of(own, change.where.key, "joints", "material", "joints = \"bedding\"", reading)) return;
  const bool joints = given(own, "joints");
  const auto row_of = [&](const auto& list, const char* what) {
    const auto found = std::find_if(list.begin(), list.end(),
                                    [&](const auto& item) { return item.name == change.to; });
    if (found != list.end()) return static_cast<Index>(found - list.begin());
    names_nothing(reading, *find(own, "to"), change.where.key + ".to", change.to, what,
                  names_in(list));
    return none;
  };
  if (!change.to.empty())
    change.row = joints ? row_of(model.joints, "joint") : row_of(model.materials, "material");
  const Index from = joints ? change.joints : change.material;
  if (change.row != none && change.row == from) {
    add_fault(reading, find(own, "to")->place, change.where.key + ".to",
              '"' + change.to + "\" is what they are already", "name another");
  } else if (change.row != none && from != none) {
    const auto a = static_cast<std::size_t>(from), b = static_cast<std::size_t>(change.row);
    if (joints) {
      check_laws(model.joints[a], model.joints[b], own, change.where, reading);
    } else {
      (is_of_linings(model, from) ? check_materials_of_linings : check_materials)(
          model.materials[a], model.materials[b], own, change.where, reading);
    }
  }
  if (given(own, "around") != given(own, "distance")) {
    const bool distance = given(own, "distance");
    add_fault(
        reading, own->place, change.where.key,
        distance ? "distance is given without an opening" : "around is given without a distance",
        distance ? "give around = \"NAME\", an opening" : "give distance = \"2 m\"");
  } else if (given(own, "around")) {
    const Opening* const opening = opening_called(reading.model, change.around);
    if (opening == nullptr) {
      names_nothing(reading, *find(own, "around"), change.where.key + ".around", change.around,
                    "opening", names_in(model.openings));
    } else {
      change.opening = static_cast<Index>(opening - model.openings.data());
    }
  }
}

}  // namespace

void complete_changes(const Value* own, Stage& stage, Reading& reading) {
  const Model& model = reading.model;
  if (stage.change.empty()) return;
  if (model.solver.method == Method::dda || model.contact.model == ContactModel::points) {
    add_fault(reading, find(own, "change")->place, stage.where.key + ".change",
              "is not available with method = \"dda\" nor with contact.model = \"points\"",
              "use method = \"edda\" and contact.model = \"faces\"");
  }
  for (std::size_t i = 0; i < stage.change.size(); ++i) {
    const Value* table = child(find(own, "change"), i);
    if (!is_table(table)) continue;
    complete_change(table, stage.change[i], reading);
    check_set(table, stage.change[i], reading);
    check_gradual(table, stage, stage.change[i], reading);
  }
}

void complete_law_changes(const Value& root, Reading& reading) {
  Model& model = reading.model;
  constexpr std::size_t most = 65000;  // a contact keeps its law in 16 bits
  std::vector<std::vector<Index>> counts_as(model.joints.size());
  for (std::size_t r = 0; r < model.joints.size(); ++r)
    counts_as[r].push_back(static_cast<Index>(r));
  for (std::size_t q = 0; q < model.stages.size(); ++q) {
    for (PropertyChange& change : model.stages[q].change) {
      if (change.joints == none || change.row == none || change.row == change.joints) continue;
      const JointLaw to = model.joints[static_cast<std::size_t>(change.row)];
      const bool gradual = change.over > 0.0 || is_ramped(model.stages[q]);
      auto& from = counts_as[static_cast<std::size_t>(change.joints)];
      auto& list = counts_as[static_cast<std::size_t>(change.row)];
      for (const Index law : from) {
        Index becomes = change.row;
        if (gradual || to.decay_time) {
          becomes = static_cast<Index>(model.joints.size());
          model.joints.push_back(to);
          model.joints.back().where = {};
          model.joints.back().change = {gradual ? law : none, change.row, q, change.over};
        }
        change.laws.emplace_back(law, becomes);
        if (std::find(list.begin(), list.end(), becomes) == list.end()) list.push_back(becomes);
      }
      if (change.region.empty() && change.around.empty() && change.set.empty()) from.clear();
      if (model.joints.size() <= most) continue;
      add_fault(reading, element(root, "stage", q)->place, change.where.key,
                "changes joints that have changed in too many ways before",
                "make fewer changes that go there and back");
      return;
    }
  }
}

}  // namespace edda
