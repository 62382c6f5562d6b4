// A pulse along a column of blocks: validation.md row 10.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::pulse_test {
namespace {

constexpr int blocks = 200;
constexpr double density = 2500.0, young = 1e10;
constexpr double width = 10.0, middle = 40.5;  // of the pulse, m

/// Unit blocks end to end, without gravity, whose joints also carry tension.
std::string free_column(double spring) {
  std::string toml =
      "plane = 'stress'\ngravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = "
      "1e10\ndamping = 0\n"
      "poisson = 0.0\n[joints.j]\nfriction_angle = 30\ncohesion = 1e9\ntensile_strength = "
      "1e9\n[contact]\n"
      "normal_stiffness = " +
      number(spring) + "\n[solver]\nduration = 1.0\n[output]\nhistory_every = 1.0\n";
  for (int i = 0; i < blocks; ++i)
    toml += "[[block]]\npolygon = " + rectangle(0, i, 1, i + 1) + "\n";
  return toml;
}

struct Peak {
  double time = 0.0, speed = 0.0;
};

/// A velocity pulse 10 blocks wide around block 40; half of it travels up. Returns the time at
/// which it passes each block, by a parabola through the three largest velocities, and the velocity
/// of the block then.
std::vector<Peak> run_pulse(double spring, double c, const std::string& label) {
  Simulation sim = scene(free_column(spring));
  for (std::size_t i = 0; i < blocks; ++i) {
    const double from = static_cast<double>(i) + 0.5 - middle;
    for (std::size_t k = 0; k < 3; ++k) {
      // Each block has the value and the slope of the pulse.
      const double y = sim.motion.state.position.y[k][i] - centroid(sim.motion.state.position, i).y;
      sim.motion.state.velocity.y[k][i] = 0.02 * std::exp(-0.5 * from * from / (width * width)) *
                                          (1.0 - from * y / (width * width));
    }
  }
  std::vector<Peak> peaks(blocks);
  std::vector<double> last(blocks, 0.0), before(blocks, 0.0);
  const double end = 175.0 / c;
  start(sim, end);
  const double h = sim.motion.state.step;
  for (int n = 0; sim.motion.state.time < end; ++n) {
    EXPECT_FALSE(step(sim).has_value());
    for (std::size_t i = 0; i < blocks; ++i) {
      const double v = centroid(sim.motion.state.velocity, i).y;
      // Without the reflection from the other end.
      const bool first_pass = sim.motion.state.time < (static_cast<double>(i) - middle + 40.0) / c;
      if (n > 1 && first_pass && last[i] > before[i] && last[i] >= v && last[i] > peaks[i].speed) {
        const double bend = before[i] - 2.0 * last[i] + v, slope = 0.5 * (v - before[i]);
        peaks[i] = {sim.motion.state.time - 1.5 * h - slope / bend * h,
                    last[i] - 0.5 * slope * slope / bend};
      }
      before[i] = last[i];
      last[i] = v;
    }
  }
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-6);
  record_model(10, label, sim);
  return peaks;
}

/// Time and velocity at which a point `below` the free end is fastest: the pulse and its mirror
/// image.
Peak hump_and_echo(double below, double c) {
  Peak peak;
  for (double ahead = 0.0; ahead < below + 1.0; ahead += 0.01) {
    const double up = (ahead - below) / width, down = (ahead + below) / width;
    const double speed = 0.01 * (std::exp(-0.5 * up * up) + std::exp(-0.5 * down * down));
    if (speed > peak.speed) peak = {(blocks - middle - ahead) / c, speed};
  }
  return peak;
}

/// Row 10: c = sqrt(E/rho)/sqrt(1 + 1/kappa), kappa = K L/(E A); the free end moves twice as fast.
TEST(Pulse, SpeedAndFreeEnd) {
  for (const double spring : {1e9, 1e10, 1e11}) {
    const double kappa = 2.0 * spring / young;
    const double c = std::sqrt(young / density) / std::sqrt(1.0 + 1.0 / kappa);
    const std::string label = "kappa = " + brief(kappa);
    const std::vector<Peak> peaks = run_pulse(spring, c, label);
    const double measured = 80.0 / (peaks[160].time - peaks[80].time);
    expect_relative({10, label, "speed of the pulse", "m/s"}, measured, c, 1e-2);
    // The velocity of the end itself, not of the last block's middle, is what doubles.
    expect_relative({10, label, "speed of the free end over that of the pulse", ""},
                    peaks[199].speed / peaks[150].speed, 2.0, 1e-2);
    Series passing(10, label, {"block", "exact time", "time", "exact speed", "speed"});
    for (std::size_t i = 60; i < blocks; ++i) {
      const Peak exact = hump_and_echo(199.5 - static_cast<double>(i), c);
      passing.add(
          {static_cast<double>(i + 1), exact.time, peaks[i].time, exact.speed, peaks[i].speed});
    }
  }
}

}  // namespace
}  // namespace edda::pulse_test
