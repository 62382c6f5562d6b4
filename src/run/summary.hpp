// summary.json.
#pragma once

#include <string>
#include <vector>

#include "run/outcome.hpp"
#include "run/simulation.hpp"

namespace edda {

/// What an engineer must look at before signing.
struct Check {
  std::string name;
  double value = 0.0;
  std::optional<double> limit;  ///< none: for information, always passed
  bool pass = true;
};

std::vector<Check> checks_of(const Simulation& sim, const Outcome& outcome);

/// input_hash: sha256 of the model file, empty where there is none.
std::string summary_json(const Simulation& sim, const Outcome& outcome,
                         const std::string& governed_by, const std::string& input_hash);

}  // namespace edda
