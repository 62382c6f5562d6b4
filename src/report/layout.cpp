#include "report/layout.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

Box box_around(const std::vector<Vec2>& points) {
  Box box{{1e300, 1e300}, {-1e300, -1e300}};
  for (const Vec2 p : points) {
    if (!std::isfinite(p.x) || !std::isfinite(p.y)) continue;
    box.low = {std::min(box.low.x, p.x), std::min(box.low.y, p.y)};
    box.high = {std::max(box.high.x, p.x), std::max(box.high.y, p.y)};
  }
  if (!(box.high.x >= box.low.x)) return {{0.0, 0.0}, {1.0, 1.0}};
  const double margin = 0.03 * std::max({box.width(), box.height(), 1e-12});
  return {box.low - Vec2{margin, margin}, box.high + Vec2{margin, margin}};
}

Layout layout_for(const Box& world, double width, bool legend) {
  Layout l;
  l.world = world;
  l.width = std::floor(width);
  l.unit = l.width / 1600.0;
  const double left = 120.0 * l.unit, right = (legend ? 230.0 : 50.0) * l.unit;
  const double top = 120.0 * l.unit, bottom = 95.0 * l.unit;
  const double most_height = 1.05 * l.width - top - bottom, room = l.width - left - right;
  l.scale = std::min(room / world.width(), most_height / world.height());
  const double drawn_width = l.scale * world.width(), drawn_height = l.scale * world.height();
  // A slim model on a wide picture: narrower, but the title must still fit.
  l.width = std::floor(std::max(left + drawn_width + right, std::min(l.width, 900.0 * l.unit)));
  const double shift = 0.5 * (l.width - left - right - drawn_width);
  // A flat one: room for the legend.
  const double least_height = legend ? 320.0 * l.unit : 120.0 * l.unit;
  const double frame_height = std::max(drawn_height, least_height);
  l.height = std::floor(top + frame_height + bottom);
  l.frame.low = {left + shift, top};
  l.frame.high = {left + shift + drawn_width, top + frame_height};
  const double more = 0.5 * (frame_height - drawn_height) / l.scale;
  l.world.low.y -= more;
  l.world.high.y += more;
  return l;
}

}  // namespace edda
