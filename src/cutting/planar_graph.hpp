// Noded edges as a planar graph with faces.
//
// Notation: e an edge; h a half-edge, 2e (from edge[e].from) or 2e + 1 (back again), h ^ 1 its
// twin. The face of h lies on its left. A cycle is what next[] runs through; each face has one
// outer cycle, counter-clockwise, and one more, clockwise, per component of the graph that lies
// isolated in it. Face 0 is the unbounded one.
#pragma once

#include <cstdint>
#include <vector>

#include "base/vec2.hpp"
#include "cutting/noding.hpp"

namespace edda {

/// One edge between two nodes; where sources coincide, the first in precedence.
struct GraphEdge {
  int from = 0, to = 0;
  Index source = 0;
};

/// How often an outline or opening runs along an edge: +1 per passage from -> to, -1 per passage
/// back. Crossing the edge from right to left changes the winding of that ring by `net`.
struct RingPassage {
  int edge = 0;
  Index source = 0;
  int net = 0;  ///< never 0
};

struct PlanarGraph {
  std::vector<Vec2> node;  ///< in order of x, then y; m, local
  std::vector<GraphEdge> edge;
  std::vector<RingPassage> passages;  ///< grouped by source
  std::vector<std::uint8_t> alive;    ///< per edge; others count as removed
};

/// Nodes, edges and half-edges are counted by int, arrays by std::size_t.
inline std::size_t at(int i) {
  return static_cast<std::size_t>(i);
}

inline int origin_of(const PlanarGraph& g, int h) {
  const GraphEdge& e = g.edge[at(h / 2)];
  return h % 2 == 0 ? e.from : e.to;
}

inline int target_of(const PlanarGraph& g, int h) {
  return origin_of(g, h ^ 1);
}

/// Joins the edges that coincide. O(n log n).
PlanarGraph planar_graph(NodedLines lines, const std::vector<LineSource>& sources);

/// Removes edges with a free end until none is left. Returns the nodes that were free ends at
/// first.
std::vector<int> trim_free_ends(PlanarGraph& graph);

/// The next half-edge along the cycle of each half-edge, -1 on removed edges; and the cycle of each
/// half-edge.
struct Cycles {
  std::vector<int> next;
  std::vector<int> cycle;    ///< -1 on removed edges
  std::vector<int> start;    ///< per cycle one half-edge of it
  std::vector<int> outward;  ///< per component: the cycle on its outside
};

/// Orders the half-edges around every node by exact orientation tests. O(n log n).
Cycles trace_cycles(const PlanarGraph& graph);

/// Removes bridges, edges with both sides on one cycle: they are the only connection of two parts
/// of the graph. Precondition: no free ends. Returns one edge of each connected run of them.
std::vector<int> remove_bridges(PlanarGraph& graph, const Cycles& cycles);

struct Faces {
  Cycles cycles;
  std::vector<int> of_cycle;  ///< face per cycle
  std::vector<int> outer;     ///< per face its outer cycle; -1 for face 0
  std::vector<int> hole_begin,
      hole;  ///< cycles hole[hole_begin[f] .. hole_begin[f + 1]) of components isolated in face f
};

inline int face_of(const Faces& faces, int h) {
  return faces.of_cycle[static_cast<std::size_t>(faces.cycles.cycle[static_cast<std::size_t>(h)])];
}

/// Faces of a graph without free ends and bridges; isolated components are located by a ray from
/// their leftmost node to the left, among the edges of its strip.
Faces find_faces(const PlanarGraph& graph, Cycles cycles);

/// Marks the faces inside the ring given by `source` (result[f] = 1): floods from the left of its
/// passages, never across them.
std::vector<std::uint8_t> inside_ring(const PlanarGraph& graph, const Faces& faces, Index source);

/// Calls visit(h) for every half-edge of a face, outer cycle first.
template <class Visit>
void for_each_half_edge(const Faces& faces, int face, Visit visit) {
  const auto run = [&](int cycle) {
    const int start = faces.cycles.start[static_cast<std::size_t>(cycle)];
    int h = start;
    do {
      visit(h);
      h = faces.cycles.next[static_cast<std::size_t>(h)];
    } while (h != start);
  };
  const auto f = static_cast<std::size_t>(face);
  if (faces.outer[f] >= 0) run(faces.outer[f]);
  for (int i = faces.hole_begin[f]; i < faces.hole_begin[f + 1]; ++i) {
    run(faces.hole[static_cast<std::size_t>(i)]);
  }
}

}  // namespace edda
