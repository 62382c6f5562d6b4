// Removes vertices on straight sides of a block, which would part a face in two there (theory,
// section 15.1).
#pragma once

#include <vector>

#include "base/polygon.hpp"
#include "model/model.hpp"

namespace edda {

/// Removes the vertices of `ring` between two edges of one law that turn by less than 90 degrees
/// and lie within `tolerance` (m) of the edge that takes their place; every removed vertex keeps
/// that distance from the final edge, however long the run. law[i] belongs to the edge from ring[i]
/// and follows. At least three vertices stay, vertices as near to a neighbour as eight times their
/// distance from the new edge stay, and a ring not much thicker than the tolerance stays as it is.
/// table: as law, but edges of several tables become one; it is that of the longest of them.
void remove_straight_runs(Ring& ring, std::vector<Index>& law, double tolerance,
                          std::vector<Index>* table = nullptr);

}  // namespace edda
