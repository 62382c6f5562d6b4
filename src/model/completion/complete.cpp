#include "model/completion/complete_tools.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>
#include <map>

#include "model/table/nearest.hpp"

namespace edda {
namespace {

void complete_materials(const Value& root, Reading& reading) {
  const auto keys = find_section("materials")->keys;
  const double gravity = norm(reading.model.gravity);
  constexpr double usual_gravity = 9.81;  // for the weight of materials in a model without gravity
  auto& materials = reading.model.materials;
  for (Material& material : materials) {
    const Value* node = find(find(&root, "materials"), material.name);
    const std::string path = material.where.key + ".unit_weight";
    const Value* weight = find(node, "unit_weight");
    if (weight != nullptr) {
      const auto value = read_number(*weight, *find_key(keys, "unit_weight"), path, reading);
      if (given(node, "density")) {
        add_fault(reading, weight->place, path, "density is given too", "give only one of them");
      } else if (value) {
        material.density = fitted(*value / (gravity > 0.0 ? gravity : usual_gravity));
      }
    } else if (!given(node, "density")) {
      add_fault(reading, node->place, material.where.key + ".density", "is missing",
                "give " + expected(*find_key(keys, "density")) + ", or unit_weight");
    }
  }
}

void complete_contact(const Value& root, Reading& reading) {
  Model& model = reading.model;
  const Value* node = find(&root, "contact");
  if (!given(node, "joint") && model.joints.size() == 1) model.contact.joint = 0;
}

/// Fills in a missing material where the model has only one.
void complete_material(const Value& root, const Value* node, Index& material, const Where& where,
                       Reading& reading) {
  if (!is_table(node) || given(node, "material")) return;
  const auto& materials = reading.model.materials;
  if (materials.size() == 1) {
    material = 0;
    return;
  }
  if (materials.empty() && given(&root, "materials")) return;  // faulty, and reported already
  std::vector<std::string_view> names;
  names.reserve(materials.size());
  for (const Material& m : materials) names.push_back(m.name);
  add_fault(reading, node->place, where.key + ".material", "is missing",
            names.empty() ? "add a material: [materials.rock]"
                          : "several are defined, name one of " + quoted_list(names));
}

void complete_material_references(const Value& root, Reading& reading) {
  Model& model = reading.model;
  const auto complete_one = [&](const Value* node, auto& item) {
    complete_material(root, node, item.material, item.where, reading);
  };
  for (std::size_t i = 0; i < model.blocks.size(); ++i) {
    complete_one(element(root, "block", i), model.blocks[i]);
  }
  if (model.domain) {
    const Value* node = find(&root, "domain");
    complete_one(node != nullptr ? node : find(&root, "slope"), *model.domain);
  }
  for (std::size_t i = 0; i < model.linings.size(); ++i) {
    complete_one(element(root, "lining", i), model.linings[i]);
  }
  for (std::size_t i = 0; i < model.fills.size(); ++i) {
    complete_one(element(root, "fill", i), model.fills[i]);
  }
  for (std::size_t i = 0; i < model.walls.size(); ++i) {
    complete_one(element(root, "brick_wall", i), model.walls[i]);
  }
  for (std::size_t i = 0; i < model.arches.size(); ++i) {
    complete_one(element(root, "arch", i), model.arches[i]);
  }
  for (std::size_t i = 0; i < model.regions.size(); ++i) {
    complete_one(element(root, "region", i), model.regions[i]);
  }
  for (std::size_t i = 0; i < model.imports.size(); ++i) {
    if (model.domain && model.imports[i].as == ImportAs::lines) continue;
    complete_one(element(root, "import", i), model.imports[i]);
  }
}

/// Rough numbers of blocks: none, one or several.
struct BlockCount {
  double all = 0.0;
  double without_law = 0.0;           ///< blocks whose edges name no joint
  std::vector<const Where*> unnamed;  ///< the tables of these edges
  /// Counts the blocks of a table whose edges have this joint.
  void add(double blocks, Index joint, const Where& where) {
    all += blocks;
    if (joint != none) return;
    without_law += blocks;
    unnamed.push_back(&where);
  }
};

BlockCount count_blocks(const Model& model) {
  BlockCount count;
  for (const BlockInput& block : model.blocks) count.add(1.0, block.joint, block.where);
  for (const BrickWall& wall : model.walls)
    count.add(static_cast<double>(wall.columns) * wall.rows, wall.joint, wall.where);
  for (const Arch& arch : model.arches) count.add(arch.count, arch.joint, arch.where);
  for (const Import& import : model.imports) {
    if (!model.domain) count.add(2.0, import.joint, import.where);
  }
  for (const Lining& lining : model.linings) count.add(1.0, lining.interface, lining.where);
  for (const Fill& fill : model.fills) count.add(1.0, fill.joint, fill.where);
  if (!model.domain) return count;
  const bool is_named = model.domain->joint != none;
  const std::size_t before = count.unnamed.size();
  const auto look = [&](const auto& cut) {
    if (cut.joint == none && !is_named) count.unnamed.push_back(&cut.where);
  };
  std::for_each(model.joint_sets.begin(), model.joint_sets.end(), look);
  std::for_each(model.traces.begin(), model.traces.end(), look);
  std::for_each(model.networks.begin(), model.networks.end(), look);
  std::for_each(model.imports.begin(), model.imports.end(), look);
  if (model.voronoi) look(*model.voronoi);
  const bool unnamed = count.unnamed.size() > before;
  const bool cut = !model.joint_sets.empty() || !model.traces.empty() || !model.networks.empty() ||
                   model.voronoi || !model.imports.empty() || !model.regions.empty();
  count.all += cut ? 2.0 : 1.0;
  if (!is_named) count.without_law += unnamed ? 2.0 : 1.0;
  if (!is_named && !unnamed) count.unnamed.push_back(&model.domain->where);  // its outline
  return count;
}

/// "block.0 (line 8), joint_set.beds (line 20) and 3 more".
std::string tables_text(const std::vector<const Where*>& tables) {
  constexpr std::size_t most = 5;
  std::string text;
  for (std::size_t q = 0; q < std::min(most, tables.size()); ++q) {
    text += q == 0 ? "" : ", ";
    text += tables[q]->key;
    if (tables[q]->line > 0) text += fmt::format(" (line {})", tables[q]->line);
  }
  return tables.size() > most ? text + fmt::format(" and {} more", tables.size() - most) : text;
}

/// A contact between edges that name no joint needs a law. Where the name of a joint is wrong, this
/// is already a fault, and the count of edges without a law has no meaning.
void check_laws(const Value& root, Reading& reading, bool joints_are_faulty) {
  const Model& model = reading.model;
  if (joints_are_faulty || (model.joints.empty() && given(&root, "joints"))) return;
  const BlockCount count = count_blocks(model);
  if (model.joints.empty() && count.all > 1.0) {
    add_fault(reading, {1, 1, false}, "joints", "no contact law is defined",
              "add [joints.NAME] with a friction_angle");
  } else if (model.joints.size() > 1 && model.contact.joint == none && count.without_law > 1.0) {
    std::vector<std::string_view> names;
    for (const JointLaw& law : model.joints) names.push_back(law.name);
    const Value* contact = find(&root, "contact");
    add_fault(
        reading, contact == nullptr ? Place{1, 1, false} : contact->place, "contact.joint",
        "is missing, and no joint is named for the edges of " + tables_text(count.unnamed),
        "give each its joint, or contact.joint for all of them: several are defined, name one "
        "of " +
            quoted_list(names));
  }
}

template <class Item>
void check_names(const Value& root, std::string_view section, const std::vector<Item>& items,
                 Reading& reading) {
  std::map<std::string_view, std::size_t> first;
  for (std::size_t i = 0; i < items.size(); ++i) {
    if (items[i].name.empty()) continue;
    const auto [other, is_new] = first.emplace(items[i].name, i);
    if (is_new) continue;
    const Value* name = find(element(root, section, i), "name");
    const Where& where = items[other->second].where;
    add_fault(reading, name->place, items[i].where.key + ".name",
              fmt::format("is the name of element {} (line {}) too", other->second, where.line),
              "give each its own name");
  }
}

void check_blocks(const Value& root, Reading& reading) {
  const auto& blocks = reading.model.blocks;
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const BlockInput& block = blocks[i];
    if (!block.fixed) continue;
    const Value* node = element(root, "block", i);
    const auto refuse = [&](const char* key) {
      add_fault(reading, find(node, key)->place, block.where.key + "." + key,
                "a fixed block cannot have a velocity", "leave it out, or set fixed = false");
    };
    if (block.velocity != Vec2{}) refuse("velocity");
    if (block.angular_velocity != 0.0) refuse("angular_velocity");
  }
}

void check_content(const Value& root, Reading& reading) {
  const Model& model = reading.model;
  const bool is_misspelt =
      std::any_of(reading.faults.begin(), reading.faults.end(), [](const Fault& fault) {
        return fault.where.key == "block" || fault.where.key == "brick_wall" ||
               fault.where.key == "arch" || fault.where.key == "import";
      });
  if (model.blocks.empty() && !model.domain && model.walls.empty() && model.arches.empty() &&
      model.imports.empty() && model.linings.empty() && !is_misspelt) {
    add_fault(reading, {1, 1, false}, "block", "the model has no blocks",
              "add a [[block]], a [domain] or a [[brick_wall]]");
  }
  if (model.domain) return;
  for (const std::string_view name :
       {"joint_set", "trace", "fracture_network", "opening", "region", "fixed"}) {
    const Value* first = element(root, name, 0);
    if (first == nullptr || (name == "fixed" && !model.imports.empty())) continue;
    add_fault(reading, first->place, std::string(name), "there is no [domain] for it to act on",
              "add a [domain] with an outline, or a [slope]");
  }
  if (model.voronoi) {
    add_fault(reading, find(&root, "voronoi")->place, "voronoi",
              "there is no [domain] for it to act on",
              "add a [domain] with an outline, or a [slope]");
  }
}

void check_solver(const Value& root, Reading& reading) {
  const Solver& solver = reading.model.solver;
  const Value* node = find(&root, "solver");
  if (solver.damping.local > 0.0) {
    check_local_damping(
        find(node, "damping"), "solver", solver,
        "leave it out: the implicit method has numerical damping, most of all with dynamic = false",
        reading);
  }
  if (solver.method == Method::edda && !solver.dynamic) {
    add_fault(reading, find(node, "dynamic")->place, "solver.dynamic",
              "false belongs to method = \"dda\"",
              "give method = \"dda\", or leave it out and end with a [[stage]] with "
              "until = \"equilibrium\"");
  }
  constexpr double most_steps = 1e12;
  if (solver.time_step && solver.duration / *solver.time_step > most_steps) {
    add_fault(reading, find(node, "time_step")->place, "solver.time_step",
              fmt::format("would take {:.1e} steps", solver.duration / *solver.time_step),
              "give a longer time_step, or \"auto\"");
  }
}

/// Without the rounding of the times from which it follows, so that rows are at times of few
/// digits.
double in_few_digits(double interval) {
  return std::isfinite(interval) ? std::strtod(fmt::format("{:.9g}", interval).c_str(), nullptr)
                                 : interval;
}

double mean_interval(const std::vector<double>& time) {
  return (time.back() - time.front()) / static_cast<double>(time.size() - 1);
}

/// The shortest mean interval of the records of ground motions, s; infinite without any.
double interval_of_record(const Model& model) {
  double finest = std::numeric_limits<double>::infinity();
  for (const Shaking& shaking : model.shakings) {
    if (shaking.record.time.size() > 1)
      finest = std::min(finest, mean_interval(shaking.record.time));
  }
  return in_few_digits(finest);
}

/// The shortest mean interval of the records of ground motions and of histories of many rows, or a
/// twentieth of the period of a sine, s.
double finest_record(const Model& model) {
  double finest = std::numeric_limits<double>::infinity();
  const auto look = [&](const std::vector<double>& time) {
    constexpr std::size_t many = 20;
    if (time.size() > many) finest = std::min(finest, mean_interval(time));
  };
  for (const Shaking& shaking : model.shakings) {
    look(shaking.record.time);
    const double frequency = shaking.acceleration.frequency.value_or(0.0);
    if (frequency > 0.0) finest = std::min(finest, 0.05 / frequency);
  }
  for (const Load& load : model.loads) look(load.factor.time);
  for (const Boundary& boundary : model.boundaries) look(boundary.factor.time);
  return in_few_digits(finest);
}

/// history_every = "record".
void take_interval_of_record(const Value& root, Reading& reading) {
  const Value* const value = find(find(&root, "output"), "history_every");
  const auto* const word = value == nullptr ? nullptr : std::get_if<std::string>(&value->content);
  if (word == nullptr || *word != "record") return;
  const double interval = interval_of_record(reading.model);
  const auto& shakings = reading.model.shakings;
  if (std::isfinite(interval)) {
    reading.model.output.history_every = interval;
  } else if (std::all_of(shakings.begin(), shakings.end(),
                         [](const Shaking& s) { return s.acceleration.file.empty(); })) {
    add_fault(reading, value->place, "output.history_every",
              "is the interval of a record, and no [[shaking]] has one",
              "give acceleration = \"FILE\" in a [[shaking]], or a time such as \"10 ms\"");
  }
}

/// A default of duration / `parts` (0 where no duration is given), or `finer`, and a fault where
/// there would be more than `most` rows. Stages until equilibrium and ramps end before their time,
/// and have rows of their own (output.settling): where there are others, the duration is that of
/// these, as long as this makes at most ten times as many rows.
void complete_interval(const Value& root, const char* key, double& interval, double parts,
                       double finer, double most, Reading& reading) {
  const Value* value = find(find(&root, "output"), key);
  const auto& stages = reading.model.stages;
  double duration = stages.empty() ? reading.model.solver.duration : 0.0, timed = 0.0;
  for (const Stage& stage : stages) {
    const bool known = !stage.ramp && stage.until == StageEnd::time;
    if (known) timed += stage.duration;
    duration += known ? stage.duration : std::min(stage.duration, Stage{}.duration);
  }
  if (value == nullptr) {
    constexpr double most_parts = 20000.0;
    const double spread = timed > 0.0 ? std::max(timed, 0.1 * duration) : duration;
    interval = std::min(spread / parts, std::max(finer, duration / most_parts));
    interval = duration > 0.0 ? fitted(interval) : 0.0;
  } else if (interval > 0.0 && duration / interval > most) {
    add_fault(reading, value->place, std::string("output.") + key,
              fmt::format("would write {:.1e} times, more than {:.0e}", duration / interval, most),
              fmt::format("give at least {:.3g} s", duration / most));
  }
}

}  // namespace

void check_local_damping(const Value* damping, const std::string& owner, const Solver& solver,
                         const char* instead, Reading& reading) {
  const Value* local = find(damping, "local");
  if (local == nullptr) return;
  const std::string key = owner + ".damping.local";
  if (solver.method == Method::dda) {
    add_fault(reading, local->place, key, "local damping belongs to method = \"edda\"", instead);
  }
  if (solver.mass == MassKind::consistent) {
    add_fault(reading, local->place, key,
              "local damping is not available with mass = \"consistent\"",
              "use mass = \"matched\", which moves the same way");
  }
}

void complete(const Value& root, Reading& reading) {
  Model& model = reading.model;
  const bool joints_are_faulty =
      std::any_of(reading.faults.begin(), reading.faults.end(), [](const Fault& fault) {
        return fault.where.key.ends_with("joint") || fault.where.key == "joints";
      });
  complete_shapes(root, reading);
  complete_materials(root, reading);
  complete_joints(root, reading);
  complete_contact(root, reading);
  complete_material_references(root, reading);
  check_content(root, reading);
  check_laws(root, reading, joints_are_faulty);
  check_names(root, "block", model.blocks, reading);
  check_names(root, "joint_set", model.joint_sets, reading);
  check_names(root, "fracture_network", model.networks, reading);
  check_names(root, "opening", model.openings, reading);
  check_names(root, "boundary", model.boundaries, reading);
  check_names(root, "load", model.loads, reading);
  check_names(root, "water", model.waters, reading);
  check_names(root, "stage", model.stages, reading);
  check_names(root, "monitor", model.monitors, reading);
  check_blocks(root, reading);
  check_names(root, "shaking", model.shakings, reading);
  check_names(root, "bolt", model.bolts, reading);
  check_names(root, "bolt_pattern", model.bolt_patterns, reading);
  check_names(root, "lining", model.linings, reading);
  check_names(root, "fill", model.fills, reading);
  check_names(root, "convergence", model.convergences, reading);
  check_names(root, "measurement", model.measurements, reading);
  complete_boundaries(root, reading);
  complete_lines(root, reading);
  complete_initial_stress(root, reading);
  complete_shakings(root, reading);
  complete_bolts(root, reading);
  complete_linings(root, reading);
  complete_fills(root, reading);
  complete_geometry(root, reading);
  complete_loads(root, reading);
  complete_flow(root, reading);
  complete_stages(root, reading);
  check_first_linings(root, reading);
  check_solver(root, reading);
  complete_fos(root, reading);
  complete_points(root, reading);
  complete_zones(root, reading);
  complete_interval(root, "every", model.output.every, 20.0,
                    std::numeric_limits<double>::infinity(), 1e5, reading);
  take_interval_of_record(root, reading);
  complete_interval(root, "history_every", model.output.history_every, 200.0, finest_record(model),
                    1e7, reading);
  const Value* output = find(&root, "output");
  if (find(output, "settling") == nullptr)
    model.output.settling =
        find(output, "every") == nullptr && find(output, "history_every") == nullptr;
}

}  // namespace edda
