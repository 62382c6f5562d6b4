#include <algorithm>
#include <cmath>
#include <cstdint>
#include <exception>
#include <memory>
#include <utility>
#include <vector>

#include "base/place.hpp"
#include "base/random.hpp"
#include "base/rings.hpp"
#include "cutting/geos.hpp"
#include "cutting/noding.hpp"
#include "cutting/planar_graph.hpp"
#include "cutting/random_lines.hpp"
#include "cutting/short_edges.hpp"

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

/// The edges of the diagram around these points.
std::vector<LineString> diagram_edges(const std::vector<Vec2>& points,
                                      const geos::geom::Envelope& box,
                                      const geos::geom::GeometryFactory& factory) {
  geos::triangulate::VoronoiDiagramBuilder builder;
  set_up(builder, points, box);
  const auto edges = builder.getDiagramEdges(factory);
  std::vector<LineString> lines;
  for (std::size_t i = 0; i < edges->getNumGeometries(); ++i) {
    const auto line = edges->getGeometryN(i)->getCoordinates();
    for (std::size_t k = 0; k + 1 < line->getSize(); ++k) {
      lines.push_back(
          {{{line->getX(k), line->getY(k)}, {line->getX(k + 1), line->getY(k + 1)}}, 0});
    }
  }
  return lines;
}

/// The polygons of the diagram inside all of the borders.
Result<Tiling> polygons_inside(std::vector<LineString> edges, const std::vector<Ring>& borders,
                               double snap, const Where& where) {
  LineWork work;
  work.lines = std::move(edges);
  work.sources.push_back({LineKind::voronoi, 0, none, 0.0, {}});
  for (const Ring& border : borders) {
    const auto source = static_cast<Index>(work.sources.size());
    work.sources.push_back({LineKind::outline, source - 1, none, 0.0, {}});
    work.lines.push_back({closed(border), source});
  }
  Result<NodedLines> noded = node_lines(work, snap, where);
  if (!noded.ok()) return noded.faults();
  PlanarGraph graph = planar_graph(std::move(noded.value()), work.sources);
  trim_free_ends(graph);
  Cycles cycles = trace_cycles(graph);
  if (!remove_bridges(graph, cycles).empty()) cycles = trace_cycles(graph);
  const Faces faces = find_faces(graph, std::move(cycles));
  std::vector<std::uint8_t> inside(faces.outer.size(), 1);
  for (std::size_t s = 1; s < work.sources.size(); ++s) {
    const std::vector<std::uint8_t> of_border = inside_ring(graph, faces, static_cast<Index>(s));
    for (std::size_t f = 0; f < inside.size(); ++f) inside[f] &= of_border[f];
  }
  Tiling tiling{graph.node, {}};
  for (std::size_t f = 1; f < inside.size(); ++f) {
    if (inside[f] == 0) continue;
    std::vector<int>& ring = tiling.ring.emplace_back();
    for_each_half_edge(faces, static_cast<int>(f),
                       [&](int h) { ring.push_back(origin_of(graph, h)); });
  }
  return tiling;
}

/// The edges between two polygons.
std::vector<std::pair<int, int>> inner_edges(const Tiling& tiling) {
  std::vector<std::pair<int, int>> all, inner;
  for (const std::vector<int>& ring : tiling.ring) {
    for (std::size_t i = 0; i < ring.size(); ++i) {
      const int v = ring[i], w = ring[i + 1 == ring.size() ? 0 : i + 1];
      all.emplace_back(std::min(v, w), std::max(v, w));
    }
  }
  std::sort(all.begin(), all.end());
  for (std::size_t i = 0; i + 1 < all.size(); ++i) {
    if (all[i] == all[i + 1]) inner.push_back(all[i]);
  }
  return inner;
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
    std::vector<Ring> borders{work.outline};
    if (!region.empty()) borders.push_back(region);
    const double fine = std::min(snap, 1e-9 * size_of(work.outline));
    Result<Tiling> tiling =
        polygons_inside(diagram_edges(points, box, *factory), borders, fine, voronoi.where);
    if (!tiling.ok()) return tiling.faults();
    Tiling& t = tiling.value();
    collapse_short_edges(t, voronoi.min_edge, 2.0 * fine);
    const auto at = [&](int v) { return t.node[static_cast<std::size_t>(v)]; };
    for (const auto& [v, w] : inner_edges(t)) work.lines.push_back({{at(v), at(w)}, source});
  } catch (const std::exception& error) {
    return {{member_of(voronoi.where, "size"),
             std::string("its polygons cannot be built: ") + error.what(),
             "change the seed or the size"}};
  }
  if (!region.empty()) work.lines.push_back({closed(region), source});
  return {};
}

}  // namespace edda
