// Large steps of the implicit method: the displacement limit, and contacts that no step may miss.
#include <algorithm>
#include <string>

#include "verification/implicit_models.hpp"
#include "verification/models.hpp"

namespace edda::implicit_large_steps_test {
namespace {

/// The displacement limit does not depend on the rotation of the model: a wide low wall has the
/// same steps when it stands upright.
TEST(DisplacementLimit, DoesNotDependOnHowTheModelIsTurned) {
  for (const char* method : {"edda", "dda"}) {
    const auto limit = [&](double angle) {
      std::string toml =
          "[materials.rock]\ndensity = 2600.0\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
          "friction_angle = 30.0\n[solver]\nduration = 1\nmax_displacement_ratio = 0.001\nmethod = "
          "'" +
          std::string(method) + "'\n";
      for (int i = 0; i < 12; ++i) {
        toml += "[[block]]\npolygon = [" + on_slope(angle, i, 0) + "," + on_slope(angle, i + 1, 0) +
                "," + on_slope(angle, i + 1, 2) + "," + on_slope(angle, i, 2) + "]\n";
      }
      return scene(toml).scene->displacement_limit;
    };
    EXPECT_NEAR(limit(0.0), 1e-3, 1e-15);
    for (const double angle : {30.0, 90.0, 137.0}) EXPECT_NEAR(limit(angle), 1e-3, 1e-12) << method;
  }
}

/// A step far too long is cut until blocks no longer pass through each other, and grows again.
TEST(ImplicitStep, IsCutAndGrowsAgain) {
  Simulation sim = scene(falling_pentagons(dda(0.05)));
  double smallest = 1.0, grown = 0.0;
  run(
      sim, [](Simulation&) {},
      [&](Simulation& s) {
        smallest = std::min(smallest, s.motion.state.step);
        grown = std::max(grown, s.motion.state.step / smallest);
      });
  EXPECT_GT(sim.accounts.steps.redone, 0u);
  EXPECT_LT(sim.accounts.max_penetration, 0.05);
  EXPECT_GT(grown, 1.9);
}

std::string falling(const std::string& block, const std::string& solver) {
  return R"(
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
fixed = true
polygon = [[-4, -1], [0, -1], [0, 0], [-4, 0]]
[[block]]
)" + block +
         "\n[output]\nhistory_every = 0.14\n[solver]\nduration = 0.28\n" + solver;
}

/// A step that would take a block from above the floor to far below it does not miss the contact,
/// not even if it is the first one and longer than the reach of the search at zero velocity.
TEST(ImplicitStep, DoesNotFallThroughTheFloorInTheFirstStep) {
  for (const char* how : {"", "dynamic = false\n"}) {
    for (const double gap : {0.055, 0.06, 0.07, 0.09}) {
      Simulation sim =
          scene(falling("polygon = " + rectangle(-3, gap, -2, gap + 1), how + dda(0.14)));
      double lowest = 0.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) { lowest = std::min(lowest, displacement(s, 1).y + gap); });
      EXPECT_GT(lowest, -1e-3) << how << gap;
    }
  }
}

/// A corner that falls on the end of a block, further in one step than it overlaps the block
/// sideways, has crossed the top face and not the side.
TEST(ImplicitStep, CornerLandsOnTheTopItHasCrossed) {
  for (const double step : {0.01, 0.005, 0.002, 0.001}) {
    for (int drop = 0; drop < 8; ++drop) {
      const double y = 0.5 + 0.008 * drop;
      const std::string block = "velocity = [0, -7]\npolygon = [[-0.02, " + number(y) +
                                "], [1.0, " + number(y + 0.5) + "], [-0.02, " + number(y + 1.0) +
                                "]]";
      Simulation sim = scene(falling(block, dda(step)));
      double lowest = 1.0;
      run(
          sim, [](Simulation&) {},
          [&](Simulation& s) {
            const Id corner = s.scene->blocks.vertex_begin[1];
            if (s.motion.pose.x[corner] + s.scene->blocks.origin.x < -1e-3) {
              lowest = std::min(lowest, s.motion.pose.y[corner] + s.scene->blocks.origin.y);
            }
          });
      EXPECT_GT(lowest, -0.01) << step << ' ' << drop;
    }
  }
}

}  // namespace
}  // namespace edda::implicit_large_steps_test
