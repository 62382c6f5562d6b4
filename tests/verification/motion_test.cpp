// Free motion, impact and rocking: validation.md rows 5, 6, 8.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::motion_test {
namespace {

/// Row 6: a unit square rotating freely; only the true centrifugal strain may appear.
TEST(FreeSpin, AreaAndAngularMomentum) {
  Simulation sim = scene(R"(
gravity = [0.0, 0.0]
plane = "stress"
[materials.rock]
density = 2750.0
young = 200e6
poisson = 0.25
[[block]]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
angular_velocity = 20.0
[solver]
duration = 3.141592653589793
[output]
history_every = 0.0031415926535897931
)");
  const double exact = 2.0 * 2750.0 * 400.0 / 12.0 * (1.0 - 0.25) / 200e6;
  // It oscillates about that with its stretch mode, 12 (C11 + C12)/(rho a^2).
  const double mode = std::sqrt(12.0 * 200e6 / (1.0 - 0.25) / 2750.0);
  Series swelling(6, "area", {"time", "exact", "computed"});
  Series turning(6, "angular momentum", {"turns", "error"});
  double area = 0.0, momentum0 = 0.0, worst = 0.0;
  int rows = 0;
  auto swell = [](const Simulation& s) {
    const Deformation f = deformation(s.scene->blocks, s.motion.state.position, 0);
    return f.xx * f.yy - f.xy * f.yx - 1.0;
  };
  auto look = [&](Simulation& s) {
    area += swell(s);
    ++rows;
    // Angular momentum at n - 1/2: r at the half step, so that it is exact in the leapfrog's terms.
    const Vec2 c = centroid(s.motion.state.position, 0);
    double momentum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 v{s.motion.state.velocity.x[k][0], s.motion.state.velocity.y[k][0]};
      const Vec2 r = Vec2{s.motion.state.position.x[k][0], s.motion.state.position.y[k][0]} - c -
                     0.5 * s.motion.state.step * v;
      momentum += s.motion.masses.node[k][0] * cross(r, v);
    }
    if (rows == 1) momentum0 = momentum;
    worst = std::max(worst, std::abs(momentum / momentum0 - 1.0));
    turning.add(
        {s.motion.state.time * 20.0 / (2.0 * std::numbers::pi), momentum / momentum0 - 1.0});
  };
  run(sim, look, [&](Simulation& s) {
    if (s.motion.state.time < 0.018) {
      swelling.add(
          {s.motion.state.time, exact * (1.0 - std::cos(mode * s.motion.state.time)), swell(s)});
    }
  });
  expect_relative({6, "", "growth of the area, mean over ten turns", ""}, area / rows, exact, 2e-2);
  expect_at_most({6, "", "largest change of angular momentum over its value", ""}, worst, 1e-10);
  record_model(6, "", sim);
}

std::string dropped(double safety) {
  return R"(
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[contact]
normal_stiffness = 1e8
[[block]]
fixed = true
polygon = [[-1, -1], [2, -1], [2, 0], [-1, 0]]
[[block]]
polygon = [[0, 1e-4], [1, 1e-4], [1, 1.0001], [0, 1.0001]]
[solver]
duration = 0.6
safety = )" +
         number(safety) + "\n[output]\nhistory_every = 0.01\n";
}

/// Row 8: depth and contact time of the first bounce; the energy balance over twenty of them.
TEST(Bounce, DepthTimeAndEnergy) {
  const double p = 1e8, m = 2600.0, g = 9.81, drop = 1e-4;
  const double w = std::sqrt(2.0 * p / m), static_depth = m * g / (2.0 * p);
  const double v = std::sqrt(2.0 * g * drop);
  const double depth =
      static_depth + std::sqrt(static_depth * static_depth + 2.0 * static_depth * drop);
  const double time = (std::numbers::pi + 2.0 * std::atan(g / (w * v))) / w;
  // Depth of the lower edge below the base: flights and, in between, half oscillations about
  // `static_depth`, the static depth.
  auto exact_depth = [&](double t) {
    const double since = std::fmod(t + v / g, 2.0 * v / g + time) - 2.0 * v / g;
    if (since < 0.0) return 0.5 * g * since * (since + 2.0 * v / g);
    return static_depth * (1.0 - std::cos(w * since)) + v / w * std::sin(w * since);
  };
  for (const double safety : {0.1, 0.2, 0.4, 0.6, 0.8}) {
    Simulation sim = scene(dropped(safety));
    const std::string label = "step " + brief(safety) + " of the critical one";
    Series path(8, label, {"time", "exact", "computed"}),
        errors(8, "ledger, " + label, {"time", "drift"});
    double error = 0.0, deepest = 0.0, touched = 0.0, left = 0.0;
    double before = -1.0, before_time = 0.0;
    int bounces = 0;
    run(
        sim,
        [&](Simulation& s) {
          keep_largest(error, account_energy(s).error);
          errors.add({s.motion.state.time, std::abs(account_energy(s).error)});
        },
        [&](Simulation& s) {
          const double d = -(s.motion.pose.y[4] + s.scene->blocks.origin.y);
          if (bounces < 4) path.add({s.motion.state.time, exact_depth(s.motion.state.time), d});
          auto crossing = [&] {
            return before_time +
                   (s.motion.state.time - before_time) * (0.0 - before) / (d - before);
          };
          if (before <= 0.0 && d > 0.0 && ++bounces == 1) touched = crossing();
          if (bounces == 1) deepest = std::max(deepest, d);
          if (bounces == 1 && before > 0.0 && d <= 0.0) left = crossing();
          before = d;
          before_time = s.motion.state.time;
        });
    EXPECT_GE(bounces, 20);
    expect_relative({8, label, "depth of the first bounce", "m"}, deepest, depth, 1e-2);
    expect_relative({8, label, "contact time of the first bounce", "s"}, left - touched, time,
                    1e-2);
    expect_at_most({8, label, "largest energy balance error", ""}, error, 1e-5);
    record_model(8, label, sim);
  }
}

/// A mode of a free block: the square of its angular frequency, 1/s2, and the strain rate that
/// starts it.
struct Mode {
  const char* name;
  double omega2;
  Tensor rate;
};

/// The three modes of a free block a x b.
std::vector<Mode> modes_of_a_free_block(double a, double b) {
  const double density = 2500.0, young = 1e9, nu = 0.25;
  const double mu = young / (2 * (1 + nu)), lambda = young * nu / ((1 + nu) * (1 - 2 * nu));
  // Stretch: eigenvalues and vectors of (12/rho)[C11/a^2, C12/a^2; C12/b^2, C22/b^2] acting on
  // strain.
  const double m11 = 12 / density * (lambda + 2 * mu) / (a * a),
               m12 = 12 / density * lambda / (a * a);
  const double m21 = 12 / density * lambda / (b * b),
               m22 = 12 / density * (lambda + 2 * mu) / (b * b);
  const double half = 0.5 * (m11 + m22), root = std::sqrt(half * half - (m11 * m22 - m12 * m21));
  std::vector<Mode> modes;
  for (const auto& [name, w2] :
       {std::pair{"stretch, fast", half + root}, std::pair{"stretch, slow", half - root}}) {
    modes.push_back({name, w2, {m12, w2 - m11, 0.0}});
  }
  modes.push_back(
      {"shear", 12 * mu * (a * a + b * b) / (density * a * a * b * b), {0.0, 0.0, 1.0}});
  return modes;
}

/// Row 7: the three natural frequencies of one free block a x b. Each mode is started by its own
/// strain rate; its strain then crosses zero every half period.
TEST(FreeBlock, NaturalFrequencies) {
  const double a = 2.0, b = 1.0;
  for (const Mode& mode : modes_of_a_free_block(a, b)) {
    Simulation sim = scene(
        "gravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = 1e9\ndamping = 0\n"
        "poisson = 0.25\n[solver]\nduration = 0.05\nsafety = 0.02\n[output]\n"
        "history_every = 0.01\n[[block]]\npolygon = [[0,0],[2,0],[2,1],[0,1]]\n");
    const double size = std::max({std::abs(mode.rate.xx), std::abs(mode.rate.yy), mode.rate.xy});
    // Shear without rotation: velocity (y b-part, x a-part) with zero angular momentum.
    const double shear_x = 2e-3 * mode.rate.xy / size * a * a / (a * a + b * b);
    const double shear_y = 2e-3 * mode.rate.xy / size * b * b / (a * a + b * b);
    for (std::size_t k = 0; k < 3; ++k) {
      const double x = sim.motion.state.position.x[k][0], y = sim.motion.state.position.y[k][0];
      sim.motion.state.velocity.x[k][0] = 1e-3 * mode.rate.xx / size * x + shear_x * y;
      sim.motion.state.velocity.y[k][0] = 1e-3 * mode.rate.yy / size * y + shear_y * x;
    }
    const double exact = std::sqrt(mode.omega2);
    const double amplitude =
        1e-3 / size / exact *
        (mode.rate.xx * mode.rate.xx + mode.rate.yy * mode.rate.yy + mode.rate.xy * mode.rate.xy);
    Series strain(7, mode.name, {"time", "exact", "computed"});
    double before = 0.0, first = 0.0, last = 0.0;
    int crossings = 0;
    run(
        sim, [](Simulation&) {},
        [&](Simulation& s) {
          const Deformation f = deformation(s.scene->blocks, s.motion.state.position, 0);
          const Tensor e = corotated_strain(f, rotation(f));
          const double q = mode.rate.xx * e.xx + mode.rate.yy * e.yy + mode.rate.xy * e.xy;
          if (before * q < 0.0) {
            last = s.motion.state.time - s.motion.state.step * q / (q - before);
            if (++crossings == 1) first = last;
          }
          before = q;
          if (s.motion.state.time * exact < 6.0 * std::numbers::pi) {
            strain.add({s.motion.state.time, std::sin(exact * s.motion.state.time), q / amplitude});
          }
        });
    ASSERT_GT(crossings, 10);
    const double omega = std::numbers::pi * (crossings - 1) / (last - first);
    expect_relative({7, mode.name, "angular frequency", "rad/s"}, omega, exact, 1e-3);
    record_model(7, mode.name, sim);
  }
}

/// Six squares, each rotated 0.1 rad more than the one below, fall on each other and on a fixed
/// base.
std::string falling_squares(double safety, const char* switching) {
  std::string toml =
      "[materials.rock]\ndensity = 2600.0\nyoung = 200e9\ndamping = 0\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 0.0\n[contact]\nnormal_stiffness = 2e9\n[solver]\nduration = 2.5\n"
      "switching = '" +
      std::string(switching) + "'\nsafety = " + number(safety) +
      "\n[output]\nhistory_every = 0.01\n[[block]]\nfixed = true\npolygon = "
      "[[-6,-1],[6,-1],[6,0],[-6,0]]\n";
  for (int i = 0; i < 6; ++i) {
    toml += "[[block]]\npolygon = [";
    for (Vec2 q : {Vec2{-.5, -.5}, Vec2{.5, -.5}, Vec2{.5, .5}, Vec2{-.5, .5}}) {
      const Vec2 p = rotated(q, 0.1 * i) + Vec2{0.0, 0.625 + 1.25 * i};
      toml += "[" + number(p.x) + "," + number(p.y) + "],";
    }
    toml += "]\n";
  }
  return toml;
}

/// The contact activation ("exact") closes the energy balance at every step; "plain", as in the
/// paper, does not.
TEST(FallingSquares, EnergyLedger) {
  for (const double safety : {0.1, 0.2, 0.4, 0.6, 0.8}) {
    double worst = 0.0, end[2] = {0.0, 0.0};
    for (const bool exact : {true, false}) {
      Simulation sim = scene(falling_squares(safety, exact ? "exact" : "plain"));
      run(sim, [&](Simulation& s) {
        const double error = std::abs(account_energy(s).error);
        if (exact) worst = std::max(worst, error);
        end[exact ? 0 : 1] = error;
      });
      EXPECT_EQ(sim.accounts.open_close.not_converged, 0u);
    }
    RecordProperty("safety_" + number(safety), "exact " + number(end[0]) + " plain " +
                                                   number(end[1]) + " worst " + number(worst));
    EXPECT_LT(end[0], safety > 0.6 ? 2e-5 : 1e-5) << safety;
    EXPECT_LT(worst, 5e-5) << safety;
  }
}

/// Row 5: quarter period of rocking from rest, theta'' = -p^2 sin(alpha - theta), p^2 = 3 g/4 R.
class Rocking : public ::testing::TestWithParam<std::pair<const char*, double>> {};

/// The pendulum released at rest, by RK4.
struct Pendulum {
  double alpha, p2, theta;
  double rate = 0.0, t = 0.0;

  void advance() {
    const double h = 1e-5;
    auto acceleration = [&](double q) { return -p2 * std::sin(alpha - q); };
    const double k1 = acceleration(theta), k2 = acceleration(theta + 0.5 * h * rate);
    const double k3 = acceleration(theta + 0.5 * h * rate + 0.25 * h * h * k1);
    const double k4 = acceleration(theta + h * rate + 0.5 * h * h * k2);
    theta += h * rate + h * h * (k1 + k2 + k3) / 6.0;
    rate += h * (k1 + 2.0 * k2 + 2.0 * k3 + k4) / 6.0;
    t += h;
  }
};

/// Until it is upright; the exact figure for 1 x 3 m is 2.44947/4 s.
double quarter_period(Pendulum p) {
  while (p.theta > 0.0) p.advance();
  return p.t - p.theta / p.rate;
}

TEST_P(Rocking, QuarterPeriod) {
  const auto [mass, safety] = GetParam();
  const double alpha = std::atan2(1.0, 3.0), theta0 = 0.5 * alpha, radius = std::sqrt(10.0) / 2.0;
  std::string polygon = "[";
  for (Vec2 p : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 3}, Vec2{0, 3}}) {
    const Vec2 q = rotated(p, -theta0);
    // Tilted about its lower right corner, which stays where it was.
    const Vec2 r = q - rotated(Vec2{1, 0}, -theta0) + Vec2{1, 0};
    polygon += "[" + number(r.x) + "," + number(r.y) + "],";
  }
  polygon += "]";
  Simulation sim = scene(R"(
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
[joints.j]
friction_angle = 60.0
[[block]]
fixed = true
polygon = [[-3, -1], [4, -1], [4, 0], [-3, 0]]
[[block]]
polygon = )" + polygon + "\n[solver]\nduration = 1.25\nmass = '" +
                         mass + "'\nsafety = " + number(safety) +
                         "\n[output]\nhistory_every = 0.001\n");
  double p2 = 3.0 * 9.81 / (4.0 * radius);
  if (std::string(mass) == "covering") {
    const double inertia = radius * radius / 3.0;  // J/M
    const Vec2 node{sim.scene->blocks.node_x[0][1] - sim.scene->blocks.centroid_x[1],
                    sim.scene->blocks.node_y[0][1] - sim.scene->blocks.centroid_y[1]};
    p2 *= (inertia + radius * radius) / (dot(node, node) + radius * radius);
  }
  auto tilt = [&](const Simulation& s) {
    const Rotation r = rotation(deformation(s.scene->blocks, s.motion.state.position, 1));
    return theta0 - std::atan2(r.s, r.c);  // counted clockwise from the tilt at the start
  };
  Series tilts(5, mass, {"time", "exact", "computed"});
  Pendulum pendulum{alpha, p2, theta0};
  double flat_at = 0.0, before = -1.0;
  run(
      sim,
      [&](Simulation& s) {
        while (pendulum.t < s.motion.state.time - 1e-9) pendulum.advance();
        if (pendulum.theta > 0.0) tilts.add({s.motion.state.time, pendulum.theta, tilt(s)});
      },
      [&](Simulation& s) {
        const double theta = tilt(s);
        if (flat_at == 0.0 && theta <= 0.0) {
          flat_at = s.motion.state.time - s.motion.state.step * theta / (theta - before);
        }
        before = theta;
      });
  const double exact = quarter_period({alpha, p2, theta0});
  if (std::string(mass) != "covering") {
    EXPECT_NEAR(exact, 2.44947 / 4.0, 1e-4);
  }
  expect_relative({5, mass, "quarter period", "s"}, flat_at, exact, 1e-4);
  record_model(5, mass, sim);
}

INSTANTIATE_TEST_SUITE_P(Masses, Rocking,
                         ::testing::Values(std::pair{"matched", 0.8}, std::pair{"consistent", 0.8},
                                           std::pair{"covering", 0.8}),
                         [](const auto& test) { return std::string(test.param.first); });

}  // namespace
}  // namespace edda::motion_test
