// A long time at rest: validation.md row 18, shortened; tools/rest-study wall runs the million
// steps.
#include "verification/wall_at_rest.hpp"

namespace edda::rest_test {
namespace {

constexpr std::uint64_t steps = 40000;

/// Gravity met at once: the wall swings in its springs for good, and must not swing higher.
TEST(WallAtRest, SwingsNoHigher) {
  Simulation sim = brick_wall(false);
  sim.start(1e4);
  EXPECT_GT(watch_rest(sim, steps, false).later_steps, steps / 3);
}

/// Settled first: then nothing that carries flips, and nothing moves.
TEST(WallAtRest, StaysSettled) {
  Simulation sim = brick_wall(true);
  sim.start(1e4);
  while (sim.state.time < 1.0) ASSERT_FALSE(sim.step().has_value());
  sim.damping.local = 0.0;
  EXPECT_GT(watch_rest(sim, steps, true).later_steps, steps / 3);
}

}  // namespace
}  // namespace edda::rest_test
