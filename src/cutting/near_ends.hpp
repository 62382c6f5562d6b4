// Ends of lines that nearly reach another line: coordinates that were rounded in a file or by a
// survey end beside the line on which they ended.
#pragma once

#include <functional>
#include <vector>

#include "cutting/line_work.hpp"

namespace edda {

struct MovedCorners {
  std::size_t count = 0;
  double farthest = 0.0;  ///< m
};

/// Moves corners of traces and imported lines onto the line that they miss by no more than rounding
/// can have moved both, so that what met before the coordinates were rounded meets again. All lines
/// that share a corner move together; other lines do not move. Ends of imports with a snap of their
/// own move onto the nearest corner, else line, within it instead. Corners closer than `snap` to a
/// line stay: noding joins them. `framed`: the outline is only the box around the lines. Returns
/// what moved, per source. O(n log n).
std::vector<MovedCorners> join_rounded_corners(LineWork& work, double snap, bool framed);

/// The free end of a trace or of an imported line, and what it misses.
struct NearMiss {
  Vec2 at;           ///< m, local
  double gap = 0.0;  ///< m, distance to the nearest other line
  Index source = 0;
};

/// The free ends for which `in_rock` holds and that end less than `reach` short of another line, of
/// the sources that are `counted`. Ends that have crossed that line are none.
std::vector<NearMiss> near_misses(const LineWork& work, const std::vector<bool>& counted,
                                  double snap, double reach, bool framed,
                                  const std::function<bool(Vec2)>& in_rock);

}  // namespace edda
