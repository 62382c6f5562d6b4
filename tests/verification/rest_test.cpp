// A long time in equilibrium: validation.md row 18, shortened; tools/rest-study wall runs the
// million steps.
#include "step/step.hpp"
#include "verification/wall_at_rest.hpp"

namespace edda::rest_test {
namespace {

constexpr std::uint64_t steps = 40000;

/// Gravity applied at once: the wall oscillates on its springs without end, with an amplitude that
/// must not grow.
TEST(WallAtRest, SwingsNoHigher) {
  Simulation sim = brick_wall(false);
  start(sim, 1e4);
  EXPECT_GT(watch_rest(sim, steps, false).later_steps, steps / 3);
}

/// From equilibrium: no contact that carries force opens or closes, and nothing moves.
TEST(WallAtRest, StaysSettled) {
  Simulation sim = brick_wall(true);
  start(sim, 1e4);
  while (sim.motion.state.time < 1.0) ASSERT_FALSE(step(sim).has_value());
  sim.motion.damping.local = 0.0;
  EXPECT_GT(watch_rest(sim, steps, true).later_steps, steps / 3);
}

}  // namespace
}  // namespace edda::rest_test
