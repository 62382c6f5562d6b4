// Ground motion: sliding on a slope, by inertia forces and on a moving base.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::shaking_test {
namespace {

constexpr double slope = 20.0;
constexpr double period = 0.5;

/// A block on a slope of 20 degrees, 30 degrees of friction, under a sine.
std::string shaken(const std::string& shaking) {
  std::string toml = ramp(slope, 30.0, "20e9");
  toml.replace(toml.find("-9.8]"), 5, "-9.81]");
  toml.replace(toml.find("duration = 0.1"), 14, "duration = 1.5");
  toml.replace(toml.find("history_every = 0.001"), 21, "history_every = 0.05");
  return toml + "[[shaking]]\nname = 'quake'\n" + shaking;
}

const std::string sine = "acceleration = { amplitude = 4.905, frequency = 2.0 }\n";

/// Displacement of the block down the slope, relative to the ground.
double slid_on_ground(const Simulation& sim) {
  const Vec2 u = displacement(sim, 1) - displacement(sim, 0);
  return u.x * std::cos(radians(slope)) - u.y * std::sin(radians(slope));
}

/// Rigid block that slides from when the driving force exceeds friction until it has the velocity
/// of the ground again: its displacement in one cycle. The slope rises to the left, so that it
/// slides while the ground goes to the left.
double newmark_per_cycle(double amplitude) {
  const double a = radians(slope), g = 9.81, mu = std::tan(radians(30.0));
  double speed = 0.0, way = 0.0;
  constexpr int steps = 200000;
  const double dt = period / steps;
  for (int n = 0; n < steps; ++n) {
    const double ground = amplitude * std::sin(4.0 * std::numbers::pi * (n + 0.5) * dt);
    const double normal = g * std::cos(a) - ground * std::sin(a);
    const double pull = g * std::sin(a) + ground * std::cos(a);
    speed = std::max(0.0, speed + dt * (pull - mu * normal));
    way += dt * speed;
  }
  return way;
}

struct Slide {
  double per_cycle, error;
};

/// Mean of the second and the third cycle, since the first one starts unstressed.
Slide slide_on(Simulation& sim) {
  double at_half = 0.0, error = 0.0;
  run(sim, [&](Simulation& s) {
    keep_largest(error, account_energy(s).error);
    if (std::abs(s.motion.state.time - period) < 1e-9) at_half = slid_on_ground(s);
  });
  return {0.5 * (slid_on_ground(sim) - at_half), error};
}

TEST(Shaking, SlidesAsNewmarksBlockOnEitherGround) {
  const double exact = newmark_per_cycle(4.905);
  EXPECT_NEAR(exact, 0.078405, 1e-6);
  for (const std::string apply : {"inertia", "base"}) {
    Simulation sim = scene(shaken(sine + "apply = '" + apply + "'\n"));
    const Slide slide = slide_on(sim);
    expect_relative({30, apply, "slid in one cycle", "m"}, slide.per_cycle, exact, 1e-2);
    EXPECT_LT(slide.error, 1e-5) << apply;
    record_model(30, apply, sim);
  }
}

/// Both give the same relative motion, since the ground is integrated by the same leapfrog as the
/// blocks.
TEST(Shaking, InertiaAndMovingBaseAreTheSame) {
  Vec2 u[2];
  int which = 0;
  for (const std::string apply : {"inertia", "base"}) {
    Simulation sim = scene(shaken(sine + "apply = '" + apply + "'\n"));
    sim.scene.edit().model.solver.duration = period;
    run(sim, [](Simulation&) {});
    u[which++] = displacement(sim, 1) - displacement(sim, 0);
  }
  EXPECT_GT(norm(u[0]), 0.05);
  EXPECT_LT(norm(u[0] - u[1]), 1e-9 * norm(u[0]));
}

/// Boundary springs move a block with the ground; all of its energy is their work.
TEST(Shaking, BoundariesMoveWithTheBase) {
  for (const std::string type : {"fixed", "roller"}) {
    std::string toml =
        "gravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = 2e9\npoisson = 0.2\n"
        "[joints.j]\nfriction_angle = 0\n[[block]]\npolygon = " +
        rectangle(0, 0, 1, 1) + "\n[[boundary]]\nsides = ['left', 'bottom']\ntype = '" + type +
        "'\nstiffness = 2e9\n"
        "[[shaking]]\napply = 'base'\nscale = 0.5\nacceleration = { amplitude = 8.0, frequency = "
        "5.0, direction = [3.0, 4.0] }\n[output]\nhistory_every = 0.01\n[solver]\nduration = 0.5\n";
    Simulation sim = scene(toml);
    double error = 0.0, off = 0.0;
    run(sim, [&](Simulation& s) {
      keep_largest(error, account_energy(s).error);
      // u = A/w^2 (w t - sin w t)
      const double w = 10.0 * std::numbers::pi, t = s.motion.state.time;
      const Vec2 exact = 4.0 / (w * w) * (w * t - std::sin(w * t)) * Vec2{0.6, 0.8};
      keep_largest(off, norm(displacement(s, 0) - exact));
      EXPECT_NEAR(norm(s.attached.ground.shift - exact), 0.0, 1e-6);
    });
    EXPECT_LT(error, 1e-6) << type;
    EXPECT_LT(off, 1e-5) << type;  // the block's own stretching under its inertia
  }
}

/// A record: linear between its rows, zero after the last.
TEST(Shaking, RecordDrivesAFreeBlock) {
  for (const std::string method : {"time_step = 1e-4\n", "method = 'dda'\ntime_step = 1e-3\n"}) {
    Simulation sim = scene(
        "gravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = 2e9\npoisson = 0.2\n"
        "[joints.j]\nfriction_angle = 0\n[[block]]\npolygon = " +
        rectangle(0, 0, 1, 1) +
        "\n[[shaking]]\nacceleration = 'tests/verification/pulse.csv'\nscale = 2\napply = "
        "'inertia'\n[output]\nhistory_every = 0.1\n[solver]\nduration = 0.5\n" +
        method);
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    // A triangle of 0.2 s and 3 m/s2, doubled: the block lags behind by its integral.
    const Vec2 v = centroid(sim.motion.state.velocity, 0);
    EXPECT_NEAR(v.x, -0.6, 1e-6) << method;
    EXPECT_NEAR(v.y, 0.3, 1e-6) << method;
    EXPECT_LT(error, 1e-6) << method;
    EXPECT_NEAR(account_energy(sim).external, 0.5 * 2500.0 * (0.36 + 0.09), 2500.0 * 1e-6)
        << method;
  }
}

}  // namespace
}  // namespace edda::shaking_test
