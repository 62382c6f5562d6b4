#include "study/fos_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

#include "model/stage_names.hpp"
#include "observe/balance.hpp"
#include "study/fault_at.hpp"

namespace edda {
namespace {

constexpr double strong = 1e-3;  // strength is divided by this where nothing is to slip or break

/// The model with strength divided by `divided` in addition, and the varied ground motion, if any,
/// multiplied.
Model before_trials(Model model, const Fos& fos, double multiplier, double divided) {
  for (Stage& stage : model.stages) {
    stage.strength_factor *= divided;
    if (stage.ramp && stage.ramp->varied == Varied::strength)
      *stage.ramp->what.range = divided * *stage.ramp->what.range;
  }
  if (fos.varied == Varied::shaking)
    model.shakings[static_cast<std::size_t>(fos.target)].scale *= multiplier;
  return model;
}

/// Duration of the ground motion that is varied: that of its record; for a sine, of the stages with
/// a fixed time from the one that activates it, or of all.
double shaking_time(const Model& model, const Fos& fos) {
  if (fos.varied != Varied::shaking) return 0.0;
  const Shaking& shaking = model.shakings[static_cast<std::size_t>(fos.target)];
  if (!shaking.record.time.empty()) return shaking.record.time.back();
  if (model.stages.empty()) return model.solver.duration;
  const auto activates = [&](const Stage& stage) {
    return std::find(stage.activate.begin(), stage.activate.end(), shaking.name) !=
           stage.activate.end();
  };
  const auto first = std::find_if(model.stages.begin(), model.stages.end(), activates);
  double time = 0.0;
  for (auto stage = first == model.stages.end() ? model.stages.begin() : first;
       stage != model.stages.end(); ++stage) {
    if (stage->until == StageEnd::time) time += stage->duration;
  }
  return time;
}

Criterion criterion_of(const Fos& fos) {
  Criterion c;
  // A ground motion may shake blocks by little; what else moves them may let them close gaps.
  if (fos.varied == Varied::shaking) c.allowed = moved_little;
  if (fos.fails.displacement) {
    c.displacement = fos.fails.displacement;
    c.allowed = std::numeric_limits<double>::infinity();
  }
  c.velocity = fos.fails.velocity;
  c.least_area = fos.least_area;
  return c;
}

/// Damping with which a model reaches equilibrium.
Damping damping_for_equilibrium(const Damping& own) {
  Damping damping;
  damping.contact = own.contact;
  damping.adaptive = Damping::for_equilibrium;
  return damping;
}

TrialPlan plan_of(const Model& model, const Fos& fos) {
  const Damping& own = model.solver.damping;
  TrialPlan plan;
  plan.varied = fos.varied;
  plan.target = fos.target;
  if (fos.varied == Varied::shaking)
    plan.given_scale = model.shakings[static_cast<std::size_t>(fos.target)].scale;
  plan.criterion = criterion_of(fos);
  plan.rigid_proof = fos.rigid_proof;
  plan.shaking = shaking_time(model, fos);
  plan.quiet = damping_for_equilibrium(own);
  plan.shaken = own;
  return plan;
}

/// Faults of settings that a search does not support.
std::optional<Fault> refused(const Model& model, const Fos& fos) {
  if (model.solver.method == Method::dda) {
    return fault_at(model, model.solver.where, "solver.method",
                    "the factor of safety is not available with \"dda\"",
                    "use method = \"edda\" (--set solver.method=edda)");
  }
  if (model.contact.model == ContactModel::points) {
    return fault_at(model, model.contact.where, "contact.model",
                    "\"points\" is the paper's contact model, without a factor of safety",
                    "use contact.model = \"faces\"");
  }
  if (model.solver.mass == MassKind::consistent) {
    return fault_at(
        model, model.solver.where, "solver.mass",
        "masses that are raised for trials are not available with mass = \"consistent\"",
        "use mass = \"matched\", which moves the same way");
  }
  const std::size_t last =
      fos.stage.empty() ? model.stages.size() : stage_called(model, fos.stage).value_or(0) + 1;
  if (last > 0 && model.stages[last - 1].until == StageEnd::collapse) {
    return fault_at(model, fos.where, "fos.stage",
                    "trials cannot begin at the end of a stage until collapse",
                    "name a stage before it");
  }
  if (fos.varied == Varied::shaking && shaking_time(model, fos) == 0.0) {
    return fault_at(model, fos.where, "fos.vary", "the duration of the ground motion is not given",
                    model.stages.empty()
                        ? "give solver.duration, or a record as the acceleration of the shaking"
                        : "give a record as the acceleration of the shaking, or a stage with a "
                          "duration that activates it");
  }
  return {};
}

std::optional<Fault> nothing_moves(const Model& model, const Simulation& sim) {
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (is_free(sim.scene->blocks, sim.motion.state, i)) return {};
  }
  return fault_at(model, model.solver.where, "block",
                  "no block is free to move, so nothing can fail",
                  "leave some blocks that are neither fixed nor excavated");
}

bool stopped(const FosOptions& options) {
  return options.stop != nullptr && options.stop->load(std::memory_order_relaxed);
}

/// Limits a model of one stage to this duration (s), and suppresses output on the way.
void last_at_most(Model& model, double time) {
  model.stages.back().duration = model.solver.duration = time;
  model.output.every = model.output.history_every = time;
}

/// The model with one stage in which it reaches equilibrium as drawn, without ground motion.
Model with_equilibrium_stage(Model model) {
  Stage rest;
  rest.until = StageEnd::equilibrium;
  rest.damping = damping_for_equilibrium(model.solver.damping);
  rest.masses = StageMasses::scaled;
  model.stages.push_back(std::move(rest));
  // The duration of a run must not influence the equilibrium.
  last_at_most(model, model.stages.back().duration);
  model.output.settling = false;
  for (Shaking& shaking : model.shakings) shaking.scale = 0.0;
  return model;
}

/// The state from which trials start, at the end of the stages.
struct Staged {
  FosStart start;
  bool in_equilibrium = true;
  std::string says;       ///< message at the end of that run
  std::size_t stage = 0;  ///< stage in which it ended
};

/// Runs the model through its stages, or to equilibrium as drawn, with the varied load multiplied
/// and strength divided.
Result<Staged> staged(const Model& model, const Fos& fos, const FosOptions& options,
                      double multiplier, double divided) {
  const bool as_drawn = model.stages.empty();
  Result<PreparedRun> prepared = prepare_run(
      before_trials(as_drawn ? with_equilibrium_stage(model) : model, fos, multiplier, divided));
  if (!prepared.ok()) return prepared.faults();
  Simulation& sim = prepared.value().sim;
  if (auto fault = nothing_moves(model, sim)) return *fault;
  const RelativeMotion drawn(sim);
  if (SteppedValue* const load = slow_value(sim.attached.loads.slow, fos.varied, fos.target);
      load != nullptr && !changes_gravity(fos.varied))
    *load = {multiplier, multiplier};
  if (as_drawn) {
    last_at_most(sim.scene.edit().model,
                 most_steps * sim.scene->model.solver.safety * uniform_step(sim));
  }
  RunOptions how;
  how.stop = options.stop;
  if (options.progress) {
    how.progress_every = 2.0;
    how.progress = [&](const Progress& p) {
      options.progress(fmt::format("before the trials: {:.3g} s in {} steps", p.time, p.steps));
    };
  }
  if (!fos.stage.empty()) how.last_stage = stage_called(model, fos.stage);
  std::optional<std::size_t> ended;
  how.stage_ended = [&](const StageReport& report) { ended = report.stage; };
  const Result<Outcome> outcome = run_model(prepared.value(), how);
  if (!outcome.ok()) return outcome.faults();
  const Status status = outcome.value().status;
  Staged made;
  made.start.as_drawn = drawn.sets(sim, moved_little, sim.relaxation.loose).empty();
  // Trials are of this instant: what moves on trial does not change the water.
  if (JointFlow& flow = sim.attached.loads.flow; flow == JointFlow::timed) flow = JointFlow::held;
  sim.motion.law_course.held = true;
  made.start.sim = std::move(sim);
  if (ended) made.stage = *ended + (status == Status::failed ? 1 : 0);  // during the next stage
  FosStart& s = made.start;
  made.in_equilibrium = (status == Status::equilibrium || status == Status::completed) &&
                        outcome.value().unsettled == 0;
  made.says = outcome.value().message;
  if (auto fault = nothing_moves(model, s.sim); made.in_equilibrium && fault) return *fault;
  s.warnings = std::move(prepared.value().warnings);
  if (status == Status::interrupted) s.status = FosStatus::interrupted;
  s.given = {s.sim.motion.laws.divided_by, fos.varied == Varied::shaking ? 0.0 : 1.0};
  if (changes_gravity(fos.varied))
    s.given.value = slow_value(s.sim.attached.loads.slow, fos.varied, fos.target)->value;
  for (double& factor : s.given.strength) factor /= divided;
  s.plan = plan_of(model, fos);
  return made;
}

/// Message: why the stages are run a second time.
std::string run_again(const Model& model, const Staged& first) {
  const std::string stage = stage_label(model, first.stage);
  return fmt::format("{} with the given strength; {} run again with a thousand times the strength",
                     first.in_equilibrium ? "blocks come loose in " + stage
                                          : stage + " does not reach equilibrium",
                     model.stages.size() == 1 ? "it is" : "the stages are");
}

Result<FosStart> at_rest(const Model& model, const Fos& fos, const FosOptions& options) {
  const bool strength = fos.varied == Varied::strength;
  if (!model.stages.empty()) {
    Result<Staged> run =
        staged(model, fos, options, fos.varied == Varied::shaking ? 0.0 : 1.0, 1.0);
    if (!run.ok()) return run.faults();
    FosStart& s = run.value().start;
    const bool stands = run.value().in_equilibrium && loose_blocks(s.sim).empty();
    if (stands || s.status == FosStatus::interrupted) return std::move(s);
    if (options.say) options.say(run_again(model, run.value()));
  }
  Result<Staged> run = staged(model, fos, options, strength ? 1.0 : 0.0, strong);
  if (!run.ok()) return run.faults();
  FosStart& s = run.value().start;
  if (s.status == FosStatus::interrupted) return std::move(s);
  if (!run.value().in_equilibrium) {
    s.status = FosStatus::unstable;
    s.message = fmt::format(
        "the model does not reach equilibrium however strong its joints are: {}; fix what falls, "
        "or check its support",
        run.value().says);
  } else if (!loose_blocks(s.sim).empty()) {
    s.warnings.push_back("with joints that do not fail, " + run.value().says +
                         "; trials are those of all other blocks");
  }
  return std::move(s);
}

}  // namespace

Loading loading_of(const Fos& fos, const Model& model, const Loading& given, double factor) {
  Loading to = given;
  if (fos.varied != Varied::strength) {
    to.value = factor;
    return to;
  }
  for (std::size_t r = 0; r < to.strength.size(); ++r) {
    const bool spared = r < model.joints.size() &&
                        std::find(fos.exclude.begin(), fos.exclude.end(), model.joints[r].name) !=
                            fos.exclude.end();
    if (!spared) to.strength[r] *= factor;
  }
  return to;
}

TrialPlan plan_at(double factor, const FosStart& start) {
  TrialPlan plan = start.plan;
  if (start.as_drawn && !start.wide)
    plan.criterion = criterion_at(factor, plan.criterion, start.rigid);
  return plan;
}

void tell_progress(const FosOptions& options, Pace& pace, double factor, const Simulation& sim) {
  constexpr std::uint64_t looks = 64;  // steps from one look at the clock to the next
  if (!options.progress || sim.motion.state.steps % looks != 0 || !pace.due()) return;
  options.progress(fmt::format("trying {:.6g}: {} steps so far", factor, sim.motion.state.steps));
}

Result<FosStart> start_trials(const Model& model, const Fos& fos, const FosOptions& options) {
  if (auto fault = refused(model, fos)) return *fault;
  Result<FosStart> made = at_rest(model, fos, options);
  if (!made.ok()) return made;
  FosStart& s = made.value();
  if (s.status != FosStatus::found) return made;
  const double given = s.given.value;
  Simulation as_given = s.sim;
  LimitOptions limit;
  limit.threads = options.threads;
  limit.stop = options.stop;
  limit.say = options.progress;  // by the clock, not by what is found
  s.rigid = rigid_limit(model, fos, s.sim.scene->blocks.size(), limit);
  Pace pace;
  Trial trial = run_trial(as_given, plan_at(given, s), s.given, [&] {
    tell_progress(options, pace, given, as_given);
    return stopped(options);
  });
  trial.factor = given;
  if (trial.end == TrialEnd::stopped) {
    s.status = FosStatus::interrupted;
    return made;
  }
  if (trial.end == TrialEnd::holds) {
    s.sim = std::move(as_given);
    if (given > 0.0) s.seen.push_back(trial);
    return made;
  }
  if (given == 0.0) {
    s.status = FosStatus::unstable;
    s.message = "the model is not stable without what is varied: " +
                still_moving(as_given, balance_of(as_given));
    return made;
  }
  s.seen.push_back(trial);
  s.failed = std::move(as_given);
  return made;
}

}  // namespace edda
