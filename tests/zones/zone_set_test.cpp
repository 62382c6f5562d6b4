// The zones of meshed blocks: their forces, energies and stresses.
#include "zones/zone_set.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "attachments/drawn_blocks.hpp"
#include "blocks/kinematics.hpp"
#include "cutting/t_nodes.hpp"
#include "cutting/zone_size.hpp"

namespace edda::zone_set_test {
namespace {

struct Rock : test::DrawnBlocks {
  ZoneModel zone_model;
  State state;
  Zones zones;

  explicit Rock(std::optional<InitialStress> stress = {}, std::optional<Yield> yield = {}) {
    model.deformation = BlockDeformation::zones;
    model.zones = ZoneInputs{0.4, {}, {}};
    model.initial_stress = std::move(stress);
    add({{0, 0}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {-0.3, 0.7}});
    model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
    model.materials[0].yield = yield;
    const ZoneSizes sizes(model, set);
    divide_edges(set.blocks[0], [of = sizes.of(set.blocks[0])](Vec2 from, Vec2 to) {
      return divisions(from, to, of);
    });
    blocks = build_blocks(model, set);
    masses = given_masses(blocks);
    zone_model = make_zones(model, blocks);
    state = initial_state(blocks, set);
    zones = zones_at_start(zone_model, model, blocks, state, {}, 1.0);
  }
  std::size_t many() const { return blocks.meshes.nodes_of(0); }
  BodyVector forces(Vec2 gravity = {}) {
    BodyVectors f = zero_vectors(blocks);
    set_zone_forces(zone_model, blocks, zones, gravity, f, 0, 1);
    return vector_of(blocks, f, 0);
  }
  void evaluate() { evaluate_zones(zone_model, blocks, state, {}, 0.0, zones); }
  /// The three nodes at X + G X.
  void strain(const Deformation& g) {
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      const Vec2 p{blocks.node_x[k][0], blocks.node_y[k][0]};
      state.position.x[k][0] = p.x + g.xx * p.x + g.xy * p.y;
      state.position.y[k][0] = p.y + g.yx * p.x + g.yy * p.y;
    }
  }
  void bend(double size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-size, size);
    for (std::size_t j = 0; j < many(); ++j)
      state.position.modes.set(j, {any(random), any(random)});
  }
  double stored() const {
    double sum = 0.0;
    for (const double w : zones.stored) sum += w;
    return sum;
  }
};

InitialStress stress_of(Triple stress, Triple gradient = {}) {
  InitialStress s;
  s.stress = stress;
  s.at_y = 0.0;
  s.gradient = gradient;
  return s;
}

TEST(ZoneSet, EveryZoneIsInOnePair) {
  const Rock o;
  std::vector<int> seen(o.blocks.meshes.zone.size(), 0);
  for (const auto& pair : o.zone_model.pair) {
    for (const std::uint32_t z : pair) {
      if (z != 0xffffffffu) ++seen[z];
    }
  }
  for (const int times : seen) EXPECT_EQ(times, 1);
  double volume = 0.0;
  for (const ZoneShape& s : o.zone_model.shape) volume += s.volume;
  EXPECT_NEAR(volume, o.blocks.volume[0], 1e-12);
}

/// Under a small uniform strain all zones have the stress of Hooke's law in plane strain, and
/// forces act on the outline alone.
TEST(ZoneSet, UniformStrainIsUniformStress) {
  Rock o;
  const Deformation g{1e-7, 0.5e-7, -0.2e-7, 2e-7};
  o.strain(g);
  o.evaluate();
  const double mu = 1e9 / 2.4, lambda = 1e9 * 0.2 / (1.2 * 0.6), trace = g.xx + g.yy;
  const std::array expected{lambda * trace + 2.0 * mu * g.xx, lambda * trace + 2.0 * mu * g.yy,
                            lambda * trace, mu * (g.xy + g.yx)};
  for (const auto& s : o.zones.stress) {
    for (std::size_t c = 0; c < s.size(); ++c) EXPECT_NEAR(s[c], expected[c], 1e-3);
  }
  const auto mean = mean_stress(o.blocks, o.zone_model, o.zones, 0);
  EXPECT_NEAR(mean[3], expected[3], 1e-3);
  const BodyVector f = o.forces();
  for (std::size_t j = o.blocks.vertex_begin[1]; j < o.many(); ++j)
    EXPECT_NEAR(norm(f.modes[j]), 0.0, 1e-4);
}

/// Forces on mesh nodes and on the three nodes are the gradient of what the zones store.
TEST(ZoneSet, ForcesAreTheGradientOfTheEnergy) {
  Rock o(stress_of({-3e6, -5e6, 1e6}, {0.0, 2e4, 0.0}));
  o.strain({0.01, 0.02, -0.03, -0.02});
  o.bend(0.01);
  o.evaluate();
  const BodyVector f = o.forces();
  constexpr double step = 1e-6;
  const auto slope = [&](double& x) {
    const double at = x;
    x = at + step;
    o.evaluate();
    const double after = o.stored();
    x = at - step;
    o.evaluate();
    const double before = o.stored();
    x = at;
    return -(after - before) / (2.0 * step);
  };
  const double size = norm(f.nodes[0]);
  for (const std::size_t j : {std::size_t{0}, std::size_t{4}, o.many() - 1}) {
    EXPECT_NEAR(slope(o.state.position.modes.x[j]), f.modes[j].x, 1e-5 * size) << j;
    EXPECT_NEAR(slope(o.state.position.modes.y[j]), f.modes[j].y, 1e-5 * size) << j;
  }
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    EXPECT_NEAR(slope(o.state.position.x[k][0]), f.nodes[k].x, 1e-5 * size) << k;
    EXPECT_NEAR(slope(o.state.position.y[k][0]), f.nodes[k].y, 1e-5 * size) << k;
  }
}

/// Zones have no resultant and no moment, wherever the block is and however it has turned; with
/// gravity the block has its weight.
TEST(ZoneSet, ForcesHaveNoResultant) {
  Rock o(stress_of({-3e6, -5e6, 1e6}));
  const double c = std::cos(2.0), s = std::sin(2.0);
  o.strain({1.01 * c - 1.0, -s, s, c - 1.0});
  o.bend(0.02);
  o.evaluate();
  const BodyVector f = o.forces();
  Vec2 sum;
  double moment = 0.0, size = 0.0;
  for (std::size_t j = 0; j < o.many(); ++j) {
    sum += f.modes[j];
    moment += cross(mesh_node_at(o.blocks, o.state.position, 0, j), f.modes[j]);
    size += norm(f.modes[j]);
  }
  EXPECT_NEAR(norm(sum), 0.0, 1e-12 * size);
  EXPECT_NEAR(moment, 0.0, 1e-12 * size);
  EXPECT_NEAR(norm(resultant(f.nodes)), 0.0, 1e-12 * size);
  EXPECT_NEAR(norm(resultant(o.forces({0.0, -9.81}).nodes) - Vec2{0.0, -9.81 * o.blocks.mass[0]}),
              0.0, 1e-12 * size);
}

/// A turn as a rigid body changes no stress but by turning it.
TEST(ZoneSet, RotationTurnsTheStress) {
  Rock o(stress_of({-4e6, -4e6, 0.0}));
  const double c = std::cos(0.7), s = std::sin(0.7);
  o.strain({c - 1.0, -s, s, c - 1.0});
  o.evaluate();
  for (const auto& stress : o.zones.stress) {
    EXPECT_NEAR(stress[0], -4e6, 1e-2);
    EXPECT_NEAR(stress[3], 0.0, 1e-2);
  }
}

/// An initial stress that grows with depth is that of each zone at its centroid, and out of plane.
TEST(ZoneSet, StartUnderTheInitialStress) {
  InitialStress given = stress_of({-3e6, -5e6, 0.0}, {1e5, 3e5, 0.0});
  given.k0_out = 0.6;
  const Rock o(given);
  const Vec2 centre{o.blocks.centroid_x[0], o.blocks.centroid_y[0]};
  for (std::size_t z = 0; z < o.zones.stress.size(); ++z) {
    double y = centre.y;
    for (const std::uint32_t j : o.blocks.meshes.zone[z]) y += o.blocks.meshes.arm_y[j] / 3.0;
    EXPECT_NEAR(o.zones.stress[z][0], -3e6 + 1e5 * y, 1.0) << z;
    EXPECT_NEAR(o.zones.stress[z][1], -5e6 + 3e5 * y, 1.0) << z;
    EXPECT_NEAR(o.zones.stress[z][2], 0.6 * (-5e6 + 3e5 * y), 1.0) << z;
  }
  const auto mean = mean_stress(o.blocks, o.zone_model, o.zones, 0);
  EXPECT_NEAR(mean[0], -3e6 + 1e5 * centre.y, 100.0);
  EXPECT_NEAR(mean[1], -5e6 + 3e5 * centre.y, 100.0);
}

/// In the terms of the balance a leapfrog keeps, of linear zones, x_n K x_n+1/2: with forces at
/// both ends of a step, (W + W')/2 + (f' - f) . dx/4.
TEST(ZoneSet, EnergyBetweenTwoSteps) {
  Rock o;
  o.strain({1e-6, 0.0, 2e-6, 0.0});
  o.evaluate();
  const double at_first = o.stored();
  const BodyVector f = o.forces();
  constexpr double h = 1e-3;
  o.state.velocity.x[1][0] = 1e-3;
  for (std::size_t j = 0; j < o.many(); ++j)
    o.state.velocity.modes.set(j, {1e-3 * std::sin(3.0 * static_cast<double>(j)), 2e-4});
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    o.state.position.x[k][0] += h * o.state.velocity.x[k][0];
    o.state.position.y[k][0] += h * o.state.velocity.y[k][0];
  }
  for (std::size_t j = 0; j < o.many(); ++j)
    o.state.position.modes.add(j, h * o.state.velocity.modes[j]);
  evaluate_zones(o.zone_model, o.blocks, o.state, {}, h, o.zones);
  const BodyVector change = o.forces() - f;
  const double expected = 0.5 * (at_first + o.stored()) +
                          0.25 * h * dot(change, vector_of(o.blocks, o.state.velocity, 0));
  // The three nodes move the mesh: what their forces and the mesh's do together.
  EXPECT_NEAR(stored_in_zones(o.zone_model, o.zones, 0), expected, 1e-9 * expected);
}

Yield weak() {
  Yield y;
  y.peak.friction_angle = 30.0;
  y.peak.cohesion = 1e5;
  y.peak.tensile_strength = 5e4;
  return y;
}

/// Compressed beyond its strength, a block of one uniform strain has the stress of its surface.
TEST(ZoneSet, RockYields) {
  Rock o({}, weak());
  o.strain({0.002, 0.0, 0.0, -0.01});
  o.evaluate();
  const double sine = 0.5, limit = 2.0 * 1e5 * std::cos(std::numbers::pi / 6.0);
  for (const auto& s : o.zones.stress) {
    const double det = 1.002 * 0.99;
    EXPECT_NEAR(det * (s[0] * (1.0 + sine) - s[1] * (1.0 - sine)), limit, 1e-6 * limit);
  }
  EXPECT_GT(dissipated_in_zones(o.zones), 0.0);
  for (const std::uint8_t yielding : o.zones.yielding) EXPECT_GT(yielding, 0);
  const double dissipated = dissipated_in_zones(o.zones);
  o.evaluate();
  EXPECT_NEAR(dissipated_in_zones(o.zones), dissipated, 1e-9 * dissipated);
}

/// The work of a step by the mean of the forces before and after is what its zones store and
/// dissipate, also where their stress changes as they yield.
TEST(ZoneSet, WorkIsStoredOrDissipated) {
  Rock o({}, weak());
  BodyVector f = o.forces();
  double work = 0.0;
  constexpr int steps = 400;
  for (int n = 1; n <= steps; ++n) {
    const NodeVectors before = vectors_of(o.state.position, 0);
    const double part = static_cast<double>(n) / steps;
    o.strain({-0.002 * part, 0.001 * part, 0.0, -0.01 * part});
    o.evaluate();
    const BodyVector now = o.forces();
    work -= 0.5 * dot(f.nodes + now.nodes, vectors_of(o.state.position, 0) - before);
    f = now;
  }
  EXPECT_GT(dissipated_in_zones(o.zones), 0.02 * work);
  EXPECT_NEAR(o.stored() + dissipated_in_zones(o.zones), work, 1e-4 * work);
}

/// Cohesion, tensile strength and the tangents of the angles are divided.
TEST(ZoneSet, StrengthIsDivided) {
  Yield y = weak();
  y.peak.dilation_angle = 10.0;
  const Rock o({}, y);
  const auto surface = std::get<MohrCoulombSurface>(divided_strength(o.zone_model, 2.0)[0].peak);
  const MohrCoulomb& s = surface.rock;
  EXPECT_NEAR(std::tan(s.friction), 0.5 * std::tan(std::numbers::pi / 6.0), 1e-12);
  EXPECT_NEAR(std::tan(s.dilation), 0.5 * std::tan(std::numbers::pi / 18.0), 1e-12);
  EXPECT_EQ(s.cohesion, 5e4);
  EXPECT_EQ(s.tension, 2.5e4);
  EXPECT_EQ(surface.planes[1].limit, 2.5e4);
}

/// No motion of the mesh is faster than the bound of its nodes says.
TEST(ZoneSet, NoPairIsFasterThanItsNodesSay) {
  const Rock o;
  const double compression = 1e9 * 0.8 / (1.2 * 0.6);
  double least = 1e300;
  for (const ZoneShape& s : o.zone_model.shape) {
    for (const Vec2 g : s.gradient) least = std::min(least, 1.0 / norm(g));
  }
  for (const double square : o.zone_model.square) {
    EXPECT_GT(square, 0.0);
    EXPECT_LT(square, 20.0 * compression / 2600.0 / (least * least));
  }
}

}  // namespace
}  // namespace edda::zone_set_test
