// Directions in which a block can leave its neighbours (Goodman and Shi 1985, in two dimensions).
#pragma once

#include <span>

#include "base/vec2.hpp"

namespace edda {

/// Whether a block can move along `direction`: d.n <= 0 for all normals that point out of it into
/// what touches it. Faces count as parallel to it up to 1e-6 rad.
bool is_free(std::span<const Vec2> outward, Vec2 direction);

/// Whether there is any such direction. None: the block is tapered, or enclosed. The directions are
/// a convex cone, whose ends are along faces, so it is enough to try those; two parallel faces
/// leave one direction.
bool can_leave(std::span<const Vec2> outward);

}  // namespace edda
