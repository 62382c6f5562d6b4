// External loads: validation.md row 14, and the energy balance of loads in both methods.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::water_test {
namespace {

constexpr double width = 2.0, height = 8.0, heavy = 24e3, water = 9810.0;

/// A dam on rock, water up to `depth` above its base on the left, rising over two seconds.
std::string dam(double depth, const std::string& solver) {
  return R"(
[materials.concrete]
unit_weight = 24e3
young = 20e9
poisson = 0.2
[joints.base]
friction_angle = 35
[contact]
normal_stiffness = 20e9
[[block]]
fixed = true
polygon = [[-3, -1], [9, -1], [9, 0], [-3, 0]]
[[block]]
polygon = )" +
         rectangle(0.0, 0.0, width, height) + "\n[[water]]\ntable = [[-9, " + number(depth) +
         "], [0, " + number(depth) + "]]\n[output]\nhistory_every = 0.05\n[solver]\n" + solver;
}

Simulation filled(double depth, const std::string& solver) {
  Simulation sim = scene(dam(depth, solver));
  sim.scene.edit().model.waters[0].rise = {{0.0, 2.0}, {-depth, 0.0}};
  return sim;
}

/// Downstream displacement of the crest at the end, m.
double leans(double depth) {
  Simulation sim = filled(depth, "duration = 4.0\ndamping = { local = 0.5 }\n");
  double error = 0.0;
  run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
  EXPECT_LT(error, 1e-5);
  const Id crest = sim.scene->blocks.vertex_begin[1] + 3;
  return sim.motion.pose.x[crest] - sim.scene->blocks.vertex_x[crest];
}

/// Row 14: the dam overturns where the moment of the water, gw h^3/6, equals that of its weight, gc
/// B^2 H/2, about the toe; no uplift. The depth at which it overturns is found by bisection.
TEST(Dam, Overturns) {
  const double exact = std::cbrt(3.0 * heavy * width * width * height / water);
  double holds = 0.9 * exact, falls = 1.1 * exact;
  while (falls - holds > 1e-3 * exact) {
    const double middle = 0.5 * (holds + falls);
    (leans(middle) > 0.05 ? falls : holds) = middle;
  }
  EXPECT_GT(holds, 0.9 * exact);
  EXPECT_LT(falls, 1.1 * exact);
  expect_relative({14, "", "depth of water that overturns the dam", "m"}, 0.5 * (holds + falls),
                  exact, 2e-2);
  Series series(14, "", {"h", "crest"});
  for (const double part : {0.90, 0.94, 0.97, 0.99, 1.00, 1.01, 1.02, 1.03}) {
    if (!recording()) break;
    series.add({part * exact, leans(part * exact)});
  }
  Simulation sim = filled(1.02 * exact, "duration = 4.0\ndamping = { local = 0.5 }\n");
  run(sim, [](Simulation&) {});
  record_model(14, "", sim);
}

/// A square under a traction that increases and decreases: its energy is the work of the load.
std::string pushed(const std::string& solver) {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = 2e9\npoisson = 0.2\n"
         "[joints.j]\nfriction_angle = 0\n[[block]]\npolygon = " +
         rectangle(0, 0, 1, 1) +
         "\n[[load]]\nalong = [[0, 0], [0, 1]]\nforce = [1e5, 0]\n[[load]]\npoint = [1, 0.25]\n"
         "force = [0, 2e4]\n[output]\nhistory_every = 0.01\n[solver]\nduration = 0.2\n" +
         solver;
}

TEST(Load, WorkIsTheEnergyOfTheMotion) {
  for (const auto& [method, close] : {std::pair{"time_step = 1e-4\n", 1e-6},
                                      std::pair{"method = 'dda'\ntime_step = 1e-4\n", 1e-3}}) {
    Simulation sim = scene(pushed(method));
    sim.scene.edit().model.loads[0].factor = {{0.0, 0.1, 0.2}, {0.0, 1.0, 0.0}};
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    const EnergyBalance l = account_energy(sim);
    EXPECT_LT(error, close) << method;
    EXPECT_GT(l.external, 0.0);
    EXPECT_NEAR((l.kinetic + l.strain + l.damping) / l.external, 1.0, 2.0 * close) << method;
    // Momentum is the load's impulse: 1e5 over half of 0.2 s, and 2e4 over all of it.
    const Vec2 v = centroid(sim.motion.state.velocity, 0);
    EXPECT_NEAR(v.x * 2500.0 / 1e4, 1.0, 2e-3) << method;
    EXPECT_NEAR(v.y * 2500.0 / 4e3, 1.0, 2e-3) << method;
  }
}

/// A block released under water rises and oscillates: it floats with that part under water whose
/// displaced water has its weight.
TEST(Water, FloatsABlock) {
  for (const std::string method :
       {"damping = { mass = 3.0 }\n",
        "method = 'dda'\ntime_step = 0.01\ndamping = { mass = 3.0 }\n"}) {
    Simulation sim = scene(
        "[materials.wood]\ndensity = 600.0\nyoung = 1e7\npoisson = 0.0\n[joints.j]\nfriction_angle "
        "= 0\n[[block]]\npolygon = " +
        rectangle(-1, -2, 1, -1) +
        "\n[[water]]\ntable = [[-9, 0], [9, 0]]\n[output]\nhistory_every = 1.0\n[solver]\n"
        "duration = 12.0\n" +
        method);
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    const double bottom = -2.0 + displacement(sim, 0).y;
    EXPECT_NEAR(bottom, -600.0 * 9.81 / 9810.0, 1e-3) << method;
    EXPECT_LT(error, 1e-4) << method;  // implicit: forces balance to 1e-3
  }
}

/// A pressure follows the face: a rotating square with pressure on one side is driven in a
/// direction that rotates with it, by both methods alike, and its energy is the work of the
/// pressure.
TEST(Load, PressureTurnsWithItsFace) {
  Vec2 end[2];
  int which = 0;
  for (const std::string method : {"time_step = 2e-5\n", "method = 'dda'\ntime_step = 2e-5\n"}) {
    Simulation sim = scene(
        "gravity = [0, 0]\nthickness = 2.0\n[materials.rock]\ndensity = 2500.0\nyoung = 2e9\n"
        "poisson = 0.2\n[joints.j]\nfriction_angle = 0\n[[block]]\nangular_velocity = "
        "20.0\npolygon = " +
        rectangle(0, 0, 1, 1) +
        "\n[[load]]\nalong = [[0, 0], [0, 1]]\npressure = 5e4\n[output]\nhistory_every = 0.01\n"
        "[solver]\nduration = 0.5\n" +
        method);
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    EXPECT_LT(error, 1e-4) << method;
    end[which++] = displacement(sim, 0);
  }
  // Driven by p/rho in a direction that rotates at w: x = p/(rho w^2) (1 - cos wt), y alike.
  const double a = 5e4 / 2500.0 / 400.0, angle = 10.0;
  EXPECT_NEAR(end[0].x, a * (1.0 - std::cos(angle)), 2e-3 * a);
  EXPECT_NEAR(end[0].y, a * (angle - std::sin(angle)), 2e-3 * a * angle);
  EXPECT_LT(norm(end[0] - end[1]), 1e-2 * norm(end[0]));
}

}  // namespace
}  // namespace edda::water_test
