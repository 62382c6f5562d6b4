#include <algorithm>
#include <cmath>
#include <exception>
#include <memory>

#include "base/place.hpp"
#include "base/random.hpp"
#include "base/rings.hpp"
#include "cutting/geos.hpp"
#include "cutting/random_lines.hpp"

namespace edda {
namespace {

using geos::geom::Coordinate;

/// The box of the random points, a little larger than the area to be covered.
geos::geom::Envelope box_round(const Ring& ring, double margin) {
  const Stretch x = extent_along(ring, {1, 0}), y = extent_along(ring, {0, 1});
  return {x.first - margin, x.second + margin, y.first - margin, y.second + margin};
}

std::vector<Vec2> random_points(const geos::geom::Envelope& box, double size, Random random) {
  const double count = std::max(1.0, std::round(box.getArea() / size / size));
  std::vector<Vec2> points;
  for (double i = 0.0; i < count; i += 1.0) {
    const double x = box.getMinX() + random.uniform() * box.getWidth();
    const double y = box.getMinY() + random.uniform() * box.getHeight();
    points.push_back({x, y});
  }
  return points;
}

void set_up(geos::triangulate::VoronoiDiagramBuilder& builder, const std::vector<Vec2>& points,
            const geos::geom::Envelope& box) {
  GeosPoints sites;
  for (const Vec2 p : points) sites.add(Coordinate(p.x, p.y));
  builder.setSites(sites);
  builder.setClipEnvelope(&box);
}

Ring ring_of(const geos::geom::Geometry& polygon) {
  const auto shell = polygon.getCoordinates();
  Ring ring;
  for (std::size_t i = 0; i + 1 < shell->getSize(); ++i) {
    ring.push_back({shell->getX(i), shell->getY(i)});
  }
  return ring;
}

/// Moves each point to the centroid of its polygon.
std::vector<Vec2> centred(const std::vector<Vec2>& points, const geos::geom::Envelope& box,
                          const geos::geom::GeometryFactory& factory) {
  geos::triangulate::VoronoiDiagramBuilder builder;
  set_up(builder, points, box);
  const auto diagram = builder.getDiagram(factory);
  std::vector<Vec2> moved;
  for (std::size_t i = 0; i < diagram->getNumGeometries(); ++i) {
    const Ring ring = ring_of(*diagram->getGeometryN(i));
    if (ring.size() >= 3) moved.push_back(moments({&ring, 1}).centroid);
  }
  return moved;
}

/// Whether a part of the segment lies inside.
bool meets(const Ring& ring, Vec2 a, Vec2 b, double snap) {
  const double length = norm(b - a);
  if (length == 0.0) return false;
  return !common(clip_line(ring, a, (b - a) / length, snap), {{0.0, length}}).empty();
}

void add_edge(LineWork& work, const Ring& region, Vec2 a, Vec2 b, Index source, double snap) {
  if (region.empty()) {
    if (meets(work.outline, a, b, snap)) work.lines.push_back({{a, b}, source});
    return;
  }
  const double length = norm(b - a);
  if (length == 0.0) return;
  const Vec2 along = (b - a) / length;
  for (const Stretch& part : common(clip_line(region, a, along, snap), {{0.0, length}})) {
    const Vec2 from = part.first == 0.0 ? a : a + part.first * along;
    const Vec2 to = part.second == length ? b : a + part.second * along;
    work.lines.push_back({{from, to}, source});
  }
}

}  // namespace

Faults add_voronoi(LineWork& work, const Voronoi& voronoi, Index source, Vec2 origin, double snap) {
  const Ring region = local_ring(voronoi.region, origin);
  constexpr double margin = 2.0;  // in units of size: the box cuts the polygons at its edge
  const geos::geom::Envelope box =
      box_round(region.empty() ? work.outline : region, margin * voronoi.size);
  try {
    const auto factory = geos::geom::GeometryFactory::create();
    const std::uint64_t key = mixed(mixed(0, "voronoi"), static_cast<std::uint64_t>(voronoi.seed));
    std::vector<Vec2> points = random_points(box, voronoi.size, Random(key));
    for (int round = 0; round < voronoi.smoothing; ++round) points = centred(points, box, *factory);
    geos::triangulate::VoronoiDiagramBuilder builder;
    set_up(builder, points, box);
    const auto edges = builder.getDiagramEdges(*factory);
    for (std::size_t i = 0; i < edges->getNumGeometries(); ++i) {
      const auto line = edges->getGeometryN(i)->getCoordinates();
      for (std::size_t k = 0; k + 1 < line->getSize(); ++k) {
        add_edge(work, region, {line->getX(k), line->getY(k)},
                 {line->getX(k + 1), line->getY(k + 1)}, source, snap);
      }
    }
  } catch (const std::exception& error) {
    return {{member_of(voronoi.where, "size"),
             std::string("its polygons cannot be built: ") + error.what(),
             "change the seed or the size"}};
  }
  if (!region.empty()) work.lines.push_back({closed(region), source});
  return {};
}

}  // namespace edda
