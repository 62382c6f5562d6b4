// A model as drawn, with what its stages change.
#pragma once

#include "run/run_model.hpp"

namespace edda {

/// The model as drawn, with the changes of all stages up to fos.stage (empty: all of them). Faults:
/// those of prepare_run().
Result<PreparedRun> as_staged(const Model& model, const Fos& fos);

}  // namespace edda
