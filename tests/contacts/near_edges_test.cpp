// Pairs of edges near each other are the same whether they are found anew or taken from those of a
// wider reach, and are those that a search of all pairs gives.
#include "contacts/near_edges.hpp"

#include <gtest/gtest.h>

#include "contacts/drifting_heap.hpp"

namespace edda {
namespace {

double distance(Vec2 p, Vec2 a, Vec2 b) {
  const Vec2 u = b - a;
  const double s = std::clamp(dot(p - a, u) / dot(u, u), 0.0, 1.0);
  return norm(p - (a + s * u));
}

/// Pairs of edges that lie within this reach and are opposed as they stand, or nearly so.
std::vector<EdgePair> brute_force(const DriftingHeap& heap, double reach) {
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
      const bool near = std::min({distance(p1, q1, q2), distance(p2, q1, q2), distance(q1, p1, p2),
                                  distance(q2, p1, p2)}) < reach;
      const double le = norm(p2 - p1), lf = norm(q2 - q1);
      const double cosine = -dot(p2 - p1, q2 - q1) / (le * lf) + reach / le + reach / lf;
      if (near && cosine > angle_gate(b, e, f).none) pairs.push_back({e, f});
    }
  }
  return pairs;
}

TEST(NearEdges, AreThoseOfASearchOfAllPairsWhateverIsKnown) {
  std::size_t total = 0, from_store = 0;
  for (unsigned seed = 0; seed < 6; ++seed) {
    std::mt19937 rng(seed);
    DriftingHeap heap(odd_polygons(rng, 40));
    heap.state.alive[3] = 0;
    constexpr double reach = 0.05;
    NearEdges known;
    for (int move = 0; move < 60; ++move) {
      const std::uint64_t lists = known.lists;
      const std::vector<EdgePair> pairs =
          edges_within(known, heap.blocks, heap.state, heap.pose, reach);
      ASSERT_EQ(pairs, brute_force(heap, reach)) << "seed " << seed << ", move " << move;
      total += pairs.size();
      from_store += known.lists == lists ? 1 : 0;
      heap.move_at_random(rng, 0.02);
    }
    EXPECT_GT(known.lists, 2u);
  }
  EXPECT_GT(total, 1000u);
  EXPECT_GT(from_store, 100u);
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
