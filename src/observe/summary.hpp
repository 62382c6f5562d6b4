// summary.json.
#pragma once

#include <string>
#include <vector>

#include "observe/outcome.hpp"
#include "step/simulation.hpp"

namespace edda {

/// A check for the engineer who signs the result.
struct Check {
  std::string name;
  double value = 0.0;
  std::optional<double> limit;  ///< none: for information only, always passed
  bool pass = true;
};

std::vector<Check> checks_of(const Simulation& sim, const Outcome& outcome);

/// The sentence for a check that fails.
std::string message_of(const Check& check, const Simulation& sim, const Outcome& outcome);

/// An input file of the run.
struct InputFile {
  std::string file, sha256;
};

std::string summary_json(const Simulation& sim, const Outcome& outcome,
                         const std::string& governed_by, const std::vector<InputFile>& inputs);

}  // namespace edda
