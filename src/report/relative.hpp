// A frame as seen from a point that moves with the blocks.
#pragma once

#include <string>

#include "report/plot.hpp"
#include "results/read_table.hpp"

namespace edda {

/// Subtracts from all positions and displacements of a frame, before it has a field, the
/// displacement of the material point that was at `start`, so that this point does not move. False
/// where no block contains the point.
bool move_with(Snapshot& shot, Vec2 start);

/// Subtracts the displacement, velocity and acceleration of a monitor from those of all monitors of
/// a history. False where the history has no such monitor.
bool move_with(Table& history, const std::string& monitor);

}  // namespace edda
