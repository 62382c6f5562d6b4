#include "cutting/zone_size.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edda {
namespace {

double half_width_of(const Ring& ring) {
  return 0.5 * least_width(ring);
}

/// Where the model gives no size.
double automatic_size(const Model& model, const PolygonSet& polygons) {
  constexpr double part_of_opening = 1.0 / 8.0, part_of_model = 1.0 / 30.0;
  double least = std::numeric_limits<double>::infinity();
  for (const Opening& o : model.openings)
    least = std::min(least, part_of_opening * half_width_of(o.polygon));
  if (std::isfinite(least)) return least;
  std::vector<Vec2> points;
  for (const BlockPolygon& block : polygons.blocks) {
    if (!block.fixed) points.insert(points.end(), block.rings[0].begin(), block.rings[0].end());
  }
  return part_of_model * least_width(points);
}

}  // namespace

ZoneSizes::ZoneSizes(const Model& model, const PolygonSet& polygons)
    : model_(model), origin_(polygons.origin) {
  constexpr double automatic_growth = 0.15;
  const ZoneInputs given = model.zones.value_or(ZoneInputs{});
  size_ = given.size ? *given.size : automatic_size(model, polygons);
  growth_ = given.growth.value_or(given.size ? 0.0 : automatic_growth);
}

double ZoneSizes::distance_from_openings(Vec2 point) const {
  double least = std::numeric_limits<double>::infinity();
  for (const Opening& o : model_.openings) {
    const Ring& ring = o.polygon;
    for (std::size_t k = 0; k < ring.size(); ++k)
      least = std::min(least, distance_to_segment(point, ring[k], ring[(k + 1) % ring.size()]));
  }
  return std::isfinite(least) ? least : 0.0;
}

MeshSize ZoneSizes::of(const BlockPolygon& block) const {
  constexpr double least_part = 1.0 / 8.0;
  const Material& material = model_.materials[static_cast<std::size_t>(block.material)];
  const double size = material.zone_size.value_or(size_);
  const double most = std::max(half_width_of(block.rings[0]), least_part * size);
  return [this, size, most](Vec2 p) {
    const double larger = growth_ > 0.0 ? growth_ * distance_from_openings(p + origin_) : 0.0;
    return std::min(size + larger, most);
  };
}

}  // namespace edda
