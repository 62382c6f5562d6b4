// Friction of 20 to 45 degrees with default settings: blocks that are stable by statics do not
// move, sliding blocks slide by the exact amount, toppling blocks rotate about their toe.
#include <algorithm>
#include <array>
#include <functional>

#include "step/changes.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::default_settings_test {
namespace {

constexpr double gravity = 9.81;

/// `count` blocks of `width` x `height` side by side on a slope; damping, stiffness and step are
/// not given.
struct Slope {
  double angle, friction, width = 1.0, height = 1.0;
  int count = 1;
  double duration = 1.0;
  double velocity = 0.0;  ///< down the slope, at the start
  std::string more = {};

  std::string label() const {
    return brief(angle) + "/" + brief(friction) + ", " + brief(width) + " x " + brief(height) +
           (count > 1 ? ", " + std::to_string(count) + " blocks" : "");
  }
  double down(Vec2 u) const {
    return u.x * std::cos(radians(angle)) - u.y * std::sin(radians(angle));
  }
  std::string box(double u0, double v0, double u1, double v1) const {
    return "[" + on_slope(angle, u0, v0) + "," + on_slope(angle, u1, v0) + "," +
           on_slope(angle, u1, v1) + "," + on_slope(angle, u0, v1) + "]";
  }
  std::string toml() const {
    std::string text =
        "[materials.rock]\ndensity = 2700.0\nyoung = 20e9\npoisson = 0.25\n[joints.j]\n"
        "friction_angle = " +
        number(friction) + "\n[[block]]\nfixed = true\npolygon = " + box(-60.0, -2.0, 60.0, 0.0) +
        "\n";
    for (int i = 0; i < count; ++i) {
      text += "[[block]]\npolygon = " + box(i * width, 0.0, (i + 1) * width, height) +
              "\nvelocity = " + on_slope(angle, velocity, 0.0) + "\n";
    }
    return text + more + "[solver]\nduration = " + number(duration) +
           "\n[output]\nhistory_every = " + number(duration / 100.0) + "\n";
  }
};

/// Distance that each block has slid.
std::vector<double> slid_by(const Slope& slope, const Simulation& sim) {
  std::vector<double> ways;
  for (int i = 1; i <= slope.count; ++i) {
    ways.push_back(slope.down(displacement(sim, static_cast<std::size_t>(i))));
  }
  return ways;
}

TEST(DefaultSettings, WhatStaticsHoldsDoesNotCreep) {
  for (const auto& [angle, friction] :
       {std::pair{20.0, 30.0}, {28.0, 30.0}, {30.0, 35.0}, {40.0, 45.0}}) {
    for (const auto& [width, height] : {std::pair{1.0, 1.0}, {2.0, 1.0}, {3.0, 3.0}}) {
      for (const int count : {1, 4}) {
        const Slope slope{angle, friction, width, height, count};
        Simulation sim = scene(slope.toml());
        std::vector<double> at_start;
        double error = 0.0;
        run(sim, [&](Simulation& s) {
          keep_largest(error, account_energy(s).error);
          if (at_start.empty() && s.motion.state.time > 0.3) at_start = slid_by(slope, s);
        });
        double creep = 0.0;
        const std::vector<double> now = slid_by(slope, sim);
        for (std::size_t i = 0; i < now.size(); ++i) keep_largest(creep, now[i] - at_start[i]);
        expect_at_most({50, slope.label(), "creep after 0.3 s", "m"}, creep,
                       width > 2.0 ? 1e-4 : 1e-5);
        EXPECT_LT(error, 1e-6) << slope.label();
      }
    }
  }
}

TEST(DefaultSettings, WhatSlidesSlidesAsARigidBlock) {
  for (const auto& [angle, friction, bound] :
       {std::array{30.0, 25.0, 1e-2}, {30.0, 28.0, 3e-2}, {45.0, 40.0, 1e-2}}) {
    for (const auto& [width, height] : {std::pair{1.0, 1.0}, {2.0, 1.0}, {3.0, 3.0}}) {
      if (angle > 44.0 && height >= width) continue;  // topples, too
      for (const int count : {1, 4}) {
        const Slope slope{angle, friction, width, height, count};
        Simulation sim = scene(slope.toml());
        run(sim, [](Simulation&) {});
        const double exact =
            0.5 * gravity *
            (std::sin(radians(angle)) - std::tan(radians(friction)) * std::cos(radians(angle)));
        FurthestOff worst;
        for (const double way : slid_by(slope, sim)) worst.see(way, exact);
        worst.expect({51, slope.label(), "distance slid in 1 s", "m"}, bound);
      }
    }
  }
}

/// Thrown up the slope, it comes to a stop and slides back.
TEST(DefaultSettings, ASlideThatReverses) {
  for (const auto& [angle, friction, speed] :
       {std::array{30.0, 25.0, 5.0}, {30.0, 29.0, 5.0}, {40.0, 30.0, 6.0}, {25.0, 20.0, 4.0}}) {
    for (const double width : {1.0, 2.0}) {
      const double pull = gravity * std::sin(radians(angle)),
                   brake = gravity * std::cos(radians(angle)) * std::tan(radians(friction));
      const double turns = speed / (pull + brake), way = 0.5 * speed * turns;
      Slope slope{angle, friction, width};
      slope.duration = 3.0 * turns;
      slope.velocity = -speed;
      Simulation sim = scene(slope.toml());
      run(sim, [](Simulation&) {});
      const double exact = -way + 0.5 * (pull - brake) * 4.0 * turns * turns;
      expect_relative({52, slope.label(), "position after three times the time of its way up", "m"},
                      slid_by(slope, sim)[0], exact, 1e-2);
    }
  }
}

/// Newmark's rigid block on a slope that rises to the left, under a ground motion along x that is a
/// sine beginning at zero: distance that it slides down in three cycles.
double newmark(const Slope& slope, double amplitude, double frequency) {
  const double c = std::cos(radians(slope.angle)), s = std::sin(radians(slope.angle)),
               mu = std::tan(radians(slope.friction));
  double speed = 0.0, way = 0.0;
  constexpr int steps = 300000;
  const double dt = 3.0 / frequency / steps;
  for (int n = 0; n < steps; ++n) {
    const double ground = amplitude * std::sin(2.0 * std::numbers::pi * frequency * (n + 0.5) * dt);
    const double pull = gravity * s - ground * c, normal = std::max(0.0, gravity * c + ground * s);
    const bool holds = std::abs(pull) <= mu * normal;
    if (speed == 0.0 && holds) continue;
    const double direction = speed != 0.0 ? std::copysign(1.0, speed) : std::copysign(1.0, pull);
    const double next = speed + dt * (pull - direction * mu * normal);
    speed = next * direction < 0.0 && holds ? 0.0 : next;
    way += dt * speed;
  }
  return way;
}

TEST(DefaultSettings, NewmarksBlock) {
  for (const auto& [angle, friction, part, frequency] : {std::array{15.0, 25.0, 0.3, 1.0},
                                                         {20.0, 30.0, 0.4, 2.0},
                                                         {10.0, 35.0, 0.7, 1.0},
                                                         {25.0, 40.0, 0.5, 1.5}}) {
    for (const double width : {1.0, 2.0}) {
      Slope slope{angle, friction, width};
      slope.duration = 0.3 + 3.0 / frequency;
      const double amplitude = part * gravity;
      // It reaches equilibrium first; the record begins with its own stage and is zero until then.
      slope.more = "[[shaking]]\nname = 'quake'\napply = 'inertia'\nacceleration = { amplitude = " +
                   number(amplitude) + ", frequency = " + number(frequency) + " }\n";
      Simulation sim = scene(slope.toml());
      sim.attached.loads.intervals.shakings[0] = {1e9};
      start(sim, 0.3);
      while (sim.motion.state.time < 0.3) ASSERT_FALSE(step(sim).has_value());
      const double at_start = slid_by(slope, sim)[0];
      switch_over(sim, {}, {{}, {}, {}, {0}});
      fit_step_to(sim, slope.duration);
      while (sim.motion.state.time < slope.duration) ASSERT_FALSE(step(sim).has_value());
      expect_relative({53, slope.label() + ", " + brief(part) + " g, " + brief(frequency) + " Hz",
                       "slid in three cycles", "m"},
                      slid_by(slope, sim)[0] - at_start, newmark(slope, amplitude, frequency),
                      1e-2);
    }
  }
}

/// A slender block on a slope too steep for it rotates about its toe and does not slip there.
TEST(DefaultSettings, TopplingAboutAToe) {
  for (const auto& [angle, friction, height] :
       {std::array{35.0, 45.0, 2.0}, {35.0, 40.0, 2.0}, {35.0, 45.0, 3.0}, {30.0, 35.0, 2.5}}) {
    Slope slope{angle, friction, 1.0, height};
    slope.duration = 0.6;
    Simulation sim = scene(slope.toml());
    const Vec2 corner =
        Vec2{std::cos(radians(angle)), -std::sin(radians(angle))} - sim.scene->blocks.origin;
    const auto weights = weights_at(sim.scene->blocks, 1, corner);
    run(sim, [](Simulation&) {});
    // The pendulum about the toe: theta'' = g r/(J/m) sin(angle - slenderness + theta).
    const double r = 0.5 * std::hypot(1.0, height), inertia = (1.0 + height * height) / 3.0;
    double theta = 0.0, rate = 0.0;
    constexpr int steps = 600000;
    const double dt = slope.duration / steps;
    for (int n = 0; n < steps; ++n) {
      rate +=
          dt * gravity * r / inertia * std::sin(radians(angle) - std::atan2(1.0, height) + theta);
      theta += dt * rate;
    }
    const Rotation turned = rotation(deformation(sim.scene->blocks, sim.motion.state.position, 1));
    // A percent is due to the block's elasticity at the sudden start: it rocks on its base.
    expect_relative({54, slope.label(), "rotation in 0.6 s", "rad"},
                    -std::atan2(turned.s, turned.c), theta, 1.5e-2);
    const Vec2 toe = weighted(weights, sim.motion.state.position, 1) - corner;
    expect_at_most({54, slope.label(), "slip of the toe", "m"}, std::abs(slope.down(toe)), 1e-5);
  }
}

/// Without any damping only friction dissipates energy, and the balance closes.
TEST(DefaultSettings, WithoutDampingTheEnergyStays) {
  for (const double friction : {0.0, 20.0, 30.0, 45.0}) {
    Slope slope{35.0, friction, 1.0, 1.0, 3};
    std::string text = slope.toml();
    text.insert(text.find("[joints.j]"), "damping = 0\n");
    Simulation sim = scene(text);
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    EXPECT_LT(error, 2e-6) << friction;
    EXPECT_EQ(account_energy(sim).damping, 0.0);
  }
}

}  // namespace
}  // namespace edda::default_settings_test
