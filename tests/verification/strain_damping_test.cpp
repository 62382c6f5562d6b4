// Viscous damping of the blocks' strain: how fast their own vibrations die away, and what it leaves
// alone.
#include <algorithm>
#include <cmath>

#include "forces/viscosity.hpp"
#include "verification/models.hpp"

namespace edda::strain_damping_test {
namespace {

std::string free_block(const std::string& material, const std::string& solver = {},
                       const std::string& block = "polygon = [[0,0],[1,0],[1,1],[0,1]]") {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2500\nyoung = 2e8\npoisson = 0.25\n" +
         material + "[solver]\nduration = 0.05\n" + solver +
         "[output]\nhistory_every = 0.001\n[[block]]\n" + block + "\n";
}

/// Of a unit square, w^2 = 24 G/(rho a^2) (row 7): its softest, with that of a stretch one way and
/// a shortening the other.
const double shear_frequency = std::sqrt(24.0 * 8e7 / 2500.0);

/// Shears block 0, its softest vibration, by velocities.
void shear(Simulation& sim, double rate) {
  for (std::size_t k = 0; k < 3; ++k) {
    sim.state.vx[k][0] = rate * (sim.state.y[k][0] - sim.blocks.centroid_y[0]);
    sim.state.vy[k][0] = rate * (sim.state.x[k][0] - sim.blocks.centroid_x[0]);
  }
}

double strain_and_motion(Simulation& sim) {
  const Ledger l = sim.ledger();
  return l.kinetic + l.strain;
}

/// The rest energy after many cycles: exp(-2 zeta w t) of it.
double damping_found(Simulation& sim, double omega) {
  shear(sim, 1e-3);
  sim.start(0.05);
  const double first = strain_and_motion(sim);
  while (sim.state.time < 0.05) EXPECT_FALSE(sim.step().has_value());
  return -std::log(strain_and_motion(sim) / first) / (2.0 * omega * 0.05);
}

TEST(StrainDamping, IsTheFractionOfTheSoftestVibration) {
  const double exact = shear_frequency;
  for (const char* mass : {"matched", "consistent"}) {
    Simulation sim = scene(
        free_block("damping = 0.05\n", "safety = 0.05\nmass = '" + std::string(mass) + "'\n"));
    EXPECT_NEAR(lowest_frequency(sim.blocks, 0) / exact, 1.0, 1e-6);
    EXPECT_NEAR(damping_found(sim, exact) / 0.05, 1.0, 0.02) << mass;
    EXPECT_LT(std::abs(sim.ledger().drift), 1e-9);
    EXPECT_GT(sim.ledger().damping, 0.0);
  }
}

TEST(StrainDamping, RayleighsIsLeastAtItsFrequency) {
  // (w_0/w + w/w_0)/2 of the fraction given at w_0. The shear has no motion of the whole.
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
  // Of the scheme's own, w h/4 of critical, little is left at this step.
  const double w = shear_frequency;
  Simulation sim = scene(free_block("damping = 0.05\n", "method = 'dda'\ntime_step = 1e-5\n"));
  EXPECT_NEAR((damping_found(sim, w) - 0.25 * w * 1e-5) / 0.05, 1.0, 0.02);
  EXPECT_LT(std::abs(sim.ledger().drift), 1e-6);
}

/// Rigid motion is what it is without: a strained block that turns, flies and falls feels nothing.
TEST(StrainDamping, LeavesRigidMotionAlone) {
  Simulation sim = scene(free_block("", "",
                                    "polygon = [[0,0],[2,0],[2.3,1],[0.2,0.8]]\nvelocity = [3, 1]\n"
                                    "angular_velocity = 15"));
  const auto momentum = [&] {
    double turning = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 x{sim.state.x[k][0], sim.state.y[k][0]}, v{sim.state.vx[k][0], sim.state.vy[k][0]};
      turning += sim.blocks.node_mass[k][0] * cross(x - 0.5 * sim.state.step * v, v);
    }
    return turning;
  };
  sim.start(2.0);
  const double before = momentum();
  while (sim.state.time < 0.5) ASSERT_FALSE(sim.step().has_value());
  const double taken = sim.ledger().damping;  // of the vibration that the sudden turn began
  while (sim.state.time < 2.0) ASSERT_FALSE(sim.step().has_value());
  EXPECT_NEAR(momentum() / before, 1.0, 1e-12);
  const Ledger end = sim.ledger();
  EXPECT_LT(end.damping - taken, 1e-9 * end.kinetic);
  EXPECT_GT(taken, 0.0);
  EXPECT_LT(std::abs(end.drift), 1e-9);
}

/// A block in a fall strikes another: what the two have of momentum stays.
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
        const double m = sim.blocks.node_mass[k][i];
        const Vec2 x{sim.state.x[k][i], sim.state.y[k][i]},
            v{sim.state.vx[k][i], sim.state.vy[k][i]};
        p[0] += m * v.x;
        p[1] += m * v.y;
        p[2] += m * cross(x - 0.5 * sim.state.step * v, v);
      }
    }
    return p;
  };
  sim.start(0.2);
  const auto before = momentum();
  while (sim.state.time < 0.2) ASSERT_FALSE(sim.step().has_value());
  const auto after = momentum();
  EXPECT_GT(sim.ledger().damping, 100.0);
  for (std::size_t q = 0; q < 3; ++q) EXPECT_NEAR(after[q], before[q], 1e-8 * std::abs(before[1]));
  EXPECT_LT(std::abs(sim.ledger().drift), 1e-5);
}

}  // namespace
}  // namespace edda::strain_damping_test
