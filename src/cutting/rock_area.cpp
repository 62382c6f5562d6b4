#include "cutting/rock_area.hpp"

#include <exception>
#include <memory>
#include <utility>

#include "cutting/geos_ring.hpp"

namespace edda {
namespace {

std::unique_ptr<geos::geom::Geometry> polygon_of(const geos::geom::GeometryFactory& factory,
                                                 const Ring& ring) {
  return factory.createPolygon(linear_ring(ring, factory));
}

}  // namespace

std::optional<double> rock_area(const Ring& outline, const std::vector<Ring>& openings) {
  if (outline.size() < 3) return std::nullopt;
  try {
    const auto factory = geos::geom::GeometryFactory::create();
    std::unique_ptr<geos::geom::Geometry> rock = polygon_of(*factory, outline);
    for (const Ring& opening : openings) {
      if (opening.size() >= 3) rock = rock->difference(polygon_of(*factory, opening).get());
    }
    return rock->getArea();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

std::optional<double> common_area(const Ring& a, const Ring& b) {
  if (a.size() < 3) return std::nullopt;
  try {
    const auto factory = geos::geom::GeometryFactory::create();
    const auto first = polygon_of(*factory, a);
    if (b.size() < 3) return first->getArea();
    return first->intersection(polygon_of(*factory, b).get())->getArea();
  } catch (const std::exception&) {
    return std::nullopt;
  }
}

}  // namespace edda
