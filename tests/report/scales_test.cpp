// Ticks, units and colours.
#include <gtest/gtest.h>

#include <array>
#include <cmath>

#include "report/colours.hpp"
#include "report/scene.hpp"
#include "report/ticks.hpp"

namespace edda::scales_test {
namespace {

TEST(Ticks, AreRoundAndInside) {
  const auto t = ticks(-0.31, 1.02, 6);
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].label, "0.0");
  EXPECT_EQ(t[1].label, "0.5");
  EXPECT_TRUE(ticks(1.0, 1.0, 5).empty());
  EXPECT_EQ(ticks(0.0, 100.0, 5).size(), 6u);
}

TEST(Ticks, OfNorthingsTellThemApart) {
  const auto t = ticks(5123400.0, 5123500.0, 5);
  ASSERT_EQ(t.size(), 6u);
  EXPECT_EQ(t[1].label, "5123420");
}

TEST(Ticks, UnitsTakeThePrefixThatSuits) {
  EXPECT_EQ(scaled_unit("Pa", 2.3e6).name, "MPa");
  EXPECT_EQ(scaled_unit("J", 2.3e3).name, "kJ");
  EXPECT_EQ(scaled_unit("m", 0.004).name, "mm");
  EXPECT_EQ(scaled_unit("m", 5000.0).name, "m");
  EXPECT_EQ(scaled_unit("degrees", 1e-5).name, "degrees");
  EXPECT_DOUBLE_EQ(scaled_unit("N", 1500.0).factor, 1e-3);
}

TEST(Ticks, RoundValuesLieBelow) {
  EXPECT_DOUBLE_EQ(round_below(0.37), 0.2);
  EXPECT_DOUBLE_EQ(round_below(5.0), 5.0);
  EXPECT_DOUBLE_EQ(round_below(99.0), 50.0);
  EXPECT_DOUBLE_EQ(round_below(0.0), 0.0);
}

/// CIE L*a*b* of an sRGB colour.
std::array<double, 3> lab(Colour c) {
  const auto linear = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const double r = linear(c.r), g = linear(c.g), b = linear(c.b);
  const auto f = [](double t) { return t > 0.008856 ? std::cbrt(t) : 7.787 * t + 16.0 / 116.0; };
  const double x = f((0.4124 * r + 0.3576 * g + 0.1805 * b) / 0.95047),
               y = f(0.2126 * r + 0.7152 * g + 0.0722 * b),
               z = f((0.0193 * r + 0.1192 * g + 0.9505 * b) / 1.08883);
  return {116.0 * y - 16.0, 500.0 * (x - y), 200.0 * (y - z)};
}

double difference(Colour a, Colour b) {
  const auto p = lab(a), q = lab(b);
  return std::hypot(p[0] - q[0], p[1] - q[1], p[2] - q[2]);
}

TEST(Colours, LightnessOfTheSequentialMapOnlyRises) {
  for (int k = 1; k <= 100; ++k) {
    EXPECT_GT(lab(sequential(k / 100.0))[0], lab(sequential((k - 1) / 100.0))[0]) << k;
  }
}

TEST(Colours, StepsOfTheDivergingMapLookEven) {
  double least = 1e300, most = 0.0;
  for (int k = 1; k <= 16; ++k) {
    const double step = difference(diverging(k / 16.0), diverging((k - 1) / 16.0));
    least = std::min(least, step);
    most = std::max(most, step);
  }
  EXPECT_LT(most, 1.3 * least);
  EXPECT_NEAR(lab(diverging(0.0))[0], lab(diverging(1.0))[0], 2.0);
  EXPECT_GT(lab(diverging(0.5))[0], 96.0);
}

}  // namespace
}  // namespace edda::scales_test
