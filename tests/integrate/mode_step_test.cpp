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
  BodyVectors force, old_velocity;
  ModeDamping damping;

  Bent() {
    model.deformation = BlockDeformation::corners;
    add({{0, 0}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {-0.3, 0.7}});
    build_all();
    double rate = 1e3;
    for (std::vector<double>& of : masses.mode_damping) of.assign(group_size, rate *= 2.0);
    state = initial_state(blocks, set);
    state.position.modes.set(place(0), {0.03, -0.05});
    state.position.modes.set(place(1), {-0.02, 0.01});
    force = old_velocity = zero_vectors(blocks);
    damping.force.assign(blocks.bending.modes(), 0.0);
    damping.couple.assign(1, 0.0);
  }
  std::size_t place(std::size_t a) const { return blocks.modes(0)[a]; }
  void step(bool damped) {
    const ModeLeap l{blocks, masses, force, old_velocity, damped ? &damping : nullptr};
    GroupKick kick;
    kick.h_new = h;
    kick.keeps[0] = kick.moves[0] = 1.0;
    kick.h[0] = h;
    advance_modes(state, l, &kick, force, 0, 1);
  }
};

TEST(ModeStep, ForcesMoveTheMassOfAMode) {
  Bent o;
  o.force.modes.set(o.place(0), {100.0, -50.0});
  const ModeVectors at = o.state.position.modes;
  o.step(false);
  const double mass = o.blocks.mass[0] / 5.0;
  EXPECT_NEAR(norm(o.state.velocity.modes[o.place(0)] - (h / mass) * Vec2{100.0, -50.0}), 0.0,
              1e-12);
  EXPECT_NEAR(norm(o.state.position.modes[o.place(0)] - at[o.place(0)] -
                   h * o.state.velocity.modes[o.place(0)]),
              0.0, 1e-15);
  EXPECT_EQ(o.state.velocity.modes[o.place(1)], Vec2{});
}

/// A rate along a bending is left with 1/(1 + h C) of it, whatever h C is.
TEST(ModeStep, EachBendingDecaysAtItsRate) {
  Bent o;
  for (std::size_t k = 0; k < bendings; ++k) {
    const auto& axis = o.blocks.bending.axis[k];
    const Vec2 first = axis[o.place(0)], second = axis[o.place(1)];
    if (dot(first, first) + dot(second, second) == 0.0) continue;
    o.state.position.modes.assign(o.blocks.bending.modes(), 0.0);
    o.old_velocity.modes = axis;
    o.step(true);
    const double left = 1.0 / (1.0 + h * o.masses.mode_damping[k][0]);
    for (std::size_t a = 0; a < 2; ++a)
      EXPECT_NEAR(norm(o.state.velocity.modes[o.place(a)] - left * axis[o.place(a)]), 0.0, 1e-12)
          << k;
  }
}

/// A bent block that turns as a whole is not damped.
TEST(ModeStep, RotationIsNotDamped) {
  Bent o;
  const double spin = 2.0;
  o.old_velocity = o.state.velocity;
  const Vec2 centre{o.blocks.centroid_x[0], o.blocks.centroid_y[0]};
  store(rigid_velocities(vector_of(o.blocks, o.state.position, 0), centre, {0.3, -0.2}, spin),
        o.blocks, o.old_velocity, 0);
  o.step(true);
  for (std::size_t a = 0; a < 2; ++a)
    EXPECT_NEAR(norm(o.state.velocity.modes[o.place(a)] - o.old_velocity.modes[o.place(a)]), 0.0,
                1e-12);
}

/// What the damping takes from the modes as moment it gives to the nodes.
TEST(ModeStep, DampingHasNoMoment) {
  Bent o;
  o.old_velocity.modes.set(o.place(0), {0.5, 0.2});
  o.old_velocity.modes.set(o.place(1), {-0.1, 0.4});
  const ModeVectors at = o.state.position.modes;
  o.step(true);
  double on_modes = 0.0, on_nodes = 0.0;
  for (std::size_t a = 0; a < 2; ++a)
    on_modes += cross(at[o.place(a)], o.damping.force[o.place(a)]);
  for (std::size_t k = 0; k < nodes_per_block; ++k)
    on_nodes += cross(Vec2{o.state.position.x[k][0], o.state.position.y[k][0]},
                      Vec2{o.force.x[k][0], o.force.y[k][0]});
  EXPECT_GT(std::abs(on_modes), 1.0);
  EXPECT_NEAR(on_modes + on_nodes, 0.0, 1e-9 * std::abs(on_modes));
  take_back_couples(o.damping, o.blocks, o.state, o.force, 0, 1);
  EXPECT_NEAR(norm(Vec2{o.force.x[1][0], o.force.y[1][0]}), 0.0, 1e-9 * std::abs(on_modes));
}

}  // namespace
}  // namespace edda::mode_step_test
