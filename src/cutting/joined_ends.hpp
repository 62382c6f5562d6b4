// What becomes of ends that nearly reach a line, with a report of it.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "cutting/line_work.hpp"

namespace edda {

struct JoinedEnds {
  std::vector<std::string> notes;     ///< per table of the model: how many corners were moved
  std::vector<std::string> warnings;  ///< per table: ends that miss a line, and the snap for them
};

/// Moves what rounding has moved (join_rounded_corners() in near_ends.hpp) and looks for what still
/// ends close to a line. `origin`: model coordinates of the local origin.
JoinedEnds join_ends(const Model& model, LineWork& work, double snap, bool framed, Vec2 origin,
                     const std::function<bool(Vec2)>& in_rock);

/// Per source: below which width a face between traces or imported lines is none; 0 for others.
/// Lines that ran through one point, or coincided, before their coordinates were rounded bound
/// faces up to about this wide.
std::vector<double> widths_of_rounding(const LineWork& work);

}  // namespace edda
