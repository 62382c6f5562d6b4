// A corner that leans on a floor with very many faces, and one with a wedge beside it.
#include <gtest/gtest.h>

#include "contacts/drifting_heap.hpp"

namespace edda {
namespace {

BlockPolygon polygon_of(const Ring& ring, bool fixed) {
  BlockPolygon p;
  p.rings = {ring};
  p.joint = {std::vector<Index>(ring.size(), none)};
  p.material = 0;
  p.fixed = fixed;
  return p;
}

/// A bar that is tilted by 10 degrees has sunk with one corner into the floor, on which `bricks`
/// more stand; a wedge fills the gap beneath it, or not. Whether the corner leans.
bool bar_leans(int bricks, bool wedge) {
  const double tilt = 10.0 / 180.0 * std::numbers::pi, depth = 1e-4;
  const auto placed = [&](Ring ring) {
    for (Vec2& p : ring) p = rotated(p, tilt) + Vec2{0.0, -depth};
    return ring;
  };
  PolygonSet set;
  set.blocks.push_back(
      polygon_of({{-1, -1}, {2.0 * bricks + 4.0, -1}, {2.0 * bricks + 4.0, 0}, {-1, 0}}, true));
  set.blocks.push_back(polygon_of(placed({{0, 0}, {1, 0}, {1, 0.2}, {0, 0.2}}), false));
  const Ring under{{0.03, 0.0}, {1.0, 0.0}, {1.0, std::tan(tilt)}, {0.03, 0.03 * std::tan(tilt)}};
  if (wedge) set.blocks.push_back(polygon_of(under, false));
  for (int i = 0; i < bricks; ++i) {
    const double x = 3.0 + 2.0 * i;
    set.blocks.push_back(polygon_of({{x, 0}, {x + 1, 0}, {x + 1, 0.5}, {x, 0.5}}, false));
  }
  DriftingHeap heap(set);
  heap.find(0.05);
  heap.alone.evaluate(heap.scene(), 1e-3);
  const FaceSet& c = heap.alone.faces;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id i = heap.blocks.vertex_block[c.edge[k]], j = heap.blocks.vertex_block[c.facing[k]];
    if (std::min(i, j) == 0 && std::max(i, j) == 1 && heap.alone.states.now[k].energy > 0.0)
      return c.leans(k);
  }
  ADD_FAILURE() << "the bar does not touch the floor";
  return false;
}

TEST(Floor, WithManyFacesTellsCornersThatLean) {
  for (const int bricks : {0, 600}) {
    EXPECT_TRUE(bar_leans(bricks, false)) << bricks;
    EXPECT_FALSE(bar_leans(bricks, true)) << bricks;
  }
}

}  // namespace
}  // namespace edda
