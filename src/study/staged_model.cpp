#include "study/staged_model.hpp"

#include "model/stage_names.hpp"
#include "run/stage_plan.hpp"
#include "step/relaxation.hpp"

namespace edda {

Result<PreparedRun> as_staged(const Model& model, const Fos& fos) {
  Result<PreparedRun> made = prepare_run(model, BlockOrder::as_cut, ReadFor::no_run);
  if (!made.ok() || model.stages.empty()) return made;
  const std::vector<StagePlan> plans = plan_stages(model);
  const std::size_t last =
      fos.stage.empty() ? plans.size() - 1 : stage_called(model, fos.stage).value_or(0);
  for (std::size_t q = 0; q <= last; ++q) {
    Simulation& sim = made.value().sim;
    if (auto fault = enter_stage(sim, plans[q], q == 0)) return *fault;
    const Stage& stage = plans[q].stage;
    // A ramp until collapse does not reach its last value.
    if (stage.ramp && stage.until != StageEnd::collapse)
      set_ramp(sim, stage, stage.ramp->what.range->y);
    end_hold(sim);
  }
  return made;
}

}  // namespace edda
