// Contacts of random blocks in motion against brute force: sizes 1 : 1,000, needles, slivers, stars
// and Ls thrown at each other. tools/contact-oracle runs more of them, and longer.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/acting_watch.hpp"
#include "verification/cut_slope.hpp"
#include "verification/heap_watch.hpp"
#include "verification/random_heap.hpp"

namespace edda::oracle_test {
namespace {

Simulation thrown(const std::vector<ThrownBlock>& heap, double friction, double duration) {
  Simulation sim = scene(thrown_model(heap, friction, "duration = " + number(duration) + "\n"));
  start(sim, duration);
  return sim;
}

/// No contact is missed while blocks move between two lists, none is listed twice, and no force
/// jumps when corners change their edges.
TEST(ThrownHeap, ContactsAgreeWithBruteForce) {
  std::size_t wanted = 0;
  std::uint64_t switched = 0;
  for (unsigned seed = 0; seed < 12; ++seed) {
    Simulation sim = thrown(thrown_blocks(seed, 3, 0.75 * (seed % 4), 30.0), 3.0 * seed, 0.5);
    HeapWatch watch(16);
    double error = 0.0;
    while (sim.motion.state.time < 0.5 && sim.motion.state.steps < 6000) {
      const auto failure = step(sim);
      ASSERT_FALSE(failure.has_value()) << seed << ": " << failure->message;
      watch.look(sim);
      if (sim.motion.state.steps % 100 == 0) keep_largest(error, account_energy(sim).error);
    }
    EXPECT_EQ(watch.list.missed, 0u) << seed;
    EXPECT_EQ(watch.list.repeated, 0u) << seed;
    EXPECT_LE(watch.worst_jump, 2.5) << seed << " at " << watch.jump_at;
    EXPECT_LT(error, 1e-4) << seed;
    wanted += watch.list.wanted;
    switched += sim.accounts.open_close.switched;
  }
  EXPECT_GT(wanted, 1000u);
  EXPECT_GT(switched, 100u);
}

/// Four heaps in which a corner passes a corner under load: a transfer of the whole force at once
/// would make it jump by 4 to 24 p u.
TEST(ThrownHeap, CornersPassWithoutAJump) {
  for (const unsigned seed : {2u, 6u, 19u, 30u}) {
    Simulation sim =
        thrown(thrown_blocks(seed, 4, 2.5 * (seed % 4) / 3.0, 30.0), (7 * seed) % 41, 0.5);
    HeapWatch watch(1000000);
    while (sim.motion.state.steps < 15000) {
      ASSERT_FALSE(step(sim).has_value());
      watch.look(sim);
    }
    EXPECT_LE(watch.worst_jump, 2.5) << seed << " at " << watch.jump_at;
  }
}

std::vector<Vec2> centres(const Simulation& s) {
  std::vector<Vec2> p;
  for (std::size_t i = 0; i < s.scene->blocks.size(); ++i)
    p.push_back(centroid(s.motion.state.position, i) + s.scene->blocks.origin);
  return p;
}

/// Mirrored, and numbered from the end: the same motion through the first impacts.
TEST(ThrownHeap, MirroredAndRenumberedMoveAlike) {
  std::uint64_t switched = 0;
  for (const unsigned seed : {1u, 2u, 5u, 9u}) {
    const std::vector<ThrownBlock> heap = thrown_blocks(seed, 3, 0.5 * (seed % 3), 30.0);
    const double end = 2e-4 + (seed % 3 == 0 ? 0.03 : 0.0);
    auto run_to_end = [&](const std::vector<ThrownBlock>& blocks) {
      Simulation sim = thrown(blocks, 25.0, end);
      while (sim.motion.state.time < end) EXPECT_FALSE(step(sim).has_value());
      switched += sim.accounts.open_close.switched;
      return centres(sim);
    };
    const std::vector<Vec2> expected = run_to_end(heap);
    std::vector<ThrownBlock> mirrored = heap;
    for (ThrownBlock& b : mirrored) {
      for (Vec2& p : b.ring) p.x = -p.x;
      b.velocity.x = -b.velocity.x;
      b.spin = -b.spin;
    }
    const std::vector<Vec2> image = run_to_end(mirrored);
    const std::vector<Vec2> last_first = run_to_end({heap.rbegin(), heap.rend()});
    for (std::size_t i = 0; i < heap.size(); ++i) {
      EXPECT_LT(norm(Vec2{-image[i].x, image[i].y} - expected[i]), 1e-9) << seed << ' ' << i;
      EXPECT_LT(norm(last_first[heap.size() - 1 - i] - expected[i]), 1e-9) << seed << ' ' << i;
    }
  }
  EXPECT_GT(switched, 60u);
}

/// Faces act and corners lean according to the definition, and no face presses from the far side of
/// a block.
void expect_acts_as_defined(const ActingFaults& faults, const std::string& what) {
  EXPECT_EQ(faults.apart, 0u) << what;
  EXPECT_EQ(faults.askew, 0u) << what;
  EXPECT_EQ(faults.behind, 0u) << what;
}

TEST(ThrownHeap, FacesActAsDefined) {
  ActingFaults sum;
  for (unsigned seed = 0; seed < 6; ++seed) {
    Simulation sim = scene(odd_heap(seed, 3.0 * seed));
    const Acting acting = acting_in(sim, 15000);
    EXPECT_EQ(acting.failure, "") << seed;
    expect_acts_as_defined(acting.faults, "seed " + std::to_string(seed));
    sum.add(acting.faults);
  }
  EXPECT_GT(sum.decided, 20000u);
}

TEST(CutSlopes, FacesActAsDefined) {
  ActingFaults sum;
  for (unsigned n = 0; n < 20; n += 5) {
    CutSlope slope = cut_slope(n, 15.0);
    if (n % 2 == 1) slope.more = "[quality]\naction = 'report'\n";
    Simulation sim = scene(slope_model(slope));
    const Acting acting = acting_in(sim, 60);
    EXPECT_EQ(acting.failure, "") << n;
    expect_acts_as_defined(acting.faults, "slope " + std::to_string(n));
    sum.add(acting.faults);
  }
  EXPECT_GT(sum.decided, 500u);
  EXPECT_GT(sum.crossed, 50u);
}

}  // namespace
}  // namespace edda::oracle_test
