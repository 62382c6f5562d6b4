// How a run ended, and what it cost.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "run/ledger.hpp"

namespace edda {

enum class Status { completed, equilibrium, collapsed, interrupted, failed };

constexpr std::string_view status_name(Status status) {
  constexpr std::string_view names[] = {"completed", "equilibrium", "collapsed", "interrupted",
                                        "failed"};
  return names[static_cast<int>(status)];
}

/// Wall time, s. search, forces and integrate share out the time of all steps as sampled by
/// StageClock.
struct WallSeconds {
  double total = 0.0, cut = 0.0, search = 0.0, forces = 0.0, integrate = 0.0, output = 0.0;
  double stepping = 0.0;  ///< all steps together
};

struct Outcome {
  Status status = Status::completed;
  std::string message;  ///< one sentence; of a failure: block, place, time, likely cause
  double time = 0.0;    ///< s reached
  std::uint64_t steps = 0;
  std::size_t contacts = 0;         ///< closed at the end
  Ledger ledger;                    ///< at the last row
  double largest_drift = 0.0;       ///< of all rows, in size
  double unbalanced = 0.0;          ///< at the last row
  double overlap_over_edge = 0.0;   ///< largest, over the smallest edge of the two blocks
  double critical_step = 0.0;       ///< s: the smallest bound of the run
  double step_over_critical = 0.0;  ///< largest step over the bound then in force
  double reaction_error =
      0.0;  ///< |boundary reactions + weight| over weight at the last row; 0 without either
  std::size_t on_nothing = 0;              ///< blocks that rested on nothing at the start
  std::vector<std::string> failed_checks;  ///< of summary.json, a sentence each
  WallSeconds wall;
};

}  // namespace edda
