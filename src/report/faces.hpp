// Faces between blocks as pictures show them: their drawn positions and the pressure on them.
#pragma once

#include <vector>

#include "base/vec2.hpp"
#include "results/grid.hpp"

namespace edda {

/// The overlap of two edges. Pressures are linear along the part that carries: a trapezoid, or a
/// triangle where one end is open.
struct DrawnFace {
  Vec2 a, b;                                  ///< ends as drawn, m
  double pressure_a = 0.0, pressure_b = 0.0;  ///< Pa, positive in compression
  double closed = 1.0;                        ///< fraction of the length that carries
  bool open = false;
};

/// A face per cell of the contacts; none where the frame does not have the ends of faces.
std::vector<DrawnFace> drawn_faces(const Grid& contacts);

/// The same, displacements drawn `scale` times as large: ends lie on their block j and move with
/// it.
std::vector<DrawnFace> drawn_faces(const Grid& contacts, const Grid& blocks, double scale);

/// Part of the diagram of a face: all in compression, or all in tension.
struct PressureArea {
  std::vector<Vec2> ring;  ///< from the face out and back to it, m
  bool tension = false;
};

/// The diagram of the pressure on a face, across it: compression on its upper side (of a steep one
/// on the left), tension on the other. `per_unit`: m per Pa; `most`: larger pressures are cut
/// there, Pa.
std::vector<PressureArea> pressure_diagram(const DrawnFace& face, double per_unit, double most);

}  // namespace edda
