#include "blocks/locate.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cutting/cut_domain.hpp"

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

/// Largest distance from its edge, by rounding alone, of a point on it, m.
double rounding_at(const BlockSet& b, Vec2 p, double snap) {
  return std::min(snap, 1e-13 * (extent(b) + norm(p + b.origin)));
}

}  // namespace

double snap_distance(const Model& model, const BlockSet& b) {
  const double rounding = 8.0 * std::numeric_limits<double>::epsilon() * norm(b.origin);
  return std::max(model.domain ? snap_of(model) : 1e-9 * extent(b), rounding);
}

std::vector<Id> blocks_at(const Model& model, const PolygonSet& polygons, const BlockSet& b, Vec2 p,
                          Among among) {
  const double edge = rounding_at(b, p, snap_distance(model, b));
  std::vector<Id> found;
  for (std::size_t q = 0; q < b.size(); ++q) {
    const std::size_t i = polygons.reversed ? b.size() - 1 - q : q;
    if (among == Among::free_blocks && b.fixed[i]) continue;
    const Vec2 arm = p - Vec2{b.centroid_x[i], b.centroid_y[i]};
    if (norm(arm) > b.radius[i] + edge) continue;
    if (side_of(polygons.blocks[i].rings, p, edge) >= 0) found.push_back(static_cast<Id>(i));
  }
  const auto rank = [&](Id i) {
    const bool leaves = !b.opening.empty() && b.opening[i] != none;
    return 4 * int{b.is_fill(i)} + 2 * int{leaves} + int{b.fixed[i] != 0};
  };
  std::stable_sort(found.begin(), found.end(), [&](Id i, Id j) { return rank(i) < rank(j); });
  return found;
}

std::optional<Id> block_at(const Model& model, const PolygonSet& polygons, const BlockSet& b,
                           Vec2 p, Among among) {
  const std::vector<Id> holding = blocks_at(model, polygons, b, p, among);
  if (!holding.empty()) return holding.front();
  std::optional<Id> nearest;
  double least = snap_distance(model, b);
  for (std::size_t q = 0; q < b.size(); ++q) {
    const std::size_t i = polygons.reversed ? b.size() - 1 - q : q;
    if (among == Among::free_blocks && b.fixed[i]) continue;
    const Vec2 arm = p - Vec2{b.centroid_x[i], b.centroid_y[i]};
    if (norm(arm) > b.radius[i] + least) continue;
    const double d = distance_to_rings(polygons.blocks[i].rings, p);
    if (d > least || (nearest && d == least)) continue;
    least = d;
    nearest = static_cast<Id>(i);
  }
  return nearest;
}

}  // namespace edda
