// Faces of blocks along a line.
#pragma once

#include <vector>

#include "attachments/boundary_lines.hpp"
#include "blocks/block_set.hpp"

namespace edda {

/// A part of an edge in its own coordinate s: 0 at its first vertex, 1 at its second.
struct Part {
  double from = 0.0, to = 0.0;
};

/// An edge on a segment, and its coordinates along the segment, m.
struct OnLine {
  Id edge;
  Part part;
  double low, high;
  bool along;  ///< runs in the direction of the segment
};

/// A part of one edge.
struct Piece {
  Id edge;
  Part part;
};

/// The part of edge v that lies on the segment from p to q, empty where it does not. Within `snap`,
/// m; local coordinates.
Part on_segment(const BlockSet& blocks, Id v, Vec2 p, Vec2 q, double snap);

/// All edges that lie on the segment from p to q, in part or whole.
std::vector<OnLine> edges_on(const BlockSet& blocks, Vec2 p, Vec2 q, double snap);

/// The remainder of `whole` without `taken`, in order.
std::vector<Part> without(Part whole, std::vector<Part> taken);

/// Parts of one face, in its own coordinate, that no face of another block but a lining covers.
std::vector<Part> free_parts(const std::vector<OnLine>& all, const OnLine& one,
                             const BlockSet& blocks, double snap);

/// Selects faces of blocks along a line: those that no other block covers, or all.
enum class WhichFaces { open, all };

/// Pieces of the faces of free blocks along the lines, by edge; each counts once, even if a line
/// turns back or touches an edge twice. `in_joints`: set where a face along the lines is wholly
/// covered.
std::vector<Piece> pieces_on(const BlockSet& blocks, const std::vector<Line>& lines,
                             WhichFaces faces, double snap, bool& in_joints);

}  // namespace edda
