// The acceleration of monitors: what an accelerometer records.
#include "observe/monitors.hpp"
#include "verification/models.hpp"

namespace edda::acceleration_test {
namespace {

constexpr double g = 9.81;

/// A fixed base with its middle at the first monitor, and a block with the second in its own, which
/// begins `above` it.
std::string block_on_base(double above, double friction, const std::string& more) {
  return "gravity = [0, -9.81]\n[materials.rock]\ndensity = 2500\nyoung = 5e9\npoisson = 0.2\n"
         "[joints.j]\nfriction_angle = " +
         number(friction) + "\n[[block]]\nfixed = true\npolygon = " + rectangle(-9, -1, 9, 0) +
         "\n[[block]]\npolygon = " + rectangle(-0.5, above, 0.5, above + 0.5) +
         "\n[[monitor]]\nname = 'base'\npoint = [0, -0.5]\n[[monitor]]\nname = "
         "'block'\npoint = [0, " +
         number(above + 0.25) + "]\n" + more;
}

struct Readings {
  double time;
  MonitorReading base, block;
};

Readings read(const Simulation& sim) {
  const auto monitors = place_monitors(sim).value();
  Instant at;
  observe(sim, at);
  return {at.state.time, read_monitor(sim, at, monitors[0]), read_monitor(sim, at, monitors[1])};
}

const std::vector<std::string> methods{"", "mass = 'consistent'\n", "method = 'dda'\n"};

/// -g from the first row on, and nothing at rest: gravity is no part of it.
TEST(Acceleration, IsThatOfGravityInFreeFallAndNoneAtRest) {
  for (const std::string& method : methods) {
    Simulation fall = scene(block_on_base(
        1.0, 30.0, "[output]\nhistory_every = 0.05\n[solver]\nduration = 0.2\n" + method));
    run(fall, [&](Simulation& s) {
      const Readings r = read(s);
      EXPECT_NEAR(r.block.acceleration.x, 0.0, 1e-6) << method;
      EXPECT_NEAR(r.block.acceleration.y, -g, 1e-6) << method << r.time;
      EXPECT_EQ(norm(r.base.acceleration), 0.0);
    });
    Simulation rest = scene(block_on_base(0.0, 30.0,
                                          "[output]\nhistory_every = 0.1\n[solver]\nduration = "
                                          "0.5\ndamping = { mass = 100 }\n" +
                                              method));
    run(rest, [](Simulation&) {});
    EXPECT_NEAR(norm(read(rest).block.acceleration), 0.0, 5e-3) << method;
  }
}

/// With the ground, which moves under apply = "base" and stays under "inertia".
TEST(Acceleration, OfABlockThatSticksIsThatOfItsShakenBase) {
  for (const std::string apply : {"base", "inertia"}) {
    Simulation sim = scene(block_on_base(
        0.0, 40.0,
        "[[shaking]]\nacceleration = { amplitude = 4, frequency = 2 }\napply = '" + apply +
            "'\n[output]\nhistory_every = 0.02\n[solver]\nduration = 1\ndamping = { contact = 0.3 "
            "}\n"));
    run(sim, [&](Simulation& s) {
      const Readings r = read(s);
      const double exact = 4.0 * std::sin(4.0 * std::numbers::pi * r.time);
      EXPECT_NEAR(r.base.acceleration.x, exact, 1e-9) << apply;
      if (r.time <= 0.5) return;
      EXPECT_NEAR(r.block.acceleration.x, exact, 0.25) << apply << r.time;
    });
  }
}

/// Newmark (1965): friction gives a sliding block mu g, however strong the shaking is.
TEST(Acceleration, OfASlidingBlockIsThatOfFriction) {
  const double limit = std::tan(radians(20.0)) * g;
  for (const std::string apply : {"base", "inertia"}) {
    Simulation sim = scene(
        block_on_base(0.0, 20.0,
                      "[[shaking]]\nacceleration = { amplitude = 12, frequency = 1 }\napply = '" +
                          apply + "'\n[output]\nhistory_every = 0.01\n[solver]\nduration = 0.4\n"));
    double sum = 0.0;
    int rows = 0;
    run(sim, [&](Simulation& s) {
      const Readings r = read(s);
      if (r.time < 0.2) return;
      sum += r.block.acceleration.x;
      ++rows;
    });
    EXPECT_NEAR(sum / rows, limit, 0.02 * limit) << apply;
  }
}

/// Of the motion as it is integrated: (x_{n+1} - 2 x_n + x_{n-1})/h^2, and with Newmark's method
/// (v_n - v_{n-1})/h, but for the angular momentum that it restores.
TEST(Acceleration, IsThatOfTheIntegration) {
  const std::string hung =
      "gravity = [3, -9.81]\n[materials.rock]\ndensity = 2500\nyoung = 2e7\npoisson = "
      "0.2\n[joints.j]\nfriction_angle = 0\n[[block]]\npolygon = " +
      rectangle(0, 0, 1, 1) +
      "\n[[boundary]]\nsides = ['left']\nstiffness = 2e7\n[[monitor]]\nname = 'a'\npoint = "
      "[0.9, 0.8]\n[[monitor]]\nname = 'b'\npoint = [0.2, 0.4]\n[solver]\nduration = 1\n"
      "damping = { mass = 5 }\n";
  for (const std::string method : {"time_step = 1e-4\n", "time_step = 1e-4\nmass = 'consistent'\n",
                                   "time_step = 1e-3\nmethod = 'dda'\n"}) {
    Simulation sim = scene(hung + method);
    const double h = *sim.scene->model.solver.time_step;
    const bool leaps = is_explicit(sim);
    start(sim, 1.0);
    std::vector<MonitorReading> at{read(sim).base};
    double largest = 0.0;
    for (int n = 1; n < 60; ++n) {
      ASSERT_FALSE(step(sim));
      at.push_back(read(sim).base);
    }
    for (std::size_t n = 1; n + 1 < at.size(); ++n) {
      const Vec2 exact =
          leaps ? (1.0 / (h * h)) *
                      (at[n + 1].displacement - 2.0 * at[n].displacement + at[n - 1].displacement)
                : (1.0 / h) * (at[n].velocity - at[n - 1].velocity);
      EXPECT_NEAR(norm(at[n].acceleration - exact), 0.0, leaps ? 2e-6 : 1e-4) << method << n;
      largest = std::max(largest, norm(at[n].acceleration));
    }
    EXPECT_GT(largest, 3.0) << method;
  }
}

}  // namespace
}  // namespace edda::acceleration_test
