// Newmark's block under records of the shapes that earthquakes have, both ways round: short
// impulses, long shaking, low and high frequencies, with default settings.
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <numbers>
#include <string>
#include <vector>

#include "step/changes.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::newmark_records_test {
namespace {

constexpr double gravity = 9.81, dt = 0.01;

/// Twelve sines between a third of and three times a frequency (Hz), of random amplitudes and
/// phases, that rise within a fifth of the duration (s) and decay, from zero to zero; the largest
/// accelerations either way are `peak` (m/s2) and more.
std::vector<double> made_record(std::uint32_t seed, double frequency, double duration,
                                double peak) {
  const auto random = [&seed] {
    seed = 1664525u * seed + 1013904223u;
    return static_cast<double>(seed >> 8) / 16777216.0;
  };
  struct Sine {
    double amplitude, frequency, phase;
  };
  std::vector<Sine> sines;
  for (int k = 0; k < 12; ++k) {
    sines.push_back({0.3 + random(), frequency * std::pow(3.0, 2.0 * random() - 1.0),
                     2.0 * std::numbers::pi * random()});
  }
  std::vector<double> a(static_cast<std::size_t>(duration / dt) + 1, 0.0);
  double right = 0.0, left = 0.0;
  for (std::size_t n = 0; n < a.size(); ++n) {
    const double t = static_cast<double>(n) * dt, s = t / duration;
    const double shape = std::min(1.0, 5.0 * s) * std::exp(-2.5 * std::max(0.0, s - 0.2)) *
                         std::min(1.0, 10.0 * (1.0 - s));
    for (const Sine& sine : sines)
      a[n] += shape * sine.amplitude *
              std::sin(2.0 * std::numbers::pi * sine.frequency * t + sine.phase);
    right = std::max(right, a[n]);
    left = std::max(left, -a[n]);
  }
  for (double& value : a) value *= peak / std::min(left, right);
  return a;
}

constexpr double angle = 15.0, friction = 25.0;  // degrees; yields under 0.174 g

/// Newmark's rigid block on a slope that falls to the right, under a ground motion along x that is
/// straight between the values of the record: distance that it slides down, m.
double newmark(const std::vector<double>& record, double sign) {
  const double c = std::cos(radians(angle)), s = std::sin(radians(angle)),
               mu = std::tan(radians(friction));
  constexpr int parts = 200;
  const double h = dt / parts;
  double speed = 0.0, way = 0.0;
  for (std::size_t n = 0; n + 1 < record.size(); ++n) {
    for (int k = 0; k < parts; ++k) {
      const double part = (k + 0.5) / parts;
      const double ground = sign * ((1.0 - part) * record[n] + part * record[n + 1]);
      const double pull = gravity * s - ground * c,
                   normal = std::max(0.0, gravity * c + ground * s);
      const bool holds = std::abs(pull) <= mu * normal;
      if (speed == 0.0 && holds) continue;
      const double way_of = speed != 0.0 ? std::copysign(1.0, speed) : std::copysign(1.0, pull);
      const double next = speed + h * (pull - way_of * mu * normal);
      speed = next * way_of < 0.0 && holds ? 0.0 : next;
      way += h * speed;
    }
  }
  return way;
}

std::string toml() {
  const auto box = [](double u0, double v0, double u1, double v1) {
    return "[" + on_slope(angle, u0, v0) + "," + on_slope(angle, u1, v0) + "," +
           on_slope(angle, u1, v1) + "," + on_slope(angle, u0, v1) + "]";
  };
  return "[materials.rock]\ndensity = 2700.0\nyoung = 20e9\npoisson = 0.25\n[joints.j]\n"
         "friction_angle = " +
         number(friction) +
         "\n[solver]\nduration = 100\n[[block]]\nfixed = true\npolygon = " + box(-20, -1, 60, 0) +
         "\n[[block]]\npolygon = " + box(0, 0, 2, 1) +
         "\n[[shaking]]\nname = 'quake'\napply = 'inertia'\nacceleration = { amplitude = 1.0, "
         "frequency = 1.0 }\n";
}

Accelerogram accelerogram(const std::vector<double>& record, double sign) {
  Accelerogram a;
  for (std::size_t n = 0; n < record.size(); ++n) {
    a.time.push_back(static_cast<double>(n) * dt);
    a.acceleration.push_back({sign * record[n], 0.0});
    a.velocity.push_back({});
  }
  return a;
}

TEST(NewmarkRecords, OfEveryShapeBothWaysRound) {
  constexpr double started = 0.3;
  int close = 0, all = 0;
  FurthestOff worst;
  for (const double frequency : {0.7, 1.5, 3.0}) {
    for (const double duration : {4.0, 8.0, 16.0}) {
      for (const double peak : {0.3, 0.6}) {
        for (const double sign : {1.0, -1.0}) {
          const std::vector<double> record = made_record(static_cast<std::uint32_t>(1 + all / 2),
                                                         frequency, duration, peak * gravity);
          Simulation sim = scene(toml());
          Shaking& shaking = sim.scene.edit().model.shakings[0];
          shaking.record = accelerogram(record, sign);
          shaking.acceleration = {
              .file = "made", .amplitude = {}, .frequency = {}, .direction = {}};
          sim.attached.loads.intervals.shakings[0] = {1e9};
          start(sim, started);
          while (sim.motion.state.time < started) ASSERT_FALSE(step(sim).has_value());
          const auto down = [&] {
            const Vec2 x = centroid(sim.motion.state.position, 1);
            return x.x * std::cos(radians(angle)) - x.y * std::sin(radians(angle));
          };
          const double from = down();
          switch_over(sim, {}, {{}, {}, {}, {0}});
          const double end = started + duration;
          fit_step_to(sim, end);
          while (sim.motion.state.time < end) ASSERT_FALSE(step(sim).has_value());
          const double exact = newmark(record, sign), way = down() - from;
          close += std::abs(way / exact - 1.0) < 1e-3 ? 1 : 0;
          ++all;
          worst.see(way, exact);
        }
      }
    }
  }
  EXPECT_EQ(all, 36);
  expect_at_least({70, "", "of 36 slides, within 0.1 %", ""}, close, 32);
  worst.expect({70, "", "the record furthest off, slid", "m"}, 0.05);
}

}  // namespace
}  // namespace edda::newmark_records_test
