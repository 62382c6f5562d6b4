// [[stage]]: its defaults, and whether what it names exists.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include "model/completion/complete_changes.hpp"
#include "model/stage_names.hpp"
#include "model/table/nearest.hpp"

namespace edda {
namespace {

/// Damping of a stage: values that it does not give are those of the solver; a stage until
/// equilibrium has adaptive damping by default.
void complete_stage_damping(const Value* node, const Solver& solver, Stage& stage) {
  const Value* own = find(node, "damping");
  const bool seeks_equilibrium = stage.to_equilibrium() && solver.method == Method::edda;
  if (!given(own, "mass")) stage.damping.mass = solver.damping.mass;
  if (!given(own, "contact")) stage.damping.contact = solver.damping.contact;
  // With local damping the user has already chosen how the stage reaches equilibrium.
  if (!given(own, "local")) stage.damping.local = seeks_equilibrium ? 0.0 : solver.damping.local;
  if (!given(own, "adaptive")) {
    const bool chosen = given(own, "local") || given(own, "mass");
    stage.damping.adaptive =
        seeks_equilibrium && !chosen ? Damping::for_equilibrium : solver.damping.adaptive;
  }
  const bool adaptive = seeks_equilibrium && stage.damping.adaptive > 0.0;
  if (!given(own, "rayleigh") && !adaptive) stage.damping.rayleigh = solver.damping.rayleigh;
}

/// In a stage until equilibrium inertia is scaled by default, so that small blocks do not shorten
/// the step.
void complete_masses(const Value* node, const Solver& solver, Stage& stage, Reading& reading) {
  const Value* own = find(node, "masses");
  if (own == nullptr) {
    const bool seeks_equilibrium = stage.to_equilibrium() && solver.method == Method::edda &&
                                   solver.mass_scaling == 0.0 && !solver.time_step;
    if (seeks_equilibrium) stage.masses = StageMasses::scaled;
    return;
  }
  if (stage.masses != StageMasses::scaled) return;
  const std::string key = stage.where.key + ".masses";
  if (solver.method == Method::dda) {
    add_fault(reading, own->place, key, "\"scaled\" belongs to method = \"edda\"",
              "leave it out: an implicit step is as long as you choose");
  } else if (solver.mass_scaling > 0.0 || solver.time_step) {
    add_fault(reading, own->place, key,
              std::string("\"scaled\" chooses the time step, and solver.") +
                  (solver.time_step ? "time_step" : "mass_scaling") + " does too",
              "leave one of them out");
  }
}

/// Excavation and release of wall forces in a stage. let_go: by what has been excavated so far;
/// placed: fills of earlier stages.
void complete_excavation(const Value* own, Stage& stage, std::map<std::string, double>& let_go,
                         const std::set<std::string>& placed, Reading& reading) {
  Model& model = reading.model;
  std::vector<std::string_view> known = names_in(model.openings);
  for (const std::string_view name : names_in(model.fills)) known.push_back(name);
  const auto is_known = [&](const std::string& name) {
    return std::find(known.begin(), known.end(), name) != known.end();
  };
  const auto unknown = [&](const Value& value, const std::string& path, const std::string& name) {
    names_nothing(reading, value, path, name, "opening or fill", known);
  };
  for (std::size_t q = 0; q < stage.excavate.size(); ++q) {
    const Value& list = *find(own, "excavate");
    const std::string path = fmt::format("{}.excavate[{}]", stage.where.key, q);
    const std::string& name = stage.excavate[q];
    Opening* const opening = opening_called(model, name);
    if (!is_known(name)) {
      unknown(list, path, name);
    } else if (let_go.contains(name)) {
      add_fault(reading, list.place, path, '"' + name + "\" has been excavated before",
                "excavate each opening once");
    } else if (opening == nullptr && !placed.contains(name)) {
      add_fault(reading, list.place, path, '"' + name + "\" has not been placed yet",
                "excavate fill in a stage after that which places it");
    } else {
      const auto says = [&](const auto& part) { return part.first == name; };
      const bool by_part = std::any_of(stage.relax.begin(), stage.relax.end(), says);
      let_go[name] = by_part ? 0.0 : 1.0;
      if (opening == nullptr) continue;
      opening->staged = true;
      if (opening->joint == none) opening->joint = glued_law(reading);
    }
  }
  for (const auto& [name, part] : stage.relax) {
    const Value& table = *find(own, "relax");
    const std::string path = stage.where.key + ".relax." + name;
    if (!is_known(name)) {
      unknown(table, path, name);
    } else if (!let_go.contains(name)) {
      add_fault(reading, table.place, path, '"' + name + "\" has not been excavated yet",
                "name it in excavate of this stage or one before");
    } else if (part < let_go[name]) {
      add_fault(reading, table.place, path,
                fmt::format("is less than the {:.6g} released so far", let_go[name]),
                "give the part released by then, all stages together");
    } else {
      let_go[name] = part;
    }
  }
}

/// The opening of this name where a stage excavates it that has yet to come.
const Opening* unexcavated(const Model& model, const std::string& name,
                           const std::map<std::string, double>& excavated) {
  for (const Opening& o : model.openings) {
    if (!o.name.empty() && o.name == name && !excavated.contains(name) && excavated_in(model, name))
      return &o;
  }
  return nullptr;
}

/// The same of the opening on whose wall a lining lies.
const Opening* unexcavated(const Model& model, const Lining& lining,
                           const std::map<std::string, double>& excavated) {
  for (const Lining& below : model.linings) {
    if (&below == &lining) break;
    if (!lining.on.empty() && below.name == lining.on) return unexcavated(model, below, excavated);
  }
  return unexcavated(model, lining.opening, excavated);
}

/// A lining comes with the stage that excavates its opening, or later.
void check_linings_of(const Stage& stage, const std::map<std::string, double>& excavated,
                      const Value* own, Reading& reading) {
  for (const Lining& lining : reading.model.linings) {
    const auto& names = stage.install;
    if (lining.name.empty() || std::find(names.begin(), names.end(), lining.name) == names.end())
      continue;
    const Opening* opening = unexcavated(reading.model, lining, excavated);
    if (opening == nullptr) continue;
    add_fault(reading, find(own, "install")->place, stage.where.key + ".install",
              '"' + lining.name + "\" lies inside \"" + opening->name +
                  "\", which has not been excavated yet",
              "install it in the stage that excavates the opening, or later");
  }
}

/// The lining on which this one lies where that has yet to be installed; else empty.
std::string missing_below(const Model& model, const std::string& name,
                          const std::set<std::string>& installed) {
  for (const Lining& lining : model.linings) {
    const std::string& on = lining.on;
    if (lining.name != name || on.empty() || name.empty()) continue;
    if (!installed.contains(on) && !installed_at_first(model, on)) return on;
  }
  return {};
}

/// Bolts and linings that a stage installs, each once.
void check_install(const Value* own, const Stage& stage, std::set<std::string>& installed,
                   const std::map<std::string, double>& excavated, Reading& reading) {
  check_linings_of(stage, excavated, own, reading);
  std::vector<std::string_view> known = names_in(reading.model.bolts);
  for (const std::string_view name : names_in(reading.model.bolt_patterns)) known.push_back(name);
  for (const std::string_view name : names_in(reading.model.linings)) known.push_back(name);
  for (std::size_t q = 0; q < stage.install.size(); ++q) {
    const std::string& name = stage.install[q];
    const Value& list = *find(own, "install");
    const std::string path = fmt::format("{}.install[{}]", stage.where.key, q);
    if (std::find(known.begin(), known.end(), name) == known.end()) {
      names_nothing(reading, list, path, name, "bolt, pattern of bolts or lining", known);
    } else if (!installed.insert(name).second) {
      add_fault(reading, list.place, path, '"' + name + "\" has been installed before",
                "install each once");
    } else if (const std::string below = missing_below(reading.model, name, installed);
               !below.empty()) {
      add_fault(reading, list.place, path,
                '"' + name + "\" lies on \"" + below + "\", which is not there yet",
                "install that one before it, or together with it and before it in the list");
    }
  }
}

/// Fills that a stage places, each once, and those in openings after these.
void check_fill(const Value* own, const Stage& stage, std::set<std::string>& placed,
                const std::map<std::string, double>& excavated, Reading& reading) {
  const Model& model = reading.model;
  for (std::size_t q = 0; q < stage.fill.size(); ++q) {
    const std::string& name = stage.fill[q];
    const Value& list = *find(own, "fill");
    const std::string path = fmt::format("{}.fill[{}]", stage.where.key, q);
    const std::vector<Index> rows = fills_called(model, {name});
    if (rows.empty()) {
      names_nothing(reading, list, path, name, "fill", names_in(model.fills));
      continue;
    }
    if (!placed.insert(name).second) {
      add_fault(reading, list.place, path, '"' + name + "\" has been placed before",
                "place each fill once");
      continue;
    }
    const Opening* const opening =
        unexcavated(model, model.fills[static_cast<std::size_t>(rows.front())].opening, excavated);
    if (opening == nullptr) continue;
    add_fault(reading, list.place, path,
              '"' + name + "\" lies in \"" + opening->name + "\", which has not been excavated yet",
              "place it in the stage that excavates the opening, or later");
  }
}

/// Checks that a stage activates only what is inactive before it, and deactivates only what is
/// active.
void check_switches(const Value* own, const Stage& stage, std::set<std::string>& acting,
                    const std::vector<std::string_view>& known, Reading& reading) {
  const auto check = [&](const char* key, const std::vector<std::string>& names, bool on) {
    for (std::size_t q = 0; q < names.size(); ++q) {
      const std::string& name = names[q];
      const Value& list = *find(own, key);
      const std::string path = fmt::format("{}.{}[{}]", stage.where.key, key, q);
      if (std::find(known.begin(), known.end(), name) == known.end()) {
        names_nothing(reading, list, path, name, "load, water, boundary or shaking", known);
        continue;
      }
      const bool changed = on ? acting.insert(name).second : acting.erase(name) > 0;
      if (changed) continue;
      add_fault(reading, list.place, path,
                '"' + name + (on ? "\" acts already" : "\" does not act before this stage"),
                "leave it out here");
    }
  };
  check("deactivate", stage.deactivate, false);
  check("activate", stage.activate, true);
  for (const std::string& name : stage.activate) {
    const auto& off = stage.deactivate;
    if (std::find(off.begin(), off.end(), name) == off.end()) continue;
    add_fault(reading, find(own, "activate")->place, stage.where.key + ".activate",
              '"' + name + "\" is in deactivate, too", "name it in one of them");
  }
}

/// What a ramp varies, and whether its two values are possible.
void find_ramp(const Value* node, const std::string& key, Ramp& ramp, Reading& reading) {
  const std::string& vary = ramp.what.vary;
  if (vary.empty()) {
    const bool said =
        std::any_of(reading.faults.begin(), reading.faults.end(),
                    [&](const Fault& f) { return f.where.key.starts_with(key + '.'); });
    if (said) return;
    add_fault(reading, node->place, key, "says nothing that is to be varied",
              "give one such as kh = [0.0, 0.5] or \"load:NAME\" = [0.0, 2.0]");
    return;
  }
  const Place place = place_of(node, vary);
  const auto found = find_varied(vary, place, key + '.' + vary, reading);
  if (!found || !ramp.what.range) return;
  ramp.varied = found->varied;
  ramp.target = found->target;
  const auto [from, to] = *ramp.what.range;
  const double least = std::min(from, to);
  const auto refuse = [&](const char* problem) {
    add_fault(reading, place, key + '.' + vary, problem, "give two values such as [1.0, 3.0]");
  };
  if (from == to) return refuse("ends where it begins");
  if (ramp.varied == Varied::strength && least <= 0.0) refuse("has a value that is not above 0");
  const bool pressure = ramp.varied == Varied::gravity || ramp.varied == Varied::water;
  if (pressure && least < 0.0) refuse("has a value below 0");
  const auto fault = [&](const char* problem, const char* remedy) {
    add_fault(reading, place, key + '.' + vary, problem, remedy);
  };
  const bool is_time = ramp.varied == Varied::flow || ramp.varied == Varied::time;
  if (is_time && (from < 0.0 || to < from))
    fault("does not go from a time to a later one", "give two such as [\"0 h\", \"48 h\"]");
  if (ramp.varied == Varied::flow && !reading.model.flow)
    fault("there is no flow of water", "add [flow]");
  const auto& joints = reading.model.joints;
  const auto decays = [](const JointLaw& law) { return law.decay_time.has_value(); };
  if (ramp.varied == Varied::time && std::none_of(joints.begin(), joints.end(), decays))
    fault("no joint loses strength with time", "give a law of joints a decay_time");
  if (ramp.varied == Varied::change && (from < 0.0 || to < from || to > 1.0))
    fault("does not go from a part of the change to a larger one", "give [0, 1]");
  if (changes_gravity(ramp.varied) && reading.model.gravity == Vec2{})
    add_fault(reading, place, key + '.' + vary, "the model has no gravity that this could act on",
              "give gravity = [0, -9.81]");
}

/// Whether a support may be displaced, which takes its time.
bool moves_supports(const Model& model) {
  return std::any_of(model.boundaries.begin(), model.boundaries.end(),
                     [](const Boundary& b) { return b.type == BoundaryType::displacement; });
}

/// Checks a ramp, and fills the defaults of its stage.
void complete_ramp(const Value* own, Stage& stage, Reading& reading) {
  const auto refuse = [&](const char* at, std::string problem, const char* remedy) {
    add_fault(reading, place_of(own, at), stage.where.key + "." + at, std::move(problem), remedy);
  };
  if (!stage.ramp) {
    if (stage.until == StageEnd::collapse)
      refuse("until", "\"collapse\" belongs to a stage with a ramp",
             "give a ramp such as ramp = { kh = [0.0, 0.5] }, or until = \"equilibrium\"");
    return;
  }
  const bool as_time = given(own, "until") && stage.until == StageEnd::time;
  if (!stage.to_equilibrium()) stage.until = StageEnd::equilibrium;
  if (as_time)
    return refuse("until", "\"time\" does not go with a ramp, which is held at each value",
                  "give \"equilibrium\" or \"collapse\"");
  const Model& model = reading.model;
  if (model.solver.method == Method::dda || model.contact.model == ContactModel::points)
    return refuse("ramp",
                  "is not available with method = \"dda\" nor with contact.model = \"points\"",
                  "use method = \"edda\" and contact.model = \"faces\"");
  const Value* node = find(own, "ramp");
  if (!is_table(node)) return;
  find_ramp(node, stage.where.key + ".ramp", *stage.ramp, reading);
  if (is_ramped(stage) && stage.change.empty())
    refuse("ramp", "varies the part of a change that the stage does not make",
           "give change = [{ joints = \"A\", to = \"B\" }], too");
  if (stage.ramp->varied == Varied::strength && given(own, "strength_factor"))
    refuse("strength_factor", "is given beside a ramp of the strength", "leave one of them out");
}

/// A ramp of time goes on from the age that joints have by then, `age` (s), to which each stage
/// adds the time that it takes.
void check_age(const Value* own, const Stage& stage, double& age, Reading& reading) {
  if (!stage.to_equilibrium()) age += stage.duration;
  if (!stage.ramp || stage.ramp->varied != Varied::time || !stage.ramp->what.range) return;
  const auto [from, to] = *stage.ramp->what.range;
  constexpr double same = 1e-9;
  if (std::abs(from - age) > same * std::max(age, to))
    add_fault(
        reading, place_of(find(own, "ramp"), "time"), stage.where.key + ".ramp.time",
        fmt::format("begins at {:.10g} s, where {:.10g} s have passed by then", from, age),
        fmt::format("begin with \"{:.10g} s\": where the ramp of time before it ends, with the "
                    "durations of stages since",
                    age));
  age = to;
}

/// What a ramp varies must act in its stage.
void check_acts(const Value* own, const Stage& stage, const std::set<std::string>& acting,
                Reading& reading) {
  if (!stage.ramp || stage.ramp->target == none) return;
  const std::string& vary = stage.ramp->what.vary;
  const std::string name = vary.substr(vary.find(':') + 1);
  if (acting.contains(name)) return;
  add_fault(reading, place_of(find(own, "ramp"), vary), stage.where.key + ".ramp." + vary,
            '"' + clipped(name) + "\" does not act in this stage",
            "name it in activate of this stage or of one before");
}

/// A ramp needs the damping by which equilibrium and failure are told apart.
void check_ramp_damping(const Value* own, const Stage& stage, Reading& reading) {
  if (!stage.ramp || stage.damping.adaptive > 0.0) return;
  if (reading.model.solver.method == Method::dda) return;
  add_fault(reading, place_of(own, "damping"), stage.where.key + ".damping",
            "a ramp needs adaptive damping, by which it tells equilibrium and failure apart",
            "leave damping out, or give adaptive = 0.8");
}

/// The larger of the model's width and height, m, by its outline and its blocks.
double extent_of(const Model& model) {
  std::vector<Vec2> corners;
  if (model.domain) corners = model.domain->outline;
  for (const BlockInput& block : model.blocks) {
    corners.insert(corners.end(), block.polygon.begin(), block.polygon.end());
  }
  const auto span = [&](double Vec2::*along) {
    if (corners.empty()) return 0.0;
    const auto [low, high] = std::minmax_element(
        corners.begin(), corners.end(), [&](Vec2 a, Vec2 b) { return a.*along < b.*along; });
    return *high.*along - *low.*along;
  };
  return std::max(span(&Vec2::x), span(&Vec2::y));
}

/// s: the longest that a stage until equilibrium may take where no duration is given. Waves cross
/// the model 200 times at least, so that a mountain has as many periods as a bench.
double longest_by_default(const Model& model, const Stage& stage) {
  if (stage.ramp || moves_supports(model)) return Ramp::longest_value;
  double slowest = std::numeric_limits<double>::infinity();  // m/s
  for (const Material& rock : model.materials) {
    if (rock.young > 0.0 && rock.density > 0.0) {
      slowest = std::min(slowest, std::sqrt(rock.young / rock.density));
    }
  }
  return std::max(Stage{}.duration, Stage::crossings * extent_of(model) / slowest);
}

void check_otherwise(const Value* own, const Stage& stage, Reading& reading) {
  if (stage.until != StageEnd::time || stage.otherwise != LooseBlocks::stop) return;
  add_fault(reading, find(own, "otherwise")->place, stage.where.key + ".otherwise",
            "\"stop\" belongs to a stage with until = \"equilibrium\"",
            "leave it out, or give until = \"equilibrium\"");
}

}  // namespace

void complete_stages(const Value& root, Reading& reading) {
  if (reading.model.stages.empty()) return;
  Solver& solver = reading.model.solver;
  const Value* duration = find(find(&root, "solver"), "duration");
  const Model& model = reading.model;
  std::vector<std::string_view> known;
  for (const auto& names : {names_in(model.loads), names_in(model.waters),
                            names_in(model.boundaries), names_in(model.shakings)}) {
    known.insert(known.end(), names.begin(), names.end());
  }
  std::set<std::string> installed, placed, acting;
  std::map<std::string, double> let_go;
  for (const std::string_view name : known) {
    const auto& first = model.stages.front().activate;
    const bool at_once = std::find(first.begin(), first.end(), name) != first.end();
    if (!at_once && acts_at_first(model, std::string(name))) acting.emplace(name);
  }
  double sum = 0.0, age = 0.0;
  bool all_given = true;
  for (std::size_t i = 0; i < reading.model.stages.size(); ++i) {
    Stage& stage = reading.model.stages[i];
    const Value* own = element(root, "stage", i);
    if (!is_table(own)) continue;
    complete_ramp(own, stage, reading);
    check_age(own, stage, age, reading);
    if ((stage.ramp || stage.to_equilibrium()) && !given(own, "duration")) {
      stage.duration = longest_by_default(model, stage);
      stage.may_last = !stage.ramp;
    }
    complete_stage_damping(own, solver, stage);
    check_ramp_damping(own, stage, reading);
    complete_masses(own, solver, stage, reading);
    complete_excavation(own, stage, let_go, placed, reading);
    check_fill(own, stage, placed, let_go, reading);
    check_install(own, stage, installed, let_go, reading);
    complete_changes(own, stage, reading);
    check_switches(own, stage, acting, known, reading);
    check_acts(own, stage, acting, reading);
    sum += stage.longest();
    if (stage.until == StageEnd::time && !given(own, "duration")) {
      all_given = false;
      add_fault(reading, own->place, stage.where.key + ".duration", "is missing",
                "give a time such as 0.1, or until = \"equilibrium\"");
    }
    check_otherwise(own, stage, reading);
    if (stage.damping.local > 0.0) {
      check_local_damping(find(own, "damping"), stage.where.key, solver,
                          "leave it out: until equilibrium this method drops velocities at each "
                          "step",
                          reading);
    }
  }
  complete_law_changes(root, reading);
  constexpr double same = 1e-9;
  if (duration != nullptr && all_given && std::abs(solver.duration - sum) > same * sum) {
    add_fault(reading, duration->place, "solver.duration",
              fmt::format("is not the {:.6g} s of the stages together", sum), "leave it out");
  }
  solver.duration = sum;
}

void check_first_linings(const Value& root, Reading& reading) {
  const Model& model = reading.model;
  for (std::size_t q = 0; q < model.linings.size(); ++q) {
    const Lining& lining = model.linings[q];
    const Value* node = element(root, "lining", q);
    if (!is_table(node) || (!lining.name.empty() && !installed_at_first(model, lining.name)))
      continue;
    if (!lining.on.empty() && !installed_at_first(model, lining.on)) {
      add_fault(reading, node->place, lining.where.key,
                "lies on \"" + lining.on + "\", which is not there at the start",
                "name it in install of the stage that installs that one, or of a later one");
      continue;
    }
    const Opening* opening = unexcavated(model, lining, {});
    if (opening == nullptr) continue;
    add_fault(reading, node->place, lining.where.key,
              "lies inside \"" + opening->name + "\", which is not excavated at the start",
              "name it in install of the stage that excavates the opening, or of a later one");
  }
}

}  // namespace edda
