// Waves along a bar of blocks: out through a viscous boundary, in through one, up to a free end.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::wave_test {
namespace {

constexpr int blocks = 120;
constexpr double density = 2500.0, young = 1e10, poisson = 0.2;
constexpr double width = 8.0, hump_at = 40.5;  // m

/// Wave speeds of the rock, and of the bar, in which the springs of the joints make them lower.
struct Speeds {
  double p, s;
};
Speeds in_rock() {
  const double mu = young / (2.0 * (1.0 + poisson));
  const double lambda = young * poisson / ((1.0 + poisson) * (1.0 - 2.0 * poisson));
  return {std::sqrt((lambda + 2.0 * mu) / density), std::sqrt(mu / density)};
}
Speeds in_bar(double spring) {
  const Speeds c = in_rock();
  const auto slower = [&](double speed) {
    return speed / std::sqrt(1.0 + density * speed * speed / (2.0 * spring));
  };
  return {slower(c.p), slower(c.s)};
}

/// A column of unit blocks with glued joints. For plane waves, rollers prevent motion transverse to
/// that of the wave: at the sides for P, along every joint for S.
std::string bar(bool shear, double spring, const std::string& more) {
  std::string toml =
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = 1e10\ndamping = 0\npoisson = "
      "0.2\n"
      "[joints.j]\ntype = 'glued'\n[contact]\nnormal_stiffness = " +
      number(spring) + "\n";
  for (int i = 0; i < blocks; ++i) {
    toml += "[[block]]\npolygon = " + rectangle(0, i, 1, i + 1) + "\n";
  }
  if (!shear) {
    toml += "[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\nstiffness = 1e11\n";
  }
  for (int y = 0; shear && y <= blocks; ++y) {
    toml += "[[boundary]]\ntype = 'roller'\nstiffness = 2e12\nalong = [[0, " + number(y) +
            "], [1, " + number(y) + "]]\n";
  }
  return toml + more;
}

double& of(Vec2& v, bool shear) {
  return shear ? v.x : v.y;
}

/// A velocity pulse around block 40: half of it travels down.
void start_hump(Simulation& sim, bool shear) {
  for (std::size_t i = 0; i < blocks; ++i) {
    const double from = static_cast<double>(i) + 0.5 - hump_at;
    for (std::size_t k = 0; k < 3; ++k) {
      // Each block has the value and the slope of the pulse.
      const double y = sim.motion.state.position.y[k][i] - centroid(sim.motion.state.position, i).y;
      (shear ? sim.motion.state.velocity.x : sim.motion.state.velocity.y)[k][i] =
          0.02 * std::exp(-0.5 * from * from / (width * width)) *
          (1.0 - from * y / (width * width));
    }
  }
}

/// Part of the half travelling down that returns through block 30 before the other half does.
double reflected(bool shear, double spring, const std::string& wave_speeds) {
  const Speeds speeds = in_bar(spring);
  const double c = shear ? speeds.s : speeds.p, end = 105.0 / c;
  Simulation sim = scene(bar(shear, spring,
                             "[[boundary]]\nname = 'base'\nsides = ['bottom']\ntype = 'viscous'\n" +
                                 wave_speeds + "[output]\nhistory_every = " + number(0.1 * end) +
                                 "\n[solver]\nduration = " + number(end) + "\n"));
  start_hump(sim, shear);
  double back = 0.0, error = 0.0, dissipated = 0.0;
  run(
      sim,
      [&](Simulation& s) {
        const EnergyBalance l = account_energy(s);
        keep_largest(error, l.error);
        EXPECT_GE(l.damping, dissipated);
        dissipated = l.damping;
      },
      [&](Simulation& s) {
        if (s.motion.state.time < 42.0 / c) return;
        Vec2 v = centroid(s.motion.state.velocity, 30);
        keep_largest(back, of(v, shear));
      });
  EXPECT_LT(error, 1e-5);
  // The dashpots have dissipated half of the energy, less what was reflected.
  const EnergyBalance l = account_energy(sim);
  const double part = back / 0.01;
  EXPECT_NEAR(l.damping / (l.damping + l.kinetic + l.strain + l.contact), 0.5 * (1.0 - part * part),
              5e-3);
  return part;
}

TEST(Viscous, LetsWavesOut) {
  for (const bool shear : {false, true}) {
    // Stiff joints: the impedance of the rock is that of the bar. Soft joints: the wave speeds of
    // the bar must be given.
    const std::string wave = shear ? "S" : "P";
    expect_at_most({31, wave + ", stiff joints", "reflected part of the wave", ""},
                   reflected(shear, 50.0 * young, ""), 0.02);
    const Speeds soft = in_bar(young);
    expect_at_most(
        {31, wave + ", soft joints, their wave speeds", "reflected part", ""},
        reflected(shear, young, "wave_speeds = [" + number(soft.p) + ", " + number(soft.s) + "]\n"),
        0.02);
    // Without them the impedance of the rock reflects the part that theory predicts.
    const double c = shear ? in_rock().s : in_rock().p, slow = shear ? soft.s : soft.p;
    EXPECT_NEAR(reflected(shear, young, ""), (c - slow) / (c + slow), 0.01) << wave;
  }
}

/// A wave that enters through the base has twice its amplitude at the free end, and leaves again.
TEST(Upgoing, ArrivesDoubledAtAFreeSurface) {
  for (const bool shear : {false, true}) {
    const double spring = 50.0 * young, frequency = 10.0, amplitude = 2.0;
    const double c = shear ? in_bar(spring).s : in_bar(spring).p;
    const double end = blocks / c + 1.0 / frequency;
    Simulation sim = scene(
        bar(shear, spring,
            "[[boundary]]\nname = 'base'\nsides = ['bottom']\ntype = 'viscous'\n[[shaking]]\napply "
            "= 'upgoing'\nacceleration = { amplitude = 2.0, frequency = 10.0, direction = " +
                std::string(shear ? "[1, 0]" : "[0, 1]") + " }\n[output]\nhistory_every = " +
                number(end) + "\n[solver]\nduration = " + number(end) + "\n"));
    double error = 0.0, top = 0.0, middle = 0.0;
    run(
        sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); },
        [&](Simulation& s) {
          Vec2 v = corner_at(s.scene->blocks, s.motion.state.velocity,
                             s.scene->blocks.vertex_begin[blocks - 1] + 2);
          keep_largest(top, of(v, shear));
          if (s.motion.state.time > 0.5 * end) return;
          Vec2 u = centroid(s.motion.state.velocity, 10);
          keep_largest(middle, of(u, shear));
        });
    // v = A/w (1 - cos w t), at most 2 A/w; twice that at the free end.
    const double upgoing = amplitude / (std::numbers::pi * frequency);
    const std::string wave = shear ? "S" : "P";
    expect_relative({32, wave, "largest velocity on its way up", "m/s"}, middle, upgoing, 2e-2);
    expect_relative({32, wave, "largest velocity of the free end", "m/s"}, top, 2.0 * upgoing,
                    2e-2);
    EXPECT_LT(error, 1e-6);
  }
}

}  // namespace
}  // namespace edda::wave_test
