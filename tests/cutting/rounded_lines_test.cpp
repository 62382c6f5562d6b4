// Coordinates that were rounded before they came into a file: the blocks are those of the lines as
// they were.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <fstream>
#include <random>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"
#include "scratch_folder.hpp"

namespace edda::rounded_lines_test {
namespace {

using namespace test;

using Segments = std::vector<std::pair<Vec2, Vec2>>;

/// Where the ray p + t d meets the segment, t > 0; negative where it does not.
double meeting(Vec2 p, Vec2 d, Vec2 a, Vec2 b) {
  const double sine = cross(d, b - a);
  if (std::abs(sine) < 1e-3 * norm(b - a)) return -1.0;
  const double t = cross(a - p, b - a) / sine, s = cross(a - p, d) / sine;
  return s < 0.0 || s > 1.0 ? -1.0 : t;
}

/// A trace from a point of one line to the first, second or third line that it meets.
std::pair<Vec2, Vec2> grown_trace(const Segments& there, std::mt19937& random) {
  std::uniform_real_distribution<double> part(0.0, 1.0);
  const auto& [a, b] = there[random() % there.size()];
  const Vec2 p = a + part(random) * (b - a);
  const Vec2 d = rotated({1.0, 0.0}, 2.0 * std::numbers::pi * part(random));
  std::vector<double> meets;
  for (const auto& [from, to] : there) {
    const double t = meeting(p, d, from, to);
    if (t > 1e-6) meets.push_back(t);
  }
  std::sort(meets.begin(), meets.end());
  if (meets.empty()) return {p, p};
  return {p, p + meets[std::min<std::size_t>(random() % 3, meets.size() - 1)] * d};
}

Model model_of(const Segments& traces) {
  Model model = domain_model(box(0, 0, 10, 10), 1e-8);
  model.domain->given_outline = model.domain->outline;
  for (const auto& [a, b] : traces) add_trace(model, {a, b});
  return model;
}

double thinnest(const PolygonSet& set) {
  double least = 1e9;
  for (const BlockPolygon& block : set.blocks) {
    double perimeter = 0.0;
    const Ring& ring = block.rings[0];
    for (std::size_t i = 0; i < ring.size(); ++i) {
      perimeter += norm(ring[(i + 1) % ring.size()] - ring[i]);
    }
    least = std::min(least, 2.0 * moments(block.rings).area / perimeter);
  }
  return least;
}

/// Traces that bound blocks, none of which is so thin that rounding to two digits could close it.
Segments random_traces(unsigned seed) {
  std::mt19937 random(seed);
  Segments there = {{{0, 0}, {10, 0}}, {{10, 0}, {10, 10}}, {{10, 10}, {0, 10}}, {{0, 10}, {0, 0}}};
  Segments traces;
  for (int i = 0; i < 40; ++i) {
    const auto trace = grown_trace(there, random);
    if (norm(trace.second - trace.first) < 0.3) continue;
    Segments more = traces;
    more.push_back(trace);
    const auto cut = build_polygons(model_of(more));
    if (!cut.ok() || thinnest(cut.value()) < 0.06) continue;
    traces = more;
    there.push_back(trace);
  }
  return traces;
}

Segments rounded(Segments traces, int digits) {
  const double unit = std::pow(10.0, digits);
  for (auto& [a, b] : traces) {
    for (Vec2* p : {&a, &b}) *p = {std::round(p->x * unit) / unit, std::round(p->y * unit) / unit};
  }
  return traces;
}

/// Each block of one lies where a block of the other does.
void expect_same_blocks(const PolygonSet& a, const PolygonSet& b, double tolerance) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  std::vector<bool> taken(b.blocks.size(), false);
  for (const BlockPolygon& block : a.blocks) {
    const Moments m = moments(block.rings);
    std::size_t found = b.blocks.size();
    for (std::size_t j = 0; j < b.blocks.size(); ++j) {
      const Moments n = moments(b.blocks[j].rings);
      if (!taken[j] && norm(m.centroid + a.origin - n.centroid - b.origin) < 8.0 * tolerance &&
          std::abs(m.area - n.area) < 40.0 * tolerance) {
        found = j;
      }
    }
    ASSERT_LT(found, b.blocks.size()) << "no block at " << m.centroid.x << ", " << m.centroid.y;
    taken[found] = true;
  }
}

TEST(RoundedLines, CutTheBlocksOfTheLinesAsTheyWere) {
  std::size_t blocks = 0;
  for (unsigned seed = 0; seed < 25; ++seed) {
    const Segments traces = random_traces(seed);
    const auto whole = build_polygons(model_of(traces));
    ASSERT_TRUE(whole.ok());
    blocks += whole.value().blocks.size();
    for (int digits = 2; digits <= 6; ++digits) {
      SCOPED_TRACE(std::to_string(seed) + ", digits " + std::to_string(digits));
      const auto cut = build_polygons(model_of(rounded(traces, digits)));
      expect_sound(cut, 1e-8);
      ASSERT_TRUE(cut.ok());
      expect_same_blocks(whole.value(), cut.value(), std::pow(10.0, -digits));
      EXPECT_EQ(cut.value().report.dangling, 0);
    }
  }
  EXPECT_GT(blocks, 300U);
}

/// The same through a table, in millimetres, far from the origin.
TEST(RoundedLines, OfTablesInAnyUnit) {
  const ScratchFolder folder;
  for (unsigned seed = 100; seed < 106; ++seed) {
    const Segments traces = random_traces(seed);
    const auto whole = build_polygons(model_of(traces));
    ASSERT_TRUE(whole.ok());
    for (int digits = 2; digits <= 6; ++digits) {
      SCOPED_TRACE(std::to_string(seed) + ", digits " + std::to_string(digits));
      const std::string path = (folder.path() / "t.csv").string();
      std::ofstream file(path);
      for (const auto& [a, b] : rounded(traces, digits)) {
        char row[200];
        std::snprintf(row, sizeof row, "%.*f,%.*f,%.*f,%.*f\n", std::max(digits - 3, 0), 1e3 * a.x,
                      std::max(digits - 3, 0), 1e3 * (a.y + 50.0), std::max(digits - 3, 0),
                      1e3 * b.x, std::max(digits - 3, 0), 1e3 * (b.y + 50.0));
        file << row;
      }
      file.close();
      Model model = model_of({});
      Import import;
      import.file = path;
      import.units = LengthUnit::mm;
      import.shift = {0, -50};
      import.where = {"import.0", "test.toml", 5, 1};
      model.imports.push_back(import);
      const auto cut = build_polygons(model);
      ASSERT_TRUE(cut.ok());
      expect_same_blocks(whole.value(), cut.value(), std::pow(10.0, -digits));
      import.snap = 1.5 * std::pow(10.0, -digits);
      model.imports[0] = import;
      const auto snapped = build_polygons(model);
      ASSERT_TRUE(snapped.ok());
      EXPECT_EQ(snapped.value().blocks.size(), whole.value().blocks.size());
    }
  }
}

/// A fault and three joints that end on it, to 1 mm.
TEST(RoundedLines, JointsOnAFault) {
  const Model model = model_of({{{0, 3.333}, {10, 6.667}},
                                {{2.5, 4.167}, {2.5, 10}},
                                {{5.1, 5.033}, {5.1, 10}},
                                {{7.7, 5.9}, {7.7, 10}}});
  const auto cut = build_polygons(model);
  ASSERT_TRUE(cut.ok());
  EXPECT_EQ(cut.value().blocks.size(), 5U);
  ASSERT_EQ(cut.value().report.notes.size(), 1U);
  EXPECT_NE(cut.value().report.notes[0].find("trace: 3 corners moved by up to 0.00"),
            std::string::npos);
  EXPECT_TRUE(cut.value().report.warnings.empty());
}

/// Strips one unit of the last digit wide are what they are: nothing that was on one line is so far
/// apart after rounding.
TEST(RoundedLines, LinesAUnitApartStayApart) {
  const auto cut = build_polygons(model_of({{{0, 5.0}, {10, 5.0}}, {{0, 5.01}, {10, 5.01}}}));
  ASSERT_TRUE(cut.ok());
  EXPECT_EQ(cut.value().blocks.size(), 3U);
}

/// A circle whose pieces are shorter than a unit of the last digit keeps its corners.
TEST(RoundedLines, SmallCurvesStay) {
  Model model = model_of({{{0, 5.01}, {10, 5.01}}});
  std::vector<Vec2> circle;
  for (int i = 0; i < 48; ++i)
    circle.push_back(Vec2{3, 3} + rotated({0.05, 0.0}, i * std::numbers::pi / 24.0));
  circle.push_back(circle.front());
  for (Vec2& p : circle) p = {std::round(p.x * 1e3) / 1e3, std::round(p.y * 1e3) / 1e3};
  add_trace(model, circle);
  const auto cut = build_polygons(model);
  ASSERT_TRUE(cut.ok());
  ASSERT_EQ(cut.value().blocks.size(), 3U);
  EXPECT_NEAR(moments(cut.value().blocks[1].rings).area, std::numbers::pi * 0.05 * 0.05, 1e-4);
}

TEST(RoundedLines, EndsThatNearlyReachALineAreNamed) {
  const auto cut = build_polygons(model_of({{{0, 5.0001}, {10, 5.0001}},
                                            {{3.0, 5.0042}, {3.0, 10.0}},
                                            {{4.0, 5.0085}, {4.0, 10.0}},
                                            {{6.0, 5.5}, {6.0, 10.0}},
                                            {{8.0, 4.9}, {8.0, 10.0}}}));
  ASSERT_TRUE(cut.ok());
  EXPECT_EQ(cut.value().blocks.size(), 3U);
  std::string all;
  for (const std::string& warning : cut.value().report.warnings) all += warning + '\n';
  EXPECT_NE(all.find("trace: 2 ends of its lines stop in the rock less than 0.01 m short"),
            std::string::npos)
      << all;
  EXPECT_NE(all.find("misses by 0.0041 m at (3, 5.0042): domain.snap = 0.01 joins them"),
            std::string::npos)
      << all;
  Model model = model_of({{{0, 5.0001}, {10, 5.0001}}, {{3.0, 5.0042}, {3.0, 10.0}}});
  model.domain->snap = 0.01;
  const auto joined = build_polygons(model);
  ASSERT_TRUE(joined.ok());
  EXPECT_EQ(joined.value().blocks.size(), 3U);
}

}  // namespace
}  // namespace edda::rounded_lines_test
