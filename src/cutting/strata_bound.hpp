// The lines of a [[joint_set]] whose joints run from one bed to the next.
#pragma once

#include "cutting/line_work.hpp"

namespace edda {

/// Adds the joints of `set` to `work`, each from a joint of `beds` to the next one. Layer k, above
/// bed k, has the joints of the set shifted by k times its stagger along the beds; with deviations
/// each layer has its own. Returns false, having stopped, if they are more than `limit`.
bool add_strata_bound(LineWork& work, const JointSet& set, const JointSet& beds, Index source,
                      Vec2 origin, double snap, double limit);

}  // namespace edda
