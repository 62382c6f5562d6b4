// Viscous damping of the blocks' strain: how fast their vibrations decay, and which motion is not
// affected.
#include <algorithm>
#include <cmath>

#include "forces/viscosity.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"

namespace edda::strain_damping_test {
namespace {

std::string free_block(const std::string& material, const std::string& solver = {},
                       const std::string& block = "polygon = [[0,0],[1,0],[1,1],[0,1]]") {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 2e8\npoisson = 0.25\n" +
         material + "[solver]\nduration = 0.05\n" + solver +
         "[output]\nhistory_every = 0.001\n[[block]]\n" + block + "\n";
}

/// Frequency of the shear mode of a unit square, w^2 = 24 G/(rho a^2) (row 7): its lowest, the same
/// as that of an elongation one way and a shortening the other.
const double shear_frequency = std::sqrt(24.0 * 8e7 / 2500.0);

/// Starts the shear mode of block 0, its lowest, by velocities.
void shear(Simulation& sim, double rate) {
  for (std::size_t k = 0; k < 3; ++k) {
    sim.motion.state.velocity.x[k][0] =
        rate * (sim.motion.state.position.y[k][0] - sim.scene->blocks.centroid_y[0]);
    sim.motion.state.velocity.y[k][0] =
        rate * (sim.motion.state.position.x[k][0] - sim.scene->blocks.centroid_x[0]);
  }
}

double strain_and_motion(Simulation& sim) {
  const EnergyBalance l = account_energy(sim);
  return l.kinetic + l.strain;
}

/// Fraction of critical damping found from the energy that remains after many cycles, exp(-2 zeta w
/// t) of the first.
double damping_found(Simulation& sim, double omega) {
  shear(sim, 1e-3);
  start(sim, 0.05);
  const double first = strain_and_motion(sim);
  while (sim.motion.state.time < 0.05) EXPECT_FALSE(step(sim).has_value());
  return -std::log(strain_and_motion(sim) / first) / (2.0 * omega * 0.05);
}

TEST(StrainDamping, IsTheFractionOfTheSoftestVibration) {
  const double exact = shear_frequency;
  for (const char* mass : {"matched", "consistent"}) {
    Simulation sim = scene(
        free_block("damping = 0.05\n", "safety = 0.05\nmass = '" + std::string(mass) + "'\n"));
    EXPECT_NEAR(lowest_frequency(sim.scene->blocks, sim.motion.masses, 0) / exact, 1.0, 1e-6);
    EXPECT_NEAR(damping_found(sim, exact) / 0.05, 1.0, 0.02) << mass;
    EXPECT_LT(std::abs(account_energy(sim).error), 1e-9);
    EXPECT_GT(account_energy(sim).damping, 0.0);
  }
}

TEST(StrainDamping, RayleighsIsLeastAtItsFrequency) {
  // (w_0/w + w/w_0)/2 of the fraction given at w_0. The shear mode has no rigid motion.
  const double w = shear_frequency;
  for (const double ratio : {0.5, 1.0, 3.0}) {
    const double frequency = ratio * w / (2.0 * std::numbers::pi);
    Simulation sim = scene(free_block("",
                                      "safety = 0.05\ndamping = { rayleigh = { fraction = 0.03, "
                                      "frequency = " +
                                          number(frequency) + " } }\n"));
    EXPECT_NEAR(damping_found(sim, w) / (0.03 * 0.5 * (ratio + 1.0 / ratio)), 1.0, 0.02) << ratio;
  }
}

TEST(StrainDamping, IsThatOfTheImplicitMethodToo) {
  // The scheme's own damping, w h/4 of critical, is small at this step.
  const double w = shear_frequency;
  Simulation sim = scene(free_block("damping = 0.05\n", "method = 'dda'\ntime_step = 1e-5\n"));
  EXPECT_NEAR((damping_found(sim, w) - 0.25 * w * 1e-5) / 0.05, 1.0, 0.02);
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-6);
}

/// Rigid motion is not damped: a strained block that rotates, flies and falls is not affected.
TEST(StrainDamping, LeavesRigidMotionAlone) {
  Simulation sim = scene(free_block("", "",
                                    "polygon = [[0,0],[2,0],[2.3,1],[0.2,0.8]]\nvelocity = [3, 1]\n"
                                    "angular_velocity = 15"));
  const auto momentum = [&] {
    double turning = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 x{sim.motion.state.position.x[k][0], sim.motion.state.position.y[k][0]},
          v{sim.motion.state.velocity.x[k][0], sim.motion.state.velocity.y[k][0]};
      turning += sim.motion.masses.node[k][0] * cross(x - 0.5 * sim.motion.state.step * v, v);
    }
    return turning;
  };
  start(sim, 2.0);
  const double before = momentum();
  while (sim.motion.state.time < 0.5) ASSERT_FALSE(step(sim).has_value());
  const double taken =
      account_energy(sim).damping;  // of the vibration that the sudden rotation began
  while (sim.motion.state.time < 2.0) ASSERT_FALSE(step(sim).has_value());
  EXPECT_NEAR(momentum() / before, 1.0, 1e-12);
  const EnergyBalance end = account_energy(sim);
  EXPECT_LT(end.damping - taken, 1e-9 * end.kinetic);
  EXPECT_GT(taken, 0.0);
  EXPECT_LT(std::abs(end.error), 1e-9);
}

/// A block strikes another: the momentum of both together is conserved.
TEST(StrainDamping, KeepsTheMomentumOfACollision) {
  Simulation sim = scene(
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 35\n[solver]\nduration = 0.2\n[output]\nhistory_every = 0.01\n[[block]]\n"
      "polygon = [[0,0],[2,0],[2,1],[0,1]]\n[[block]]\n"
      "polygon = [[0.3,1.05],[1.2,1.2],[0.9,2.1],[0,1.9]]\nvelocity = [0.5, -4]\n"
      "angular_velocity = 2\n");
  const auto momentum = [&] {
    std::array<double, 3> p{};
    for (std::size_t i = 0; i < 2; ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double m = sim.motion.masses.node[k][i];
        const Vec2 x{sim.motion.state.position.x[k][i], sim.motion.state.position.y[k][i]},
            v{sim.motion.state.velocity.x[k][i], sim.motion.state.velocity.y[k][i]};
        p[0] += m * v.x;
        p[1] += m * v.y;
        p[2] += m * cross(x - 0.5 * sim.motion.state.step * v, v);
      }
    }
    return p;
  };
  start(sim, 0.2);
  const auto before = momentum();
  while (sim.motion.state.time < 0.2) ASSERT_FALSE(step(sim).has_value());
  const auto after = momentum();
  EXPECT_GT(account_energy(sim).damping, 100.0);
  for (std::size_t q = 0; q < 3; ++q) EXPECT_NEAR(after[q], before[q], 1e-8 * std::abs(before[1]));
  EXPECT_LT(std::abs(account_energy(sim).error), 1e-5);
}

std::string rayleigh(double fraction, double frequency) {
  return "rayleigh = { fraction = " + number(fraction) + ", frequency = " + number(frequency) +
         " }";
}

TEST(StrainDamping, RayleighsOfAMaterialIsLeastAtItsFrequency) {
  const double w = shear_frequency;
  for (const double ratio : {0.5, 3.0}) {
    const double frequency = ratio * w / (2.0 * std::numbers::pi),
                 expected = 0.03 * 0.5 * (ratio + 1.0 / ratio);
    // In place of the damping of the solver and of the material's own strain damping.
    Simulation sim =
        scene(free_block("damping = 0.4\n" + rayleigh(0.03, frequency) + "\n",
                         "safety = 0.05\ndamping = { " + rayleigh(0.2, 50.0) + " }\n"));
    EXPECT_NEAR(damping_found(sim, w) / expected, 1.0, 0.02) << ratio;
    EXPECT_LT(std::abs(account_energy(sim).error), 1e-9);
    Simulation implicit =
        scene(free_block(rayleigh(0.03, frequency) + "\n", "method = 'dda'\ntime_step = 1e-5\n"));
    EXPECT_NEAR((damping_found(implicit, w) - 0.25 * w * 1e-5) / expected, 1.0, 0.02) << ratio;
    EXPECT_LT(std::abs(account_energy(implicit).error), 1e-6);
  }
}

/// Two materials with what the solver has are the same as the solver's.
TEST(StrainDamping, RayleighsOfAllMaterialsIsThatOfTheSolver) {
  const auto made = [](const std::string& material, const std::string& solver) {
    const std::string rock = "density = 2500\nyoung = 2e8\npoisson = 0.25\n" + material;
    return scene("[materials.rock]\n" + rock + "[materials.fill]\n" + rock +
                 "[joints.j]\nfriction_angle = 35\n[solver]\nduration = 0.2\n" + solver +
                 "[[block]]\nmaterial = 'rock'\npolygon = [[0,0],[2,0],[2,1],[0,1]]\nfixed = true\n"
                 "[[block]]\nmaterial = 'rock'\npolygon = [[0,1],[2,1],[2,2],[0,2]]\n"
                 "velocity = [0.3, -0.2]\n[[block]]\nmaterial = 'fill'\n"
                 "polygon = [[0,2],[2,2],[2,3],[0,3]]\nangular_velocity = 0.2\n");
  };
  for (const char* method : {"", "method = 'dda'\ntime_step = 1e-3\n"}) {
    Simulation own = made(rayleigh(0.05, 20.0) + "\n", method),
               all = made("", method + ("damping = { " + rayleigh(0.05, 20.0) + " }\n"));
    for (Simulation* sim : {&own, &all}) {
      start(*sim, 0.2);
      while (sim->motion.state.time < 0.2) ASSERT_FALSE(step(*sim).has_value());
    }
    EXPECT_EQ(own.motion.state.steps, all.motion.state.steps);
    EXPECT_EQ(own.motion.state.position.x, all.motion.state.position.x);
    EXPECT_EQ(own.motion.state.velocity.y, all.motion.state.velocity.y);
    EXPECT_LT(std::abs(account_energy(own).error), 1e-4);
  }
}

/// The part of critical with which the top of a column swings, whose weight acts all at once: from
/// the extremes of its displacement after the first two, and its frequency.
struct Swing {
  double fraction = 0.0, omega = 0.0, error = 0.0;
};
Swing swing_of(Simulation& sim, std::size_t vertex, double duration) {
  std::vector<double> extremes, times;
  double before = sim.motion.pose.y[vertex], slope = 0.0;
  start(sim, duration);
  while (sim.motion.state.time < duration) {
    EXPECT_FALSE(step(sim).has_value());
    const double now = sim.motion.pose.y[vertex];
    if (slope * (now - before) < 0.0) {
      extremes.push_back(before);
      times.push_back(sim.motion.state.time - sim.motion.state.step);
    }
    slope = now - before;
    before = now;
  }
  Swing s;
  s.error = account_energy(sim).error;
  const std::size_t last = extremes.size() - 1, first = 2;
  EXPECT_GT(last, first + 2);
  if (last < first + 2) return s;
  const double swings = double(last - first - 1),
               half = (times[last] - times[first]) / double(last - first),
               decay = std::log((extremes[first + 1] - extremes[first]) /
                                (extremes[last] - extremes[last - 1]) *
                                (int(swings) % 2 == 0 ? 1.0 : -1.0)) /
                       swings;
  s.fraction = decay / std::numbers::pi;
  s.omega = std::numbers::pi / half;
  return s;
}

/// A column of zones on a base, its lower half of rock and its upper one of fill with the same
/// elasticity: a part p of the kinetic energy of its first mode, sin(pi y/2L), and 1 - p of its
/// elastic energy are in the lower half, p = 1/2 - 1/pi. For small damping the fraction of critical
/// is sum (a w^-1 kinetic part + b w elastic part)/2.
TEST(StrainDamping, RayleighsOfTwoMaterialsInAColumnOfZones) {
  const double w = 0.5 * std::numbers::pi / 10.0 * std::sqrt(2e8 / 2000.0),
               hertz = w / (2.0 * std::numbers::pi), p = 0.5 - 1.0 / std::numbers::pi;
  const std::string elastic = "density = 2000\nyoung = 2e8\npoisson = 0\n";
  const double low = 0.01, high = 0.06;
  Simulation sim = scene(
      "gravity = [0, -1]\ndeformation = 'zones'\n[zones]\nsize = 1\n[materials.rock]\n" + elastic +
      rayleigh(low, hertz) + "\n[materials.fill]\n" + elastic + rayleigh(high, 2.0 * hertz) +
      "\n[joints.j]\ntype = 'glued'\nkn = 1e12\n[solver]\nduration = 1.6\n"
      "[[block]]\nmaterial = 'rock'\npolygon = [[0,0],[1,0],[1,5],[0,5]]\n"
      "[[block]]\nmaterial = 'fill'\npolygon = [[0,5],[1,5],[1,10],[0,10]]\n"
      "[[boundary]]\ntype = 'fixed'\nalong = [[0,0],[1,0]]\nstiffness = 1e12\n");
  const BlockSet& b = sim.scene->blocks;
  std::size_t top = 0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v)
    if (b.vertex_y[v] > b.vertex_y[top]) top = v;
  const Swing s = swing_of(sim, top, 1.6);
  EXPECT_NEAR(s.omega, w, 0.01 * w);
  const double expected =
      0.5 * (low * p + 2.0 * high * (1.0 - p)) + 0.5 * (low * (1.0 - p) + 0.5 * high * p);
  EXPECT_NEAR(s.fraction, expected, 0.03 * expected);
  EXPECT_LT(std::abs(s.error), 1e-4);
  EXPECT_GT(account_energy(sim).damping, 0.0);
}

}  // namespace
}  // namespace edda::strain_damping_test
