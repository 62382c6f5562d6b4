#include "cutting/unenclosed.hpp"

#include <algorithm>
#include <cstdio>

#include "base/polygon.hpp"
#include "base/text.hpp"

namespace edda {
namespace {

/// A point just inside the middle of the block's longest edge.
Vec2 point_inside(const Ring& ring) {
  Vec2 place, along;
  double longest = 0.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    const Vec2 edge = ring[(i + 1) % ring.size()] - ring[i];
    if (norm(edge) <= longest) continue;
    longest = norm(edge);
    along = edge;
    place = ring[i] + 0.5 * edge;
  }
  constexpr double little = 1e-6;
  return place + little * perp(along);
}

}  // namespace

std::optional<std::string> unenclosed_warning(const Imports& imports,
                                              const std::vector<BlockPolygon>& blocks,
                                              Vec2 origin) {
  std::vector<std::vector<Ring>> closed;
  for (const ImportedLine& line : imports.lines) {
    Ring ring = closed_ring(line.points);
    if (ring.size() < 3) continue;
    for (Vec2& p : ring) p = p - origin;
    closed.push_back({std::move(ring)});
  }
  std::size_t outside = 0;
  double largest = 0.0;
  Vec2 place;
  for (const BlockPolygon& block : blocks) {
    const Vec2 p = point_inside(block.rings[0]);
    if (std::any_of(closed.begin(), closed.end(),
                    [&](const std::vector<Ring>& ring) { return side_of(ring, p, 0.0) > 0; }))
      continue;
    ++outside;
    const Moments m = moments(block.rings);
    if (m.area <= largest) continue;
    largest = m.area;
    place = m.centroid + origin;
  }
  if (closed.empty() || outside == 0 || outside == blocks.size()) return std::nullopt;
  char text[320];
  std::snprintf(text, sizeof text,
                "%s that no closed line of the drawing encloses %s rock, too, the largest of %.4g "
                "m2 at (%.5g, %.5g): where closed lines are the blocks, give the [[import]] as = "
                "\"blocks\"",
                counted(outside, "area").c_str(), outside == 1 ? "is" : "are", largest, place.x,
                place.y);
  return text;
}

}  // namespace edda
