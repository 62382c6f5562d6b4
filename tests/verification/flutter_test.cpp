// Why an undamped slab with high friction does not slide smoothly, nor rest after a jolt: sliding
// friction couples the normal, rocking and shear vibrations of an elastic block without symmetry,
// and two of them can feed on the slide. The rate is that of the equations, not of the step.
#include <Eigen/Dense>
#include <algorithm>

#include "verification/models.hpp"

namespace edda::flutter_test {
namespace {

/// Growth (1/s) of the worst vibration of the 2 x 1 block of row 1 in steady sliding: eigenvalues
/// of M^-1 K for shift, turn and strain, with T = -N tan(phi) at both lower corners.
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

/// The same, measured: from a settled slide, until the normal force of the uphill corner has moved
/// off its static value by a hundredth. 0 if it never does within `duration`.
double measured_growth(double phi, double spring, double safety, double duration) {
  const double settle = 0.3;
  std::string undamped = ramp(30.0, phi, "20e9", 1,
                              "damping = { mass = 1e4 }\nsafety = " + number(safety) +
                                  "\n[contact]\nnormal_stiffness = " + number(spring) + "\n");
  undamped.insert(undamped.find("[joints.ramp]"), "damping = 0\n");
  Simulation sim = scene(undamped);
  sim.start(settle);
  while (sim.state.time < settle) EXPECT_FALSE(sim.step().has_value());
  sim.damping.mass = 0.0;
  const auto normal = [&] {
    double largest = 0.0;
    for (std::size_t k = 0; k < sim.contacts.size(); ++k)
      largest = std::max({largest, sim.contacts.now.normal_a[k], sim.contacts.now.normal_b[k]});
    return largest;
  };
  const double still = normal();
  double first = 0.0, last = 0.0;
  sim.aim_at(settle + duration);
  while (sim.state.time < settle + duration) {
    EXPECT_FALSE(sim.step().has_value());
    const double off = std::abs(normal() / still - 1.0);
    if (off > 1e-5 && first == 0.0) first = sim.state.time;
    if (off > 1e-2 && last == 0.0) last = sim.state.time;
  }
  return last > first ? std::log(1e3) / (last - first) : 0.0;
}

TEST(Flutter, GrowsAsTheEquationsSayAtAnyStep) {
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

/// A slab that statics holds, gravity met at once: with contacts as stiff as the rock a little
/// contact damping brings it to rest, and local damping does with any.
TEST(Flutter, DampedSlabsComeToRest) {
  for (const char* damping : {"damping = { contact = 0.1 }\n[contact]\nnormal_stiffness = 2e10\n",
                              "damping = { local = 0.5 }\n"}) {
    Simulation sim = scene(ramp(30.0, 35.0, "20e9", 1, damping));
    sim.start(0.5);
    while (sim.state.time < 0.5) ASSERT_FALSE(sim.step().has_value());
    const double by_then = slid(sim, 30.0);
    sim.aim_at(1.0);
    while (sim.state.time < 1.0) ASSERT_FALSE(sim.step().has_value());
    EXPECT_LT(slid(sim, 30.0), 1e-4) << damping;
    EXPECT_NEAR(slid(sim, 30.0), by_then, 1e-8) << damping;
    EXPECT_LT(sim.ledger().kinetic, 1e-8) << damping;
  }
}

}  // namespace
}  // namespace edda::flutter_test
