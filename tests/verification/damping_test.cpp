// Damping, and blocks that stand on one another.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "verification/scene.hpp"

namespace edda::damping_test {
namespace {

std::string stack(int blocks, const std::string& solver, const std::string& contact = "") {
  std::string toml =
      "[materials.rock]\ndensity = 2500.0\nyoung = 20e9\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 30\n" +
      contact + "[solver]\nduration = 0.5\n" + solver +
      "[output]\nhistory_every = 0.01\n[[block]]\nfixed = true\npolygon = "
      "[[-3,-1],[5,-1],[5,0],[-3,0]]\n";
  for (int i = 0; i < blocks; ++i) {
    toml += "[[block]]\npolygon = [[0," + number(i) + "],[2," + number(i) + "],[2," +
            number(i + 1) + "],[0," + number(i + 1) + "]]\n";
  }
  return toml;
}

TEST(LocalDamping, IsStableAtEveryFractionWithTheDefaultStep) {
  for (const double beta : {0.3, 0.5, 0.7, 0.8, 0.95}) {
    Simulation sim = scene(stack(1, "damping = { local = " + number(beta) + " }\n", "kn = 1e9\n"));
    run(sim, [](Simulation&) {});
    EXPECT_NEAR(displacement(sim, 1).y / (-2500.0 * 9.81 / 1e9), 1.0, 0.02) << beta;
    EXPECT_LT(account_energy(sim).kinetic, 1e-6) << beta;
  }
}

TEST(MassDamping, DecaysAsExactlyAsTheStepAllows) {
  // v = v0 exp(-a t) for a free block, from the first step on; the longest step allowed is 1/a.
  for (const double a : {1.0, 10.0, 100.0, 1000.0}) {
    Simulation sim = scene(
        "gravity = [0, 0]\n[materials.rock]\ndensity = 1000\nyoung = 2e5\n"
        "poisson = 0.2\n[solver]\nduration = 0.1\ndamping = { mass = " +
        number(a) +
        " }\n[output]\nhistory_every = 0.01\n[[block]]\n"
        "polygon = [[0,0],[1,0],[1,1],[0,1]]\nvelocity = [1, 0]\n");
    run(sim, [](Simulation&) {});
    const double ah = a * sim.motion.state.step;
    EXPECT_LE(ah, 1.0);
    EXPECT_NEAR(displacement(sim, 0).x / ((1.0 - std::exp(-0.1 * a)) / a), 1.0,
                0.3 * ah * ah + 1e-6)
        << a;
  }
}

/// Contacts of blocks that stand on each other undamped open and close without end; this must not
/// affect the energy balance.
TEST(Stack, WithoutDampingKeepsItsEnergy) {
  for (const int blocks : {3, 5, 10}) {
    Simulation sim = scene(stack(blocks, ""));
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    EXPECT_LT(error, 1e-6) << blocks;
    EXPECT_LE(sim.accounts.open_close.not_converged, sim.accounts.open_close.steps / 50) << blocks;
  }
}

/// A given step remains below the critical one, which is that of blocks that touch all round: it
/// need not change when the blocks come into contact.
TEST(GivenStep, StaysWithinTheBoundWhenBlocksLand) {
  Simulation sim = scene(
      "[materials.rock]\ndensity = 2600\nyoung = 1e8\ndamping = 0\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[contact]\nnormal_stiffness = 2e10\n[solver]\n"
      "duration = 0.6\ntime_step = 2e-3\n[output]\nhistory_every = 0.01\n[[block]]\n"
      "fixed = true\npolygon = [[-3,-1],[4,-1],[4,0],[-3,0]]\n[[block]]\n"
      "polygon = [[0,0.5],[1,0.55],[1,1.5],[0,1.5]]\n");
  double error = 0.0;
  run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
  EXPECT_LE(sim.accounts.steps.over_critical, 1.0 + 1e-9);
  EXPECT_EQ(sim.accounts.steps.changes, 0u);
  EXPECT_LT(error, 1e-3);
}

}  // namespace
}  // namespace edda::damping_test
