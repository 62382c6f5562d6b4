// Which columns of a history are drawn, and which of them together.
#pragma once

#include <string>
#include <vector>

#include "base/fault.hpp"
#include "results/read_table.hpp"

namespace edda {

/// Lines that share an axis.
struct HistoryPanel {
  std::string label;                 ///< "displacement"
  std::string unit;                  ///< "m"
  std::vector<const Column*> lines;  ///< of the table
};

/// `names`: columns of history.csv; a monitor or convergence line for all columns of it; "energy"
/// for those terms of the energy balance that are visible beside the largest. Panels in the order
/// in which they are first named. Faults list the names that exist.
Result<std::vector<HistoryPanel>> history_panels(const Table& history,
                                                 const std::vector<std::string>& names);

}  // namespace edda
