#include "run/stage_plan.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "blocks/property_change.hpp"
#include "model/stage_names.hpp"
#include "run/ramp.hpp"
#include "run/stages.hpp"
#include "step/changes.hpp"
#include "step/law_progress.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

/// Of an opening or a fill.
Index owner_called(const Model& model, const std::string& name) {
  const std::vector<Index> fills = fills_called(model, {name});
  if (!fills.empty()) return Owners(model).of_fill(fills.front());
  const auto found = std::find_if(model.openings.begin(), model.openings.end(),
                                  [&](const Opening& o) { return o.name == name; });
  return static_cast<Index>(found - model.openings.begin());
}

StagePlan plan_of(const Model& model, const Stage& stage, std::size_t row) {
  StagePlan plan{stage,
                 row,
                 rows_called(model, stage.deactivate),
                 rows_called(model, stage.activate),
                 bolts_called(model, stage.install),
                 linings_called(model, stage.install),
                 fills_called(model, stage.fill),
                 {},
                 {}};
  for (const std::string& name : stage.excavate) plan.out.push_back(owner_called(model, name));
  for (const auto& [name, part] : stage.relax) {
    plan.relax.emplace_back(owner_called(model, name), part);
  }
  return plan;
}

/// The plan without what changes from outside have done already.
StagePlan without_what_is_done(const Simulation& sim, StagePlan plan) {
  const ActiveIntervals& intervals = sim.attached.loads.intervals;
  plan.off = rows_that(true, intervals, plan.off);
  plan.on = rows_that(false, intervals, plan.on);
  std::erase_if(plan.bolts, [&](Index row) { return is_installed(sim.attached.bolts, row); });
  return plan;
}

/// Fraction of the wall forces of an opening that has been released so far.
double released(const Simulation& sim, Index opening) {
  const double kept = sim.attached.loads.remaining[static_cast<std::size_t>(opening)].value;
  return is_excavated(sim, opening) ? 1.0 - kept : 0.0;
}

void excavate_openings(Simulation& sim, const StagePlan& plan) {
  std::vector<std::pair<Index, double>> more;  // those that exceed what has been released by now
  for (const auto& [opening, part] : plan.relax) {
    if (part >= released(sim, opening)) more.emplace_back(opening, part);
  }
  if (!plan.out.empty()) excavate(sim, plan.out);
  for (const auto& [opening, part] : more) relax(sim, opening, part);
}

void change_strength(Simulation& sim, const Stage& stage, double factor) {
  const std::vector<double> factors(sim.motion.laws.rows.size(), factor);
  if (stage.to_equilibrium() && stage.damping.adaptive > 0.0) {
    begin_gradually(sim, factors, stage.ramp.has_value());
  } else {
    set_strength_factors(sim, factors);
  }
}

/// Water has its own time to flow, at first none (but in a model as drawn); in a stage in time
/// after such a one it stays as it is; else it has all the time it needs.
void choose_flow(Simulation& sim, const Stage& stage) {
  JointFlow& flow = sim.attached.loads.flow;
  const bool timed = stage.ramp && stage.ramp->varied == Varied::flow;
  const bool stays = !stage.to_equilibrium() && flow != JointFlow::steady;
  flow = stays ? JointFlow::held : JointFlow::steady;
  if (timed && sim.motion.state.steps > 0) begin_timed_flow(sim);
}

/// Whether rock has got an elasticity or a strength that is for linings alone.
bool hardens_rock(const BlockSet& b, const Model& model, const PropertyChange& change,
                  const std::vector<Index>& before) {
  if (change.material == none) return false;
  const auto of = [&](Index row) -> const Material& {
    return model.materials[static_cast<std::size_t>(row)];
  };
  if (of(change.material).may_weather_to(of(change.row))) return false;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.is_lining(i) && b.material[i] != before[i]) return true;
  }
  return false;
}

Fault rock_of(const Model& model, const PropertyChange& change) {
  return {
      change.where,
      fmt::format("changes rock of \"{}\", which is the material of a lining, too: of rock only "
                  "the strength in zones can change",
                  model.materials[static_cast<std::size_t>(change.material)].name),
      "give the lining a material of its own"};
}

/// A change that a stage before has made in part is not made again for the rest.
std::string remedy_of_idle(const Model& model, std::size_t stage, const PropertyChange& change) {
  for (std::size_t q = 0; q < stage && change.joints != none; ++q) {
    for (const PropertyChange& before : model.stages[q].change) {
      if (before.joints != change.joints || before.row != change.row) continue;
      return fmt::format(
          "they are of \"{0}\" since {1}, in whole or in part: to take them further change \"{0}\" "
          "to another law that has the numbers of the end",
          change.to, stage_label(model, q));
    }
  }
  return "check its name, set, region and distance, and the changes before it";
}

}  // namespace

Faults idle_changes(const Scene& scene) {
  Faults faults;
  BlockSet blocks = scene.blocks;
  const Model& model = scene.model;
  for (std::size_t q = 0; q < model.stages.size(); ++q) {
    const std::vector<std::uint8_t> linings = linings_before(model, q);
    for (const PropertyChange& change : model.stages[q].change) {
      const std::vector<Index> before = blocks.material;
      if (!change_properties(blocks, model, change, linings).empty()) {
        if (hardens_rock(blocks, model, change, before)) faults.push_back(rock_of(model, change));
        continue;
      }
      const bool joints = change.joints != none;
      const auto row = static_cast<std::size_t>(joints ? change.joints : change.material);
      faults.push_back(
          {change.where,
           fmt::format("changes nothing: there {} \"{}\"{} by then",
                       joints ? "are no joints of law" : "is no rock and no lining of material",
                       joints ? model.joints[row].name : model.materials[row].name,
                       change.set.empty() ? "" : " in set \"" + change.set + '"'),
           remedy_of_idle(model, q, change)});
    }
  }
  return faults;
}

void repeat_changes(Simulation& sim, const std::vector<StagePlan>& plans, std::size_t stage) {
  for (std::size_t q = 0; q <= stage && q < plans.size(); ++q) {
    for (const PropertyChange& change : plans[q].stage.change) {
      repeat_change(sim.scene.edit(), change, linings_before(sim.scene->model, q));
    }
  }
}

void set_ramp(Simulation& sim, const Stage& stage, double value) {
  const Ramp& ramp = *stage.ramp;
  const State& state = sim.motion.state;
  if (ramp.varied == Varied::flow) {
    SteppedValue& time = sim.attached.loads.slow.flow;
    if (value == ramp.what.range->x) {
      time = {value, value};
    } else {
      begin_timed_flow(sim);
      time.change(value, state.time);
    }
  } else if (SteppedValue* const v =
                 slow_value(sim.attached.loads.slow, ramp.varied, ramp.target)) {
    if (state.steps == 0 && !is_displaced(sim.scene->model, ramp.varied, ramp.target)) {
      *v = {value, value};
    } else {
      v->change(value, state.time);
    }
  }
  change_strength(sim, stage, ramp.varied == Varied::strength ? value : stage.strength_factor);
}

std::vector<StagePlan> plan_stages(const Model& model) {
  std::vector<StagePlan> plans;
  for (const Stage& stage : stages_of(model)) plans.push_back(plan_of(model, stage, plans.size()));
  return plans;
}

std::optional<Fault> enter_stage(Simulation& sim, const StagePlan& given, bool first) {
  const StagePlan plan = first ? given : without_what_is_done(sim, given);
  const Stage& stage = plan.stage;
  const bool glued = stage.joints == StageJoints::glued;
  stop_gradual_change(sim);
  // Unglue before excavation, so that the walls are not supported by joints that are no longer
  // glued. Glue after all other changes, so that joints are glued in their state at that time.
  if (!glued) glue_joints(sim, false);
  // Excavate before boundaries take over from each other, so that a boundary takes over the forces
  // after excavation.
  excavate_openings(sim, plan);
  begin_law_changes(sim, plan.row);
  for (const PropertyChange& change : stage.change) change_properties(sim, change);
  // Joints whose aperture has changed keep the pressure of their water; all else that changes now
  // finds what they contain.
  choose_flow(sim, stage);
  switch_over(sim, plan.off, plan.on);
  if (!plan.fills.empty()) {
    if (auto fault = place_fills(sim, plan.fills)) return fault;
  }
  if (!plan.linings.empty()) install_linings(sim, plan.linings);
  // Bolts are installed in the rock that remains.
  if (!plan.bolts.empty()) {
    if (auto fault = install(sim, plan.bolts)) return fault;
  }
  glue_joints(sim, glued);
  // Mass scaling and the step that damping allows depend on all springs that act from now on.
  scale_masses(sim, stage.masses);
  const bool carry = sim.scene->model.solver.dynamic && !stage.to_equilibrium();
  change_damping(sim, stage.damping, carry);
  // Damping for equilibrium brings blocks to rest, not to the velocity of the ground.
  if (stage.to_equilibrium()) lose_velocity(sim, sim.attached.ground.velocity);
  // Strength changes last: with adaptive damping it changes gradually, together with all that has
  // begun or ended to act above.
  if (stage.ramp) {
    set_ramp(sim, stage, stage.ramp->what.range->x);
  } else {
    change_strength(sim, stage, stage.strength_factor);
  }
  if (stage.reset_displacements) reset_displacements(sim);
  update_flow(sim);
  return {};
}

}  // namespace edda
