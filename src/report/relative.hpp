// A frame as seen from a point that moves with the blocks.
#pragma once

#include "report/plot.hpp"

namespace edda {

/// Subtracts from all positions and displacements of a frame, before it has a field, the
/// displacement of the material point that was at `start`, so that this point does not move. False
/// where no block contains the point.
bool move_with(Snapshot& shot, Vec2 start);

}  // namespace edda
