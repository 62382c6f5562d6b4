// Arcs, circles, ellipses and splines of drawings beside the curves that they stand for.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <random>

#include "base/polygon.hpp"
#include "imports/dxf_text.hpp"
#include "imports/spline_curve.hpp"

namespace edda::dxf_curves_test {
namespace {

using namespace test;
using std::numbers::pi;

std::string arc(const std::string& from, const std::string& to, const std::string& up = "1") {
  return entity("ARC", {{8, "J"},
                        {10, "3"},
                        {20, "-2"},
                        {40, "2.5"},
                        {210, "0"},
                        {220, "0"},
                        {230, up},
                        {50, from},
                        {51, to}});
}

TEST(DxfCurves, ArcsLieOnTheirCircle) {
  const std::vector<Vec2> points = only_line(read_dxf(arc("350", "80")));
  ASSERT_EQ(points.size(), 13U);  // a quarter of 48 pieces
  const Vec2 centre{3, -2};
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double angle = (-10.0 + 7.5 * static_cast<double>(i)) * pi / 180.0;
    expect_near(points[i], centre + 2.5 * Vec2{std::cos(angle), std::sin(angle)}, 1e-14);
    if (i == 0) continue;
    const double sagitta = 2.5 - norm(0.5 * (points[i] + points[i - 1]) - centre);
    EXPECT_NEAR(sagitta, 2.5 * (1.0 - std::cos(3.75 * pi / 180.0)), 1e-14);
  }
}

TEST(DxfCurves, ArcsEndExactlyAtRightAngles) {
  const std::vector<Vec2> points = only_line(read_dxf(arc("90", "-180")));
  EXPECT_EQ(points.front(), (Vec2{3, 0.5}));
  EXPECT_EQ(points.back(), (Vec2{0.5, -2}));
  EXPECT_EQ(points.size(), 13U);
  EXPECT_EQ(only_line(read_dxf(arc("80", "60"))).size(), 1U + 46U);
}

TEST(DxfCurves, CirclesAreClosed) {
  const std::string circle = entity("CIRCLE", {{10, "1"}, {20, "2"}, {40, "0.5"}});
  for (const std::string& text : {circle, arc("0", "360"), arc("45", "45"), arc("10", "370")}) {
    const std::vector<Vec2> points = only_line(read_dxf(text));
    ASSERT_EQ(points.size(), 49U);
    EXPECT_EQ(points.front(), points.back());
    const double radius = text == circle ? 0.5 : 2.5;
    const Ring ring(points.begin(), points.end() - 1);
    EXPECT_NEAR(signed_area(ring), 24.0 * radius * radius * std::sin(pi / 24.0), 1e-13);
  }
}

/// What is drawn from below has its x mirrored, arcs and circles as the bulges of polylines; lines,
/// ellipses and splines are in coordinates of the drawing.
TEST(DxfCurves, DrawnFromBelow) {
  const std::vector<Vec2> points = only_line(read_dxf(arc("0", "90", "-1")));
  EXPECT_EQ(points.front(), (Vec2{-5.5, -2}));
  EXPECT_EQ(points.back(), (Vec2{-3, 0.5}));
  const std::vector<Vec2> same =
      only_line(read_dxf(entity("LWPOLYLINE", {{10, "5.5"},
                                               {20, "-2"},
                                               {42, "0.41421356"},  // tan(90 degrees / 4)
                                               {10, "3"},
                                               {20, "0.5"},
                                               {230, "-1"}})));
  ASSERT_EQ(points.size(), same.size());
  for (std::size_t i = 0; i < same.size(); ++i) expect_near(points[i], same[i], 1e-5);
  const DxfPairs end = {{10, "1"}, {20, "2"}, {11, "3"}, {21, "2"}, {230, "-1"}, {40, "0.25"}};
  EXPECT_EQ(only_line(read_dxf(entity("LINE", end))), (std::vector<Vec2>{{1, 2}, {3, 2}}));
  EXPECT_EQ(only_line(read_dxf(entity("CIRCLE", end)))[0], (Vec2{-1.25, 2}));
  const std::vector<Vec2> ellipse = only_line(read_dxf(
      entity("ELLIPSE", {{10, "1"}, {20, "2"}, {11, "2"}, {21, "0"}, {40, "0.25"}, {230, "-1"}}) +
      groups({{41, "0"}, {42, "1.5707963267948966"}})));
  EXPECT_EQ(ellipse.front(), (Vec2{3, 2}));
  expect_near(ellipse.back(), {1, 1.5}, 1e-15);
  expect_near(ellipse[6], Vec2{1, 2} + std::sqrt(0.5) * Vec2{2, -0.5}, 1e-14);
  const std::string in_space =
      entity("POLYLINE", {{70, "8"}, {230, "-1"}}) + entity("VERTEX", {{10, "1"}, {20, "2"}}) +
      entity("VERTEX", {{10, "3"}, {20, "4"}, {30, "5"}}) + entity("SEQEND", {});
  EXPECT_EQ(only_line(read_dxf(in_space)), (std::vector<Vec2>{{1, 2}, {3, 4}}));
}

TEST(DxfCurves, EllipsesByTheirParameter) {
  const DxfPairs ellipse = {{8, "J"}, {10, "1"}, {20, "-1"}, {11, "3"}, {21, "4"}, {40, "0.4"}};
  const DxfPairs part = {{41, "0.3"}, {42, "2.5"}};
  const std::vector<Vec2> points = only_line(read_dxf(entity("ELLIPSE", ellipse) + groups(part)));
  ASSERT_EQ(points.size(), 18U);  // 2.2 of 2 pi, of which 48 pieces are a full turn
  for (std::size_t i = 0; i < points.size(); ++i) {
    const double t = 0.3 + 2.2 * static_cast<double>(i) / 17.0;
    const Vec2 on{1.0 + 3.0 * std::cos(t) - 1.6 * std::sin(t),
                  -1.0 + 4.0 * std::cos(t) + 1.2 * std::sin(t)};
    expect_near(points[i], on, 1e-14);
  }
  for (const DxfPairs& whole : {DxfPairs{}, DxfPairs{{41, "0"}, {42, "6.283185"}},
                                DxfPairs{{41, "-1"}, {42, "5.283185307179586"}}}) {
    const std::vector<Vec2> all = only_line(read_dxf(entity("ELLIPSE", ellipse) + groups(whole)));
    ASSERT_EQ(all.size(), 49U);
    EXPECT_EQ(all.front(), all.back());
    const Ring ring(all.begin(), all.end() - 1);
    EXPECT_NEAR(signed_area(ring), 24.0 * 10.0 * std::sin(pi / 24.0), 1e-12);
  }
}

std::string spline(int degree, const std::vector<double>& knots, const std::vector<Vec2>& points,
                   const std::vector<double>& weights = {}, const std::string& flags = "8") {
  const auto text = [](double value) {
    std::string digits(40, ' ');
    digits.resize(
        static_cast<std::size_t>(std::snprintf(digits.data(), digits.size(), "%.17g", value)));
    return digits;
  };
  DxfPairs pairs = {{8, "J"}, {70, flags}, {71, std::to_string(degree)}, {42, "1e-7"}};
  for (const double u : knots) pairs.emplace_back(40, text(u));
  for (const double w : weights) pairs.emplace_back(41, text(w));
  for (const Vec2 p : points) {
    pairs.insert(pairs.end(), {{10, text(p.x)}, {20, text(p.y)}, {30, "7"}});
  }
  return entity("SPLINE", pairs);
}

const double half = std::sqrt(0.5);

TEST(DxfCurves, ARationalSplineIsAnExactCircle) {
  const std::vector<Vec2> quarter =
      only_line(read_dxf(spline(2, {0, 0, 0, 1, 1, 1}, {{1, 0}, {1, 1}, {0, 1}}, {1, half, 1})));
  EXPECT_EQ(quarter.front(), (Vec2{1, 0}));
  EXPECT_EQ(quarter.back(), (Vec2{0, 1}));
  for (std::size_t i = 1; i < quarter.size(); ++i) {
    EXPECT_NEAR(norm(quarter[i]), 1.0, 1e-15);
    EXPECT_GT(cross(quarter[i - 1], quarter[i]), 0.0);
    EXPECT_LE(1.0 - norm(0.5 * (quarter[i] + quarter[i - 1])), std::sqrt(2.0) / 2000.0);
  }
  EXPECT_EQ(quarter.size(), 33U);
  const std::vector<Vec2> circle = only_line(read_dxf(
      spline(2, {0, 0, 0, 1, 1, 2, 2, 3, 3, 4, 4, 4},
             {{1, 0}, {1, 1}, {0, 1}, {-1, 1}, {-1, 0}, {-1, -1}, {0, -1}, {1, -1}, {1, 0}},
             {1, half, 1, half, 1, half, 1, half, 1}, "13")));
  EXPECT_EQ(circle.front(), circle.back());
  EXPECT_EQ(circle.size(), 65U);
  for (const Vec2 p : circle) EXPECT_NEAR(norm(p), 1.0, 1e-15);
}

TEST(DxfCurves, SplinesOfKnownPolynomials) {
  const std::vector<Vec2> straight{{0, 0}, {1, 5}, {-2, 3}};
  EXPECT_EQ(only_line(read_dxf(spline(1, {0, 0, 1, 2, 2}, straight))), straight);
  // x = t, y = t^3
  const std::vector<Vec2> cubic = only_line(read_dxf(
      spline(3, {0, 0, 0, 0, 1, 1, 1, 1}, {{0, 0}, {1.0 / 3.0, 0}, {2.0 / 3.0, 0}, {1, 1}})));
  for (const Vec2 p : cubic) EXPECT_NEAR(p.y, p.x * p.x * p.x, 1e-15);
  EXPECT_GT(cubic.size(), 8U);
  EXPECT_LT(cubic.size(), 40U);
}

/// A closed one, as drawings have them: its first points are there again at its end.
TEST(DxfCurves, PeriodicSplinesClose) {
  const std::vector<Vec2> points{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 0}, {4, 0}, {4, 4}};
  const std::vector<Vec2> curve =
      only_line(read_dxf(spline(3, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, points, {}, "11")));
  EXPECT_EQ(curve.front(), curve.back());
  for (std::size_t i = 0; i < 4; ++i) {  // at a knot (P0 + 4 P1 + P2)/6
    const Vec2 at_knot = (points[i] + 4.0 * points[i + 1] + points[i + 2]) / 6.0;
    EXPECT_TRUE(
        std::any_of(curve.begin(), curve.end(), [&](Vec2 p) { return norm(p - at_knot) < 1e-14; }));
  }
  std::vector<Vec2> open = points;
  open[6] = {9, 9};
  const Drawing d = read_dxf(spline(3, {-3, -2, -1, 0, 1, 2, 3, 4, 5, 6, 7}, open, {}, "11"));
  EXPECT_EQ(d.skipped.at("SPLINE said to be closed that is open"), 1);
}

/// The basis function of a B-spline by its definition.
double basis(const std::vector<double>& u, std::size_t i, int degree, double t) {
  if (degree == 0) return u[i] <= t && t < u[i + 1] ? 1.0 : 0.0;
  const auto d = static_cast<std::size_t>(degree);
  const double before = u[i + d] - u[i], after = u[i + d + 1] - u[i + 1];
  return (before > 0.0 ? (t - u[i]) / before * basis(u, i, degree - 1, t) : 0.0) +
         (after > 0.0 ? (u[i + d + 1] - t) / after * basis(u, i + 1, degree - 1, t) : 0.0);
}

Vec2 point_at(const SplineCurve& curve, double t) {
  Vec2 sum;
  double weight = 0.0;
  for (std::size_t i = 0; i < curve.points.size(); ++i) {
    const double n = curve.weights[i] * basis(curve.knots, i, curve.degree, t);
    sum += n * curve.points[i];
    weight += n;
  }
  return sum / weight;
}

double distance(const std::vector<Vec2>& line, Vec2 p) {
  double least = 1e300;
  for (std::size_t i = 1; i < line.size(); ++i) {
    least = std::min(least, distance_to_segment(p, line[i - 1], line[i]));
  }
  return least;
}

TEST(DxfCurves, SplinesKeepTheirDistance) {
  std::mt19937 random(5);
  const auto number = [&] { return std::uniform_real_distribution(0.0, 1.0)(random); };
  for (int round = 0; round < 60; ++round) {
    SplineCurve curve;
    curve.degree = 1 + round % 5;
    const std::size_t count = static_cast<std::size_t>(curve.degree) + 1 + random() % 6;
    double u = number();
    int repeated = 1;
    for (std::size_t i = 0; i < count + static_cast<std::size_t>(curve.degree) + 1; ++i) {
      const bool again = repeated < curve.degree && random() % 3 == 0;
      repeated = again ? repeated + 1 : 1;
      u += again ? 0.0 : number();
      curve.knots.push_back(u);
    }
    for (std::size_t i = 0; i < count; ++i) {
      curve.points.push_back({100.0 * number(), number()});
      curve.weights.push_back(std::pow(10.0, 4.0 * number() - 2.0));
    }
    const double first = curve.knots[static_cast<std::size_t>(curve.degree)];
    const double last = curve.knots[count];
    if (first == last) continue;
    const std::vector<Vec2> line = spline_points(curve);
    const double tolerance = curve.size() / 2000.0;
    for (int i = 0; i < 200; ++i) {
      const Vec2 p = point_at(curve, first + (last - first) * i / 200.0);
      ASSERT_LE(distance(line, p), tolerance * (1.0 + 1e-9)) << round;
    }
    expect_near(line.front(), point_at(curve, first), 1e-10);
    expect_near(line.back(), point_at(curve, last - 1e-13 * (last - first)), 1e-6);
    EXPECT_LT(line.size(), 800U) << round;
  }
}

TEST(DxfCurves, WhatIsNotDrawnIsCounted) {
  const auto left_out = [](const std::string& text, const std::string& kind) {
    const Drawing d = read_dxf(text);
    EXPECT_TRUE(d.lines.empty()) << kind;
    EXPECT_TRUE(d.skipped.contains(kind)) << kind << ", not " << d.skipped.begin()->first;
  };
  const std::vector<Vec2> three{{0, 0}, {1, 1}, {2, 0}};
  left_out(entity("SPLINE", {{71, "3"}, {74, "2"}, {11, "0"}, {21, "0"}, {11, "1"}, {21, "1"}}),
           "SPLINE without control points");
  left_out(spline(12, {}, three), "SPLINE of unusual degree");
  left_out(spline(0, {}, three), "SPLINE of unusual degree");
  left_out(spline(2, {0, 0, 0, 1, 1, 1}, three, {1, 0, 1}), "SPLINE of weights not above 0");
  left_out(spline(2, {0, 0, 0, 1, 1, 1}, three, {1, -1, 1}), "SPLINE of weights not above 0");
  left_out(spline(2, {0, 0, 0, 1, 1, 1}, three, {1, 1e-12, 1}), "SPLINE of weights not above 0");
  left_out(spline(2, {0, 0, 0, 1, 1, 1}, three) + groups({{220, "1"}}), "SPLINE across the plane");
  left_out(arc("0", "90") + groups({{67, "1"}}), "ARC on paper");
  left_out(arc("0", "90") + groups({{60, "1"}}), "hidden ARC");
  left_out(entity("ARC",
                  {{10, "1"}, {20, "1"}, {40, "2"}, {50, "0"}, {51, "9"}, {210, "1"}, {230, "0"}}),
           "ARC across the plane");
  left_out(spline(1, {0, 0, 1, 1, 2, 2}, {{0, 0}, {1, 1}, {2, 2}, {3, 3}}),
           "SPLINE that is interrupted");
  left_out(entity("CIRCLE", {{10, "1"}, {20, "1"}, {40, "0"}}), "CIRCLE of no radius");
  left_out(entity("ARC", {{10, "1"}, {20, "1"}, {40, "-2"}, {50, "0"}, {51, "9"}}),
           "ARC of no radius");
  left_out(entity("ELLIPSE", {{10, "1"}, {20, "1"}, {11, "1"}, {21, "0"}, {40, "0"}}),
           "ELLIPSE of no width");
}

TEST(DxfCurves, BadOnesAreLeftOut) {
  const auto fault = [](const std::string& text, int line, const std::string& fragment) {
    expect_left_out(parse_dxf(dxf(text), "a.dxf"), line, fragment);
  };
  fault(entity("ARC", {{10, "1"}, {20, "1"}, {50, "0"}, {51, "9"}}), 5, "ARC lacks group 40");
  fault(entity("ARC", {{10, "1"}, {20, "1"}, {40, "1"}, {50, "0"}}), 5, "ARC lacks group 51");
  fault(entity("ARC", {{10, "1"}, {20, "1"}, {40, "1"}, {50, "inf"}}), 14, "\"inf\" is not a");
  fault(entity("CIRCLE", {{10, "1"}, {40, "nan"}}), 5, "CIRCLE lacks group 20");
  fault(entity("CIRCLE", {{10, "1"}, {20, "1"}, {40, "nan"}}), 12, "\"nan\" is not a length");
  fault(entity("ELLIPSE", {{10, "1"}, {20, "1"}, {11, "1"}, {21, "0"}}), 5, "lacks group 40");
  const std::vector<Vec2> three{{0, 0}, {1, 1}, {2, 0}};
  fault(entity("SPLINE", {{10, "1"}, {20, "1"}}), 5, "SPLINE lacks group 71");
  fault(spline(3, {0, 0, 0, 1, 1, 1, 1}, three), 5, "fewer control points");
  fault(spline(2, {0, 0, 0, 1, 1}, three), 5, "SPLINE has 5 knots, but 6 belong");
  fault(spline(2, {0, 0, 0, 1, 1, 1}, three, {1, 1}), 5, "2 weights for 3 control points");
  fault(spline(2, {0, 0, 1, 0, 1, 1}, three), 5, "the knots of SPLINE decrease");
  fault(spline(2, {1, 1, 1, 1, 1, 1}, three), 5, "the knots of SPLINE are all one");
  fault(spline(2, {0, 0, 0, 1, 1, std::nan("")}, three), 26, "\"nan\" is not a number");
  fault(entity("SPLINE", {{71, "1"}, {10, "1"}, {10, "1"}}), 5, "lacks group 20");
  fault(entity("SPLINE", {{71, "1"}, {20, "1"}}), 9, "does not begin with group 10");
  fault(entity("SPLINE", {{71, "99999999999"}}), 8, "is not a whole number");
}

}  // namespace
}  // namespace edda::dxf_curves_test
