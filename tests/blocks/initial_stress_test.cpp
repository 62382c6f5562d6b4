#include "blocks/initial_stress.hpp"

#include <gtest/gtest.h>

namespace edda::initial_stress_test {
namespace {

constexpr double g = 9.81;

Model ground(std::vector<double> densities) {
  Model m;
  for (const double d : densities) {
    m.materials.push_back({"m" + std::to_string(d), d, 1e10, 0.25, {}});
  }
  m.domain.emplace();
  m.domain->outline = {{0, 0}, {40, 0}, {40, 20}, {20, 20}, {10, 10}, {0, 10}};
  m.domain->material = 0;
  m.initial_stress.emplace();
  return m;
}

TEST(StressField, IsLinearInHeight) {
  Model m = ground({2500.0});
  m.initial_stress->stress = {-3e6, -2e6, 4e5};
  m.initial_stress->at_y = 5.0;
  m.initial_stress->gradient = {1e4, 2e4, -3e3};
  const Vec2 origin{7.0, 3.0};
  const Tensor t = StressField(m, origin).at(Vec2{1.0, 8.0} - origin);
  EXPECT_DOUBLE_EQ(t.xx, -3e6 + 3e4);
  EXPECT_DOUBLE_EQ(t.yy, -2e6 + 6e4);
  EXPECT_DOUBLE_EQ(t.xy, 4e5 - 9e3);
}

TEST(StressField, WeighsTheRockAboveUpToALevel) {
  Model m = ground({2500.0});
  m.initial_stress->k0 = 1.5;
  m.initial_stress->surface_y = 120.0;
  const Tensor t = StressField(m, {}).at({1.0, 8.0});
  EXPECT_DOUBLE_EQ(t.yy, -2500.0 * g * 112.0);
  EXPECT_DOUBLE_EQ(t.xx, 1.5 * t.yy);
  EXPECT_EQ(t.xy, 0.0);
  EXPECT_EQ(StressField(m, {}).at({1.0, 130.0}).yy, 0.0);
}

TEST(StressField, FollowsTheOutlinesUpperSide) {
  Model m = ground({2500.0});
  m.initial_stress->k0 = 1.0;
  m.initial_stress->surface = SurfaceKind::outline;
  const StressField field(m, {});
  EXPECT_NEAR(field.at({5.0, 4.0}).yy, -2500.0 * g * 6.0, 1e-3);
  EXPECT_NEAR(field.at({15.0, 4.0}).yy, -2500.0 * g * 11.0, 1e-3);
  EXPECT_NEAR(field.at({30.0, 4.0}).yy, -2500.0 * g * 16.0, 1e-3);
  EXPECT_NEAR(field.at({0.0, 4.0}).yy, -2500.0 * g * 6.0, 1e-3);  // on the sides
  EXPECT_NEAR(field.at({40.0, 4.0}).yy, -2500.0 * g * 16.0, 1e-3);
  EXPECT_NEAR(field.at({30.0, 20.0}).yy, 0.0, 1e-3);
}

/// Regions, the last of which counts; an upright face between two has the mean of both sides; what
/// lies above the model is as dense as the rock at its top.
TEST(StressField, WeighsEachRockOfTheColumn) {
  Model m = ground({2500.0, 1800.0, 3000.0});
  m.domain->outline = {{0, 0}, {40, 0}, {40, 20}, {0, 20}};
  m.regions = {{{{0, 10}, {40, 10}, {40, 15}, {0, 15}}, 1, none, {}},
               {{{20, 12}, {40, 12}, {40, 20}, {20, 20}}, 2, none, {}}};
  m.initial_stress->k0 = 1.0;
  m.initial_stress->surface_y = 30.0;
  const StressField field(m, {});
  const double left = 2500.0 * (5 + 15) + 1800.0 * 5, right = 2500.0 * 5 + 1800.0 * 2 + 3000.0 * 18;
  EXPECT_NEAR(field.at({10.0, 5.0}).yy, -g * left, 1e-2);
  EXPECT_NEAR(field.at({30.0, 5.0}).yy, -g * right, 1e-2);
  EXPECT_NEAR(field.at({20.0, 5.0}).yy, -0.5 * g * (left + right), 1e-2);
  EXPECT_NEAR(field.at({10.0, 12.0}).yy, -g * (1800.0 * 3 + 2500.0 * 15), 1e-2);
}

/// Brute force: a column summed in thin slices, for many points under a ragged surface.
TEST(StressField, AgreesWithSlices) {
  Model m = ground({2500.0, 1800.0});
  m.domain->outline = {{0, 0}, {40, 0}, {40, 17}, {31, 20}, {26, 12}, {9, 15}, {0, 10}};
  m.regions = {{{{2, 3}, {30, 1}, {38, 9}, {20, 16}, {5, 8}}, 1, none, {}}};
  m.initial_stress->k0 = 1.0;
  m.initial_stress->surface = SurfaceKind::outline;
  const StressField field(m, {});
  for (int q = 0; q < 40; ++q) {
    const Vec2 p{0.37 + 0.98 * q, 0.2 + 0.1 * q};
    double weight = 0.0;
    constexpr double slice = 1e-3;
    for (double y = p.y + 0.5 * slice; y < 20.0; y += slice) {
      const std::vector<Ring> all{m.domain->outline}, weak{m.regions[0].polygon};
      if (side_of(all, {p.x, y}, 0.0) <= 0) continue;
      weight += slice * (side_of(weak, {p.x, y}, 0.0) > 0 ? 1800.0 : 2500.0);
    }
    EXPECT_NEAR(field.at(p).yy, -g * weight, 4.0 * slice * 2500.0 * g) << q;
  }
}

TEST(InitialStress, OutOfThePlane) {
  Model m = ground({2500.0});
  m.initial_stress->stress = {-3e6, -2e6, 0.0};
  BlockSet b;
  b.area = {1.0};
  b.centroid_x = b.centroid_y = {5.0};
  b.material = {0};
  const auto zz = [&] {
    set_initial_stress(b, m, StressField(m, {}));
    return b.initial_zz[0];
  };
  EXPECT_DOUBLE_EQ(zz(), 0.25 * -5e6);
  m.initial_stress->k0_out = 0.8;
  EXPECT_DOUBLE_EQ(zz(), 0.8 * -2e6);
  m.plane = Plane::stress;
  EXPECT_EQ(zz(), 0.0);
}

}  // namespace
}  // namespace edda::initial_stress_test
