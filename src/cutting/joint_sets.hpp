// The lines of one [[joint_set]].
#pragma once

#include "cutting/line_work.hpp"

namespace edda {

/// Adds the joints of `set` to `work`: persistent, or as traces with gaps between them, each
/// drawn from the means and deviations. They depend on the set's seed and name alone, not
/// on other sets, and, unless its origin lies a thousand traces or spacings away, not on the
/// domain. Returns false, having stopped, if they are more than `limit`. O(lines), and O(traces).
bool add_joint_set(LineWork& work, const JointSet& set, Index source, Vec2 origin, double snap,
                   double limit);

}  // namespace edda
