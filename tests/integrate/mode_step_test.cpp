// The step of the modes of blocks that bend, and their damping.
#include "integrate/mode_step.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "attachments/drawn_blocks.hpp"

namespace edda::mode_step_test {
namespace {

constexpr double h = 1e-4;

/// A pentagon, bent, whose modes are damped, each kind at a rate of its own.
struct Bent : test::DrawnBlocks {
  State state;
  Nodes fx = zero_nodes(1), fy = fx;
  ModeVectors force, old_rate;
  ModeDamping damping;

  Bent() {
    model.deformation = BlockDeformation::corners;
    add({{0, 0}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {-0.3, 0.7}});
    build_all();
    double rate = 1e3;
    for (std::vector<double>& of : masses.mode_damping) of = {rate *= 2.0};
    state = initial_state(blocks, set);
    state.bend.set(0, {0.03, -0.05});
    state.bend.set(1, {-0.02, 0.01});
    force.assign(2, 0.0);
    old_rate.assign(2, 0.0);
    damping.force.assign(2, 0.0);
    damping.couple.assign(1, 0.0);
  }
  ModeLeap leap(ModeDamping* damps) const {
    return {blocks, masses, force, old_rate, state.vx, state.vy, damps};
  }
  void step(bool damped) {
    const ModeLeap l{
        blocks, masses, force, old_rate, state.vx, state.vy, damped ? &damping : nullptr};
    advance_modes(state, l, {1.0, h, h, 0.0}, 0, fx, fy);
  }
};

TEST(ModeStep, ForcesMoveTheMassOfAMode) {
  Bent o;
  o.force.set(0, {100.0, -50.0});
  const ModeVectors at = o.state.bend;
  o.step(false);
  const double mass = o.blocks.mass[0] / 5.0;
  EXPECT_NEAR(norm(o.state.bend_rate[0] - (h / mass) * Vec2{100.0, -50.0}), 0.0, 1e-12);
  EXPECT_NEAR(norm(o.state.bend[0] - at[0] - h * o.state.bend_rate[0]), 0.0, 1e-15);
  EXPECT_EQ(o.state.bend_rate[1], Vec2{});
}

/// A rate along a bending is left with 1/(1 + h C) of it, whatever h C is.
TEST(ModeStep, EachBendingDecaysAtItsRate) {
  Bent o;
  for (std::size_t k = 0; k < bendings; ++k) {
    const auto& axis = o.blocks.bending.axis[k];
    if (dot(axis[0], axis[0]) + dot(axis[1], axis[1]) == 0.0) continue;
    o.state.bend.assign(2, 0.0);
    o.old_rate = axis;
    o.step(true);
    const double left = 1.0 / (1.0 + h * o.masses.mode_damping[k][0]);
    for (std::size_t a = 0; a < 2; ++a)
      EXPECT_NEAR(norm(o.state.bend_rate[a] - left * axis[a]), 0.0, 1e-12) << k;
  }
}

/// A bent block that turns as a whole is not damped.
TEST(ModeStep, RotationIsNotDamped) {
  Bent o;
  const double spin = 2.0;
  store(rigid_velocities(vectors_of(o.state.x, o.state.y, 0),
                         {o.blocks.centroid_x[0], o.blocks.centroid_y[0]}, {0.3, -0.2}, spin),
        o.state.vx, o.state.vy, 0);
  for (std::size_t a = 0; a < 2; ++a) o.old_rate.set(a, spin * perp(o.state.bend[a]));
  o.step(true);
  for (std::size_t a = 0; a < 2; ++a)
    EXPECT_NEAR(norm(o.state.bend_rate[a] - o.old_rate[a]), 0.0, 1e-12);
}

/// What the damping takes from the modes as moment it gives to the nodes.
TEST(ModeStep, DampingHasNoMoment) {
  Bent o;
  o.old_rate.set(0, {0.5, 0.2});
  o.old_rate.set(1, {-0.1, 0.4});
  const ModeVectors at = o.state.bend;
  o.step(true);
  double on_modes = 0.0, on_nodes = 0.0;
  for (std::size_t a = 0; a < 2; ++a) on_modes += cross(at[a], o.damping.force[a]);
  for (std::size_t k = 0; k < nodes_per_block; ++k)
    on_nodes += cross(Vec2{o.state.x[k][0], o.state.y[k][0]}, Vec2{o.fx[k][0], o.fy[k][0]});
  EXPECT_GT(std::abs(on_modes), 1.0);
  EXPECT_NEAR(on_modes + on_nodes, 0.0, 1e-9 * std::abs(on_modes));
  take_back_couples(o.damping, o.blocks, o.state, o.fx, o.fy, 0, 1);
  EXPECT_NEAR(norm(Vec2{o.fx[1][0], o.fy[1][0]}), 0.0, 1e-9 * std::abs(on_modes));
}

}  // namespace
}  // namespace edda::mode_step_test
