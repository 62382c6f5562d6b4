// Studies of a model as a whole: warnings, factor of safety, error bars.
#include <omp.h>

#include "library/impl.hpp"
#include "run/check_model.hpp"
#include "study/fos.hpp"
#include "study/limit_analysis.hpp"
#include "study/verify_model.hpp"

namespace edda::api {
namespace {

PreparedRun prepared(const Model& model) {
  use_threads();
  check_memory(model.impl().model);
  return value_or_raise(prepare_run(model.impl().model));
}

FosTrial trial_of(const Trial& t) {
  return {t.factor,
          t.end == TrialEnd::holds,
          t.reason,
          t.displacement,
          t.block == no_id ? -1 : static_cast<std::int32_t>(t.block),
          t.velocity,
          t.time};
}

}  // namespace

const std::vector<std::string>& Model::warnings() const {
  const std::lock_guard lock(impl_->asking);
  if (!impl_->warnings) impl_->warnings = prepared(*this).warnings;
  return *impl_->warnings;
}

ModelCheck check(const Model& model) {
  PreparedRun run = prepared(model);
  const edda::ModelCheck found = check_model(run.sim);
  ModelCheck result;
  result.blocks = run.sim.scene->blocks.size();
  result.held = found.fixed;
  result.contacts = found.closed;
  result.critical_step = found.critical_step;
  result.time_step = found.step;
  result.steps = found.steps;
  result.at_most = found.at_most;
  result.steps_per_second = found.rate;
  result.governed_by = run.governed_by;
  result.loads = found.loads;
  result.initial_stress = found.initial_stress;
  result.strain_damping = found.strain_damping;
  result.warnings = run.warnings;
  return result;
}

FactorOfSafety fos(const Model& model, const std::atomic<bool>* stop) {
  use_threads();
  check_memory(model.impl().model);
  FosOptions options;
  options.threads = omp_get_max_threads();
  options.stop = stop;
  const FosResult found = value_or_raise(find_factor(model.impl().model, options));
  FactorOfSafety result;
  result.status = fos_status_name(found.status);
  result.message = found.message;
  result.factor = found.factor;
  result.holds = found.holds;
  result.fails = found.fails;
  if (found.mechanism) result.mechanism = found.mechanism->text;
  for (const Trial& t : found.trials) result.trials.push_back(trial_of(t));
  result.warnings = found.warnings;
  result.wall_seconds = found.seconds;
  return result;
}

LimitLoad limit(const Model& model) {
  use_threads();
  check_memory(model.impl().model);
  const LimitResult found = value_or_raise(limit_analysis(model.impl().model));
  const auto lower_of = [](const LimitValue& value) {
    return value.status == LimitEnd::found ? std::optional<double>(value.lower) : std::nullopt;
  };
  LimitLoad result;
  result.status = limit_end_name(found.largest.status);
  result.message = found.message;
  result.limit = lower_of(found.largest);
  if (result.limit) result.upper = found.largest.upper;
  if (found.smallest) result.other_end = lower_of(*found.smallest);
  result.without_dilation = found.without_dilation;
  result.residual = found.residual;
  if (found.mechanism) result.mechanism = found.mechanism->text;
  for (const ContactRecord& c : found.forces) {
    result.joints.push_back({c.block_i, c.block_j, std::string(c.joint), c.position.x, c.position.y,
                             c.force.x, c.force.y, c.normal_force, c.mobilised});
  }
  result.warnings = found.warnings;
  result.wall_seconds = found.seconds;
  return result;
}

Verification verify(const Model& model, const std::atomic<bool>* stop) {
  use_threads();
  check_memory(model.impl().model);
  VerifyOptions options;
  options.threads = omp_get_max_threads();
  options.stop = stop;
  const edda::Verification found = value_or_raise(verify_model(model.impl().model, options));
  Verification result;
  for (const MonitorBar& m : found.monitors) {
    result.monitors.push_back(
        {m.name, m.displacement.x, m.displacement.y, m.step, m.stiffness, m.order});
  }
  result.time = found.time;
  result.largest_drift = found.largest_energy_error;
  result.failed = found.failed;
  return result;
}

}  // namespace edda::api
