// The equilibrium state from which the trials of a factor start.
#pragma once

#include "base/pace.hpp"
#include "run/run_model.hpp"
#include "study/fos.hpp"
#include "study/fos_rigid.hpp"

namespace edda {

/// A state in equilibrium, and its loading.
struct FosStart {
  Simulation sim;
  Loading given;  ///< loading of the model as given (without ground motion)
  TrialPlan plan;
  RigidLimit rigid;
  bool as_drawn = true;                 ///< the blocks stand where `rigid` has them
  std::vector<Trial> seen;              ///< the trial of the factor 1, where one was made
  FosStatus status = FosStatus::found;  ///< otherwise unstable or interrupted, with a message
  std::string message;
  std::optional<Simulation> failed;  ///< final state of the trial of the factor 1, where that
                                     ///< failed
  std::vector<std::string> warnings;
  bool wide = false;  ///< blocks may move by a tenth of their size at any factor
};

/// Loading of a trial of this factor, and how it is made.
Loading loading_of(const Fos& fos, const Model& model, const Loading& given, double factor);
TrialPlan plan_at(double factor, const FosStart& start);

/// Reports how far the trial of this factor is, where a line of progress is due.
void tell_progress(const FosOptions& options, Pace& pace, double factor, const Simulation& sim);

/// Brings the model to equilibrium. With stages: runs them to the end of the one named, and with a
/// thousand times the strength of the joints where they do not reach equilibrium otherwise. Without
/// stages: under gravity and loads, first with such joints, so that nothing slips or breaks on the
/// way, then with those given.
Result<FosStart> start_trials(const Model& model, const Fos& fos, const FosOptions& options);

}  // namespace edda
