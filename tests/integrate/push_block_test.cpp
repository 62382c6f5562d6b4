// A block that is pushed after its step moves as if the force had been there in the step.
#include "integrate/push_block.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "attachments/drawn_blocks.hpp"
#include "integrate/leapfrog.hpp"

namespace edda::push_block_test {
namespace {

/// A quadrilateral that moves and turns.
struct Moving : test::DrawnBlocks {
  State state;
  Pose pose;
  BodyVectors old_velocity;
  double pushed_by = 0.0;
  double damping_work = 0.0;  ///< J, of the strain damping

  Moving() {
    model.deformation = BlockDeformation::corners;
    add({{0, 0}, {2, 0}, {2.2, 1}, {0, 1.3}});
    build_all();
    masses.viscosity = {1e-3};
    for (std::vector<double>& rate : masses.mode_damping) rate.assign(group_size, 3e3);
    state = initial_state(blocks, set);
    const double vx[3] = {0.1, -0.2, 0.05}, vy[3] = {0.03, 0.1, -0.15};
    for (std::size_t k = 0; k < 3; ++k) {
      state.velocity.x[k][0] = vx[k];
      state.velocity.y[k][0] = vy[k];
    }
    old_velocity = state.velocity;
    pose = {blocks.vertex_x, blocks.vertex_y, blocks.vertex_x,
            blocks.vertex_y, blocks.vertex_x, blocks.vertex_y};
  }
};

constexpr double h_old = 1e-4, h_new = 2e-4;
const NodeVectors force{{{3e4, -2e4}, {1e4, 5e4}, {-2e4, 1e4}}};
const EdgeForce more{1, 2, {-1e4, 4e4}, {2e4, 1e4}};

/// Makes a step with the force, and with all of it in the step or some of it by a push.
Moving moved(double mass_damping, bool strain_damped, bool pushed, const EdgeForce& by = more) {
  Moving m;
  BodyVectors forces = zero_vectors(m.blocks);
  BlockForces all{m.blocks, 0};
  all.sum.nodes = force;
  all.sum.modes.set(0, {2e4, 2e4});
  if (!pushed) {
    all.at_corner(more.edge, more.at_edge);
    all.at_corner(more.end, more.at_end);
  }
  store(all.sum, m.blocks, forces, 0);
  StrainDamping strain;
  const double h = 0.5 * (h_old + h_new);
  prepare(strain, m.blocks, m.masses, h / (1.0 + 0.5 * mass_damping * h));
  StrainDamping* const damps = strain_damped ? &strain : nullptr;
  ModeDamping modes;
  modes.force.assign(m.blocks.bending.modes(), 0.0);
  modes.couple.assign(1, 0.0);
  const StepDamping damping{mass_damping, 0.0, nullptr, damps, strain_damped ? &modes : nullptr};
  const Leap leap{m.blocks, m.masses, forces, m.old_velocity, h_old, h_new, damping};
  advance_modes(m.state, leap, forces, 0, 1);
  advance(m.state, leap);
  if (pushed) m.pushed_by = push_block({leap, m.state, m.pose}, 0, by);
  DampingWork work{{0.0}};
  account_damping(m.state, leap, work);
  m.damping_work = work.joules[0];
  m.pose.x1 = m.pose.x;
  m.pose.y1 = m.pose.y;
  place_vertices(m.blocks, m.state.position, 0, m.pose.x, m.pose.y);
  return m;
}

TEST(PushBlock, MovesABlockAsTheForceWouldHave) {
  constexpr double strong = 1.5 / (0.5 * (h_old + h_new));  // 1/s: half of it counts for much
  for (const double mass_damping : {0.0, strong}) {
    for (const bool strain_damped : {false, true}) {
      const Moving a = moved(mass_damping, strain_damped, true),
                   b = moved(mass_damping, strain_damped, false);
      const Moving alone = moved(mass_damping, strain_damped, true, {1, 2, {}, {}});
      double farthest = 0.0;
      for (std::size_t v = 0; v < a.pose.x.size(); ++v) {
        EXPECT_EQ(a.pose.x1[v], a.pose.x[v]) << "placed by the push";
        EXPECT_EQ(a.pose.y1[v], a.pose.y[v]);
        farthest = std::max(
            farthest, std::hypot(a.pose.x[v] - alone.pose.x[v], a.pose.y[v] - alone.pose.y[v]));
      }
      EXPECT_NEAR(a.pushed_by, farthest, 1e-6 * farthest);
      EXPECT_NEAR(a.damping_work, b.damping_work, 1e-3 * b.damping_work);
      if (strain_damped) {
        EXPECT_GT(std::abs(a.damping_work - alone.damping_work), 0.003 * b.damping_work);
      }
      for (std::size_t k = 0; k < nodes_per_block; ++k) {
        const double size = 1e-3;  // m/s: about what `more` changes
        EXPECT_NEAR(a.state.velocity.x[k][0], b.state.velocity.x[k][0], 1e-3 * size)
            << mass_damping;
        EXPECT_NEAR(a.state.velocity.y[k][0], b.state.velocity.y[k][0], 1e-3 * size)
            << mass_damping;
        EXPECT_NEAR(a.state.position.x[k][0], b.state.position.x[k][0], 1e-3 * size * h_new);
        EXPECT_NEAR(a.state.position.y[k][0], b.state.position.y[k][0], 1e-3 * size * h_new);
      }
      EXPECT_GT(norm(b.state.velocity.modes[0] - alone.state.velocity.modes[0]), 1e-4);
      EXPECT_LT(norm(a.state.velocity.modes[0] - b.state.velocity.modes[0]), 1e-6);
      EXPECT_LT(norm(a.state.position.modes[0] - b.state.position.modes[0]), 1e-6 * h_new);
    }
  }
}

}  // namespace
}  // namespace edda::push_block_test
