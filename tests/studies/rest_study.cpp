// Row 18 in full: a wall of 8 x 8 bricks for a million steps, as drawn and settled:
// rest_study [STEPS]. Exit 1 if its energy grows, its ledger has a trend, or it moves.
#include <cstdio>
#include <cstdlib>

#include "step/step.hpp"
#include "verification/wall_at_rest.hpp"

int main(int argc, char** argv) {
  using namespace edda;
  const std::uint64_t steps = argc > 1 ? std::strtoull(argv[1], nullptr, 10) : 1000000;
  for (const bool settle : {true, false}) {
    Simulation sim = brick_wall(settle);
    start(sim, 1e4);
    while (settle && sim.motion.state.time < 1.0 && !step(sim)) {
    }
    sim.motion.damping.local = 0.0;
    const Equilibrium rest = watch_rest(sim, steps, settle);
    std::printf(
        "%s: kinetic energy %.3g J in the first second, %.3g J after it; drift %.2e, trend %.1e; "
        "%llu flips in %llu steps; moved %.2e m; unsettled %llu of %llu\n",
        settle ? "settled" : "as drawn", rest.first_kinetic, rest.later_kinetic, rest.error,
        rest.trend, static_cast<unsigned long long>(rest.flips),
        static_cast<unsigned long long>(rest.later_steps), rest.moved,
        static_cast<unsigned long long>(sim.accounts.open_close.not_converged),
        static_cast<unsigned long long>(sim.accounts.open_close.steps));
  }
  return testing::UnitTest::GetInstance()->ad_hoc_test_result().Failed() ? 1 : 0;
}
