// The step of the deviations of mesh nodes, and their damping.
#include "integrate/mesh_step.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "attachments/drawn_blocks.hpp"
#include "integrate/push_block.hpp"

namespace edda::mesh_step_test {
namespace {

constexpr double h = 1e-4;

/// A meshed pentagon with random deviations, velocities and forces.
struct Meshed : test::DrawnBlocks {
  State state;
  BodyVectors force, old_velocity;
  DampingOfStep damping;

  Meshed() {
    model.deformation = BlockDeformation::zones;
    model.zones = ZoneInputs{0.4, {}, {}};
    add({{0, 0}, {0.6, -0.05}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {0.1, 1.0}, {-0.3, 0.7}});
    build_all();
    state = initial_state(blocks, set);
    force = old_velocity = zero_vectors(blocks);
    for (BodyVectors* u : {&state.position, &old_velocity}) {
      const bool rates = u == &old_velocity;
      fill(*u, rates ? 3.0 : 0.02, rates ? 1u : 2u);
    }
    fill(force, 1e4, 3u);
    force.x[0][0] = 4e3;
    force.y[1][0] = -2e3;
  }
  std::size_t many() const { return blocks.meshes.nodes_of(0); }
  /// Deviations without an affine part; of forces any.
  void fill(BodyVectors& u, double size, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> any(-size, size);
    BodyVector v(many());
    for (std::size_t j = 0; j < many(); ++j) v.modes.set(j, {any(random), any(random)});
    if (&u != &force) {
      const double mass = blocks.mass[0];
      for (std::size_t j = 0; j < many(); ++j)
        v.modes.set(j, mass * blocks.meshes.share[j] * v.modes[j]);
      v = accelerations(masses, blocks, 0, v);
    }
    v.nodes = vectors_of(u, 0);
    store(v, blocks, u, 0);
  }
  Leap leap() { return {blocks, masses, force, old_velocity, h, h, damping.in_force}; }
  void step() {
    const Leap l = leap();
    advance_meshes(state, l, 0, 1);
    advance(state, l);
  }
  AffinePart affine(const ModeVectors& u) const {
    AffinePart sum;
    for (std::size_t j = 0; j < many(); ++j)
      blocks.meshes.add(sum, j, blocks.meshes.share[j] * u[j]);
    return sum;
  }
};

TEST(MeshStep, AcceleratesAsTheMassMatrixSays) {
  Meshed o;
  const BodyVector before = vector_of(o.blocks, o.old_velocity, 0),
                   f = vector_of(o.blocks, o.force, 0);
  o.step();
  const BodyVector a = accelerations(o.masses, o.blocks, 0, f),
                   after = vector_of(o.blocks, o.state.velocity, 0);
  for (std::size_t j = 0; j < o.many(); ++j)
    EXPECT_NEAR(norm(after.modes[j] - before.modes[j] - h * a.modes[j]), 0.0, 1e-12);
}

/// With local damping, too, the deviations keep no affine part.
TEST(MeshStep, DeviationsStayFreeOfAffineMotion) {
  Meshed o;
  o.damping.in_force.local = 0.7;
  o.step();
  const AffinePart left = o.affine(o.state.velocity.modes);
  EXPECT_NEAR(norm(left.one) + norm(left.x) + norm(left.y), 0.0, 1e-12);
}

/// A block that is excavated stays where it is.
TEST(MeshStep, ExcavatedBlocksStay) {
  Meshed o;
  o.state.alive[0] = 0;
  const ModeVectors at = o.state.position.modes;
  const Leap l = o.leap();
  advance_meshes(o.state, l, 0, 1);
  for (std::size_t j = 0; j < o.many(); ++j) {
    EXPECT_EQ(o.state.position.modes[j], at[j]);
    EXPECT_EQ(o.state.velocity.modes[j], Vec2{});
  }
}

/// What a force that comes later changes is what it would have done in the step.
TEST(MeshStep, PushedLaterIsPushedAtOnce) {
  Meshed at_once, later;
  const Vec2 first{3e4, -1e4}, second{2e4, 5e3};
  BlockForces more{at_once.blocks, 0};
  more.at_corner(1, first);
  more.at_corner(2, second);
  add(more.sum, at_once.blocks, at_once.force, 0);
  at_once.step();
  later.step();
  Pose pose{std::vector<double>(7, 0.0), std::vector<double>(7, 0.0), {}, {}};
  for (std::vector<double>* of : {&pose.x1, &pose.y1}) of->assign(7, 0.0);
  const Leap l = later.leap();
  push_block({l, later.state, pose}, 0, {1, 2, first, second});
  for (const auto of : {&State::position, &State::velocity}) {
    const BodyVector a = vector_of(at_once.blocks, at_once.state.*of, 0),
                     b = vector_of(later.blocks, later.state.*of, 0);
    for (std::size_t j = 0; j < at_once.many(); ++j)
      EXPECT_NEAR(norm(a.modes[j] - b.modes[j]), 0.0, 1e-10);
    for (std::size_t k = 0; k < nodes_per_block; ++k)
      EXPECT_NEAR(norm(a.nodes[k] - b.nodes[k]), 0.0, 1e-10);
  }
}

/// What damping dissipates is what the deviations lose beyond the work of the forces.
TEST(MeshStep, DissipationIsWhatEnergyLacks) {
  for (const auto& [local, mass] : {std::pair{0.6, 0.0}, {0.0, 200.0}}) {
    Meshed o;
    o.damping.in_force.local = local;
    o.damping.in_force.mass = mass;
    o.force.x = o.force.y = zero_nodes(1);
    const BodyVector f = vector_of(o.blocks, o.force, 0);
    o.step();
    const Leap l{o.blocks, o.masses, o.force, o.old_velocity, h, h, o.damping.in_force};
    DampingWork work{{0.0}};
    account_damping(o.state, l, work);
    const BodyVector before = vector_of(o.blocks, o.old_velocity, 0),
                     after = vector_of(o.blocks, o.state.velocity, 0);
    const BodyVector moved = (0.5 * h) * (before + after);
    const double kinetic = 0.5 * (mass_product(o.masses, o.blocks, 0, after, after) -
                                  mass_product(o.masses, o.blocks, 0, before, before));
    EXPECT_GT(work.joules[0], 0.0);
    EXPECT_NEAR(work.joules[0], dot(f, moved) - kinetic, 1e-9 * std::abs(work.joules[0]))
        << local << ' ' << mass;
  }
}

}  // namespace
}  // namespace edda::mesh_step_test
