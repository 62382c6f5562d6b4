// Closed outlines of known area, in all the ways in which a drawing can write them.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/polygon.hpp"
#include "imports/dxf_text.hpp"
#include "imports/imports.hpp"

namespace edda::dxf_areas_test {
namespace {

using namespace test;

constexpr double pi = std::numbers::pi;
/// Of a sector of straight pieces, 48 to the turn, the part of the true area.
const double of_arc = std::sin(2.0 * pi / 48.0) / (2.0 * pi / 48.0);

double area_of(const Drawing& drawing) {
  double sum = 0.0;
  for (const DrawnLine& line : drawing.lines)
    sum += std::abs(signed_area(closed_ring(line.points)));
  return sum;
}

std::string text_of(double x) {
  char text[40];
  std::snprintf(text, sizeof text, "%.17g", x);
  return text;
}

struct Corner {
  double x, y, bulge = 0.0;
};

std::string light(const std::vector<Corner>& corners, int flags, const DxfPairs& more = {}) {
  std::string text = entity("LWPOLYLINE", {{8, "J"}, {90, "9"}, {70, std::to_string(flags)}});
  for (const Corner& c : corners) {
    text += groups({{10, text_of(c.x)}, {20, text_of(c.y)}, {42, text_of(c.bulge)}});
  }
  return text + groups(more);
}

std::string old(const std::vector<Corner>& corners, int flags, const DxfPairs& more = {}) {
  std::string text = entity("POLYLINE", {{8, "J"}, {66, "1"}, {70, std::to_string(flags)}});
  text += groups(more);
  for (const Corner& c : corners) {
    text += entity("VERTEX", {{10, text_of(c.x)}, {20, text_of(c.y)}, {42, text_of(c.bulge)}});
  }
  return text + entity("SEQEND", {});
}

const std::vector<Corner> square = {{0, 0}, {2, 0}, {2, 2}, {0, 2}};

TEST(DxfAreas, ClosedFlagsWithMoreBits) {
  for (const int flags : {1, 129, 1 | 2 | 128}) {
    EXPECT_NEAR(area_of(read_dxf(light(square, flags))), 4.0, 1e-12) << flags;
  }
  for (const int flags : {1, 129, 1 | 4}) {
    EXPECT_NEAR(area_of(read_dxf(old(square, flags))), 4.0, 1e-12) << flags;
  }
  EXPECT_EQ(area_of(read_dxf(light(square, 128))), 0.0);
}

/// A bulge is the tangent of a quarter of the arc's angle: a chord of 2 with an arc of angle a has
/// the radius r = 1/sin(a/2), and the segment the area r^2 (a - sin a)/2.
TEST(DxfAreas, BulgesAboveOne) {
  for (const double angle : {0.3, 1.0, 2.0, pi, 4.0, 5.0, 6.0}) {
    const double r = 1.0 / std::sin(0.5 * angle);
    const double bulge = std::tan(0.25 * angle);
    const double straight = -0.5 * r * r * std::sin(angle);
    const double most = 0.5 * r * r * angle + straight;
    const double tolerance = 0.005 * r * r * angle;
    for (const bool light_one : {true, false}) {
      // Beyond the half circle the arc bulges out, below the chord.
      const std::vector<Corner> chord = {{1, 0, bulge}, {-1, 0, 0}};
      const Drawing d = read_dxf(light_one ? light(chord, 1) : old(chord, 1));
      EXPECT_NEAR(area_of(d), most, tolerance) << angle;
      const std::vector<Corner> back = {{1, 0, -bulge}, {-1, 0, 0}};
      EXPECT_NEAR(area_of(read_dxf(light(back, 1))), most, tolerance) << angle;
    }
  }
  // Two half circles are a circle of 48 pieces.
  EXPECT_NEAR(area_of(read_dxf(light({{1, 0, 1}, {-1, 0, 1}}, 1))), pi * of_arc, 1e-9);
}

/// Drawn from below x is mirrored: the area stays, the centroid changes its side.
TEST(DxfAreas, MirroredNormals) {
  const std::vector<Corner> shape = {{1, 0, 1}, {3, 0}, {3, 2}, {1, 2}};
  for (const bool light_one : {true, false}) {
    const DxfPairs below = {{210, "0"}, {220, "0"}, {230, "-1"}};
    const Drawing up = read_dxf(light_one ? light(shape, 1) : old(shape, 1));
    const Drawing down = read_dxf(light_one ? light(shape, 1, below) : old(shape, 1, below));
    EXPECT_NEAR(area_of(up), 4.0 + 0.5 * pi * of_arc, 1e-9);
    EXPECT_NEAR(area_of(down), area_of(up), 1e-12);
    const Ring a = closed_ring(up.lines[0].points), b = closed_ring(down.lines[0].points);
    expect_near(moments({&a, 1}).centroid,
                {-moments({&b, 1}).centroid.x, moments({&b, 1}).centroid.y}, 1e-12);
  }
}

/// No normal, 0, 0, 0, is that of the plane.
TEST(DxfAreas, NoNormalIsThatOfThePlane) {
  const DxfPairs none = {{210, "0"}, {220, "0"}, {230, "0"}};
  EXPECT_NEAR(area_of(read_dxf(light(square, 1, none))), 4.0, 1e-12);
  EXPECT_NEAR(area_of(read_dxf(old(square, 1, none))), 4.0, 1e-12);
}

TEST(DxfAreas, UnequallyScaledInserts) {
  const std::string all = blocks(block("A", "1", "1", light({{1, 1, 1}, {-1, 1, 1}}, 1)));
  for (const auto& [x, y] : {std::pair(2.0, 0.5), std::pair(-3.0, 1.0), std::pair(1.5, -2.0)}) {
    const std::string insert =
        entity("INSERT",
               {{2, "A"}, {10, "7"}, {20, "-3"}, {41, text_of(x)}, {42, text_of(y)}, {50, "37"}});
    EXPECT_NEAR(area_of(read_dxf(insert, all)), std::abs(x * y) * pi * of_arc, 1e-9);
  }
}

/// A rational spline of degree 2 is a circle to the last digit; here as a closed one with more
/// bits, without a normal, and with its knots repeated once more than its degree, as Bezier pieces.
TEST(DxfAreas, SplinesAsCircles) {
  const double w = std::sqrt(0.5);
  const std::vector<Vec2> nine = {{1, 0},   {1, 1},  {0, 1},  {-1, 1}, {-1, 0},
                                  {-1, -1}, {0, -1}, {1, -1}, {1, 0}};
  const auto circle = [&](bool bezier, int flags) {
    std::string text = entity(
        "SPLINE",
        {{8, "J"}, {210, "0"}, {220, "0"}, {230, "0"}, {70, std::to_string(flags)}, {71, "2"}});
    std::vector<double> knots = {0, 0, 0};
    for (const double u : {1.0, 2.0, 3.0}) knots.insert(knots.end(), bezier ? 3 : 2, u);
    knots.insert(knots.end(), 3, 4.0);
    for (const double u : knots) text += groups({{40, text_of(u)}});
    std::vector<std::pair<Vec2, double>> points;
    for (std::size_t i = 0; i < nine.size(); ++i) {
      const bool joint = bezier && i % 2 == 0 && i > 0 && i + 1 < nine.size();
      for (int k = 0; k < (joint ? 2 : 1); ++k) points.emplace_back(nine[i], i % 2 == 0 ? 1.0 : w);
    }
    for (const auto& [p, weight] : points) text += groups({{41, text_of(weight)}});
    for (const auto& [p, weight] : points) text += groups({{10, text_of(p.x)}, {20, text_of(p.y)}});
    return text;
  };
  for (const bool bezier : {false, true}) {
    for (const int flags : {8, 11, 1 | 2 | 4 | 8}) {
      EXPECT_NEAR(area_of(read_dxf(circle(bezier, flags))), pi, 0.02) << bezier << flags;
    }
  }
}

}  // namespace
}  // namespace edda::dxf_areas_test
