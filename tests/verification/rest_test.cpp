// A long time at rest: validation.md row 18, shortened; tools/rest-study runs the million steps.
#include "verification/wall_at_rest.hpp"

namespace edda {
namespace {

constexpr std::uint64_t steps = 40000;

/// Gravity met at once: the wall swings in its springs for good, and must not swing higher.
TEST(WallAtRest, SwingsNoHigher) {
  Simulation sim = brick_wall(false);
  sim.start(1e4);
  const Rest rest = watch_rest(sim, steps);
  EXPECT_GT(rest.later_steps, steps / 3);
  EXPECT_LT(rest.later_kinetic, 1.2 * rest.first_kinetic);
  EXPECT_LT(rest.drift, 1e-5);
  EXPECT_LT(std::abs(rest.trend), 1e-6);
  EXPECT_LT(rest.moved, 1e-3);
}

/// Settled first: then nothing that carries flips, and nothing moves.
TEST(WallAtRest, StaysSettled) {
  Simulation sim = brick_wall(true);
  sim.start(1e4);
  while (sim.state.time < 1.0) ASSERT_FALSE(sim.step().has_value());
  sim.model.solver.damping.local = 0.0;
  const Rest rest = watch_rest(sim, steps);
  EXPECT_GT(rest.later_steps, steps / 3);
  EXPECT_LT(rest.later_kinetic, 1e-12);  // J: rounding, of a wall that stores hundreds
  EXPECT_EQ(rest.flips, 0u);
  EXPECT_LT(rest.drift, 1e-9);
  EXPECT_LT(rest.moved, 1e-9);
}

}  // namespace
}  // namespace edda
