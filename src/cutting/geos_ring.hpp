// A ring of the model as one of GEOS.
#pragma once

#include <memory>
#include <utility>

#include "base/polygon.hpp"
#include "cutting/geos.hpp"

namespace edda {

/// Closed, with the first corner repeated at the end; the ring has at least three corners.
inline std::unique_ptr<geos::geom::LinearRing> linear_ring(
    const Ring& ring, const geos::geom::GeometryFactory& factory) {
  auto corners = std::make_unique<GeosPoints>();
  for (const Vec2 p : ring) corners->add(geos::geom::Coordinate(p.x, p.y));
  corners->add(geos::geom::Coordinate(ring.front().x, ring.front().y));
  return factory.createLinearRing(std::move(corners));
}

}  // namespace edda
