#include "run/fos_start.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "model/key_places.hpp"
#include "run/settling.hpp"

namespace edda {
namespace {

constexpr double strong = 1e-3;  // what strength is divided by where nothing is to slip or break

/// The model with what is varied multiplied by `multiplier` and strength divided by `divided` once
/// more.
Model before_trials(Model model, const Fos& fos, double multiplier, double divided) {
  for (Stage& stage : model.stages) stage.strength_factor *= divided;
  const auto q = static_cast<std::size_t>(std::max(fos.target, 0));
  if (fos.varied == Varied::shaking) model.shakings[q].scale *= multiplier;
  if (fos.varied == Varied::water) model.waters[q].unit_weight *= multiplier;
  if (fos.varied == Varied::load && multiplier != 1.0) {
    TimeHistory& factor = model.loads[q].factor;
    if (factor.time.empty()) factor = {{0.0}, {1.0}};
    for (double& value : factor.value) value *= multiplier;
  }
  return model;
}

/// Length of the shaking that is varied: of its record; of a sine, of the stages by time from the
/// one that activates it, or of all.
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

FosCriterion criterion_of(const Simulation& sim, const Model& model, const Fos& fos) {
  FosCriterion c;
  double count = 0.0, mass = 0.0, force = 0.0;
  const LoadsNow acting = loads_at(model, sim.loads, sim.state.time);
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i)) continue;
    c.size += std::sqrt(sim.blocks.area[i]);
    mass += sim.blocks.mass[i];
    force += norm(load_on(sim.blocks, acting, sim.pose, i));
    count += 1.0;
  }
  c.size /= std::max(count, 1.0);
  c.acceleration = norm(model.gravity);
  if (c.acceleration == 0.0) c.acceleration = force > 0.0 ? force / mass : usual_acceleration;
  constexpr double part_of_size = 0.01, slower = 10.0;
  c.duration = time_to_stay(c.size, c.acceleration);
  c.shaking = shaking_time(model, fos);
  c.slows = !fos.fails.displacement && fos.varied != Varied::shaking;
  c.displacement = fos.fails.displacement.value_or(part_of_size * c.size);
  c.velocity = fos.fails.velocity.value_or(c.displacement / (slower * c.duration));
  return c;
}

/// In which a model comes to rest.
Damping damping_to_rest(const Damping& own) {
  Damping damping;
  damping.contact = own.contact;
  damping.adaptive = Damping::to_rest;
  damping.rayleigh = own.rayleigh;
  return damping;
}

TrialPlan plan_of(const Simulation& sim, const Model& model, const Fos& fos) {
  const Damping& own = model.solver.damping;
  TrialPlan plan;
  plan.given = model;
  plan.varied = fos.varied;
  plan.target = static_cast<std::size_t>(std::max(fos.target, 0));
  plan.criterion = criterion_of(sim, model, fos);
  plan.quiet = damping_to_rest(own);
  plan.shaken = own;
  return plan;
}

Fault cannot(const Model& model, const Where& table, const char* key, std::string problem,
             std::string remedy) {
  Fault fault{table, std::move(problem), std::move(remedy)};
  if (fault.where.file.empty()) fault.where.file = model.file;
  fault.where.key = key;
  return at_their_keys(model.key_places, {fault}).front();
}

/// What a search cannot do.
std::optional<Fault> refused(const Model& model, const Fos& fos) {
  if (model.solver.method == Method::dda) {
    return cannot(model, model.solver.where, "solver.method",
                  "the factor of safety is not sought by \"dda\"",
                  "use method = \"edda\" (--set solver.method=edda)");
  }
  if (model.contact.model == ContactModel::points) {
    return cannot(model, model.contact.where, "contact.model",
                  "\"points\" is the paper's and knows no factor of safety",
                  "use contact.model = \"faces\"");
  }
  if (model.solver.mass == MassKind::consistent) {
    return cannot(model, model.solver.where, "solver.mass",
                  "masses that are raised for trials do not go with \"consistent\"",
                  "use mass = \"matched\", which moves the same way");
  }
  if (fos.varied == Varied::shaking && shaking_time(model, fos) == 0.0) {
    return cannot(model, fos.where, "fos.vary", "nothing says for how long the ground shakes",
                  model.stages.empty()
                      ? "give solver.duration, or the shaking a record"
                      : "give the shaking a record, or a stage with a duration that activates it");
  }
  return {};
}

std::optional<Fault> nothing_moves(const Model& model, const Simulation& sim) {
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (is_free(sim.blocks, sim.state, i)) return {};
  }
  return cannot(model, model.solver.where, "block", "no block is free to move, so nothing can fail",
                "leave some blocks neither fixed nor held, nor taken out");
}

bool stopped(const FosOptions& options) {
  return options.stop != nullptr && options.stop->load(std::memory_order_relaxed);
}

/// A model of one stage goes on for so long (s) at most, and writes nothing on the way.
void last_at_most(Model& model, double time) {
  model.stages.back().duration = model.solver.duration = time;
  model.output.every = model.output.history_every = time;
}

/// The model with one stage in which it comes to rest as drawn; nothing shakes yet.
Model with_rest(Model model) {
  Stage rest;
  rest.until = StageEnd::equilibrium;
  rest.damping = damping_to_rest(model.solver.damping);
  rest.masses = StageMasses::uniform_step;
  model.stages.push_back(std::move(rest));
  // Where it ends does not hang on how long a run would go on.
  last_at_most(model, model.stages.back().duration);
  model.output.settling = false;
  for (Shaking& shaking : model.shakings) shaking.scale = 0.0;
  return model;
}

/// How trials of the model start: as its stages leave it.
struct Staged {
  FosStart start;
  bool rests = true;
  std::string says;       ///< of the end of that run
  std::size_t stage = 0;  ///< in which it ended
};

/// After its stages, or at rest as drawn, with what is varied multiplied and strength divided.
Result<Staged> staged(const Model& model, const Fos& fos, const FosOptions& options,
                      double multiplier, double divided) {
  const bool as_drawn = model.stages.empty();
  Result<PreparedRun> prepared =
      prepare_run(before_trials(as_drawn ? with_rest(model) : model, fos, multiplier, divided));
  if (!prepared.ok()) return prepared.faults();
  if (auto fault = nothing_moves(model, prepared.value().sim)) return *fault;
  if (as_drawn) {
    Simulation& sim = prepared.value().sim;
    last_at_most(sim.model, most_steps * sim.model.solver.safety * sim.uniform_step());
  }
  RunOptions how;
  how.stop = options.stop;
  if (!fos.stage.empty()) how.last_stage = stage_called(model, fos.stage);
  std::optional<std::size_t> ended;
  how.stage_ended = [&](const StageReport& report) { ended = report.stage; };
  const Result<Outcome> outcome = run_model(prepared.value(), how);
  if (!outcome.ok()) return outcome.faults();
  const Status status = outcome.value().status;
  Staged made{{std::move(prepared.value().sim), {}, {}, {}, {}, {}, {}, {}, {}}, true, {}, 0};
  if (ended) made.stage = *ended + (status == Status::failed ? 1 : 0);  // amid the next one
  FosStart& s = made.start;
  made.rests = status != Status::collapsed && status != Status::failed;
  made.says = outcome.value().message;
  if (auto fault = nothing_moves(model, s.sim); made.rests && fault) return *fault;
  s.warnings = std::move(prepared.value().warnings);
  if (status == Status::interrupted) s.status = FosStatus::interrupted;
  s.loading = {s.sim.laws.divided_by, multiplier};
  s.given = {s.sim.laws.divided_by, 1.0};
  for (double& factor : s.given.strength) factor /= divided;
  s.plan = plan_of(s.sim, model, fos);
  return made;
}

/// Why the stages are run a second time.
std::string run_again(const Model& model, const Staged& first) {
  const std::string stage = stage_label(model, first.stage);
  return fmt::format("{} with the strength given; {} run again with a thousand times the strength",
                     first.rests ? "blocks come loose in " + stage : stage + " comes to no rest",
                     model.stages.size() == 1 ? "it is" : "the stages are");
}

Result<FosStart> at_rest(const Model& model, const Fos& fos, const FosOptions& options) {
  const bool strength = fos.varied == Varied::strength;
  if (!model.stages.empty()) {
    Result<Staged> run =
        staged(model, fos, options, fos.varied == Varied::shaking ? 0.0 : 1.0, 1.0);
    if (!run.ok()) return run.faults();
    if (run.value().rests && loose_ones(run.value().start.sim).empty())
      return std::move(run.value().start);
    if (options.say) options.say(run_again(model, run.value()));
  }
  Result<Staged> run = staged(model, fos, options, strength ? 1.0 : 0.0, strong);
  if (!run.ok()) return run.faults();
  FosStart& s = run.value().start;
  if (!run.value().rests) {
    s.status = FosStatus::unstable;
    s.message = fmt::format(
        "the model finds no rest however strong its joints are: {}; hold what falls, or see what "
        "it stands on",
        run.value().says);
  } else if (!loose_ones(s.sim).empty()) {
    s.warnings.push_back("with joints that do not give way, " + run.value().says +
                         "; the factor is that of all others");
  }
  return std::move(s);
}

}  // namespace

Loading loading_of(const Fos& fos, const Model& model, const Loading& given, double factor) {
  Loading to = given;
  if (fos.varied != Varied::strength) {
    to.multiplier = factor;
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

Result<FosStart> start_trials(const Model& model, const Fos& fos, const FosOptions& options) {
  if (auto fault = refused(model, fos)) return *fault;
  Result<FosStart> made = at_rest(model, fos, options);
  if (!made.ok()) return made;
  FosStart& s = made.value();
  if (s.status != FosStatus::found) return made;
  const bool shaken = fos.varied == Varied::shaking;
  const Loading to = loading_of(fos, model, s.given, shaken ? 0.0 : 1.0);
  Simulation as_given = s.sim;
  Trial trial = run_trial(as_given, s.plan, s.loading, to, [&] { return stopped(options); });
  trial.factor = 1.0;
  if (trial.end == TrialEnd::stopped) {
    s.status = FosStatus::interrupted;
    return made;
  }
  if (trial.end == TrialEnd::holds) {
    s.sim = std::move(as_given);
    s.loading = to;
    if (!shaken) s.seen.push_back(trial);
    return made;
  }
  if (shaken) {
    s.status = FosStatus::unstable;
    s.message = "the model does not stand without the shaking: " +
                still_moving(as_given, balance_of(as_given));
    return made;
  }
  s.seen.push_back(trial);
  s.failed = std::move(as_given);
  return made;
}

}  // namespace edda
