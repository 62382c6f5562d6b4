// The global matrix against finite differences of what it is the derivative of.
#include "implicit/assemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "forces/viscosity.hpp"
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

void expect_derivative(ImplicitBlocks& s) {
  const Nodes x0 = s.solver.start_x = s.state.x, y0 = s.solver.start_y = s.state.y;
  set_pattern(s.solver, s.scene(), s.state, s.contacts);
  begin_springs(s.solver.springs, s.contacts);
  const auto n = static_cast<Eigen::Index>(6 * s.solver.block_of.size());
  ASSERT_EQ(n, 12);
  s.solver.moved = Eigen::VectorXd::Zero(n);
  const Eigen::VectorXd at_rest = s.residual(x0, y0);
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
    const Eigen::VectorXd up = s.residual(x0, y0);
    s.solver.moved[k] = -h;
    slopes.col(k) = (s.residual(x0, y0) - up) / (2.0 * h);
  }
  // What the matrix leaves out is of the order of force over length: small against the springs.
  EXPECT_LE((slopes - matrix).norm(), 2e-3 * matrix.norm());
  EXPECT_GT(at_rest.norm(), 0.0);
}

TEST(Assemble, MatrixIsTheDerivativeOfTheResidual) {
  ImplicitBlocks penalty(pressed);
  expect_derivative(penalty);
  // Ends that know of each other; rock whose strain is viscous.
  std::string with_stiffness = pressed;
  with_stiffness.insert(with_stiffness.find("friction_angle"), "kn = 5e9\nks = 5e9\n");
  ImplicitBlocks measured(with_stiffness);
  expect_derivative(measured);
  ImplicitBlocks viscous(pressed);
  fill_viscosity(viscous.masses, viscous.blocks, {});
  expect_derivative(viscous);
}

/// Of v_n: M (2/h + a) v_n, and what is viscous sees 2 D/h - v_n.
TEST(Assemble, ResidualHasTheVelocityAtTheStartOfTheStep) {
  ImplicitBlocks s(pressed);
  const Nodes x0 = s.solver.start_x = s.state.x, y0 = s.solver.start_y = s.state.y;
  set_pattern(s.solver, s.scene(), s.state, s.contacts);
  begin_springs(s.solver.springs, s.contacts);
  s.solver.moved = Eigen::VectorXd::Zero(12);
  const Eigen::VectorXd at_rest = s.residual(x0, y0);
  for (std::size_t k = 0; k < 3; ++k) {
    s.state.vx[k][1] = 0.1 + 0.2 * static_cast<double>(k);
    s.state.vy[k][1] = 0.3 - 0.1 * static_cast<double>(k);
  }
  const NodalVector v = nodal(s.state.vx, s.state.vy, 1);
  const NodalVector change = (s.residual(x0, y0) - at_rest).head<6>();
  const NodalVector expected =
      (2.0 / s.settings.step + s.settings.mass_damping) * s.solver.mass[1] * v;
  EXPECT_LT((change - expected).norm(), 1e-9 * expected.norm());
  fill_viscosity(s.masses, s.blocks, {});
  s.solver.moved.head<6>() << 1e-7, 2e-7, -1e-7, 0.0, 3e-7, 1e-7;
  const NodalVector rate = 2.0 / s.settings.step * s.solver.moved.head<6>() - 1e-3 * v;
  for (auto* nodes : {&s.state.vx, &s.state.vy}) {
    for (std::size_t k = 0; k < 3; ++k) (*nodes)[k][1] *= 1e-3;
  }
  const NodalVector force = viscous_force(s.solver, s.scene(), s.settings, s.state, 0);
  const NodalVector linear = -viscous_matrix(s.blocks, s.masses, 1) * rate;
  EXPECT_LT((force - linear).norm(), 1e-4 * linear.norm());
}

TEST(Assemble, FillsThePatternOfWhatMayTouch) {
  ImplicitBlocks s(pressed);
  set_pattern(s.solver, s.scene(), s.state, s.contacts);
  EXPECT_EQ(s.solver.row_of[0], no_id);
  EXPECT_EQ(s.solver.matrix.rows(), 2u);
  EXPECT_NE(s.solver.matrix.slot(0, 1), no_id);
}

}  // namespace
}  // namespace edda::assemble_test
