// Grids of frames, made by hand.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "results/frames.hpp"
#include "results/grid.hpp"

namespace edda {

/// One block of a frame: its corners in the first frame, and whether it is held.
struct TestBlock {
  std::int32_t id = 0;
  std::vector<Vec2> corners;
  bool fixed = false;
  bool gone = false;  ///< its points are still there, its cell is not
};

using Moved = std::function<Vec2(const TestBlock&, Vec2)>;

/// The grid of these blocks: `place` says where a point of the first frame is, `displacement` what
/// the frame calls its displacement.
inline Grid frame_of(const std::vector<TestBlock>& blocks, const Moved& place,
                     const Moved& displacement) {
  Grid g;
  Field u{"displacement", 3, {}, {}, false}, id{"id", 1, {}, {}, true};
  Field material{"material", 1, {}, {}, true}, fixed{"fixed", 1, {}, {}, true};
  Field velocity{"velocity", 3, {}, {}, false}, stress{"stress", 6, {}, {}, false};
  Field rotation{"rotation", 1, {}, {}, false}, omega{"omega", 1, {}, {}, false};
  for (const TestBlock& b : blocks) {
    for (const Vec2 p : b.corners) {
      const Vec2 x = place(b, p), d = displacement(b, p);
      g.corners.push_back(static_cast<std::int64_t>(g.point_count()));
      g.points.insert(g.points.end(), {x.x, x.y, 0.0});
      u.values.insert(u.values.end(), {d.x, d.y, 0.0});
    }
    if (b.gone) {
      g.corners.resize(g.ends.empty() ? 0 : static_cast<std::size_t>(g.ends.back()));
      continue;
    }
    g.ends.push_back(static_cast<std::int64_t>(g.corners.size()));
    g.types.push_back(cell_type::polygon);
    const double n = b.id + 1.0;
    id.values.push_back(b.id);
    material.values.push_back(b.id % 2);
    fixed.values.push_back(b.fixed ? 1.0 : 0.0);
    velocity.values.insert(velocity.values.end(), {0.1 * n, -0.2 * n, 0.0});
    stress.values.insert(stress.values.end(), {-1e6 * n, 2e6 * n, 3e5 * n, 4e5 * n, 0.0, 0.0});
    rotation.values.push_back(0.01 * n);
    omega.values.push_back(-7.0 * n);
  }
  g.point_fields = {u};
  g.cell_fields = {id, material, fixed, velocity, stress, rotation, omega};
  return g;
}

inline Vec2 stays(const TestBlock&, Vec2 p) {
  return p;
}
inline Vec2 nothing(const TestBlock&, Vec2) {
  return {};
}

}  // namespace edda
