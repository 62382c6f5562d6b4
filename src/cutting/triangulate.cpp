#include "cutting/triangulate.hpp"

#include <map>
#include <memory>
#include <utility>

#include "cutting/geos_ring.hpp"

namespace edda {
namespace {

double twice_area(Vec2 a, Vec2 b, Vec2 c) {
  return cross(b - a, c - a);
}

}  // namespace

bool is_convex(std::span<const Vec2> ring) {
  const std::size_t n = ring.size();
  for (std::size_t k = 0; k < n; ++k) {
    if (twice_area(ring[k], ring[(k + 1) % n], ring[(k + 2) % n]) < 0.0) return false;
  }
  return true;
}

std::vector<Triangle> triangulate(std::span<const Ring> rings) {
  const auto factory = geos::geom::GeometryFactory::create();
  std::vector<std::unique_ptr<geos::geom::LinearRing>> holes;
  std::map<std::pair<double, double>, std::uint32_t> number;
  std::vector<Vec2> corners;
  for (const Ring& ring : rings) {
    if (&ring != &rings[0]) holes.push_back(linear_ring(ring, *factory));
    for (const Vec2 p : ring) {
      number.try_emplace({p.x, p.y}, static_cast<std::uint32_t>(corners.size()));
      corners.push_back(p);
    }
  }
  const auto polygon = factory->createPolygon(linear_ring(rings[0], *factory), std::move(holes));
  const auto parts =
      geos::triangulate::polygon::ConstrainedDelaunayTriangulator::triangulate(polygon.get());
  std::vector<Triangle> triangles;
  for (std::size_t q = 0; q < parts->getNumGeometries(); ++q) {
    const auto at = parts->getGeometryN(q)->getCoordinates();
    Triangle triangle{};
    for (std::size_t k = 0; k < 3; ++k) triangle[k] = number.at({at->getX(k), at->getY(k)});
    const auto [a, b, c] = triangle;
    if (twice_area(corners[a], corners[b], corners[c]) < 0.0) std::swap(triangle[1], triangle[2]);
    triangles.push_back(triangle);
  }
  return triangles;
}

}  // namespace edda
