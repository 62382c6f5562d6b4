// Bolts and loads within blocks that are meshed: they are carried by zones.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "attachments/bolted_blocks.hpp"
#include "attachments/loads.hpp"
#include "attachments/stored_in_bolts.hpp"
#include "blocks/block_point.hpp"
#include "cutting/t_nodes.hpp"
#include "cutting/zone_size.hpp"

namespace edda::meshed_bolts_test {
namespace {

using testing::stored;

using test::grouted;

/// One block of 6 m x 2 m; size 0: not meshed.
struct Bar : test::Bolted {
  explicit Bar(double size) {
    add({{0, 0}, {6, 0}, {6, 2}, {0, 2}});
    model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
    if (size > 0.0) {
      model.deformation = BlockDeformation::zones;
      model.zones = ZoneInputs{size, {}, {}};
      const ZoneSizes sizes(model, set);
      divide_edges(set.blocks[0], [of = sizes.of(set.blocks[0])](Vec2 from, Vec2 to) {
        return divisions(from, to, of);
      });
    }
    blocks = build_blocks(model, set);
    masses = given_masses(blocks);
    state = initial_state(blocks, set);
  }
  std::size_t many() const { return blocks.meshes.nodes_of(0); }
  /// The three nodes at X + G X, X from the centroid.
  void strain(const Deformation& g) {
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      const Vec2 p{blocks.node_x[k][0], blocks.node_y[k][0]},
          arm = p - Vec2{blocks.centroid_x[0], blocks.centroid_y[0]};
      state.position.x[k][0] = p.x + g.xx * arm.x + g.xy * arm.y;
      state.position.y[k][0] = p.y + g.yx * arm.x + g.yy * arm.y;
    }
  }
  /// Every mesh node by itself.
  void shake(double size) {
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(-size, size);
    for (std::size_t j = 0; j < many(); ++j)
      state.position.modes.set(j, {any(random), any(random)});
  }
  void install(const Bolt& bolt) {
    model.bolts = {bolt};
    // Bolts go in where corners are now.
    std::vector<double> x, y;
    for (Id v = 0; v < blocks.vertex_count(); ++v) {
      const Vec2 p = corner_at(blocks, state.position, v);
      x.push_back(p.x);
      y.push_back(p.y);
    }
    Result<Bolts> found = attach_bolts(model, blocks, state, x, y, {0}, 0.05);
    ASSERT_TRUE(found.ok()) << to_string(found.faults()[0]);
    bolts = std::move(found.value());
  }
  void update() { update_bolts(bolts, blocks, state); }
  BodyVector forces() const {
    BlockForces on{blocks, 0};
    add_bolts(on, bolts);
    return on.sum;
  }
};

/// Within its strength.
Bolt elastic(Vec2 from, Vec2 to) {
  Bolt bolt = grouted(from, to);
  bolt.bond = {1e8, 1e12};
  return bolt;
}

/// A block of one strain, meshed or not: the same forces along the bolt and on the three nodes.
TEST(MeshedBolts, FeelAUniformStrainAsInABlockOfOneStrain) {
  const Bolt bolt = elastic({0.8, 0.3}, {5.2, 1.6});
  Bar whole(0.0), meshed(0.4);
  for (Bar* bar : {&whole, &meshed}) {
    bar->install(bolt);
    bar->strain({2e-4, 0.5e-4, -1e-4, 1e-4});
    bar->update();
  }
  ASSERT_EQ(whole.many(), 0u);
  ASSERT_GT(meshed.many(), 50u);
  const BoltSprings &of_whole = whole.bolts.bars, &of_mesh = meshed.bolts.bars;
  ASSERT_EQ(of_whole.force.size(), of_mesh.force.size());
  const double largest = *std::max_element(of_whole.force.begin(), of_whole.force.end());
  EXPECT_GT(largest, 1e3);
  for (std::size_t k = 0; k < whole.bolts.size(); ++k) {
    EXPECT_NEAR(of_mesh.force[k], of_whole.force[k], 1e-8 * largest);
    EXPECT_NEAR(meshed.bolts.bonds.force[k], whole.bolts.bonds.force[k], 1e-8 * largest);
  }
  const BodyVector f = whole.forces(), g = meshed.forces();
  for (std::size_t k = 0; k < nodes_per_block; ++k)
    EXPECT_LT(norm(f.nodes[k] - g.nodes[k]), 1e-8 * largest);
}

/// A bolt of length 2 l in rock whose strain is c x, with no mean: EA (u + s)'' = K s, no force at
/// the ends, so that N = EA c (x - l sinh(lambda x)/sinh(lambda l)) with lambda^2 = K/EA.
TEST(MeshedBolts, FeelAStrainThatVariesAlongThem) {
  const double l = 2.0, c = 1e-5;
  const Bolt bolt = elastic({1.0, 1.1}, {1.0 + 2.0 * l, 1.1});
  const double steel = bolt.young * 0.25 * std::numbers::pi * bolt.diameter * bolt.diameter,
               lambda = std::sqrt(bolt.bond.stiffness / steel);
  for (const double size : {0.4, 0.2}) {
    Bar bar(size);
    bar.install(bolt);
    for (std::size_t j = 0; j < bar.many(); ++j) {
      const double x = bar.blocks.meshes.arm_x[j];
      bar.state.position.modes.set(j, {0.5 * c * x * x, 0.0});
    }
    bar.update();
    double largest = 0.0, error = 0.0;
    for (std::size_t k = 0; k + 1 < bar.bolts.size(); ++k) {
      const double x = bar.bolts.distance[k] + 0.5 * bar.bolts.length[k] - l;
      const double exact = steel * c * (x - l * std::sinh(lambda * x) / std::sinh(lambda * l));
      largest = std::max(largest, std::abs(exact));
      error = std::max(error, std::abs(bar.bolts.bars.force[k] - exact));
    }
    EXPECT_GT(largest, 200.0);
    EXPECT_LT(error, 0.02 * largest) << size;
  }
}

/// On the three nodes and on every mesh node; together they have neither resultant nor moment.
void expect_gradients(Bolt bolt) {
  bolt.pretension = 2e4;
  Bar bar(0.7);
  bar.install(bolt);
  bar.strain({0.01, 0.52, -0.48, -0.02});
  bar.shake(0.01);
  bar.update();
  const BodyVector f = bar.forces();
  double scale = 0.0, torque = 0.0;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    scale = std::max(scale, norm(f.nodes[k]));
    torque += cross({bar.state.position.x[k][0], bar.state.position.y[k][0]}, f.nodes[k]);
  }
  for (std::size_t j = 0; j < bar.many(); ++j) {
    scale = std::max(scale, norm(f.modes[j]));
    torque += cross(bar.state.position.modes[j], f.modes[j]);
  }
  EXPECT_GT(scale, 1e4);
  EXPECT_LT(norm(resultant(f.nodes)), 1e-9 * scale);
  EXPECT_LT(std::abs(torque), 1e-8 * scale);
  const auto slope = [&](double& place) {
    constexpr double d = 1e-6;
    const double at = place;
    place = at + d;
    bar.update();
    const double more = stored(bar.bolts);
    place = at - d;
    bar.update();
    const double less = stored(bar.bolts);
    place = at;
    return (less - more) / (2.0 * d);
  };
  BodyVectors& x = bar.state.position;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    EXPECT_NEAR(slope(x.x[k][0]), f.nodes[k].x, 2e-5 * scale);
    EXPECT_NEAR(slope(x.y[k][0]), f.nodes[k].y, 2e-5 * scale);
  }
  for (std::size_t j = 0; j < bar.many(); ++j) {
    EXPECT_NEAR(slope(x.modes.x[j]), f.modes[j].x, 2e-5 * scale);
    EXPECT_NEAR(slope(x.modes.y[j]), f.modes[j].y, 2e-5 * scale);
  }
}

TEST(MeshedBolts, ForcesAreGradientsOfTheStoredEnergy) {
  Bolt bolt = elastic({0.8, 0.3}, {5.2, 1.6});
  expect_gradients(bolt);
  bolt.type = BoltType::end;
  expect_gradients(bolt);
}

/// Put into a mesh that has been distorted, a bolt is as straight and free of force as in any.
TEST(MeshedBolts, GoInWhereMeshNodesAreNow) {
  Bar bar(0.4);
  bar.strain({0.02, 0.01, -0.03, -0.02});
  bar.shake(0.05);
  const Vec2 from{0.8, 0.4}, to{5.2, 1.6}, t = unit(to - from);
  bar.install(elastic(from, to));
  const Bolts& b = bar.bolts;
  ASSERT_GT(b.size(), 10u);
  for (std::size_t k = 0; k < b.size(); ++k) {
    const Vec2 at = node_place(b, bar.blocks, bar.state, k) + bar.blocks.origin;
    EXPECT_LT(norm(at - (from + b.distance[k] * t)), 1e-12);
    EXPECT_NEAR(b.bars.force[k], 0.0, 1e-3);
    for (const double part : weights_of(b.weight, k)) EXPECT_GT(part, -1e-9);
  }
}

/// A force at a point within a meshed block does its work on the way of that point.
TEST(MeshedBolts, ALoadAtAPointMovesItsZone) {
  Bar bar(0.4);
  Load load;
  load.point = Vec2{2.3, 0.7};
  load.force = Vec2{3e4, -1e5};
  bar.model.loads = {load};
  const Result<Loads> loads = attach_loads(bar.model, bar.set, bar.blocks);
  ASSERT_TRUE(loads.ok());
  BlockForces on{bar.blocks, 0};
  add_loads(on, loads_at(bar.model, loads.value(), 0.0), bar.blocks.vertex_x, bar.blocks.vertex_y);
  bar.strain({0.02, 0.01, -0.03, -0.02});
  bar.shake(0.05);
  const BlockPoint p = block_point(bar.blocks, 0, *load.point - bar.blocks.origin);
  const Vec2 way = at_point(bar.blocks, bar.state.position, p);
  EXPECT_NEAR(dot(on.sum, vector_of(bar.blocks, bar.state.position, 0)), dot(*load.force, way),
              1e-7 * norm(*load.force));
  std::size_t pushed = 0;
  for (std::size_t j = 0; j < bar.many(); ++j) pushed += norm(on.sum.modes[j]) > 0.0;
  EXPECT_EQ(pushed, corners_of_zone);
}

}  // namespace
}  // namespace edda::meshed_bolts_test
