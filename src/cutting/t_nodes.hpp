// Nodes within the edges of blocks that bend (theory, section 3.4): T-nodes at corners of
// neighbours that lie within an edge, since a straight edge between two corners cannot follow two
// neighbours that turn against each other; and across long blocks from these.
#pragma once

#include <functional>

#include "cutting/polygon_set.hpp"

namespace edda {

/// Adds them to the blocks of which `bends` (row of PolygonSet::blocks) holds. A corner within
/// `tolerance` (m) of the edge counts, if it is not nearer to either end than a twentieth of the
/// edge, and if its own edges do not both lie along the edge within 8 degrees. Where an edge is
/// longer than the block is thick, the edge across has a node opposite each of its own, unless it
/// has one nearer than half the thickness. Laws and order of the blocks do not change. No block
/// gets more than `most` corners: it does without partners, or without any.
void add_t_nodes(PolygonSet& polygons, double tolerance, std::size_t most,
                 const std::function<bool(std::size_t)>& bends);

}  // namespace edda
