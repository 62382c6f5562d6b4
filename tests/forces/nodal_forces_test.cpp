// Forces on the nodes, against the energy, the work or the motion that they stand for.
#include "forces/nodal_forces.hpp"

#include <gtest/gtest.h>

#include <random>

#include "attachments/dashpots.hpp"
#include "contacts/moved_blocks.hpp"
#include "forces/block_matrices.hpp"
#include "forces/dashpot_forces.hpp"
#include "forces/elastic.hpp"

namespace edda::nodal_forces_test {
namespace {

using test::MovedBlocks;

/// One block, and what is held of it.
struct OneBlock : MovedBlocks {
  BoundarySprings springs;
  BodyVectors forces;

  explicit OneBlock(const std::vector<Boundary>& boundaries = {}) {
    model.joints = {test::rough_joint(30.0)};
    model.contact.normal_stiffness = model.contact.shear_stiffness = 1e9;
    model.boundaries = boundaries;
    add({{0, 0}, {2, 0.3}, {1.7, 1.4}, {-0.2, 1}});
    start();
    springs = attach_boundaries(model, blocks).value();
    for (std::size_t k = 0; k < 3; ++k) forces.x[k] = forces.y[k] = {0.0};
  }
  void gather(Vec2 gravity, const LoadsNow& loads = {}) {
    place_vertices(blocks, state.position, 0, pose.x, pose.y);
    BodyVectors on_faces;
    sum_faces(on_faces, blocks, faces, corner_forces(faces, tiled.tiles, blocks, pose));
    gather_forces(forces, blocks, state, pose, on_faces, springs, gravity, loads);
  }
  Vec2 on_node(std::size_t k) const { return {forces.x[k][0], forces.y[k][0]}; }
  Vec2 whole() const { return on_node(0) + on_node(1) + on_node(2); }
  /// Turns and strains it.
  void deform() {
    const double more[3] = {0.02, -0.03, 0.01};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p = rotated({state.position.x[k][0], state.position.y[k][0]}, 0.4);
      state.position.x[k][0] = p.x + more[k];
      state.position.y[k][0] = p.y + more[(k + 1) % 3];
    }
  }
};

TEST(GatherForces, OfAStrainedBlockAreTheGradientOfItsEnergy) {
  OneBlock o;
  o.deform();
  const auto energy = [&] {
    const Deformation f = deformation(o.blocks, o.state.position, 0);
    const Tensor e = corotated_strain(f, rotation(f));
    return strain_energy(e, e, o.blocks.volume[0], o.blocks.lame_lambda[0], o.blocks.lame_mu[0]);
  };
  o.gather({});
  const double d = 1e-6, scale = norm(o.on_node(0));
  EXPECT_GT(scale, 1e6);
  for (std::size_t k = 0; k < 3; ++k) {
    for (auto* place : {&o.state.position.x[k][0], &o.state.position.y[k][0]}) {
      const double at = *place;
      *place = at + d;
      const double up = energy();
      *place = at - d;
      const double down = energy();
      *place = at;
      const double force = place == &o.state.position.x[k][0] ? o.on_node(k).x : o.on_node(k).y;
      EXPECT_NEAR(force, (down - up) / (2.0 * d), 1e-6 * scale);
    }
  }
}

TEST(GatherForces, WeightIsThatOfTheBlock) {
  OneBlock o;
  const Vec2 gravity{1.0, -9.81}, frame{0.5, 0.25};
  o.gather(gravity);
  const double mass = o.blocks.mass[0];
  EXPECT_NEAR(norm(o.whole() - mass * gravity), 0.0, 1e-6 * mass);
  EXPECT_NEAR(norm(o.on_node(1) - mass / 3.0 * gravity), 0.0, 1e-6 * mass);
  // On a ground that accelerates, and while weight is still to come.
  LoadsNow loads;
  loads.frame = frame;
  loads.to_come = {0.0, -4.0};
  o.gather(gravity, loads);
  EXPECT_NEAR(norm(o.whole() - mass * (gravity - frame - Vec2{0.0, -4.0})), 0.0, 1e-6 * mass);
}

TEST(GatherForces, BoundarySpringsPullBack) {
  OneBlock o({test::boundary_along(BoundaryType::fixed, {0, 0}, {2, 0.3}, 1e6)});
  ASSERT_EQ(o.springs.size(), 2u);
  for (std::size_t k = 0; k < 3; ++k) {
    o.state.position.x[k][0] += 0.01;
    o.state.position.y[k][0] -= 0.02;
  }
  o.gather({});
  EXPECT_NEAR(o.whole().x, -2.0 * 1e6 * 0.01, 1e-6);
  EXPECT_NEAR(o.whole().y, 2.0 * 1e6 * 0.02, 1e-6);
}

/// What faces do on the corners and what the nodes get of it work as much, whatever the motion.
TEST(GatherForces, OfFacesWorkAsOnTheCorners) {
  MovedBlocks m = test::square_on_base(test::rough_joint(30.0));
  m.start();
  m.put_still(1, {{0.0, -1e-4}, 5e-5});
  m.go(1, {{2e-5, -1e-4}, 5e-5});
  BodyVectors forces;
  for (std::size_t k = 0; k < 3; ++k) forces.x[k] = forces.y[k] = {0.0, 0.0};
  BoundarySprings none;
  none.block_begin.assign(3, 0);
  BodyVectors on_faces;
  sum_faces(on_faces, m.blocks, m.faces, corner_forces(m.faces, m.tiled.tiles, m.blocks, m.pose));
  gather_forces(forces, m.blocks, m.state, m.pose, on_faces, none, {});
  std::mt19937 rng(3);
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  BodyVectors moved = zero_vectors(m.blocks);
  double on_nodes = 0.0;
  for (std::size_t k = 0; k < 3; ++k) {
    moved.x[k] = {0.0, u(rng)};
    moved.y[k] = {0.0, u(rng)};
    on_nodes += forces.x[k][1] * moved.x[k][1] + forces.y[k][1] * moved.y[k][1];
  }
  double on_corners = 0.0;
  for (std::size_t k = 0; k < m.faces.size(); ++k) {
    const CornerForces on = m.row(k).force;
    on_corners += dot(on.q1, corner_at(m.blocks, moved, m.faces.facing[k])) +
                  dot(on.q2, corner_at(m.blocks, moved, m.faces.facing_end[k]));
  }
  EXPECT_GT(std::abs(on_corners), 1e4);
  EXPECT_NEAR(on_nodes, on_corners, 1e-9 * std::abs(on_corners));
  EXPECT_NEAR(norm(resultant(vectors_of(on_faces, 1)) - m.force_on(1)), 0.0, 1e-6);
}

/// eta C : dU/dt of a block that is neither turned nor strained.
TEST(ViscousStress, IsTheElasticOneOfItsRate) {
  OneBlock o;
  const double lambda = o.blocks.lame_lambda[0], mu = o.blocks.lame_mu[0];
  const PiolaStress p =
      viscous_stress(o.blocks, 2e-3, 0, strain_frame({1.0, 0.0, 0.0, 1.0}), {0.3, -0.1, 0.5});
  EXPECT_NEAR(p.xx, 2e-3 * (lambda * 0.2 + 2.0 * mu * 0.3), 1e-6);
  EXPECT_NEAR(p.yy, 2e-3 * (lambda * 0.2 - 2.0 * mu * 0.1), 1e-6);
  EXPECT_NEAR(p.xy, 2e-3 * mu * 0.5, 1e-6);
  EXPECT_NEAR(p.yx, 2e-3 * mu * 0.5, 1e-6);
}

/// f = -C ((v- + v+)/2 - r), v+ the velocity that f itself leads to, with mass damping and viscous
/// rock.
TEST(DashpotForces, AreThoseOfTheMeanVelocityOfTheStep) {
  OneBlock o({test::boundary_along(BoundaryType::viscous, {0, 0}, {2, 0.3})});
  const Dashpots dashpots = attach_dashpots(o.model, o.blocks).value();
  const std::size_t points = dashpots.points.size();
  ASSERT_EQ(points, 2u);
  const double h = 1e-3, mass_damping = 0.2;
  Masses masses = given_masses(o.blocks);
  masses.viscosity = {1e-4};
  BodyVectors velocity;
  for (std::size_t k = 0; k < 3; ++k) {
    velocity.x[k] = {0.2 + 0.1 * static_cast<double>(k)};
    velocity.y[k] = {-0.3 + 0.05 * static_cast<double>(k)};
  }
  const std::vector<Vec2> reference{{0.05, 0.02}, {0.01, -0.03}}, push{{10.0, 20.0}, {-5.0, 3.0}};
  std::vector<Vec2> on_point(points);
  o.gather({0.0, -9.81});
  add_dashpots(o.forces, on_point, dashpots, {o.blocks, masses, o.state, velocity},
               {h, mass_damping, nullptr, reference, push}, 0, 1);
  const NodalMatrix mass = mass_matrix(masses, 0);
  const NodalVector before = nodal(velocity, 0);
  const NodalMatrix left =
      (1.0 + mass_damping) * mass + h * viscous_matrix(o.blocks, masses, 0, {1.0, 0.0, 0.0, 1.0});
  const NodalVector after =
      left.ldlt().solve((1.0 - mass_damping) * mass * before + h * nodal(o.forces, 0));
  Nodes mean_x, mean_y;
  for (std::size_t k = 0; k < 3; ++k) {
    const auto at = static_cast<Eigen::Index>(2 * k);
    mean_x[k] = {0.5 * (before[at] + after[at])};
    mean_y[k] = {0.5 * (before[at + 1] + after[at + 1])};
  }
  for (std::size_t p = 0; p < points; ++p) {
    const Dashpot& at = dashpots.points[p];
    const Vec2 v = weighted(at.weight, mean_x, mean_y, 0) - reference[p];
    const Vec2 force{-(at.cxx * v.x + at.cxy * v.y), -(at.cxy * v.x + at.cyy * v.y)};
    EXPECT_GT(norm(force), 1e4);
    EXPECT_NEAR(norm(on_point[p] - push[p] - force), 0.0, 1e-9 * norm(force));
  }
  remove_dashpots(o.forces, on_point, dashpots, o.blocks);
  EXPECT_NEAR(norm(o.whole() - o.blocks.mass[0] * Vec2{0.0, -9.81}), 0.0, 1e-6);
}

/// A meshed block on dashpots along two of its sides, which meet at a corner, with random
/// velocities and forces.
struct MeshOnDashpots : test::DrawnBlocks {
  State state;
  Dashpots dashpots;
  BodyVectors velocity, forces, yet_on_nodes;
  std::vector<Vec2> reference, push, on_point;
  static constexpr double h = 4e-4, mass_damping = 0.2;

  explicit MeshOnDashpots(double size) {
    model.deformation = BlockDeformation::zones;
    model.zones = ZoneInputs{size, {}, {}};
    add({{0, 0}, {0.4, 0.06}, {1.2, 0.18}, {2, 0.3}, {1.8, 1.04}, {1.7, 1.4}, {-0.2, 1}});
    model.boundaries = {test::boundary_along(BoundaryType::viscous, {0, 0}, {2, 0.3}),
                        test::boundary_along(BoundaryType::viscous, {2, 0.3}, {1.8, 1.04})};
    build_all();
    state = initial_state(blocks, set);
    dashpots = attach_dashpots(model, blocks).value();
    std::mt19937 random(1);
    std::uniform_real_distribution<double> any(-1.0, 1.0);
    const auto vector = [&] { return Vec2{any(random), any(random)}; };
    const auto fill = [&](BodyVectors& u, double scale) {
      BodyVector v(blocks.count_modes(0));
      for (Vec2& of_node : v.nodes) of_node = scale * vector();
      for (std::size_t j = 0; j < v.count; ++j) v.modes.set(j, scale * vector());
      u = zero_vectors(blocks);
      store(v, blocks, u, 0);
    };
    fill(velocity, 0.3);
    fill(forces, 1e5);
    fill(yet_on_nodes, 1e5);
    for (std::size_t p = 0; p < dashpots.points.size(); ++p) {
      reference.push_back(0.1 * vector());
      push.push_back(1e4 * vector());
    }
    on_point.resize(dashpots.points.size());
  }
  void act() {
    add_mesh_dashpots(forces, on_point, dashpots, {blocks, masses, state, velocity},
                      {h, mass_damping, nullptr, reference, push}, &yet_on_nodes, 0, 1);
  }
};

/// The same in a mesh, whatever its size; no other corner has any.
TEST(DashpotForces, OfAMeshAreThoseOfTheMeanVelocityOfTheStep) {
  for (const double size : {2.0, 0.3}) {
    MeshOnDashpots o(size);
    const std::vector<Dashpot>& points = o.dashpots.points;
    ASSERT_EQ(points.size(), 8u);
    const BodyVector alone = vector_of(o.blocks, o.forces, 0);
    o.act();
    BodyVector f = vector_of(o.blocks, o.forces, 0);
    f.nodes = f.nodes + vectors_of(o.yet_on_nodes, 0);
    const BodyVector v = vector_of(o.blocks, o.velocity, 0);
    const BodyVector a = accelerations(o.masses, o.blocks, 0, f);
    // (v- + v+)/2 with (1 + a h/2) v+ = (1 - a h/2) v- + h M^-1 f
    BodyVectors mean = zero_vectors(o.blocks);
    store((v + (0.5 * o.h) * a) / (1.0 + o.mass_damping), o.blocks, mean, 0);
    Vec2 whole;
    for (std::size_t p = 0; p < points.size(); ++p) {
      const Dashpot& at = points[p];
      const Vec2 u = mesh_node_at(o.blocks, mean, 0, at.node) - o.reference[p];
      const Vec2 force{-(at.cxx * u.x + at.cxy * u.y), -(at.cxy * u.x + at.cyy * u.y)};
      EXPECT_NEAR(norm(o.on_point[p] - o.push[p] - force), 0.0, 1e-9 * norm(force)) << size;
      whole += o.on_point[p];
    }
    EXPECT_NEAR(norm(resultant(vector_of(o.blocks, o.forces, 0).nodes - alone.nodes) - whole), 0.0,
                1e-9 * norm(whole));
    remove_dashpots(o.forces, o.on_point, o.dashpots, o.blocks);
    const BodyVector left = vector_of(o.blocks, o.forces, 0) - alone;
    EXPECT_NEAR(dot(left, left), 0.0, 1e-12 * dot(alone, alone));
  }
}

/// What does not act carries nothing.
TEST(DashpotForces, OfAMeshAreNoneOnceTheyHaveGone) {
  MeshOnDashpots o(0.3);
  const BodyVector alone = vector_of(o.blocks, o.forces, 0);
  o.on_point.assign(o.on_point.size(), {1.0, 1.0});
  o.dashpots.set_acting({{0.0, 0.0}, {0.0, 0.0}});
  o.act();
  for (const Vec2 f : o.on_point) EXPECT_EQ(f, Vec2{});
  const BodyVector left = vector_of(o.blocks, o.forces, 0) - alone;
  EXPECT_EQ(dot(left, left), 0.0);
}

}  // namespace
}  // namespace edda::nodal_forces_test
