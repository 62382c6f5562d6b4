// The implicit method in motion: the damping of its time integration, and what it conserves.
#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>
#include <string>
#include <utility>
#include <vector>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/implicit_models.hpp"
#include "verification/models.hpp"

namespace edda::implicit_motion_test {
namespace {

/// Block on boundary springs, w = sqrt(sum k/m), with an initial velocity; the time step determines
/// w h.
std::string oscillator(const std::string& solver) {
  return R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2500.0
young = 1e13
poisson = 0.0
[joints.j]
friction_angle = 0.0
[[block]]
velocity = [1e-4, 0.0]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[boundary]]
name = "below"
sides = ["bottom", "top"]
type = "fixed"
stiffness = 2.5e7
[output]
history_every = 1.0
[solver]
duration = 1.0
)" + solver;
}

/// Newmark with beta = 1/2, gamma = 1: amplitude per step (1 + w^2 h^2/2)^(-1/2) while w h < 4.
TEST(ImplicitOscillator, AlgorithmicDampingIsThatOfTheory) {
  const double omega = std::sqrt(4.0 * 2.5e7 / 2500.0);
  for (const double wh : {0.05, 0.3, 1.0, 2.0, 3.0, 3.9}) {
    const double h = wh / omega;
    Simulation sim = scene(oscillator(dda(h) + "max_displacement_ratio = 1.0\n"));
    start(sim, 1e9 * h);
    // Both eigenvalues of the step have this modulus, and their product is the determinant of the
    // step: the ratio of the determinants of two successive pairs (x, v).
    double x[3], v[3];
    for (int n = 0; n < 3; ++n) {
      step(sim);
      x[n] = displacement(sim, 0).x;
      v[n] = centroid(sim.motion.state.velocity, 0).x;
    }
    const double before = x[0] * v[1] - x[1] * v[0], after = x[1] * v[2] - x[2] * v[1];
    const double measured = std::sqrt(after / before),
                 theory = 1.0 / std::sqrt(1.0 + 0.5 * wh * wh);
    RecordProperty("ratio_" + number(wh), number(measured / theory));
    EXPECT_NEAR(measured / theory, 1.0, 1e-2) << wh;
  }
}

/// Over ten periods the leapfrog loses no energy.
TEST(ImplicitOscillator, ExplicitShowsNoDamping) {
  Simulation sim = scene(oscillator("time_step = 2e-7\n"));
  const double period = 2.0 * std::numbers::pi / std::sqrt(4.0 * 2.5e7 / 2500.0);
  start(sim, 10.0 * period);
  double first = 0.0, last = 0.0;
  while (sim.motion.state.time < 3.0 * period) {
    ASSERT_FALSE(step(sim));
    const double x = std::abs(displacement(sim, 0).x);
    (sim.motion.state.time < period ? first : last) =
        std::max(sim.motion.state.time < period         ? first
                 : sim.motion.state.time > 2.0 * period ? last
                                                        : 0.0,
                 x);
  }
  EXPECT_NEAR(last / first, 1.0, 1e-6);
}

/// Without contacts the scheme follows a parabola exactly, at any step.
TEST(ImplicitFlight, FollowsTheParabola) {
  std::string toml = R"(
[materials.rock]
density = 2500.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
fixed = true
polygon = [[-50, -101], [50, -101], [50, -100], [-50, -100]]
[[block]]
velocity = [3.0, 2.0]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[output]
history_every = 0.5
[solver]
duration = 0.5
max_displacement_ratio = 1.0
)";
  Simulation sim = scene(toml + dda(0.01));
  run(sim, [](Simulation&) {});
  const Vec2 u = displacement(sim, 1);
  EXPECT_NEAR(u.x, 1.5, 1e-9);
  EXPECT_NEAR(u.y, 1.0 - 0.5 * 9.81 * 0.25, 1e-9);
}

/// Positions are total and each step's equations are solved until forces balance: a block that
/// rotates keeps its area, where codes that add up linear increments see it grow.
TEST(ImplicitSpin, KeepsItsArea) {
  const std::string toml = R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2500.0
young = 1e10
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
angular_velocity = 6.283185307179586
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[output]
history_every = 0.1
[solver]
duration = 1.0
max_displacement_ratio = 1.0
)";
  Simulation sim = scene(toml + dda(1e-3));
  run(sim, [](Simulation& s) {
    const Deformation f = deformation(s.scene->blocks, s.motion.state.position, 0);
    EXPECT_NEAR(f.xx * f.yy - f.xy * f.yx, 1.0, 1e-4);
  });
}

/// Ten revolutions of a free block that also translates, at the default step.
TEST(ImplicitSpin, KeepsItsEnergyFromTurnToTurn) {
  for (const char* mass : {"matched", "covering", "consistent"}) {
    for (const double rate : {1.0, 10.0, 100.0}) {
      const double turn = 2.0 * std::numbers::pi / rate;
      Simulation sim = scene(R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2600.0
young = 20e9
poisson = 0.2
[joints.j]
friction_angle = 30.0
[[block]]
polygon = [[0, 0], [1.2, 0], [1, 1], [0, 0.8]]
velocity = [0.3, -0.2]
angular_velocity = )" + number(rate) +
                             "\n[solver]\nmethod = 'dda'\nmass = '" + mass +
                             "'\nduration = " + number(10.0 * turn) +
                             "\n[output]\nhistory_every = " + number(turn) + "\n");
      std::vector<double> energy, balance;
      run(sim, [&](Simulation& s) {
        const EnergyBalance l = account_energy(s);
        energy.push_back(l.kinetic + l.strain);
        balance.push_back(l.balance());
      });
      ASSERT_EQ(energy.size(), 11U);
      for (std::size_t k = 1; k < energy.size(); ++k) {
        EXPECT_NEAR(energy[k], energy[k - 1], 1e-3 * energy[0]) << mass << ' ' << rate << ' ' << k;
        EXPECT_NEAR(balance[k], balance[0], 1e-4 * energy[0]) << mass << ' ' << rate << ' ' << k;
      }
      const Vec2 u = displacement(sim, 0);
      EXPECT_NEAR(u.x, 0.3 * 10.0 * turn, 1e-6 * 10.0 * turn);
      EXPECT_NEAR(u.y, -0.2 * 10.0 * turn, 1e-6 * 10.0 * turn);
    }
  }
}

/// Six pentagons fall on each other: the energy balance closes, and no dissipation ever decreases.
TEST(ImplicitHeap, EnergyBalanceClosesAndDissipates) {
  Simulation sim = scene(falling_pentagons(dda(5e-4)));
  double error = 0.0, friction = 0.0, damping = 0.0, scale = 0.0;
  run(sim, [&](Simulation& s) {
    const EnergyBalance l = account_energy(s);
    scale = std::max(scale, l.scale());
    keep_largest(error, l.error);
    EXPECT_GE(l.friction, friction - 1e-4 * scale) << s.motion.state.time;
    EXPECT_GE(l.damping, damping - 1e-4 * scale) << s.motion.state.time;
    friction = l.friction;
    damping = l.damping;
  });
  EXPECT_GT(friction, 0.0);
  EXPECT_GT(damping, 0.0);
  EXPECT_LT(error, 2e-4);
  EXPECT_GT(sim.accounts.open_close.switched, 10u);
}

/// Momentum changes by external forces alone: two blocks collide, off centre and with friction. It
/// is conserved as accurately as the equations are solved: to rounding where a factor of the matrix
/// solves them, as without damping, and otherwise to the tolerance of the solver.
TEST(ImplicitCollision, KeepsMomentum) {
  const std::string toml = R"(
gravity = [0.0, 0.0]
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.2
DAMPING
[joints.j]
friction_angle = 25.0
[[block]]
velocity = [1.0, 0.1]
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
velocity = [-1.0, 0.0]
polygon = [[1.02, 0.5], [2.02, 0.6], [2.0, 1.6], [1.1, 1.4]]
[output]
history_every = 0.05
[solver]
duration = 0.05
)";
  auto momentum = [](const Simulation& s) {
    Vec2 p;
    double turning = 0.0;
    for (std::size_t i = 0; i < s.scene->blocks.size(); ++i) {
      for (std::size_t k = 0; k < 3; ++k) {
        const double m = s.motion.masses.node[k][i];
        const Vec2 x{s.motion.state.position.x[k][i], s.motion.state.position.y[k][i]},
            v{s.motion.state.velocity.x[k][i], s.motion.state.velocity.y[k][i]};
        p += m * v;
        turning += m * cross(x, v);
      }
    }
    return std::array{p.x, p.y, turning};
  };
  for (const auto& [damping, bound] : {std::pair{"damping = 0", 1e-4}, {"", 1e-4}}) {
    std::string model = toml + dda(2e-4);
    model.replace(model.find("DAMPING"), 7, damping);
    Simulation sim = scene(model);
    const auto before = momentum(sim);
    run(sim, [](Simulation&) {});
    EXPECT_LT(centroid(sim.motion.state.velocity, 0).x, 0.5);  // they have met
    const auto after = momentum(sim);
    EXPECT_NEAR(after[0], before[0], bound * 2500.0);
    EXPECT_NEAR(after[1], before[1], bound * 2500.0);
    EXPECT_NEAR(after[2], before[2], 1e-4 * 2500.0);
  }
}

}  // namespace
}  // namespace edda::implicit_motion_test
