// Boundaries that carry a stress, and boundaries that are moved.
#include "observe/attachment_rows.hpp"
#include "step/energy_balance.hpp"
#include "verification/models.hpp"

namespace edda::boundary_test {
namespace {

std::string square(const std::string& more) {
  return "gravity = [0, 0]\nplane = 'stress'\n[materials.rock]\ndensity = 2500.0\nyoung = 2e9\n"
         "poisson = 0.2\n[joints.j]\nfriction_angle = 0\n[[block]]\npolygon = " +
         rectangle(0, 0, 2, 1) +
         "\n[[boundary]]\nname = 'wall'\nsides = ['left']\ntype = 'roller'\nstiffness = 1e12\n"
         "[[boundary]]\nname = 'floor'\nsides = ['bottom']\ntype = 'roller'\nstiffness = 1e12\n" +
         more;
}

/// A traction on two sides is the stress inside; the other boundaries carry it.
TEST(StressBoundary, IsTheStressInside) {
  for (const std::string method :
       {"damping = { mass = 500.0 }\n", "method = 'dda'\ndynamic = false\ntime_step = 1e-3\n"}) {
    Simulation sim = scene(square(
        "[[boundary]]\nname = 'pull'\nsides = ['right']\ntype = 'stress'\ntraction = [1e6, 0]\n"
        "[[boundary]]\nname = 'push'\nsides = ['top']\ntype = 'stress'\ntraction = [0, -5e5]\n"
        "history = 'tests/verification/ramp_up.csv'\n[output]\nhistory_every = 0.02\n[solver]\n"
        "duration = 0.1\n" +
        method));
    run(sim, [](Simulation&) {});
    const Tensor s = stress_of(sim, 0);
    EXPECT_NEAR(s.xx, 1e6, 2e3) << method;
    EXPECT_NEAR(s.yy, -1e6, 2e3) << method;  // the history ends at 2
    Instant at;
    observe(sim, at);
    const std::vector<Vec2> r = reactions(sim, at);
    EXPECT_NEAR(r[0].x, -1e6, 2e3) << method;
    EXPECT_NEAR(r[1].y, 2e6, 4e3) << method;
    EXPECT_EQ(r[2], (Vec2{1e6, 0.0}));
    EXPECT_EQ(r[3], (Vec2{0.0, -2e6}));
    EXPECT_LT(std::abs(account_energy(sim).error), 1e-4) << method;
  }
}

/// A side that is moved by its velocity times its history; its work is stored as strain energy.
TEST(VelocityBoundary, MovesItsSide) {
  Simulation sim = scene(square(
      "[[boundary]]\nname = 'pull'\nsides = ['right']\ntype = 'velocity'\nvelocity = [0.01, 0]\n"
      "stiffness = 1e12\nhistory = 'tests/verification/ramp_up.csv'\n[output]\n"
      "history_every = 0.01\n[solver]\nduration = 0.2\ndamping = { mass = 200.0 }\n"));
  double error = 0.0;
  run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
  // Factor 0 to 2 over 0.05 s, then 2.
  const double moved = 0.01 * (0.05 + 2.0 * 0.15);
  EXPECT_NEAR(sim.attached.springs.shift[2].x, moved, 1e-9);
  EXPECT_NEAR(sim.motion.pose.x[1] + sim.scene->blocks.origin.x, 2.0 + moved, 1e-2 * moved);
  EXPECT_LT(error, 1e-5);
  const EnergyBalance l = account_energy(sim);
  EXPECT_NEAR((l.strain + l.contact + l.damping + l.kinetic) / l.external, 1.0, 1e-5);
  EXPECT_GT(l.external, 0.5 * 2e9 * moved * moved / 2.0 * 0.9);
}

}  // namespace
}  // namespace edda::boundary_test
