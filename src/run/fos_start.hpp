// What the trials of a factor begin from: the model at rest.
#pragma once

#include "run/fos.hpp"
#include "run/run_model.hpp"

namespace edda {

/// A state at rest, and under what.
struct FosStart {
  Simulation sim;
  Loading loading;  ///< in force in it
  Loading given;    ///< of the model as it is (no shaking)
  TrialPlan plan;
  std::vector<Trial> seen;              ///< the trial of the factor 1, where one was made
  FosStatus status = FosStatus::found;  ///< else unstable or interrupted, with a message
  std::string message;
  std::optional<Simulation> failed;  ///< end of the trial of the factor 1, where that failed
  std::vector<std::string> warnings;
};

/// Loading of a trial of this factor.
Loading loading_of(const Fos& fos, const Model& model, const Loading& given, double factor);

/// Brings the model to rest. With stages: runs them to the end of the one named, or with joints of
/// a thousand times their strength where they find no rest as they are. Without: under gravity and
/// loads, with such joints first so that nothing slips or breaks on the way, then with those given.
Result<FosStart> start_trials(const Model& model, const Fos& fos, const FosOptions& options);

}  // namespace edda
