// Why an undamped slab with high friction neither slides smoothly nor stops after a jolt: sliding
// friction couples the normal, rocking and shear vibrations of an elastic block by an unsymmetric
// matrix, and two of them can take energy from the sliding. The growth rate is that of the
// equations and does not depend on the step.
#include <Eigen/Dense>
#include <algorithm>

#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"

namespace edda::flutter_test {
namespace {

/// Growth (1/s) of the worst vibration of the 2 x 1 block of row 1 in steady sliding: eigenvalues
/// of M^-1 K for translation, rotation and strain, with T = -N tan(phi) at both lower corners.
double growth_rate(double phi, double young, double spring) {
  using Matrix = Eigen::Matrix<double, 6, 6>;
  const double a = 2.0, b = 1.0, density = 2750.0, nu = 0.25, volume = a * b;
  const double lambda = young * nu / ((1 + nu) * (1 - 2 * nu)), mu = young / (2 * (1 + nu));
  // Motion: u = (q0 - q2 y + q3 x + q5 y/2, q1 + q2 x + q4 y + q5 x/2).
  Matrix mass = Matrix::Zero(), stiffness = Matrix::Zero();
  const double sx = density * volume * a * a / 12, sy = density * volume * b * b / 12;
  mass(0, 0) = mass(1, 1) = density * volume;
  mass(2, 2) = sx + sy;
  mass(3, 3) = sx;
  mass(4, 4) = sy;
  mass(5, 5) = 0.25 * (sx + sy);
  mass(2, 5) = mass(5, 2) = 0.5 * (sx - sy);
  stiffness(3, 3) = stiffness(4, 4) = volume * (lambda + 2 * mu);
  stiffness(3, 4) = stiffness(4, 3) = volume * lambda;
  stiffness(5, 5) = volume * mu;
  for (const double x : {-a / 2, a / 2}) {
    const double y = -b / 2;
    Eigen::Matrix<double, 6, 1> along, across;
    along << 1, 0, -y, x, 0, y / 2;
    across << 0, 1, x, 0, y, x / 2;
    stiffness += spring * (across - std::tan(radians(phi)) * along) * across.transpose();
  }
  const Eigen::EigenSolver<Matrix> solver(mass.inverse() * stiffness, false);
  double worst = 0.0;
  for (const auto& w2 : solver.eigenvalues())
    worst = std::max(worst, std::abs(std::sqrt(-w2).real()));
  return worst;
}

/// The same, measured: from steady sliding, until the normal force of the uphill corner has moved
/// off its static value by a hundredth. 0 if it never does within `duration`.
double measured_growth(double phi, double spring, double safety, double duration) {
  const double damped_time = 0.3;
  std::string undamped = ramp(30.0, phi, "20e9", 1,
                              "damping = { mass = 1e4 }\nsafety = " + number(safety) +
                                  "\n[contact]\nnormal_stiffness = " + number(spring) + "\n");
  undamped.insert(undamped.find("[joints.ramp]"), "damping = 0\ndeformation = 'uniform'\n");
  Simulation sim = scene(undamped);
  start(sim, damped_time);
  while (sim.motion.state.time < damped_time) EXPECT_FALSE(step(sim).has_value());
  sim.motion.damping.mass = 0.0;
  const auto normal = [&] {
    double largest = 0.0;
    for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
      const FaceFields face = face_row(sim, k).state;
      largest = std::max({largest, face.normal_a, face.normal_b});
    }
    return largest;
  };
  const double still = normal();
  double first = 0.0, last = 0.0;
  fit_step_to(sim, damped_time + duration);
  while (sim.motion.state.time < damped_time + duration) {
    EXPECT_FALSE(step(sim).has_value());
    const double off = std::abs(normal() / still - 1.0);
    if (off > 1e-5 && first == 0.0) first = sim.motion.state.time;
    if (off > 1e-2 && last == 0.0) last = sim.motion.state.time;
  }
  return last > first ? std::log(1e3) / (last - first) : 0.0;
}

TEST(Flutter, GrowsAtTheRateOfTheEquationsAtAnyStep) {
  const double exact = growth_rate(29.9, 20e9, 2e11);
  EXPECT_GT(exact, 500.0);
  for (const double safety : {0.7, 0.07})
    EXPECT_NEAR(measured_growth(29.9, 2e11, safety, 0.2) / exact, 1.0, 0.1) << safety;
}

TEST(Flutter, IsAbsentWhereTheEquationsAreStable) {
  for (const auto& [phi, spring] : {std::pair{15.0, 2e11}, std::pair{29.9, 2e10}}) {
    EXPECT_LT(growth_rate(phi, 20e9, spring), 1e-3);
    EXPECT_EQ(measured_growth(phi, spring, 0.7, 0.5), 0.0) << phi;
  }
}

/// A slab that is stable by statics, gravity applied at once: with contacts as stiff as the rock a
/// little contact damping stops it, and local damping does with any contacts.
TEST(Flutter, DampedSlabsStop) {
  for (const char* damping : {"damping = { contact = 0.1 }\n[contact]\nnormal_stiffness = 2e10\n",
                              "damping = { local = 0.5 }\n"}) {
    Simulation sim = scene(ramp(30.0, 35.0, "20e9", 1, damping));
    start(sim, 0.5);
    while (sim.motion.state.time < 0.5) ASSERT_FALSE(step(sim).has_value());
    const double by_then = slip_so_far(sim, 30.0);
    fit_step_to(sim, 1.0);
    while (sim.motion.state.time < 1.0) ASSERT_FALSE(step(sim).has_value());
    EXPECT_LT(slip_so_far(sim, 30.0), 1e-4) << damping;
    EXPECT_NEAR(slip_so_far(sim, 30.0), by_then, 1e-8) << damping;
    EXPECT_LT(account_energy(sim).kinetic, 1e-8) << damping;
  }
}

}  // namespace
}  // namespace edda::flutter_test
