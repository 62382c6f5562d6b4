// Nodes within the edges of blocks that bend (theory, section 3.4): T-nodes at corners of
// neighbours that lie within an edge, since a straight edge between two corners cannot follow two
// neighbours that turn against each other; and nodes along long blocks.
#pragma once

#include <functional>

#include "cutting/polygon_set.hpp"

namespace edda {

/// Adds them to the blocks of which `bends` (row of PolygonSet::blocks) holds. A corner within
/// `tolerance` (m) of the edge counts, if it is not nearer to either end than a twentieth of the
/// edge. Edges that are longer than the block is thick are divided, too. Laws and order of the
/// blocks do not change.
void add_t_nodes(PolygonSet& polygons, double tolerance,
                 const std::function<bool(std::size_t)>& bends);

}  // namespace edda
