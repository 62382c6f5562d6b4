// Joint sets with traces, gaps and deviations: what is drawn against what was asked for.
#include "cutting/joint_sets.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>

#include "base/rings.hpp"
#include "cutting/checks.hpp"
#include "cutting/length_inside.hpp"
#include "cutting/line_models.hpp"

namespace edda::joint_sets_test {
namespace {

using namespace test;

constexpr double snap = 1e-7;

LineWork square(double side, Vec2 low = {}) {
  LineWork work;
  work.outline = box(low.x, low.y, low.x + side, low.y + side);
  return work;
}

JointSet set_of(double angle, double spacing) {
  JointSet set;
  set.angle = angle;
  set.spacing = set.given_spacing = spacing;
  return set;
}

LineWork drawn_set(const JointSet& set, LineWork work) {
  EXPECT_TRUE(add_joint_set(work, set, 0, {0, 0}, snap, 1e6));
  return work;
}

TEST(JointSets, WithoutDeviationsTracesAndGapsAlternate) {
  JointSet set = set_of(0.0, 1.0);
  set.trace_length = 3.0;
  set.gap = 2.0;
  set.stagger = 0.75;
  const LineWork work = drawn_set(set, square(40.0));
  std::map<double, std::vector<std::pair<double, double>>> rows;
  for (const LineString& line : work.lines) {
    rows[line.points[0].y].emplace_back(line.points[0].x, line.points[1].x);
  }
  EXPECT_EQ(rows.size(), 41U);
  for (auto& [y, traces] : rows) {
    EXPECT_NEAR(y, std::round(y), 1e-12);
    std::sort(traces.begin(), traces.end());
    for (std::size_t i = 0; i < traces.size(); ++i) {
      const bool whole = traces[i].first > 0.0 && traces[i].second < 40.0;
      if (whole) {
        EXPECT_NEAR(traces[i].second - traces[i].first, 3.0, 1e-12);
      }
      if (i > 0) {
        EXPECT_NEAR(traces[i].first - traces[i - 1].second, 2.0, 1e-12);
      }
    }
    // One begins at the origin, on each joint that much later.
    const double phase = std::fmod(traces[1].first - 0.75 * y + 100.0, 5.0);
    EXPECT_NEAR(std::min(phase, 5.0 - phase), 0.0, 1e-9);
  }
}

/// The part of the length that is joint is L/(L + g), whatever the deviations.
TEST(JointSets, LengthPerAreaIsThatOfTheMeans) {
  for (const JointSpread spread :
       {JointSpread::uniform, JointSpread::normal, JointSpread::exponential}) {
    double sum = 0.0;
    for (long long seed = 0; seed < 20; ++seed) {
      JointSet set = set_of(25.0, 1.0);
      set.trace_length = 4.0;
      set.gap = 2.0;
      set.deviation = {4.0, 0.3, 1.0, 0.6, spread};
      set.seed = seed;
      sum += length_inside(drawn_set(set, square(40.0)), box(0, 0, 40, 40), snap);
    }
    const double per_area = sum / 20.0 / 1600.0;
    EXPECT_NEAR(per_area, 4.0 / 6.0, 0.01) << static_cast<int>(spread);
  }
}

TEST(JointSets, DeviationsHaveTheirMeanAndSpread) {
  JointSet set = set_of(30.0, 1.0);
  set.trace_length = 2.0;
  set.gap = 1.0;
  set.deviation = {6.0, 0.0, 0.5, 0.5, JointSpread::uniform};
  const LineWork work = drawn_set(set, square(60.0));
  double angle = 0.0, angle2 = 0.0, length = 0.0, longest = 0.0, shortest = 9.0;
  double n = 0.0;
  for (const LineString& line : work.lines) {
    const Vec2 middle = 0.5 * (line.points[0] + line.points[1]),
               d = line.points[1] - line.points[0];
    if (std::min({middle.x, middle.y, 60.0 - middle.x, 60.0 - middle.y}) < 3.0) continue;
    const double a = std::atan2(d.y, d.x) * 180.0 / std::numbers::pi;
    EXPECT_LE(std::abs(a - 30.0), 6.0 + 1e-9);
    angle += a;
    angle2 += (a - 30.0) * (a - 30.0);
    length += norm(d);
    longest = std::max(longest, norm(d));
    shortest = std::min(shortest, norm(d));
    n += 1.0;
  }
  ASSERT_GT(n, 500.0);
  EXPECT_NEAR(angle / n, 30.0, 0.4);
  EXPECT_NEAR(std::sqrt(angle2 / n), 6.0 / std::sqrt(3.0), 0.2);
  EXPECT_NEAR(length / n, 2.0, 0.03);
  EXPECT_NEAR(longest, 2.5, 0.02);
  EXPECT_NEAR(shortest, 1.5, 0.02);
}

TEST(JointSets, SpacingDeviatesAboutItsMeanAndOneJointPassesTheOrigin) {
  JointSet set = set_of(90.0, 2.0);
  set.origin = {101.0, 7.0};
  set.deviation.spacing = 0.8;
  const LineWork work = drawn_set(set, square(400.0));
  std::vector<double> x;
  for (const LineString& line : work.lines) x.push_back(line.points[0].x);
  std::sort(x.begin(), x.end());
  ASSERT_GT(x.size(), 180U);
  double smallest = 9.0, largest = 0.0;
  for (std::size_t i = 1; i < x.size(); ++i) {
    smallest = std::min(smallest, x[i] - x[i - 1]);
    largest = std::max(largest, x[i] - x[i - 1]);
  }
  EXPECT_NEAR((x.back() - x.front()) / static_cast<double>(x.size() - 1), 2.0, 0.1);
  EXPECT_NEAR(smallest, 1.2, 0.05);
  EXPECT_NEAR(largest, 2.8, 0.05);
  const auto through = std::min_element(x.begin(), x.end(), [](double a, double b) {
    return std::abs(a - 101.0) < std::abs(b - 101.0);
  });
  EXPECT_NEAR(*through, 101.0, 1e-9);
}

TEST(JointSets, ExponentialSpacingsBeginAtTheMeanLessTheDeviation) {
  for (const double deviation : {2.0, 0.5}) {
    JointSet set = set_of(90.0, 2.0);
    set.deviation.spacing = deviation;
    set.deviation.distribution = JointSpread::exponential;
    const LineWork work = drawn_set(set, square(8000.0));
    std::vector<double> x;
    for (const LineString& line : work.lines) x.push_back(line.points[0].x);
    std::sort(x.begin(), x.end());
    ASSERT_GT(x.size(), 3500U);
    const double n = static_cast<double>(x.size() - 1), mean = (x.back() - x.front()) / n;
    double smallest = 9.0, squares = 0.0, wide = 0.0;
    for (std::size_t i = 1; i < x.size(); ++i) {
      const double spacing = x[i] - x[i - 1];
      smallest = std::min(smallest, spacing);
      squares += (spacing - mean) * (spacing - mean);
      wide += spacing > 2.0 ? 1.0 : 0.0;
    }
    EXPECT_NEAR(mean, 2.0, 0.04 * deviation);
    EXPECT_NEAR(std::sqrt(squares / n), deviation, 0.06 * deviation);
    EXPECT_NEAR(smallest, 2.0 - deviation, 0.004);
    EXPECT_NEAR(wide / n, std::exp(-1.0), 0.02);  // of an exponential, above its mean
  }
}

/// Lines that both pictures hold whole, rounded so that they can be compared.
std::vector<std::array<long, 4>> whole_lines(const LineWork& work, double low, double high) {
  std::vector<std::array<long, 4>> lines;
  for (const LineString& line : work.lines) {
    std::array<long, 4> rounded{};
    bool inside = true;
    for (std::size_t k = 0; k < 2; ++k) {
      const Vec2 p = line.points[k];
      inside = inside && std::min(p.x, p.y) > low && std::max(p.x, p.y) < high;
      rounded[2 * k] = std::lround(p.x * 1e6);
      rounded[2 * k + 1] = std::lround(p.y * 1e6);
    }
    if (inside) lines.push_back(rounded);
  }
  std::sort(lines.begin(), lines.end());
  return lines;
}

TEST(JointSets, AreTheSameWhateverTheDomainAndTheOtherSets) {
  JointSet set = set_of(40.0, 1.0);
  set.origin = {3.0, 4.0};
  set.trace_length = 2.0;
  set.gap = 1.0;
  set.deviation = {5.0, 0.4, 0.7, 0.5, JointSpread::normal};
  set.seed = 3;
  const auto small = whole_lines(drawn_set(set, square(12.0)), 0.5, 11.5);
  const auto large = whole_lines(drawn_set(set, square(40.0, {-15.0, -9.0})), 0.5, 11.5);
  EXPECT_GT(small.size(), 10U);
  EXPECT_EQ(small, large);
  LineWork both = square(12.0);
  JointSet other = set_of(100.0, 0.7);
  other.trace_length = 1.0;
  other.gap = 1.0;
  other.deviation.angle = 10.0;
  EXPECT_TRUE(add_joint_set(both, other, 0, {0, 0}, snap, 1e6));
  const std::size_t first = both.lines.size();
  EXPECT_TRUE(add_joint_set(both, set, 1, {0, 0}, snap, 1e6));
  both.lines.erase(both.lines.begin(), both.lines.begin() + static_cast<std::ptrdiff_t>(first));
  EXPECT_EQ(whole_lines(both, 0.5, 11.5), small);
}

TEST(JointSets, SeedAndNameMakeThemOthers) {
  JointSet set = set_of(40.0, 1.0);
  set.trace_length = 2.0;
  set.gap = 1.0;
  set.deviation.trace_length = 0.1;
  const auto first = whole_lines(drawn_set(set, square(20.0)), 0.0, 20.0);
  EXPECT_EQ(first, whole_lines(drawn_set(set, square(20.0)), 0.0, 20.0));
  set.seed = 1;
  EXPECT_NE(first, whole_lines(drawn_set(set, square(20.0)), 0.0, 20.0));
  set.seed = 0;
  set.name = "other";
  EXPECT_NE(first, whole_lines(drawn_set(set, square(20.0)), 0.0, 20.0));
}

TEST(JointSets, FarFromTheirOriginTheyAreDrawnAllTheSame) {
  JointSet set = set_of(20.0, 1.0);
  set.origin = {-3e6, 5e6};
  set.trace_length = 2.0;
  set.gap = 2.0;
  set.deviation = {2.0, 0.2, 0.2, 0.2, JointSpread::uniform};
  const LineWork work = drawn_set(set, square(30.0));
  EXPECT_NEAR(length_inside(work, box(0, 0, 30, 30), snap) / 900.0, 0.5, 0.1);
}

TEST(JointSets, StayInTheirRegion) {
  JointSet set = set_of(10.0, 0.5);
  set.region = {{2, 2}, {15, 3}, {8, 8}, {14, 16}, {3, 15}};
  set.trace_length = 3.0;
  set.gap = 0.5;
  set.deviation = {15.0, 0.2, 1.0, 0.3, JointSpread::uniform};
  const LineWork work = drawn_set(set, square(20.0));
  ASSERT_GT(work.lines.size(), 30U);
  for (const LineString& line : work.lines) {
    for (const Vec2 p : {line.points[0], 0.5 * (line.points[0] + line.points[1]), line.points[1]}) {
      EXPECT_GE(side_of({&set.region, 1}, p, 1e-6), 0);
    }
  }
  const Ring region = set.region;
  EXPECT_NEAR(length_inside(work, region, snap) / signed_area(region), 3.0 / 3.5 / 0.5, 0.35);
}

TEST(JointSets, TooManyAreRefused) {
  LineWork work = square(1000.0);
  JointSet set = set_of(20.0, 0.5);
  EXPECT_FALSE(add_joint_set(work, set, 0, {0, 0}, snap, 100));
  set.deviation.spacing = 0.2;
  EXPECT_FALSE(add_joint_set(work, set, 0, {0, 0}, snap, 100));
  set = set_of(20.0, 20.0);
  set.trace_length = 0.01;
  EXPECT_FALSE(add_joint_set(work, set, 0, {0, 0}, snap, 1000));
}

TEST(JointSets, RandomTracesCutSoundBlocks) {
  for (long long seed = 0; seed < 6; ++seed) {
    Model model = domain_model(box(0, 0, 30, 20), 3e-8);
    for (const double angle : {20.0, 110.0}) {
      JointSet set = set_of(angle, 1.2);
      set.trace_length = 8.0;
      set.gap = 1.0;
      set.deviation = {8.0, 0.4, 3.0, 0.5, JointSpread::uniform};
      set.seed = seed;
      set.where = {"joint_set.0", "test.toml", 9, 1};
      model.joint_sets.push_back(set);
    }
    const auto result = build_polygons(model);
    expect_sound(result, 3e-8);
    ASSERT_TRUE(result.ok());
    EXPECT_GT(result.value().blocks.size(), 100U);
    EXPECT_GT(result.value().report.dangling, 50);
  }
}

}  // namespace
}  // namespace edda::joint_sets_test
