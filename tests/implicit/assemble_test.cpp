// The global matrix against finite differences of what it is the derivative of.
#include "implicit/assemble.hpp"

#include <gtest/gtest.h>

#include <algorithm>

#include "blocks/build_blocks.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/place_faces.hpp"
#include "lines/build_polygons.hpp"
#include "model/read_model.hpp"

namespace edda::assemble_test {
namespace {

struct Scene {
  Model model;
  PolygonSet polygons;
  BlockSet blocks;
  LawTable laws;
  BoundarySprings springs;
  State state;
  Pose pose;
  FaceSet contacts;
  NodalForces forces;
  ImplicitSolver solver;
  ImplicitSettings settings;

  explicit Scene(const std::string& toml) {
    model = read_model_text(toml, "scene.toml", {}).value();
    polygons = build_polygons(model).value();
    blocks = build_blocks(model, polygons);
    laws = build_laws(model);
    springs = attach_boundaries(model, blocks).value();
    state = initial_state(blocks, polygons);
    for (std::size_t k = 0; k < 3; ++k) {
      forces.x[k].assign(blocks.size(), 0.0);
      forces.y[k].assign(blocks.size(), 0.0);
    }
    pose.x = blocks.vertex_x;
    pose.y = blocks.vertex_y;
    place();
    pose.x1 = pose.x;
    pose.y1 = pose.y;
    find_faces(contacts, blocks, state, pose, laws, 0.05);
    place_faces(contacts, blocks, pose, laws, 1.0);
    stand_still(contacts);  // limits of friction
    settings.step = 2e-3;
    settings.mass_damping = 3.0;
    settings.contact_damping = 0.1;
    set_face_dashpots(contacts, laws, settings.contact_damping);
  }

  ImplicitScene scene() const { return {blocks, laws, springs, {0.0, -9.81}}; }

  void place() {
    for (std::size_t i = 0; i < blocks.size(); ++i) {
      place_vertices(blocks, state.x, state.y, i, pose.x, pose.y);
    }
  }

  /// What is out of balance with D as it stands.
  Eigen::VectorXd residual(const Nodes& x0, const Nodes& y0) {
    for (std::size_t row = 0; row < solver.block_of.size(); ++row) {
      const Id i = solver.block_of[row];
      for (std::size_t k = 0; k < 3; ++k) {
        const auto at = static_cast<Eigen::Index>(6 * row + 2 * k);
        state.x[k][i] = x0[k][i] + solver.moved[at];
        state.y[k][i] = y0[k][i] + solver.moved[at + 1];
      }
    }
    place();
    evaluate_springs(solver.springs, contacts, blocks, pose, settings.step, false);
    gather_forces(forces, blocks, state, pose, contacts, springs, {0.0, -9.81});
    measure_residual(solver, scene(), settings, state, contacts, forces);
    return solver.residual;
  }
};

/// Two blocks on a held one, pressed together and turned a little, with boundary springs.
const char* pressed = R"(
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

TEST(Assemble, MatrixIsTheDerivativeOfTheResidual) {
  Scene s(pressed);
  const Nodes x0 = s.state.x, y0 = s.state.y;
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

TEST(Assemble, FillsThePatternOfWhatMayTouch) {
  Scene s(pressed);
  set_pattern(s.solver, s.scene(), s.state, s.contacts);
  EXPECT_EQ(s.solver.row_of[0], no_id);
  EXPECT_EQ(s.solver.matrix.rows(), 2u);
  EXPECT_NE(s.solver.matrix.slot(0, 1), no_id);
}

}  // namespace
}  // namespace edda::assemble_test
