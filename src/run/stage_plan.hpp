// The changes at the beginning of a stage, with names resolved to rows.
#pragma once

#include <optional>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "model/stage_names.hpp"

namespace edda {

struct Scene;
struct Simulation;

/// A stage, with the rows of the names in it.
struct StagePlan {
  Stage stage;
  std::size_t row = 0;                          ///< of Model::stages
  NamedRows off, on;                            ///< what it deactivates and activates
  std::vector<Index> bolts;                     ///< rows of all_bolts() that it installs
  std::vector<Index> linings;                   ///< rows of Model::linings that it installs
  std::vector<Index> fills;                     ///< rows of Model::fills that it places
  std::vector<Index> out;                       ///< openings and fills (Owners) that it excavates
  std::vector<std::pair<Index, double>> relax;  ///< the same, and the fraction of the forces on
                                                ///< their walls that it releases
};

/// The stages of a model in order; for a model without stages, the one stage that it consists of.
std::vector<StagePlan> plan_stages(const Model& model);

/// Makes the changes at the beginning of a stage of the model, between two steps; a ramp is at its
/// first value. After the `first`
/// stage, changes that have been made from outside are skipped. Fault: a bolt without rock at its
/// place, fill without room.
std::optional<Fault> enter_stage(Simulation& sim, const StagePlan& plan, bool first);

/// Changes of properties (stage.change) that would change nothing, in the blocks as drawn.
Faults idle_changes(const Scene& scene);
/// Makes those of the stages up to `stage` again, in the scene alone, for a run that goes on: its
/// faces come from a checkpoint.
void repeat_changes(Simulation& sim, const std::vector<StagePlan>& plans, std::size_t stage);

/// Brings the ramp of the stage to this value, gradually.
void set_ramp(Simulation& sim, const Stage& stage, double value);

}  // namespace edda
