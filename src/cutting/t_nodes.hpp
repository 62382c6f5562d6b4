// Nodes within the edges of blocks that bend (theory, section 3.4): T-nodes at corners of
// neighbours that lie within an edge, since a straight edge between two corners cannot follow two
// neighbours that turn against each other; and across long blocks from these.
#pragma once

#include <functional>

#include "cutting/polygon_set.hpp"

namespace edda {

/// What a block may have of them.
struct TNodes {
  std::size_t most = 0;   ///< corners in all: it does without partners, or without any
  bool partners = false;  ///< nodes across from others
};

/// Adds them to each block as it may have them (row of PolygonSet::blocks). A corner within
/// `tolerance` (m) of the edge counts, if it is not nearer to either end than a twentieth of the
/// edge, and if its own edges do not both lie along the edge within 8 degrees. Where an edge is
/// longer than the block is thick, the edge across has a node opposite each of its own, unless it
/// has one nearer than half the thickness. Laws and order of the blocks do not change.
void add_t_nodes(PolygonSet& polygons, double tolerance,
                 const std::function<TNodes(std::size_t)>& may_have);

/// Gives the edges of a block further corners: those that `within` names for each, from its first
/// corner on, in their order.
void divide_edges(BlockPolygon& block, const std::function<std::vector<Vec2>(Vec2, Vec2)>& within);

}  // namespace edda
