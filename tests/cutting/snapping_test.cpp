// Noding with a tolerance against GEOS's own, whose rules it follows: the same nodes and edges, to
// the bit.
#include "cutting/snapping.hpp"

#include <gtest/gtest.h>

#include <memory>
#include <random>
#include <utility>
#include <vector>

#include "cutting/noding.hpp"

// The oracle; as for all of GEOS's headers (lines/geos.hpp).
#pragma GCC diagnostic push
#pragma GCC diagnostic ignored "-Wconversion"
#pragma GCC diagnostic ignored "-Wunused-parameter"
#include <geos/noding/snap/SnappingNoder.h>
#pragma GCC diagnostic pop

namespace edda::snapping_test {
namespace {

using geos::geom::Coordinate;
using geos::noding::SegmentString;

struct Edge {
  Vec2 from, to;
  Index source = 0;
  friend bool operator==(const Edge&, const Edge&) = default;
};

/// GEOS hands out bare pointers.
std::vector<std::unique_ptr<SegmentString>> owned(const std::vector<SegmentString*>& strings) {
  return {strings.begin(), strings.end()};
}

std::vector<Edge> edges_by_geos(const LineWork& work, double snap) {
  std::vector<SegmentString*> input;
  for (const LineString& line : work.lines) {
    auto points = std::make_unique<GeosPoints>();
    for (Vec2 p : line.points) points->add(Coordinate(p.x, p.y));
    input.push_back(
        noded_string(std::move(points), &work.sources[static_cast<std::size_t>(line.source)]));
  }
  const auto keep = owned(input);
  geos::noding::snap::SnappingNoder noder(snap);
  noder.computeNodes(&input);
  const std::unique_ptr<std::vector<SegmentString*>> strings(noder.getNodedSubstrings());
  std::vector<Edge> edges;
  for (const auto& s : owned(*strings)) {
    const auto source = static_cast<const LineSource*>(s->getData()) - work.sources.data();
    for (std::size_t i = 0; i + 1 < s->size(); ++i) {
      const Coordinate &a = s->getCoordinate(i), &b = s->getCoordinate(i + 1);
      edges.push_back({{a.x, a.y}, {b.x, b.y}, static_cast<Index>(source)});
    }
  }
  return edges;
}

std::vector<Edge> edges_of(const NodedLines& lines) {
  std::vector<Edge> edges;
  const auto node = [&](int i) { return lines.nodes[static_cast<std::size_t>(i)]; };
  for (const NodedEdge& e : lines.edges) edges.push_back({node(e.from), node(e.to), e.source});
  return edges;
}

/// Polylines between points of a coarse raster, each moved a little: much of it nearly coincides.
LineWork crowded_lines(unsigned seed, double moved) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> off(-moved, moved);
  std::uniform_int_distribution<int> raster(0, 8), corners(2, 5);
  LineWork work;
  work.sources.resize(12);
  for (Index source = 0; source < 12; ++source) {
    LineString line{{}, source};
    for (int k = corners(random); k > 0; --k) {
      line.points.push_back({raster(random) - 4 + off(random), raster(random) - 4 + off(random)});
    }
    work.lines.push_back(line);
  }
  return work;
}

TEST(Snapping, IsThatOfGeosToTheBit) {
  int compared = 0;
  for (unsigned seed = 0; seed < 400; ++seed) {
    for (const double snap : {1e-9, 1e-3, 0.05}) {
      for (const double moved : {0.0, 0.6 * snap, 3.0 * snap, 0.3}) {
        const LineWork work = crowded_lines(seed, moved);
        const auto noded = node_lines(work, snap, {});
        if (!noded.ok() || noded.value().snap_rounded) continue;
        ASSERT_EQ(edges_of(noded.value()), edges_by_geos(work, snap))
            << seed << ' ' << snap << ' ' << moved;
        ++compared;
      }
    }
  }
  EXPECT_GT(compared, 3000);
}

TEST(Snapping, TakesTheNearestPointAndOfTwoTheLesser) {
  SnapPoints points(1.0);
  const auto snapped = [&](double x, double y) {
    const Coordinate p = points.snap(Coordinate(x, y));
    return Vec2{p.x, p.y};
  };
  EXPECT_EQ(snapped(0.0, 0.0), (Vec2{0.0, 0.0}));
  EXPECT_EQ(snapped(-1.5, 0.0), (Vec2{-1.5, 0.0}));
  EXPECT_EQ(snapped(-0.75, 0.0), (Vec2{-1.5, 0.0}));
  EXPECT_EQ(snapped(-0.5, 0.0), (Vec2{0.0, 0.0}));
  EXPECT_EQ(snapped(0.0, -1.0), (Vec2{0.0, 0.0}));
  EXPECT_EQ(snapped(0.0, 1.25), (Vec2{0.0, 1.25}));
}

/// Such lines come from traces that reach far out of the domain.
TEST(Snapping, PointsBeyondAllIntegers) {
  SnapPoints points(1e-9);
  for (const double x : {1e300, -1e300, 1e18}) {
    EXPECT_EQ(points.snap(Coordinate(x, 1.0)).x, x);
    EXPECT_EQ(points.snap(Coordinate(x, 1.0)).x, x);
  }
}

}  // namespace
}  // namespace edda::snapping_test
