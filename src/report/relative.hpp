// A frame as seen from a point that moves with the blocks.
#pragma once

#include "report/plot.hpp"

namespace edda {

/// Takes from all places and displacements of a frame, before it has a field, what the material
/// point has moved that was at `start`, so that this one stays. False where no block holds the
/// point.
bool move_with(Snapshot& shot, Vec2 start);

}  // namespace edda
