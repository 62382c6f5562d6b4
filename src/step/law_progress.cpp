#include "step/law_progress.hpp"

#include <algorithm>

#include "contacts/strength.hpp"
#include "step/changes.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

/// The stage by which laws change; none in a model without stages.
const Stage* stage_of(const Simulation& sim) {
  const std::vector<Stage>& stages = sim.scene->model.stages;
  return stages.empty() ? nullptr : &stages[sim.motion.law_course.stage];
}

bool is_timed(const Stage* stage) {
  return stage == nullptr || !stage->to_equilibrium();
}

bool is_change_of(const JointLaw& law, std::size_t stage) {
  return law.change && law.change->stage == stage;
}

/// s: the time that joints have had in the present stage.
double time_of_stage(const Simulation& sim, const Stage* stage) {
  const double time = sim.motion.state.time;
  if (is_timed(stage)) return time - sim.motion.law_course.began;
  if (!stage->ramp || stage->ramp->varied != Varied::time) return 0.0;
  return sim.attached.loads.slow.time.at(time, sim.attached.loads.gradual) -
         stage->ramp->what.range->x;
}

}  // namespace

LawProgress progress_now(const Simulation& sim) {
  const std::vector<JointLaw>& joints = sim.scene->model.joints;
  const LawCourse& course = sim.motion.law_course;
  LawProgress now = sim.motion.laws.progress;
  if (course.held) return now;
  const Stage* const stage = stage_of(sim);
  const double time = sim.motion.state.time, passed = time_of_stage(sim, stage);
  if (std::any_of(joints.begin(), joints.end(), [](const JointLaw& j) { return j.decay_time; }))
    now.time = course.time + passed;
  for (std::size_t r = 0; r < joints.size(); ++r) {
    if (!is_change_of(joints[r], course.stage) || now.part.empty()) continue;
    const double over = joints[r].change->over;
    now.part[r] = over > 0.0 ? std::min(passed / over, 1.0)
                             : sim.attached.loads.slow.change.at(time, sim.attached.loads.gradual);
  }
  return now;
}

void begin_law_changes(Simulation& sim, std::size_t stage) {
  LawTable& laws = sim.motion.laws;
  const Model& model = sim.scene->model;
  set_strength_factors(sim, laws.divided_by);
  sim.motion.law_course = {stage, sim.motion.state.time, laws.progress.time};
  const std::optional<Ramp>& ramp = model.stages[stage].ramp;
  const double from = ramp && ramp->varied == Varied::time ? ramp->what.range->x : 0.0;
  sim.attached.loads.slow.change = {};
  sim.attached.loads.slow.time = {from, from};
  LawProgress begins = laws.progress;
  for (std::size_t r = 0; r < model.joints.size(); ++r) {
    if (!is_change_of(model.joints[r], stage)) continue;
    begins.part.resize(model.joints.size());
    begins.since.resize(model.joints.size());
    begins.since[r] = begins.time;
  }
  // No face has one of these laws yet.
  if (begins != laws.progress) laws = divided_laws(model, laws.divided_by, begins);
}

void update_laws(Simulation& sim) {
  constexpr std::uint64_t steps_between = 10;
  if (sim.motion.state.steps % steps_between != 0 || !is_timed(stage_of(sim))) return;
  set_strength_factors(sim, sim.motion.laws.divided_by);
}

}  // namespace edda
