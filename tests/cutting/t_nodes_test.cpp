// Corners of neighbours within an edge.
#include "cutting/t_nodes.hpp"

#include <gtest/gtest.h>

namespace edda::t_nodes_test {
namespace {

PolygonSet of(const std::vector<Ring>& rings) {
  PolygonSet set;
  for (const Ring& ring : rings) {
    BlockPolygon p;
    p.rings = {ring};
    for (std::size_t e = 0; e < ring.size(); ++e) {
      if (e == 0) p.joint.emplace_back();
      p.joint[0].push_back(static_cast<Index>(e));
    }
    set.blocks.push_back(p);
  }
  return set;
}
const auto all = [](std::size_t) { return true; };

/// Two bricks on one: the joint between them ends within its upper edge.
TEST(TNodes, AnEdgeHasOneWhereTwoNeighboursMeet) {
  PolygonSet set = of({{{0, -1}, {2, -1}, {2, 1}, {0, 1}},
                       {{0, 1}, {0.9, 1}, {0.9, 2}, {0, 2}},
                       {{0.9, 1}, {2, 1}, {2, 2}, {0.9, 2}}});
  add_t_nodes(set, 1e-9, all);
  const Ring expected{{0, -1}, {2, -1}, {2, 1}, {0.9, 1}, {0, 1}};
  EXPECT_EQ(set.blocks[0].rings[0], expected);
  const std::vector<Index> laws{0, 1, 2, 2, 3};
  EXPECT_EQ(set.blocks[0].joint[0], laws);
  EXPECT_EQ(set.blocks[1].rings[0].size(), 4u);
  EXPECT_EQ(set.blocks[2].rings[0].size(), 4u);
}

TEST(TNodes, CornersElsewhereAreNone) {
  // Beside the edge, at its end, beyond it, and hardly within it.
  PolygonSet set = of({{{0, -1}, {2, -1}, {2, 1}, {0, 1}},
                       {{0.5, 1.001}, {1.5, 1.001}, {1.5, 2}, {0.5, 2}},
                       {{2, 1}, {3, 1}, {3, 2}, {2, 2}},
                       {{-1, 1}, {0.05, 1}, {0.05, 2}, {-1, 2}}});
  const PolygonSet before = set;
  add_t_nodes(set, 1e-9, all);
  EXPECT_EQ(set.blocks[0].rings, before.blocks[0].rings);
}

/// A long block has nodes all along, beside those at its neighbours; a square has none.
TEST(TNodes, LongEdgesAreDivided) {
  PolygonSet set = of({{{-2, -1}, {4, -1}, {4, 0}, {-2, 0}}, {{0.1, 0}, {1, 0}, {1, 1}, {0.1, 1}}});
  add_t_nodes(set, 1e-9, all);
  const Ring expected{{-2, -1}, {-1, -1}, {0, -1}, {1, -1}, {2, -1},  {3, -1}, {4, -1},
                      {4, 0},   {3, 0},   {2, 0},  {1, 0},  {0.1, 0}, {-1, 0}, {-2, 0}};
  ASSERT_EQ(set.blocks[0].rings[0].size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v)
    EXPECT_NEAR(norm(set.blocks[0].rings[0][v] - expected[v]), 0.0, 1e-12) << v;
  PolygonSet square = of({{{0, 0}, {1, 0}, {1, 1}, {0, 1}}});
  add_t_nodes(square, 1e-9, all);
  EXPECT_EQ(square.blocks[0].rings[0].size(), 4u);
  PolygonSet thin = of({{{0, 0}, {100, 0}, {100, 1}, {0, 1}}});
  add_t_nodes(thin, 1e-9, all);
  EXPECT_EQ(thin.blocks[0].rings[0].size(), 4u + 2u * 9u) << "ten pieces at most";
}

TEST(TNodes, OnlyBlocksThatBendHaveThem) {
  PolygonSet set =
      of({{{0, -1}, {2, -1}, {2, 1}, {0, 1}}, {{0.5, 1}, {1.5, 1}, {1.5, 2}, {0.5, 2}}});
  add_t_nodes(set, 1e-9, [](std::size_t i) { return i == 1; });
  EXPECT_EQ(set.blocks[0].rings[0].size(), 4u);
  add_t_nodes(set, 1e-9, all);
  EXPECT_EQ(set.blocks[0].rings[0].size(), 6u);
}

/// A long edge across many small blocks, drawn at an angle, and the corner of every one of them.
TEST(TNodes, ALongEdgeHasOneAtEveryNeighbour) {
  const Vec2 along{0.8, 0.6}, up{-0.6, 0.8};
  const auto at = [&](double s, double t) { return s * along + t * up; };
  std::vector<Ring> rings{{at(0, -1), at(19, -1), at(19, 0), at(0, 0)}};
  for (int k = 0; k < 19; ++k) rings.push_back({at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1)});
  PolygonSet set = of(rings);
  add_t_nodes(set, 1e-9, all);
  EXPECT_EQ(set.blocks[0].rings[0].size(), 4u + 18u + 9u) << "and ten pieces below";
}

}  // namespace
}  // namespace edda::t_nodes_test
