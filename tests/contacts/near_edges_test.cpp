// Pairs of edges near each other are the same whether they are found anew or taken from those of a
// wider reach, and are those that a search of all pairs gives.
#include "contacts/near_edges.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <vector>

#include "contacts/drifting_heap.hpp"

namespace edda {
namespace {

double distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = b - a;
  const double s = std::clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0);
  return norm(p - (a + s * u));
}

/// Overlap along the bisector of two edges where f lies behind e in part of it; none otherwise. The
/// plane is turned until the bisector is the x axis, with the block of e above it.
std::optional<double> overlap_behind(Vec2 p1, Vec2 p2, Vec2 q1, Vec2 q2) {
  const Vec2 along = unit(unit(p2 - p1) - unit(q2 - q1));
  const double turn = -std::atan2(along.y, along.x);
  for (Vec2* p : {&p1, &p2, &q1, &q2}) *p = rotated(*p, turn);
  if (!(p1.x < p2.x && q2.x < q1.x)) return {};
  const double from = std::max(p1.x, q2.x), to = std::min(p2.x, q1.x);
  const auto height = [](Vec2 a, Vec2 b, double x) {
    return a.y + (b.y - a.y) * (x - a.x) / (b.x - a.x);
  };
  const auto behind = [&](double x) { return height(q2, q1, x) > height(p1, p2, x); };
  if (!behind(from) && !behind(to)) return {};
  return to - from;
}

/// Pairs of edges that lie within this reach and are opposed as they stand, or nearly so.
std::vector<EdgePair> brute_force(const DriftingHeap& heap, Reach reach) {
  const BlockSet& b = heap.blocks;
  const Pose& pose = heap.pose;
  std::vector<EdgePair> pairs;
  for (Id e = 0; e < b.vertex_count(); ++e) {
    for (Id f = e + 1; f < b.vertex_count(); ++f) {
      const Id i = b.vertex_block[e], j = b.vertex_block[f];
      if (i == j || heap.state.alive[i] == 0 || heap.state.alive[j] == 0 ||
          (b.fixed[i] != 0 && b.fixed[j] != 0))
        continue;
      const Vec2 p1 = at(pose.x, pose.y, e), p2 = at(pose.x, pose.y, b.next[e]);
      const Vec2 q1 = at(pose.x, pose.y, f), q2 = at(pose.x, pose.y, b.next[f]);
      double within = reach.apart;
      if (const auto overlap = overlap_behind(p1, p2, q1, q2))
        within += 2.0 * std::clamp(*overlap + reach.apart, 0.0, reach.behind);
      const bool near = std::min({distance(p1, q1, q2), distance(p2, q1, q2), distance(q1, p1, p2),
                                  distance(q2, p1, p2)}) < within;
      const double le = norm(p2 - p1), lf = norm(q2 - q1);
      const double cosine =
          -dot(p2 - p1, q2 - q1) / (le * lf) + reach.apart / le + reach.apart / lf;
      if (near && cosine > angle_gate(b, e, f).none) pairs.push_back({e, f});
    }
  }
  return pairs;
}

TEST(NearEdges, AreThoseOfASearchOfAllPairsWhateverIsKnown) {
  std::size_t total = 0, from_store = 0, deeper = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    std::mt19937 rng(seed);
    DriftingHeap heap(odd_polygons(rng, 40));
    heap.state.alive[3] = 0;
    const Reach reach(0.05, seed % 2 == 0 ? 0.0 : 0.04);
    NearEdges known;
    for (int move = 0; move < 60; ++move) {
      const std::uint64_t lists = known.lists;
      const std::vector<EdgePair> pairs =
          edges_within(known, heap.blocks, heap.state, heap.pose, reach);
      ASSERT_EQ(pairs, brute_force(heap, reach)) << "seed " << seed << ", move " << move;
      total += pairs.size();
      if (reach.behind > 0.0) deeper += pairs.size() - brute_force(heap, reach.apart).size();
      from_store += known.lists == lists ? 1 : 0;
      heap.move_at_random(rng, 0.02);
    }
    EXPECT_GT(known.lists, 2u);
  }
  EXPECT_GT(total, 1000u);
  EXPECT_GT(deeper, 100u);
  EXPECT_GT(from_store, 200u);
}

/// A block lies on the end of another, presses 0.02 into it, and itself ends so far from its end.
/// The two ends overlap by those 0.02 along each other, and act once they are within 0.04.
bool ends_are_near(double inside, const Reach& reach) {
  PolygonSet set;
  for (const Ring& ring : {Ring{{0, 0}, {2, 0}, {2, 1}, {0, 1}},
                           Ring{{2 - inside, 0.98}, {5, 0.98}, {5, 2}, {2 - inside, 2}}}) {
    BlockPolygon p;
    p.rings = {ring};
    p.joint = {std::vector<Index>(ring.size(), none)};
    p.material = 0;
    set.blocks.push_back(p);
  }
  const DriftingHeap two(set);
  NearEdges known;
  const auto pairs = edges_within(known, two.blocks, two.state, two.pose, reach);
  constexpr EdgePair ends{1, 7};
  return std::find(pairs.begin(), pairs.end(), ends) != pairs.end();
}

TEST(NearEdges, EndsThatLieBehindEachOtherAreNearBeforeTheyAct) {
  const Reach deep(0.01, 0.1), shallow(0.01, 0.005);
  EXPECT_TRUE(ends_are_near(0.009, 0.01));
  EXPECT_FALSE(ends_are_near(0.011, 0.01));
  EXPECT_TRUE(ends_are_near(0.069, deep));  // 0.01 + 2 (0.02 + 0.01)
  EXPECT_FALSE(ends_are_near(0.071, deep));
  EXPECT_TRUE(ends_are_near(0.019, shallow));  // 0.01 + 2 x 0.005
  EXPECT_FALSE(ends_are_near(0.021, shallow));
  EXPECT_FALSE(ends_are_near(-0.011, deep));  // they lie in front of each other
}

TEST(NearEdges, AWiderReachIsFoundAnew) {
  std::mt19937 rng(3);
  const DriftingHeap heap(odd_polygons(rng, 40));
  NearEdges known;
  edges_within(known, heap.blocks, heap.state, heap.pose, 0.02);
  EXPECT_EQ(edges_within(known, heap.blocks, heap.state, heap.pose, 0.3), brute_force(heap, 0.3));
  EXPECT_EQ(known.lists, 2u);
}

/// What is stored for fast blocks is not kept when they have come to rest.
TEST(NearEdges, AMuchWiderStoreIsGivenUp) {
  std::mt19937 rng(5);
  const DriftingHeap heap(odd_polygons(rng, 40));
  NearEdges known;
  edges_within(known, heap.blocks, heap.state, heap.pose, 0.5);
  EXPECT_LT(known.reach, 4.0 * 0.5);
  edges_within(known, heap.blocks, heap.state, heap.pose, 0.4);
  EXPECT_EQ(known.lists, 1u);
  EXPECT_EQ(edges_within(known, heap.blocks, heap.state, heap.pose, 0.01), brute_force(heap, 0.01));
  EXPECT_EQ(known.lists, 2u);
}

TEST(NearEdges, ExcavatedBlocksHaveNone) {
  std::mt19937 rng(4);
  DriftingHeap heap(odd_polygons(rng, 40));
  NearEdges known;
  const std::size_t with = edges_within(known, heap.blocks, heap.state, heap.pose, 0.05).size();
  heap.state.alive[7] = 0;
  const auto without = edges_within(known, heap.blocks, heap.state, heap.pose, 0.05);
  EXPECT_EQ(known.lists, 1u);
  EXPECT_EQ(without, brute_force(heap, 0.05));
  EXPECT_LT(without.size(), with);
}

}  // namespace
}  // namespace edda
