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

/// What a check says that does not hold.
std::string sentence_of(const Check& check, const Simulation& sim, const Outcome& outcome);

/// A file that the run was made from.
struct InputFile {
  std::string file, sha256;
};

std::string summary_json(const Simulation& sim, const Outcome& outcome,
                         const std::string& governed_by, const std::vector<InputFile>& inputs);

}  // namespace edda
