#include "blocks/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "lines/cut_domain.hpp"

namespace edda {
namespace {

double extent(const BlockSet& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    largest = std::max({largest, std::abs(b.vertex_x[v]), std::abs(b.vertex_y[v])});
  }
  return 2.0 * largest;
}

double distance_to_rings(const std::vector<Ring>& rings, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ring& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      least = std::min(least, distance_to_segment(p, ring[k], ring[(k + 1) % ring.size()]));
    }
  }
  return least;
}

}  // namespace

double snap_distance(const Model& model, const BlockSet& b) {
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * norm(b.origin);
  return std::max(model.domain ? snap_of(model) : 1e-9 * extent(b), rounding);
}

std::optional<Id> block_at(const Model& model, const PolygonSet& polygons, const BlockSet& b,
                           Vec2 p, Among among) {
  const double snap = snap_distance(model, b);
  const double edge = std::min(snap, 1e-13 * (extent(b) + norm(p + b.origin)));  // rounding only
  std::optional<Id> nearest, leaving;
  double least = snap;
  for (std::size_t q = 0; q < b.size(); ++q) {
    const std::size_t i = polygons.reversed ? b.size() - 1 - q : q;
    if (among == Among::free_blocks && b.fixed[i]) continue;
    const Vec2 arm = p - Vec2{b.centroid_x[i], b.centroid_y[i]};
    if (norm(arm) > b.radius[i] + snap + edge) continue;
    const std::vector<Ring>& rings = polygons.blocks[i].rings;
    if (side_of(rings, p, edge) >= 0) {
      const bool stays = b.opening.empty() || b.opening[i] == none;
      if (stays) return static_cast<Id>(i);
      if (!leaving) leaving = static_cast<Id>(i);
      continue;
    }
    const double d = distance_to_rings(rings, p);
    if (d > least || (nearest && d == least)) continue;
    least = d;
    nearest = static_cast<Id>(i);
  }
  return leaving ? leaving : nearest;
}

}  // namespace edda
