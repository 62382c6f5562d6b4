// The global matrix against finite differences of what it is the derivative of.
#include "implicit/assemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "forces/viscosity.hpp"
#include "implicit/body_forces.hpp"
#include "implicit/implicit_blocks.hpp"

namespace edda::assemble_test {
namespace {

using test::ImplicitBlocks;

/// Two blocks on a held one, pressed together and turned a little, with boundary springs.
const std::string pressed = R"(
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.2
[joints.j]
friction_angle = 60.0
[[block]]
fixed = true
polygon = [[-1, -1], [4, -1], [4, 0.0001], [-1, 0.0001]]
[[block]]
polygon = [[0, 0], [1.0001, 0], [1.0001, 1], [0, 1]]
[[block]]
polygon = [[1, -5e-5], [2, -5e-5], [2, 1.3], [1, 1.3]]
[[boundary]]
name = "b"
along = [[0, -0.5], [0, 2]]
type = "roller"
stiffness = 1e8
[solver]
duration = 1.0
)";

void expect_derivative(ImplicitBlocks& s, Eigen::Index n) {
  s.begin_step();
  ASSERT_EQ(s.solver.matrix.lines(), n);
  const Eigen::VectorXd at_rest = s.residual();
  const std::vector<std::uint8_t>& states = s.solver.springs.state;
  ASSERT_GE(std::count_if(states.begin(), states.end(), [](int state) { return state != 0; }), 3);
  ASSERT_TRUE(assemble(s.solver, s.scene(), s.settings, s.state, s.pose, s.contacts));
  const Eigen::MatrixXd matrix(s.solver.matrix.scalar());
  EXPECT_LE((matrix - matrix.transpose()).norm(), 1e-12 * matrix.norm());
  Eigen::MatrixXd slopes(n, n);
  const double h = 1e-8;
  for (Eigen::Index k = 0; k < n; ++k) {
    s.solver.moved.setZero();
    s.solver.moved[k] = h;
    const Eigen::VectorXd up = s.residual();
    s.solver.moved[k] = -h;
    slopes.col(k) = (s.residual() - up) / (2.0 * h);
  }
  // What the matrix leaves out is of the order of force over length: small against the springs.
  EXPECT_LE((slopes - matrix).norm(), 2e-3 * matrix.norm());
  EXPECT_GT(at_rest.norm(), 0.0);
}

TEST(Assemble, MatrixIsTheDerivativeOfTheResidual) {
  ImplicitBlocks penalty(pressed);
  expect_derivative(penalty, 16);
  ImplicitBlocks uniform("deformation = 'uniform'\n" + pressed);
  expect_derivative(uniform, 12);
  // Ends that know of each other; rock whose strain is viscous.
  std::string with_stiffness = pressed;
  with_stiffness.insert(with_stiffness.find("friction_angle"), "kn = 5e9\nks = 5e9\n");
  ImplicitBlocks measured(with_stiffness);
  expect_derivative(measured, 16);
  ImplicitBlocks viscous(pressed);
  fill_viscosity(viscous.masses, viscous.blocks, {});
  expect_derivative(viscous, 16);
}

/// Of v_n: M (2/h + a) v_n, and what is viscous sees D/h.
TEST(Assemble, ResidualHasTheVelocityAtTheStartOfTheStep) {
  ImplicitBlocks s(pressed);
  s.begin_step();
  const Eigen::VectorXd at_rest = s.residual();
  for (std::size_t k = 0; k < 3; ++k) {
    s.state.velocity.x[k][1] = 0.1 + 0.2 * static_cast<double>(k);
    s.state.velocity.y[k][1] = 0.3 - 0.1 * static_cast<double>(k);
  }
  s.state.velocity.modes.set(s.blocks.modes(1)[0], {0.2, -0.3});
  const BodyColumn v = column_of(s.blocks, s.state.velocity, 1);
  const BodyColumn change = (s.residual() - at_rest).head<8>();
  const BodyColumn expected =
      (2.0 / s.settings.step + s.settings.damping.mass) * (s.solver.mass[1] * v);
  EXPECT_LT((change - expected).norm(), 1e-9 * expected.norm());
  fill_viscosity(s.masses, s.blocks, {});
  s.solver.moved.head<8>() << 1e-7, 2e-7, -1e-7, 0.0, 3e-7, 1e-7, 2e-7, -2e-7;
  const BodyColumn rate = 1.0 / s.settings.step * s.solver.moved.head<8>();
  s.residual();
  const BodyColumn force = viscous_force(s.solver, s.scene(), s.settings, s.state, 0);
  const BodyColumn linear =
      -of_body(viscous_matrix(s.blocks, s.masses, 1), viscosity_of_modes(s.blocks, s.masses, 1)) *
      rate;
  EXPECT_LT((force - linear).norm(), 1e-4 * linear.norm());
}

TEST(Assemble, FillsThePatternOfWhatMayTouch) {
  ImplicitBlocks s(pressed);
  set_pattern(s.solver, s.scene(), s.state, s.pose, s.trial());
  EXPECT_EQ(s.solver.row_of[0], no_id);
  EXPECT_EQ(s.solver.matrix.rows(), 2u);
  EXPECT_NE(s.solver.matrix.slot(0, 1), no_id);
}

}  // namespace
}  // namespace edda::assemble_test
