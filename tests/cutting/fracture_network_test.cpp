// Fracture networks: density, lengths, directions and crossings against what they are known to be.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "base/rings.hpp"
#include "cutting/checks.hpp"
#include "cutting/length_inside.hpp"
#include "cutting/line_models.hpp"
#include "cutting/random_lines.hpp"

namespace edda::fracture_network_test {
namespace {

using namespace test;

constexpr double snap = 1e-8;

FractureNetwork network(double p21, double angle, LengthSpread length, long long seed) {
  FractureNetwork n;
  n.p21 = p21;
  n.angle = {angle, 0.0, Spread::normal};
  n.length = length;
  n.seed = seed;
  n.where = {"fracture_network.0", "test.toml", 5, 1};
  return n;
}

LengthSpread constant(double mean) {
  LengthSpread s;
  s.distribution = LengthKind::constant;
  s.mean = mean;
  return s;
}

LineWork square(double side) {
  LineWork work;
  work.outline = box(0, 0, side, side);
  return work;
}

LineWork drawn_network(const FractureNetwork& n, LineWork work) {
  const Faults faults = add_network(work, n, 0, {0, 0}, snap, 1e6);
  EXPECT_TRUE(faults.empty()) << (faults.empty() ? "" : to_string(faults[0]));
  return work;
}

TEST(FractureNetwork, ReachesItsDensityInsideToHalfAFracture) {
  const Ring ell = {{0, 0}, {30, 0}, {30, 10}, {12, 10}, {12, 30}, {0, 30}};
  for (long long seed = 0; seed < 5; ++seed) {
    LineWork work;
    work.outline = ell;
    work = drawn_network(network(1.5, 35.0, constant(4.0), seed), work);
    const double area = signed_area(ell);
    EXPECT_NEAR(length_inside(work, ell, snap), 1.5 * area, 2.0 + 1e-9);
    ASSERT_EQ(work.notes.size(), 1U);
    EXPECT_NE(work.notes[0].find("m of them per m2"), std::string::npos);
  }
}

/// The edge of the domain sees as many as its middle: both have p21 of their own, over many seeds.
TEST(FractureNetwork, IsAsDenseAtTheEdgeAsInTheMiddle) {
  double edge = 0.0, middle = 0.0;
  constexpr int seeds = 60;
  for (long long seed = 0; seed < seeds; ++seed) {
    FractureNetwork n = network(1.0, 0.0, constant(6.0), seed);
    n.angle = {0.0, 90.0, Spread::uniform};
    const LineWork work = drawn_network(n, square(20.0));
    edge += length_inside(work, box(0, 0, 20, 1), snap) / 20.0 / seeds;
    middle += length_inside(work, box(0, 9.5, 20, 10.5), snap) / 20.0 / seeds;
  }
  EXPECT_NEAR(edge, 1.0, 0.05);
  EXPECT_NEAR(middle, 1.0, 0.05);
}

/// Crossings per area of two independent networks: P21 P21' |sin of the angle between them|.
TEST(FractureNetwork, TwoNetworksCrossAsOftenAsTheyShould) {
  double crossings = 0.0;
  constexpr int seeds = 20;
  for (long long seed = 0; seed < seeds; ++seed) {
    const LineWork a = drawn_network(network(1.2, 10.0, constant(3.0), seed), square(25.0));
    const LineWork b = drawn_network(network(0.8, 70.0, constant(5.0), 1000 + seed), square(25.0));
    for (const LineString& p : a.lines) {
      for (const LineString& q : b.lines) {
        const Vec2 u = p.points[1] - p.points[0], v = q.points[1] - q.points[0];
        const double s = cross(q.points[0] - p.points[0], v) / cross(u, v);
        const double t = cross(q.points[0] - p.points[0], u) / cross(u, v);
        if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) continue;
        const Vec2 x = p.points[0] + s * u;
        crossings += std::min(x.x, x.y) >= 0.0 && std::max(x.x, x.y) <= 25.0;
      }
    }
  }
  const double expected = 1.2 * 0.8 * std::sin(std::numbers::pi / 3.0);
  EXPECT_NEAR(crossings / seeds / 625.0, expected, 0.03 * expected);
}

/// Lengths and directions of the fractures that lie well inside a large domain.
struct Sample {
  std::vector<double> length, angle;
};

Sample sample_of(const FractureNetwork& n, double side, double rim) {
  Sample sample;
  for (const LineString& line : drawn_network(n, square(side)).lines) {
    const Vec2 middle = 0.5 * (line.points[0] + line.points[1]),
               d = line.points[1] - line.points[0];
    if (std::min({middle.x, middle.y, side - middle.x, side - middle.y}) < rim) continue;
    sample.length.push_back(norm(d));
    sample.angle.push_back(std::atan2(d.y, d.x) * 180.0 / std::numbers::pi);
  }
  return sample;
}

std::pair<double, double> mean_and_deviation(const std::vector<double>& values) {
  double sum = 0.0, squares = 0.0;
  for (const double v : values) sum += v;
  const double n = static_cast<double>(values.size()), mean = sum / n;
  for (const double v : values) squares += (v - mean) * (v - mean);
  return {mean, std::sqrt(squares / n)};
}

TEST(FractureNetwork, LognormalLengthsHaveTheirMeanAndDeviation) {
  LengthSpread spread;
  spread.mean = 3.0;
  spread.deviation = 1.0;
  FractureNetwork n = network(1.0, 60.0, spread, 9);
  n.angle.deviation = 5.0;
  const Sample sample = sample_of(n, 200.0, 8.0);
  ASSERT_GT(sample.length.size(), 9000U);
  const auto [mean, deviation] = mean_and_deviation(sample.length);
  EXPECT_NEAR(mean, 3.0, 0.04);
  EXPECT_NEAR(deviation, 1.0, 0.04);
  const auto [angle, spread_of_angle] = mean_and_deviation(sample.angle);
  EXPECT_NEAR(angle, 60.0, 0.2);
  EXPECT_NEAR(spread_of_angle, 5.0, 0.15);
}

/// Of lengths with density ~ l^-a from 1 to 10 the part above x is (x^b - 10^b)/(1 - 10^b), b = 1 -
/// a; for a = 1 it is 1 - log10 x.
TEST(FractureNetwork, PowerLawLengthsFallAsTheyShould) {
  for (const double exponent : {1.0, 2.5}) {
    LengthSpread spread;
    spread.distribution = LengthKind::power;
    spread.exponent = exponent;
    spread.min = 1.0;
    spread.max = 10.0;
    const Sample sample = sample_of(network(1.0, 20.0, spread, 4), 150.0, 6.0);
    const double n = static_cast<double>(sample.length.size());
    ASSERT_GT(n, 3000.0);
    for (const double x : {1.5, 2.0, 4.0, 8.0}) {
      const double above = static_cast<double>(std::count_if(
          sample.length.begin(), sample.length.end(), [&](double l) { return l > x; }));
      const double b = 1.0 - exponent, most = std::pow(10.0, b);
      const double expected =
          exponent == 1.0 ? 1.0 - std::log10(x) : (std::pow(x, b) - most) / (1.0 - most);
      EXPECT_NEAR(above / n, expected, 0.025) << exponent << ' ' << x;
    }
  }
}

TEST(FractureNetwork, CountIsOfFracturesThatShow) {
  FractureNetwork n = network(1.0, 45.0, constant(5.0), 2);
  n.p21.reset();
  n.count = 77;
  const LineWork work = drawn_network(n, square(10.0));
  EXPECT_EQ(work.lines.size(), 77U);
  for (const LineString& line : work.lines) {
    LineWork one;
    one.lines = {line};
    EXPECT_GT(length_inside(one, box(0, 0, 10, 10), snap), snap);
  }
}

TEST(FractureNetwork, StaysInItsRegion) {
  FractureNetwork n = network(2.0, 45.0, constant(5.0), 2);
  n.region = {{2, 2}, {8, 2}, {5, 30}};
  const LineWork work = drawn_network(n, square(20.0));
  const Ring inside = {{2, 2}, {8, 2}, {5 + 3.0 * 10 / 28, 20}, {5 - 3.0 * 10 / 28, 20}};
  EXPECT_NEAR(length_inside(work, n.region, snap), 2.0 * signed_area(inside), 5.0);
  for (const LineString& line : work.lines) {
    EXPECT_GE(side_of({&n.region, 1}, 0.5 * (line.points[0] + line.points[1]), 1e-6), 0);
  }
}

TEST(FractureNetwork, WhatCannotBeDrawnIsRefused) {
  LineWork work = square(10.0);
  const auto refused = [&](const FractureNetwork& n, double limit) {
    LineWork copy = work;
    const Faults faults = add_network(copy, n, 0, {0, 0}, snap, limit);
    return faults.size() == 1 ? to_string(faults[0]) : std::string();
  };
  EXPECT_NE(refused(network(5.0, 0.0, constant(1.0), 0), 50).find("max_blocks"), std::string::npos);
  FractureNetwork outside = network(1.0, 0.0, constant(1.0), 0);
  outside.region = box(20, 20, 30, 30);
  EXPECT_NE(refused(outside, 1e6).find("wholly outside"), std::string::npos);
}

TEST(FractureNetwork, CutsSoundBlocks) {
  for (long long seed = 0; seed < 6; ++seed) {
    Model model = domain_model(box(0, 0, 30, 20), 3e-8);
    LengthSpread spread;
    spread.mean = 12.0;
    spread.deviation = 4.0;
    for (const double angle : {15.0, 100.0}) {
      model.networks.push_back(network(0.7, angle, spread, seed));
      model.networks.back().angle.deviation = 10.0;
      model.networks.back().joint = angle > 90.0 ? 1 : 0;
    }
    const auto result = build_polygons(model);
    expect_sound(result, 3e-8);
    ASSERT_TRUE(result.ok());
    EXPECT_GT(result.value().blocks.size(), 40U);
    EXPECT_EQ(result.value().report.notes.size(), 2U);
    EXPECT_GT(length_by_law(result.value().blocks).at(1), 10.0);
  }
}

}  // namespace
}  // namespace edda::fracture_network_test
