// Line work that is all coincidence, turned so that no coordinate is exact: no block may be lost.
#include <gtest/gtest.h>

#include <numeric>
#include <random>
#include <set>
#include <tuple>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"
#include "cutting/noding.hpp"
#include "cutting/planar_graph.hpp"

namespace edda::degenerate_lines_test {
namespace {

using namespace test;

/// A box split again and again, each trace ending on two edges of the block it splits: `splits` + 1
/// blocks.
Model split_blocks(int splits, unsigned seed) {
  Model model = domain_model(box(0, 0, 10, 10), 1e-8);
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> part(0.2, 0.8);
  std::vector<Ring> blocks = {model.domain->outline};
  for (int s = 0; s < splits; ++s) {
    const auto largest = std::max_element(
        blocks.begin(), blocks.end(),
        [](const Ring& a, const Ring& b) { return signed_area(a) < signed_area(b); });
    const Ring ring = *largest;
    const std::size_t n = ring.size();
    const std::size_t i = random() % n, j = (i + 1 + random() % (n - 1)) % n;
    const auto on_edge = [&](std::size_t e) {
      return ring[e] + part(random) * (ring[(e + 1) % n] - ring[e]);
    };
    const Vec2 p = on_edge(i), q = on_edge(j);
    add_trace(model, {p, q}, s % 3);
    Ring one = {p}, two = {q};
    for (std::size_t k = (i + 1) % n;; k = (k + 1) % n) {
      one.push_back(ring[k]);
      if (k == j) break;
    }
    one.push_back(q);
    for (std::size_t k = (j + 1) % n;; k = (k + 1) % n) {
      two.push_back(ring[k]);
      if (k == i) break;
    }
    two.push_back(p);
    *largest = one;
    blocks.push_back(two);
  }
  return model;
}

TEST(DegenerateLines, TracesEndingOnTracesLoseNoBlockAtAThousandAngles) {
  const Model model = split_blocks(60, 1);
  for (int i = 0; i < 1000; ++i) {
    SCOPED_TRACE(i);
    const auto result = build_polygons(turned(model, 0.36 * i + 0.01));
    expect_sound(result, 1e-8);
    ASSERT_TRUE(result.ok());
    ASSERT_EQ(result.value().blocks.size(), 61u);
    ASSERT_EQ(result.value().report.dangling, 0);
  }
}

TEST(DegenerateLines, TracesEndingOnTracesLoseNoBlockFarAway) {
  for (unsigned seed = 0; seed < 50; ++seed) {
    const Model model = shifted(turned(split_blocks(40, seed), 7.0 * seed), {1e6, -3e5});
    const auto result = build_polygons(model);
    expect_sound(result, 1e-8);
    ASSERT_EQ(result.value().blocks.size(), 41u) << seed;
  }
}

TEST(DegenerateLines, SnapNeverFallsBelowTheDigitsOfTheCoordinates) {
  // At 1e8 m doubles are 1.5e-8 m apart: a snap of 1e-8 m would leave the ends of traces loose.
  for (unsigned seed = 0; seed < 50; ++seed) {
    const auto result = build_polygons(shifted(split_blocks(20, seed), {1e8, -1e8}));
    ASSERT_TRUE(result.ok()) << reason(result);
    EXPECT_EQ(result.value().blocks.size(), 21u) << seed;
    EXPECT_EQ(result.value().report.dangling, 0) << seed;
  }
}

TEST(DegenerateLines, FiftyThroughOnePointMakeAHundredBlocks) {
  Model model = domain_model(box(-5, -5, 5, 5), 1e-8);
  for (int i = 0; i < 50; ++i) {
    const Vec2 d = rotated({20.0, 0.0}, std::numbers::pi * (i + 0.3) / 50.0);
    add_trace(model, {Vec2{0.7, -0.4} - d, Vec2{0.7, -0.4} + d});
  }
  for (int i = 0; i < 100; ++i) {
    SCOPED_TRACE(i);
    const Model there = shifted(turned(model, 3.61 * i), i % 2 ? Vec2{0, 0} : Vec2{1e5, 2e5});
    const auto result = build_polygons(there);
    expect_sound(result, 1e-8);
    ASSERT_TRUE(result.ok());
    EXPECT_EQ(result.value().blocks.size(), 100u);
  }
}

TEST(DegenerateLines, FiftyThroughNearlyOnePointKeepTheArea) {
  std::mt19937 random(4);
  for (double spread : {0.3, 1.0, 3.0, 30.0, 1000.0}) {
    std::uniform_real_distribution<double> off(-spread * 1e-8, spread * 1e-8);
    Model model = domain_model(box(-5, -5, 5, 5), 1e-8);
    for (int i = 0; i < 50; ++i) {
      const Vec2 d = rotated({20.0, 0.0}, std::numbers::pi * (i + 0.3) / 50.0);
      const Vec2 p{off(random), off(random)};
      add_trace(model, {p - d, p + d});
    }
    const auto result = build_polygons(model);
    // Nodes moved by snap at a hundred wedge tips, each times half a side: more than 1e-9 of the
    // area.
    expect_sound(result, 1e-8, 2e-8);
    EXPECT_GE(result.value().blocks.size(), 100u) << spread;
  }
}

/// An exact point with coordinates in lowest terms: x = xn/d, y = yn/d, d > 0.
using Exact = std::tuple<long long, long long, long long>;

struct LatticeSegment {
  long long ax, ay, bx, by;
};

Exact exact(long long xn, long long yn, long long d) {
  const long long g = std::gcd(std::gcd(xn, yn), d) * (d < 0 ? -1 : 1);
  return {xn / g, yn / g, d / g};
}

bool on_segment(const LatticeSegment& s, const Exact& p) {
  const auto [x, y, d] = p;
  if ((s.bx - s.ax) * (y - s.ay * d) != (s.by - s.ay) * (x - s.ax * d)) return false;
  return std::min(s.ax, s.bx) * d <= x && x <= std::max(s.ax, s.bx) * d &&
         std::min(s.ay, s.by) * d <= y && y <= std::max(s.ay, s.by) * d;
}

void add_meetings(const LatticeSegment& s, const LatticeSegment& t, std::set<Exact>& points) {
  for (const Exact& end : {exact(t.ax, t.ay, 1), exact(t.bx, t.by, 1)}) {
    if (on_segment(s, end)) points.insert(end);
  }
  const long long dx = s.bx - s.ax, dy = s.by - s.ay, ex = t.bx - t.ax, ey = t.by - t.ay;
  const long long den = dx * ey - dy * ex;
  if (den == 0) return;
  const long long num = (t.ax - s.ax) * ey - (t.ay - s.ay) * ex;
  const Exact p = exact(s.ax * den + num * dx, s.ay * den + num * dy, den);
  if (on_segment(s, p) && on_segment(t, p)) points.insert(p);
}

/// Bounded faces of an arrangement of segments between lattice points, by Euler in exact integers:
/// edges - nodes + components.
int exact_faces(const std::vector<LatticeSegment>& segments) {
  std::set<Exact> nodes;
  std::set<std::pair<Exact, Exact>> edges;
  for (const LatticeSegment& s : segments) {
    std::set<Exact> own = {exact(s.ax, s.ay, 1), exact(s.bx, s.by, 1)};
    for (const LatticeSegment& t : segments) add_meetings(s, t, own);
    std::vector<Exact> along(own.begin(), own.end());
    std::sort(along.begin(), along.end(), [&](const Exact& a, const Exact& b) {
      const auto [ax, ay, ad] = a;
      const auto [bx, by, bd] = b;
      return ((s.bx - s.ax) * ax + (s.by - s.ay) * ay) * bd <
             ((s.bx - s.ax) * bx + (s.by - s.ay) * by) * ad;
    });
    nodes.insert(along.begin(), along.end());
    for (std::size_t i = 0; i + 1 < along.size(); ++i) {
      edges.insert(std::minmax(along[i], along[i + 1]));
    }
  }
  std::map<Exact, Exact> parent;
  for (const Exact& n : nodes) parent[n] = n;
  const auto root = [&](Exact n) {
    while (parent[n] != n) n = parent[n];
    return n;
  };
  int components = static_cast<int>(nodes.size());
  for (const auto& [a, b] : edges) {
    const Exact ra = root(a), rb = root(b);
    if (ra == rb) continue;
    parent[ra] = rb;
    --components;
  }
  return static_cast<int>(edges.size()) - static_cast<int>(nodes.size()) + components;
}

/// A lattice box with random traces between lattice points: T junctions, overlaps, stars, free
/// ends, rings, floating pieces, lines along the outline.
struct Lattice {
  Model model;
  int faces = 0;
};

Lattice lattice(int traces, int size, unsigned seed) {
  const auto far = static_cast<double>(size);
  Lattice result{domain_model(box(0, 0, far, far), 1e-9 * far), 0};
  const long long s = size;
  std::vector<LatticeSegment> segments = {{0, 0, s, 0}, {s, 0, s, s}, {s, s, 0, s}, {0, s, 0, 0}};
  std::mt19937 random(seed);
  const auto pick = [&] {
    return static_cast<long long>(random() % (static_cast<unsigned>(size) + 1));
  };
  for (int i = 0; i < traces; ++i) {
    LatticeSegment t{pick(), pick(), pick(), pick()};
    if (t.ax == t.bx && t.ay == t.by) continue;
    segments.push_back(t);
    add_trace(result.model,
              {{static_cast<double>(t.ax), static_cast<double>(t.ay)},
               {static_cast<double>(t.bx), static_cast<double>(t.by)}},
              i % 4);
  }
  result.faces = exact_faces(segments);
  return result;
}

TEST(DegenerateLines, LatticeTracesAgreeWithExactArithmetic) {
  int blocks = 0, holes = 0, dangling = 0, bridging = 0, merged = 0;
  for (unsigned seed = 0; seed < 1500; ++seed) {
    SCOPED_TRACE(seed);
    const Lattice l =
        lattice(2 + static_cast<int>(seed % 40), 4 + static_cast<int>(seed % 9), seed);
    const Model model = turned(l.model, seed % 5 == 0 ? 0.0 : 0.7 * seed);
    const auto result = build_polygons(model);
    expect_sound(result, model.domain->snap);
    ASSERT_TRUE(result.ok());
    ASSERT_EQ(static_cast<int>(result.value().blocks.size()), l.faces);
    merged += result.value().report.merged;
    blocks += l.faces;
    for (const auto& b : result.value().blocks) holes += static_cast<int>(b.rings.size()) - 1;
    dangling += result.value().report.dangling;
    bridging += result.value().report.bridging;
  }
  // The corner cases must have been there.
  EXPECT_GT(blocks, 50000);
  EXPECT_GT(holes, 20);
  EXPECT_GT(dangling, 1000);
  EXPECT_GT(bridging, 5);
  EXPECT_EQ(merged, 0);
}

TEST(DegenerateLines, CountFreeEndsAlikeAtAllAngles) {
  for (unsigned seed = 0; seed < 1200; ++seed) {
    const Lattice l = lattice(8, 12, 1000 + seed);
    const auto reference = build_polygons(l.model);
    ASSERT_TRUE(reference.ok());
    for (double angle : {13.0, 45.0, 77.7, 200.1}) {
      const auto result = build_polygons(shifted(turned(l.model, angle), {1e4, 1e4}));
      ASSERT_TRUE(result.ok()) << reason(result);
      EXPECT_EQ(result.value().report.dangling, reference.value().report.dangling) << seed;
      EXPECT_EQ(result.value().report.bridging, reference.value().report.bridging) << seed;
      const auto expected = length_by_law(reference.value().blocks);
      for (const auto& [law, length] : length_by_law(result.value().blocks)) {
        EXPECT_NEAR(length, expected.at(law), 1e-6) << seed;
      }
    }
  }
}

TEST(DegenerateLines, SnapRoundingFindsTheSameFaces) {
  for (unsigned seed = 0; seed < 100; ++seed) {
    const Lattice l = lattice(20, 9, 300 + seed);
    const Model model = turned(l.model, 3.3 * seed);
    const Vec2 origin = model.domain->outline[0];
    auto work = line_work(model, origin, model.domain->snap);
    ASSERT_TRUE(work.ok());
    auto noded = node_lines(work.value(), model.domain->snap, {}, Noding::rounding);
    ASSERT_TRUE(noded.ok()) << to_string(noded.faults()[0]);
    EXPECT_TRUE(noded.value().snap_rounded);
    PlanarGraph graph = planar_graph(std::move(noded.value()), work.value().sources);
    trim_free_ends(graph);
    const Cycles cycles = trace_cycles(graph);
    remove_bridges(graph, cycles);
    const Faces faces = find_faces(graph, trace_cycles(graph));
    EXPECT_EQ(static_cast<int>(faces.outer.size()) - 1, l.faces) << seed;
  }
}

}  // namespace
}  // namespace edda::degenerate_lines_test
