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
const auto all = [](std::size_t) { return TNodes{48, true}; };

/// Two bricks on one: the joint between them ends within its upper edge.
TEST(TNodes, AnEdgeHasOneWhereTwoNeighboursMeet) {
  PolygonSet set = of({{{0, -1}, {2, -1}, {2, 1}, {0, 1}},
                       {{0, 1}, {0.9, 1}, {0.9, 2}, {0, 2}},
                       {{0.9, 1}, {2, 1}, {2, 2}, {0.9, 2}}});
  set.blocks[0].table = {{4, 5, 6, 7}};
  add_t_nodes(set, 1e-9, all);
  const Ring expected{{0, -1}, {2, -1}, {2, 1}, {0.9, 1}, {0, 1}};
  EXPECT_EQ(set.blocks[0].rings[0], expected);
  const std::vector<Index> laws{0, 1, 2, 2, 3};
  EXPECT_EQ(set.blocks[0].joint[0], laws);
  const std::vector<Index> tables{4, 5, 6, 6, 7};
  EXPECT_EQ(set.blocks[0].table[0], tables);
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

/// A side of a neighbour that hardly turns meets the edge before and behind its corner.
TEST(TNodes, ACornerThatHardlyTurnsIsNone) {
  for (const double rise : {0.0, 0.01, 0.1, 0.3}) {
    PolygonSet set =
        of({{{0, -1}, {2, -1}, {2, 0}, {0, 0}}, {{-1, 0}, {1, 0}, {3, rise}, {3, 2}, {-1, 2}}});
    add_t_nodes(set, 1e-9, all);
    EXPECT_EQ(set.blocks[0].rings[0].size(), rise < 0.2 ? 4u : 6u) << rise << " over 2 m";
  }
}

/// A long block has nodes across from those at its neighbours; a thick one has none, nor has one
/// without such neighbours.
TEST(TNodes, LongBlocksHavePartners) {
  PolygonSet set = of({{{-2, -1}, {4, -1}, {4, 0}, {-2, 0}}, {{0.1, 0}, {2, 0}, {2, 1}, {0.1, 1}}});
  add_t_nodes(set, 1e-9, all);
  const Ring expected{{-2, -1}, {0.1, -1}, {2, -1}, {4, -1}, {4, 0}, {2, 0}, {0.1, 0}, {-2, 0}};
  ASSERT_EQ(set.blocks[0].rings[0].size(), expected.size());
  for (std::size_t v = 0; v < expected.size(); ++v)
    EXPECT_NEAR(norm(set.blocks[0].rings[0][v] - expected[v]), 0.0, 1e-12) << v;
  PolygonSet thick =
      of({{{-2, -5}, {4, -5}, {4, 0}, {-2, 0}}, {{0.1, 0}, {2, 0}, {2, 1}, {0.1, 1}}});
  add_t_nodes(thick, 1e-9, all);
  EXPECT_EQ(thick.blocks[0].rings[0].size(), 6u);
  PolygonSet alone = of({{{0, 0}, {100, 0}, {100, 1}, {0, 1}}});
  add_t_nodes(alone, 1e-9, all);
  EXPECT_EQ(alone.blocks[0].rings[0].size(), 4u);
}

/// Neighbours nearer to each other than half the thickness share a partner.
TEST(TNodes, PartnersKeepApart) {
  PolygonSet set =
      of({{{-20, -4}, {20, -4}, {20, 0}, {-20, 0}}, {{-1.5, 0}, {1.5, 0}, {1.5, 1}, {-1.5, 1}}});
  add_t_nodes(set, 1e-9, all);
  EXPECT_EQ(set.blocks[0].rings[0].size(), 4u + 2u + 2u);
  PolygonSet near =
      of({{{-20, -4}, {20, -4}, {20, 0}, {-20, 0}}, {{-0.9, 0}, {0.9, 0}, {0.9, 1}, {-0.9, 1}}});
  add_t_nodes(near, 1e-9, all);
  EXPECT_EQ(near.blocks[0].rings[0].size(), 4u + 1u + 1u);
}

/// A block that would have more corners than may bend does without partners, or without nodes.
TEST(TNodes, NoBlockHasMoreThanMayBend) {
  const PolygonSet drawn =
      of({{{-20, -4}, {20, -4}, {20, 0}, {-20, 0}}, {{-4, 0}, {4, 0}, {4, 1}, {-4, 1}}});
  for (const auto& [most, corners] : {std::pair{8u, 8u}, {7u, 6u}, {6u, 6u}, {5u, 4u}}) {
    PolygonSet set = drawn;
    add_t_nodes(set, 1e-9, [limit = most](std::size_t) { return TNodes{limit, true}; });
    EXPECT_EQ(set.blocks[0].rings[0].size(), corners) << most;
  }
}

TEST(TNodes, OnlyBlocksThatBendHaveThem) {
  PolygonSet set =
      of({{{0, -1}, {2, -1}, {2, 1}, {0, 1}}, {{0.5, 1}, {1.5, 1}, {1.5, 2}, {0.5, 2}}});
  add_t_nodes(set, 1e-9, [](std::size_t i) { return i == 1 ? TNodes{48, true} : TNodes{}; });
  EXPECT_EQ(set.blocks[0].rings[0].size(), 4u);
  add_t_nodes(set, 1e-9, all);
  EXPECT_EQ(set.blocks[0].rings[0].size(), 6u);
}

/// A meshed block has nodes at its neighbours' corners alone.
TEST(TNodes, WithoutPartnersNoneAreAcross) {
  PolygonSet set =
      of({{{-20, -4}, {20, -4}, {20, 0}, {-20, 0}}, {{-4, 0}, {4, 0}, {4, 1}, {-4, 1}}});
  add_t_nodes(set, 1e-9, [](std::size_t) { return TNodes{1000, false}; });
  EXPECT_EQ(set.blocks[0].rings[0].size(), 6u);
}

TEST(DividedEdges, KeepTheirJointsAndTables) {
  PolygonSet set = of({{{0, 0}, {3, 0}, {3, 1}, {0, 1}}});
  set.blocks[0].table = {{4, 5, 6, 7}};
  divide_edges(set.blocks[0], [](Vec2 from, Vec2 to) {
    std::vector<Vec2> points;
    if (norm(to - from) > 2.0) points = {from + (to - from) / 3.0, from + 2.0 / 3.0 * (to - from)};
    return points;
  });
  const Ring expected{{0, 0}, {1, 0}, {2, 0}, {3, 0}, {3, 1}, {2, 1}, {1, 1}, {0, 1}};
  ASSERT_EQ(set.blocks[0].rings[0].size(), expected.size());
  for (std::size_t k = 0; k < expected.size(); ++k)
    EXPECT_NEAR(norm(set.blocks[0].rings[0][k] - expected[k]), 0.0, 1e-12);
  EXPECT_EQ(set.blocks[0].joint[0], (std::vector<Index>{0, 0, 0, 1, 2, 2, 2, 3}));
  EXPECT_EQ(set.blocks[0].table[0], (std::vector<Index>{4, 4, 4, 5, 6, 6, 6, 7}));
}

/// A long edge across many small blocks, drawn at an angle, and the corner of every one of them.
TEST(TNodes, ALongEdgeHasOneAtEveryNeighbour) {
  const Vec2 along{0.8, 0.6}, up{-0.6, 0.8};
  const auto at = [&](double s, double t) { return s * along + t * up; };
  std::vector<Ring> rings{{at(0, -1), at(19, -1), at(19, 0), at(0, 0)}};
  for (int k = 0; k < 19; ++k) rings.push_back({at(k, 0), at(k + 1, 0), at(k + 1, 1), at(k, 1)});
  PolygonSet set = of(rings);
  add_t_nodes(set, 1e-9, all);
  EXPECT_EQ(set.blocks[0].rings[0].size(), 4u + 18u + 18u) << "and as many below";
}

}  // namespace
}  // namespace edda::t_nodes_test
