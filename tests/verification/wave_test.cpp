// Waves along a bar of blocks: out through a viscous boundary, in through one, up to a free end.
#include <algorithm>

#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::wave_test {
namespace {

constexpr int blocks = 120;
constexpr double density = 2500.0, young = 1e10, poisson = 0.2;
constexpr double width = 8.0, hump_at = 40.5;  // m

/// Of the rock, and of the bar: the springs of its joints make it slower.
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

/// Unit blocks on one another that hold together. Plane waves: what would move across the wave is
/// held by rollers, at the sides for P, along every joint for S.
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

/// A hump of velocity round block 40: half of it runs down.
void start_hump(Simulation& sim, bool shear) {
  for (std::size_t i = 0; i < blocks; ++i) {
    const double from = static_cast<double>(i) + 0.5 - hump_at;
    for (std::size_t k = 0; k < 3; ++k) {
      // Each block takes the hump's value and its slope.
      const double y = sim.state.y[k][i] - centroid(sim.state.x, sim.state.y, i).y;
      (shear ? sim.state.vx : sim.state.vy)[k][i] = 0.02 *
                                                    std::exp(-0.5 * from * from / (width * width)) *
                                                    (1.0 - from * y / (width * width));
    }
  }
}

/// What of the half that ran down comes back through block 30 before the other half does.
double reflected(bool shear, double spring, const std::string& wave_speeds) {
  const Speeds speeds = in_bar(spring);
  const double c = shear ? speeds.s : speeds.p, end = 105.0 / c;
  Simulation sim = scene(bar(shear, spring,
                             "[[boundary]]\nname = 'base'\nsides = ['bottom']\ntype = 'viscous'\n" +
                                 wave_speeds + "[output]\nhistory_every = " + number(0.1 * end) +
                                 "\n[solver]\nduration = " + number(end) + "\n"));
  start_hump(sim, shear);
  double back = 0.0, drift = 0.0, dissipated = 0.0;
  run(
      sim,
      [&](Simulation& s) {
        const Ledger l = s.ledger();
        keep_largest(drift, l.drift);
        EXPECT_GE(l.damping, dissipated);
        dissipated = l.damping;
      },
      [&](Simulation& s) {
        if (s.state.time < 42.0 / c) return;
        Vec2 v = centroid(s.state.vx, s.state.vy, 30);
        keep_largest(back, of(v, shear));
      });
  EXPECT_LT(drift, 1e-5);
  // Half of the energy has gone into the dashpots, but for what came back.
  const Ledger l = sim.ledger();
  const double part = back / 0.01;
  EXPECT_NEAR(l.damping / (l.damping + l.kinetic + l.strain + l.contact), 0.5 * (1.0 - part * part),
              5e-3);
  return part;
}

TEST(Viscous, LetsWavesOut) {
  for (const bool shear : {false, true}) {
    // Stiff joints: the rock's own impedance is that of the bar. Soft ones: theirs must be given.
    const std::string wave = shear ? "S" : "P";
    expect_at_most({31, wave + ", stiff joints", "part of the wave that comes back", ""},
                   reflected(shear, 50.0 * young, ""), 0.02);
    const Speeds soft = in_bar(young);
    expect_at_most(
        {31, wave + ", soft joints, their wave speeds", "part that comes back", ""},
        reflected(shear, young, "wave_speeds = [" + number(soft.p) + ", " + number(soft.s) + "]\n"),
        0.02);
    // Without them the rock's impedance throws back what theory says.
    const double c = shear ? in_rock().s : in_rock().p, slow = shear ? soft.s : soft.p;
    EXPECT_NEAR(reflected(shear, young, ""), (c - slow) / (c + slow), 0.01) << wave;
  }
}

/// A wave that comes in through the base arrives at the free end doubled, and leaves.
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
    double drift = 0.0, top = 0.0, middle = 0.0;
    run(
        sim, [&](Simulation& s) { keep_largest(drift, s.ledger().drift); },
        [&](Simulation& s) {
          Vec2 v =
              vertex_at(s.blocks, s.state.vx, s.state.vy, s.blocks.vertex_begin[blocks - 1] + 2);
          keep_largest(top, of(v, shear));
          if (s.state.time > 0.5 * end) return;
          Vec2 u = centroid(s.state.vx, s.state.vy, 10);
          keep_largest(middle, of(u, shear));
        });
    // v = A/w (1 - cos w t), at most 2 A/w; twice that at the free end.
    const double upgoing = amplitude / (std::numbers::pi * frequency);
    const std::string wave = shear ? "S" : "P";
    expect_relative({32, wave, "largest velocity on its way up", "m/s"}, middle, upgoing, 2e-2);
    expect_relative({32, wave, "largest velocity of the free end", "m/s"}, top, 2.0 * upgoing,
                    2e-2);
    EXPECT_LT(drift, 1e-6);
  }
}

}  // namespace
}  // namespace edda::wave_test
