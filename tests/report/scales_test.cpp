// Ticks, units and colours.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>

#include "report/colours.hpp"
#include "report/drawn_range.hpp"
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

Ends drawn(std::vector<Weighed> values) {
  Ends all{values.front().value, values.front().value};
  for (const Weighed& v : values) all = {std::min(all.low, v.value), std::max(all.high, v.value)};
  return drawn_ends(all, inner_ends(values));
}

/// 0.01 to 1.00, 1 m2 each.
std::vector<Weighed> hundred() {
  std::vector<Weighed> values;
  for (int k = 1; k <= 100; ++k) values.push_back({0.01 * ((37 * k) % 101), 1.0});
  return values;
}

TEST(DrawnRange, LeavesOutWhatLiesFarBeyondNearlyAllOfTheArea) {
  std::vector<Weighed> values = hundred();
  EXPECT_NEAR(inner_ends(values).low, 0.02, 1e-12);
  EXPECT_NEAR(inner_ends(values).high, 0.99, 1e-12);
  EXPECT_DOUBLE_EQ(drawn(values).low, 0.01);
  EXPECT_DOUBLE_EQ(drawn(values).high, 1.0);
  values.push_back({1.9, 0.01});
  EXPECT_DOUBLE_EQ(drawn(values).high, 1.9);
  values.push_back({167.0, 0.01});
  EXPECT_LE(drawn(values).high, 1.5);
  // By area, not by number: five crumbs are as good as one, a large block is not left out.
  for (int k = 0; k < 5; ++k) values.push_back({100.0 + k, 0.01});
  EXPECT_LE(drawn(values).high, 1.5);
  values.push_back({50.0, 3.0});
  EXPECT_DOUBLE_EQ(drawn(values).high, 75.0);
  // On the other side, too.
  values = hundred();
  values.push_back({-20.0, 0.5});
  EXPECT_DOUBLE_EQ(drawn(values).high, 1.0);
  EXPECT_NEAR(drawn(values).low, 0.01 - 0.5 * 0.99, 1e-12);
}

TEST(DrawnRange, IsWholeWhereAllButAFewLieStill) {
  std::vector<Weighed> values(99, {1e-9, 1.0});
  values.push_back({0.5, 1.0});
  EXPECT_DOUBLE_EQ(drawn(values).high, 0.5);
  values = {{3.0, 0.0}, {2.0, 0.0}};
  EXPECT_DOUBLE_EQ(inner_ends(values).low, 2.0);
  EXPECT_DOUBLE_EQ(inner_ends(values).high, 3.0);
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

using Matrix = std::array<std::array<double, 3>, 3>;

/// As eyes see it that have only two kinds of cones (Machado, Oliveira and Fernandes 2009).
Colour seen_by(const Matrix& m, Colour c) {
  const auto to = [](double v) {
    return v <= 0.04045 ? v / 12.92 : std::pow((v + 0.055) / 1.055, 2.4);
  };
  const auto back = [](double v) {
    v = std::clamp(v, 0.0, 1.0);
    return v <= 0.0031308 ? 12.92 * v : 1.055 * std::pow(v, 1.0 / 2.4) - 0.055;
  };
  const std::array<double, 3> l{to(c.r), to(c.g), to(c.b)};
  std::array<double, 3> seen{};
  for (std::size_t i = 0; i < 3; ++i)
    seen[i] = back(m[i][0] * l[0] + m[i][1] * l[1] + m[i][2] * l[2]);
  return {seen[0], seen[1], seen[2]};
}

TEST(Colours, StatesOfContactsAreToldApartByTheColourBlind) {
  const std::array<Matrix, 4> eyes{
      {{{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}}},
       {{{0.367, 0.861, -0.228}, {0.280, 0.673, 0.047}, {-0.012, 0.043, 0.969}}},
       {{{0.152, 1.053, -0.205}, {0.115, 0.786, 0.099}, {-0.004, -0.048, 1.052}}},
       {{{1.256, -0.077, -0.179}, {-0.078, 0.931, 0.148}, {0.005, 0.691, 0.304}}}}};
  for (const Matrix& eye : eyes) {
    for (std::size_t a = 0; a < 4; ++a) {
      const Colour one = seen_by(eye, state_colour(a));
      for (std::size_t b = 0; b < a; ++b)
        EXPECT_GT(difference(one, seen_by(eye, state_colour(b))), 35.0) << a << ' ' << b;
      // An open one is white, and has a dark rim.
      if (a == 0) continue;
      EXPECT_GT(difference(one, seen_by(eye, ink::block)), 45.0) << a;
    }
  }
}

}  // namespace
}  // namespace edda::scales_test
