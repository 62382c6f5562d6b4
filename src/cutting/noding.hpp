// Noding: from line work to edges that meet only at their ends.
#pragma once

#include <vector>

#include "base/fault.hpp"
#include "base/vec2.hpp"
#include "cutting/line_work.hpp"

namespace edda {

/// A piece of line between two nodes, directed as its source runs. A piece on which several sources
/// coincide appears once for each.
struct NodedEdge {
  int from = 0, to = 0;  ///< nodes
  Index source = 0;
};

struct NodedLines {
  std::vector<Vec2> nodes;  ///< distinct, in order of x, then y; m, local
  std::vector<NodedEdge> edges;
  bool snap_rounded = false;  ///< snap rounding was needed, too
};

enum class Noding {
  automatic,  ///< snapping; snap rounding only if that leaves a crossing
  rounding    ///< snap rounding at once
};

/// Nodes all lines at the tolerance `snap` (m): snapping (snapping.hpp), checked by GEOS's
/// FastNodingValidator, else its SnapRoundingNoder, checked too. Fault at `where` if lines still
/// cross between nodes.
Result<NodedLines> node_lines(const LineWork& work, double snap, const Where& where,
                              Noding noding = Noding::automatic);

/// The noded edges as lines again, to be noded once more.
std::vector<LineString> line_strings(const NodedLines& lines);

}  // namespace edda
