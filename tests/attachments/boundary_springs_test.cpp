#include "attachments/boundary_springs.hpp"

#include <gtest/gtest.h>

#include "blocks/build_blocks.hpp"

namespace edda::boundary_springs_test {
namespace {

/// Four unit squares in a row from x = 0, the last one held; a boundary of the given type and
/// place.
struct Row {
  Model model;
  BlockSet blocks;
};

Row row(const Boundary& boundary) {
  Row r;
  r.model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  r.model.boundaries.push_back(boundary);
  PolygonSet set;
  for (int i = 0; i < 4; ++i) {
    BlockPolygon p;
    const double x = i;
    p.rings = {{{x, 0}, {x + 1, 0}, {x + 1, 1}, {x, 1}}};
    p.joint = {std::vector<Index>(4, none)};
    p.material = 0;
    p.fixed = i == 3;
    set.blocks.push_back(p);
  }
  r.blocks = build_blocks(r.model, set);
  return r;
}

Boundary boundary(BoundaryType type, std::vector<std::string> sides, std::vector<Vec2> along = {}) {
  Boundary b;
  b.name = "b";
  b.type = type;
  b.sides = std::move(sides);
  b.along = std::move(along);
  b.stiffness = 5.0;
  return b;
}

TEST(BoundarySprings, FixedHoldsEveryFreeVertexOnTheSide) {
  const Row r = row(boundary(BoundaryType::fixed, {"bottom"}));
  const auto springs = attach_boundaries(r.model, r.blocks);
  ASSERT_TRUE(springs.ok());
  const BoundarySprings& s = springs.value();
  EXPECT_EQ(s.size(), 6u);  // two lower corners of each of three free blocks
  for (std::size_t q = 0; q < s.size(); ++q) {
    EXPECT_EQ(s.kxx[q], 5.0);
    EXPECT_EQ(s.kyy[q], 5.0);
    EXPECT_EQ(s.kxy[q], 0.0);
    EXPECT_EQ(r.blocks.vertex_y[s.vertex[q]], 0.0);
  }
  EXPECT_EQ(s.block_begin.back(), s.size());
}

TEST(BoundarySprings, RollerHoldsAcrossItsLineOnly) {
  const Row r = row(boundary(BoundaryType::roller, {"left", "bottom"}));
  const auto springs = attach_boundaries(r.model, r.blocks);
  ASSERT_TRUE(springs.ok());
  const BoundarySprings& s = springs.value();
  ASSERT_EQ(s.size(), 7u);
  for (std::size_t q = 0; q < s.size(); ++q) {
    const bool on_left = r.blocks.vertex_x[s.vertex[q]] == 0.0;
    const bool on_bottom = r.blocks.vertex_y[s.vertex[q]] == 0.0;
    EXPECT_DOUBLE_EQ(s.kxx[q], on_left ? 5.0 : 0.0);
    EXPECT_DOUBLE_EQ(s.kyy[q], on_bottom ? 5.0 : 0.0);
  }
}

TEST(BoundarySprings, AFrictionlessPlatenHoldsAcrossItsLineOnly) {
  for (const BoundaryType type : {BoundaryType::velocity, BoundaryType::displacement}) {
    for (const bool frictionless : {false, true}) {
      Boundary platen = boundary(type, {"top"});
      platen.frictionless = frictionless;
      const Row r = row(platen);
      const auto springs = attach_boundaries(r.model, r.blocks);
      ASSERT_TRUE(springs.ok());
      const BoundarySprings& s = springs.value();
      ASSERT_EQ(s.size(), 6u);
      for (std::size_t q = 0; q < s.size(); ++q) {
        EXPECT_EQ(s.kyy[q], 5.0);
        EXPECT_EQ(s.kxx[q], frictionless ? 0.0 : 5.0);
      }
    }
  }
}

TEST(BoundarySprings, SlantedRollerIsAcrossThePolyline) {
  Row r = row(boundary(BoundaryType::roller, {}, {{0, 1}, {1, 0}}));
  const auto springs = attach_boundaries(r.model, r.blocks);
  ASSERT_TRUE(springs.ok());
  const BoundarySprings& s = springs.value();
  ASSERT_GE(s.size(), 2u);
  EXPECT_DOUBLE_EQ(s.kxx[0], 2.5);
  EXPECT_DOUBLE_EQ(s.kxy[0], 2.5);
}

TEST(BoundarySprings, PiecesOfOneLineCountOnce) {
  const Row one = row(boundary(BoundaryType::roller, {}, {{0, 0}, {3, 0}}));
  const Row cut = row(boundary(BoundaryType::roller, {}, {{0, 0}, {1, 0}, {2, 0}, {3, 0}, {1, 0}}));
  const BoundarySprings a = attach_boundaries(one.model, one.blocks).value();
  const BoundarySprings b = attach_boundaries(cut.model, cut.blocks).value();
  EXPECT_EQ(a.kyy, b.kyy);
  EXPECT_EQ(a.vertex, b.vertex);
}

TEST(BoundarySprings, ThicknessScalesThem) {
  Row r = row(boundary(BoundaryType::fixed, {"bottom"}));
  r.model.thickness = 2.0;
  r.blocks.thickness = 2.0;
  EXPECT_EQ(attach_boundaries(r.model, r.blocks).value().kxx[0], 10.0);
}

TEST(BoundarySprings, OneThatHoldsNothingIsAFault) {
  const Row r = row(boundary(BoundaryType::fixed, {}, {{0, 7}, {1, 7}}));
  const auto springs = attach_boundaries(r.model, r.blocks);
  ASSERT_FALSE(springs.ok());
  EXPECT_NE(springs.faults()[0].problem.find("no vertex of a free block"), std::string::npos);
}

TEST(BoundarySprings, EnergyIsTheProductOfTwoSteps) {
  const Row r = row(boundary(BoundaryType::fixed, {"left"}));
  const BoundarySprings s = attach_boundaries(r.model, r.blocks).value();
  Pose pose{r.blocks.vertex_x, r.blocks.vertex_y, r.blocks.vertex_x, r.blocks.vertex_y};
  for (double& x : pose.x) x += 0.3;
  for (double& x : pose.x1) x += 0.1;
  EXPECT_NEAR(boundary_energy(s, pose), static_cast<double>(s.size()) * 0.5 * 5.0 * 0.03, 1e-12);
}

/// K = k n n^T of a slanted roller: k (n . w)(n . u)/2.
TEST(BoundarySprings, EnergyOfASlantedRollerIsAcrossIt) {
  const Row r = row(boundary(BoundaryType::roller, {}, {{0, 1}, {1, 0}}));
  const BoundarySprings s = attach_boundaries(r.model, r.blocks).value();
  const Vec2 now{0.3, 0.1}, before{0.2, -0.4}, n = unit(Vec2{1, 1});
  Pose pose{r.blocks.vertex_x, r.blocks.vertex_y, r.blocks.vertex_x, r.blocks.vertex_y};
  for (std::size_t v = 0; v < pose.x.size(); ++v) {
    pose.x[v] += now.x;
    pose.y[v] += now.y;
    pose.x1[v] += before.x;
    pose.y1[v] += before.y;
  }
  EXPECT_NEAR(boundary_energy(s, pose),
              static_cast<double>(s.size()) * 0.5 * 5.0 * dot(n, now) * dot(n, before), 1e-12);
}

TEST(BoundarySprings, BeginToActWhereTheirVerticesAre) {
  const Row r = row(boundary(BoundaryType::fixed, {"left"}));
  BoundarySprings s = attach_boundaries(r.model, r.blocks).value();
  s.release(0);
  std::vector<double> x = r.blocks.vertex_x, y = r.blocks.vertex_y;
  for (double& u : x) u += 0.3;
  for (double& u : y) u -= 0.2;
  s.shift[0] = {0.05, 0.07};
  s.engage(0, x, y);
  for (std::size_t q = 0; q < s.size(); ++q) {
    EXPECT_NEAR(norm(spring_force(s, q, x, y)), 0.0, 1e-12);
    EXPECT_EQ(s.kxx[q], 5.0);
  }
  s.shift[0] += Vec2{0.1, 0.0};
  EXPECT_NEAR(spring_force(s, 0, x, y).x, 0.5, 1e-12);
}

}  // namespace
}  // namespace edda::boundary_springs_test
