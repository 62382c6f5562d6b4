// What strain damping takes off waves: the estimate of the warning against what a run shows.
#include "observe/wave_loss.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>
#include <string>

#include "observe/damping_report.hpp"
#include "run/prepared.hpp"
#include "scratch_folder.hpp"
#include "step/step.hpp"

namespace edda::wave_loss_test {
namespace {

using testing::prepared;

/// Half of the range of the velocity, or acceleration, of a block in a run.
double amplitude(PreparedRun& run, Vec2 at, bool acceleration) {
  Simulation& sim = run.sim;
  const BlockSet& b = sim.scene->blocks;
  std::size_t nearest = 0;
  for (std::size_t i = 0; i < b.size(); ++i) {
    const auto distance = [&](std::size_t q) {
      return norm(Vec2{b.centroid_x[q], b.centroid_y[q]} + b.origin - at);
    };
    if (distance(i) < distance(nearest)) nearest = i;
  }
  double low = 0.0, high = 0.0, before = 0.0;
  const double duration = sim.scene->model.solver.duration;
  start(sim, duration);
  while (sim.motion.state.time < duration && !step(sim)) {
    const Vec2 v = centroid(sim.motion.state.velocity, nearest);
    const double along = acceleration ? (v.x + v.y - before) / sim.motion.state.step : v.x + v.y;
    before = v.x + v.y;
    low = std::min(low, along);
    high = std::max(high, along);
  }
  return 0.5 * (high - low);
}

/// A layer of soil, 20 m, on rock, shaken from below through dashpots or on fixed ground.
std::string layer(double frequency, double duration, bool fixed, double damping) {
  const std::string zeta = "\ndamping = " + std::to_string(damping) + "\n";
  return "gravity = [0, 0]\n[materials.soil]\ndensity = 2000\nyoung = 0.5e9\npoisson = 0" + zeta +
         "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0" + zeta +
         R"([joints.g]
type = "glued"
kn = 2e11
ks = 2e11
[domain]
outline = [[0, -6], [4, -6], [4, 20], [0, 20]]
material = "rock"
joint = "g"
[[joint_set]]
angle = 0
spacing = 2
[[region]]
polygon = [[0, 0], [4, 0], [4, 20], [0, 20]]
material = "soil"
joint = "g"
[[boundary]]
sides = ["bottom"]
type = ")" +
         std::string(fixed ? "fixed" : "viscous") +
         "\"\n[[shaking]]\nacceleration = { amplitude = 1, direction = [0, 1], frequency = " +
         std::to_string(frequency) + " }\n" + (fixed ? "" : "apply = \"upgoing\"\n") +
         "[solver]\nduration = " + std::to_string(duration) + "\n";
}

/// On, off and far above the resonance of the layer at 6.25 Hz, where waves leave at the base and
/// where they do not.
TEST(WaveLoss, OfALayerIsWhatTheRunLoses) {
  for (const bool fixed : {false, true}) {
    for (const double frequency : {3.0, 5.5, 6.25, 9.0, 18.0}) {
      if (fixed && frequency == 6.25) continue;  // no steady state without damping
      const double duration = 12.0 / frequency;
      double found[2], estimate = 0.0;
      for (const bool damped : {false, true}) {
        PreparedRun run = prepared(layer(frequency, duration, fixed, damped ? 0.5 : 0.0));
        if (damped) estimate = strain_damping_at(run.sim).at(0).lost;
        found[damped] = amplitude(run, {2.0, 19.0}, true);
      }
      const double lost = 1.0 - found[1] / found[0];
      EXPECT_NEAR(estimate, lost, 0.02 + 0.2 * std::abs(lost))
          << frequency << (fixed ? " Hz on fixed ground" : " Hz on rock");
    }
  }
}

/// A pulse of a load, a raised cosine, along a bar of 100 blocks.
TEST(WaveLoss, OfAPulseIsWhatTheRunLoses) {
  const ScratchFolder folder;
  for (const double length : {0.006, 0.01, 0.02, 0.06}) {
    const std::string path = (folder.path() / "pulse.csv").string();
    {
      std::ofstream file(path);
      for (int k = 0; k <= 40; ++k) {
        file << length * k / 40 << ',' << 0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * k / 40)
             << '\n';
      }
    }
    double found[2], estimate = 0.0;
    for (const bool damped : {false, true}) {
      PreparedRun run = prepared(R"(gravity = [0, 0]
[materials.rock]
density = 2600
young = 20e9
poisson = 0
damping = )" + std::string(damped ? "0.5" : "0") +
                                 R"(
[joints.g]
type = "glued"
kn = 8e12
ks = 8e12
[domain]
outline = [[0, 0], [50, 0], [50, 1], [0, 1]]
joint = "g"
[[joint_set]]
angle = 90
spacing = 0.5
[[load]]
along = [[0, 0], [0, 1]]
force = [1e5, 0]
history = ")" + path + R"("
[[boundary]]
sides = ["right"]
type = "viscous"
[solver]
duration = )" + std::to_string(0.025 + length) +
                                 "\n");
      if (damped) {
        const auto at = strain_damping_at(run.sim);
        ASSERT_EQ(at.size(), 1u);
        EXPECT_NEAR(at[0].length, 50.0, 1e-6);
        EXPECT_NEAR(at[0].frequency * length, 1.0, 0.25);
        estimate = at[0].lost;
      }
      found[damped] = 2.0 * amplitude(run, {49.75, 0.5}, false);
    }
    const double lost = 1.0 - found[1] / found[0];
    EXPECT_NEAR(estimate, lost, 0.01 + 0.15 * lost) << length << " s";
  }
}

TEST(WaveLoss, IsWarnedOfWhereItIsMuch) {
  const auto warned = [](double frequency, double damping) {
    const PreparedRun run = prepared(layer(frequency, 2.0, false, damping));
    return std::any_of(run.warnings.begin(), run.warnings.end(), [](const std::string& w) {
      return w.find("is lost to their strain damping") != std::string::npos;
    });
  };
  EXPECT_TRUE(warned(6.0, 0.5));
  EXPECT_FALSE(warned(0.5, 0.5));
  EXPECT_FALSE(warned(6.0, 0.02));
}

}  // namespace
}  // namespace edda::wave_loss_test
