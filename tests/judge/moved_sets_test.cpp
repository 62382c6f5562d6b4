// How far blocks have moved as seen from those beside them.
#include "judge/moved_sets.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "run/prepared.hpp"

namespace edda {
namespace {

const std::string rock = R"(
[materials.rock]
density = 2500
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 30
[solver]
duration = 1
)";

std::string block(const std::string& name, double x, double y, double width, double height,
                  const std::string& more = {}) {
  const auto n = [](double v) { return std::to_string(v); };
  return "[[block]]\nname = '" + name + "'\n" + more + "polygon = [[" + n(x) + ", " + n(y) +
         "], [" + n(x + width) + ", " + n(y) + "], [" + n(x + width) + ", " + n(y + height) +
         "], [" + n(x) + ", " + n(y + height) + "]]\n";
}

Simulation model(const std::string& blocks) {
  return testing::prepared(rock + blocks).sim;
}

/// The block of this name as the cut numbers it.
Id id_of(const Simulation& sim, const std::string& name) {
  const BlockSet& b = sim.scene->blocks;
  for (Id i = 0; i < b.size(); ++i) {
    if (b.name(i) == name) return i;
  }
  ADD_FAILURE() << name;
  return 0;
}

/// Moves a block by `by` after it has turned about `about`, counter-clockwise (rad).
void move(Simulation& sim, Id i, Vec2 by, double turn = 0.0, Vec2 about = {}) {
  const BlockSet& b = sim.scene->blocks;
  BodyVectors& at = sim.motion.state.position;
  store(rigid_positions(vector_of(b, at, i), about - b.origin, by, turn), b, at, i);
}

const std::string supported = "[[boundary]]\nsides = ['bottom']\ntype = 'fixed'\n";
const std::string ground = block("ground", -10, -10, 20, 10) + supported;

TEST(MovedSets, ABlockSlidesOnGroundHoweverLargeAndFreeThatIs) {
  for (const double size : {20.0, 2000.0}) {
    for (const char* fixed : {"", "fixed = true\n"}) {
      const bool is_fixed = *fixed != '\0';
      Simulation sim = model(block("ground", -size / 2, -size, size, size, fixed) +
                             block("slider", 0, 0, 2, 0.5) + (is_fixed ? "" : supported));
      const RelativeMotion motion(sim);
      move(sim, id_of(sim, "slider"), {0.05, 0.0});
      const std::vector<MovedSet> sets = motion.sets(sim, 0.01);
      ASSERT_EQ(sets.size(), 1u) << size << fixed;
      EXPECT_EQ(sets[0].blocks, std::vector<Id>{id_of(sim, "slider")});
      EXPECT_NEAR(sets[0].distance, 0.05, 1e-12);
      EXPECT_NEAR(sets[0].part, 0.05, 1e-12) << "of its size, 1 m";
      EXPECT_NEAR(sets[0].area, 1.0, 1e-12);
    }
  }
}

/// A corner of meshed ground is as large as itself, however large the ground, and flows against
/// what its rock strains; ground that turns as a whole does not flow.
TEST(MovedSets, APartOfMeshedGroundFlows) {
  for (const double size : {8.0, 24.0}) {
    Simulation sim =
        model("[zones]\nsize = 0.5\n" + block("ground", -size / 2, -size, size, size) + supported);
    const RelativeMotion motion(sim);
    const BlockSet& b = sim.scene->blocks;
    const Meshes& m = b.meshes;
    ASSERT_TRUE(b.is_meshed(0));
    Zones& zones = sim.motion.zones;
    const double shear = 1e9 / 2.4, strain = 2e-3;
    zones.state[0].stress = {0.0, -2.0 * shear * strain, 0.0, 0.0};
    zones.yielding[0] = static_cast<std::uint8_t>(Yielding::in_tension);
    move(sim, 0, {0.5, 0.2}, 0.3);
    EXPECT_TRUE(motion.flowing(sim).empty()) << "nothing shears";
    zones.yielding[0] = static_cast<std::uint8_t>(Yielding::in_shear);
    const std::vector<FlowingPart> turned = motion.flowing(sim);
    EXPECT_TRUE(turned.empty() || turned[0].part < 1e-12);
    const Vec2 corner{0.5 * size, 0.5 * size};
    double area = 0.0;
    for (std::size_t j = 0; j < m.nodes(); ++j) {
      if (norm(Vec2{m.arm_x[j], m.arm_y[j]} - corner) > 3.0) continue;
      area += m.share[j] * b.area[0];
      sim.motion.state.position.modes.add(b.bending.modes() + j, {0.1, 0.0});
    }
    const std::vector<FlowingPart> parts = motion.flowing(sim);
    ASSERT_EQ(parts.size(), 1u) << size;
    EXPECT_NEAR(parts[0].area, area, 1e-9 * area);
    EXPECT_NEAR(parts[0].part, 0.1 / std::sqrt(area), 1e-9);
    EXPECT_NEAR(parts[0].strains, 0.1 / std::sqrt(area) / strain, 1e-6);
  }
}

TEST(MovedSets, WhatRidesOnGroundThatSettlesTiltsOrTravelsHasNotMoved) {
  Simulation sim =
      model(ground + block("lower", 0, 0, 0.5, 0.25) + block("upper", 0, 0.25, 0.5, 0.25));
  const RelativeMotion motion(sim);
  for (const char* name : {"ground", "lower", "upper"})
    move(sim, id_of(sim, name), {0.3, -0.7}, 0.2);
  // The ground alone is as large as the model: 0.04 of its size as seen from where it was.
  for (const MovedSet& set : motion.sets(sim, 0.01)) EXPECT_EQ(set.blocks.size(), 3u);
}

TEST(MovedSets, WhatMovesTogetherIsOneSetOfTheSizeOfItsLargestBlock) {
  Simulation sim = model(ground + block("wide", 0, 0, 4, 1) + block("small", 0, 1, 0.5, 0.5));
  const RelativeMotion motion(sim);
  for (const char* name : {"wide", "small"}) move(sim, id_of(sim, name), {0.1, 0.0});
  const std::vector<MovedSet> sets = motion.sets(sim, 0.01);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].blocks.size(), 2u);
  EXPECT_NEAR(sets[0].part, 0.1 / 2.0, 1e-12);
}

/// A sliver between two blocks of which one slides by a little: they may have carried it along.
TEST(MovedSets, ASliverBetweenBlocksThatSlideIsNotWhatMoves) {
  Simulation sim = model(ground + block("sliver", 0, 0, 0.1, 0.02) + block("slab", 0, 0.02, 4, 1));
  const RelativeMotion motion(sim);
  move(sim, id_of(sim, "slab"), {0.01, 0.0});
  move(sim, id_of(sim, "sliver"), {0.006, 0.0});
  EXPECT_TRUE(motion.sets(sim, 0.01).empty());
  move(sim, id_of(sim, "sliver"), {0.5, 0.0});  // by itself
  const std::vector<MovedSet> sets = motion.sets(sim, 0.01);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_EQ(sets[0].blocks, std::vector<Id>{id_of(sim, "sliver")});
}

TEST(MovedSets, AColumnThatTurnsAboutItsToeMovesAtItsTop) {
  Simulation sim = model(ground + block("column", 0, 0, 1, 4));
  const RelativeMotion motion(sim);
  const double turn = 0.02;
  move(sim, id_of(sim, "column"), {}, turn);
  const std::vector<MovedSet> sets = motion.sets(sim, 0.01);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_NEAR(sets[0].distance, 2.0 * std::sin(0.5 * turn) * std::sqrt(17.0), 1e-9);
}

TEST(MovedSets, WhatWasInTheAirWasToLand) {
  Simulation sim =
      model(block("ground", -10, -10, 20, 10, "fixed = true\n") + block("high", 0, 3, 1, 1));
  const RelativeMotion motion(sim);
  move(sim, id_of(sim, "high"), {0.0, -0.5});
  const std::vector<MovedSet> sets = motion.sets(sim, 0.01);
  ASSERT_EQ(sets.size(), 1u);
  EXPECT_NEAR(sets[0].part, 0.05, 1e-12);
}

TEST(MovedSets, BlocksLeftOutNeitherMoveNorCarryOthers) {
  Simulation sim = model(ground + block("lower", 0, 0, 1, 1) + block("upper", 0, 1, 1, 1));
  const RelativeMotion motion(sim);
  move(sim, id_of(sim, "lower"), {0.5, 0.0});
  std::vector<std::uint8_t> out(sim.scene->blocks.size(), 0);
  out[id_of(sim, "lower")] = 1;
  EXPECT_TRUE(motion.sets(sim, 0.01, out).empty());
}

}  // namespace
}  // namespace edda
