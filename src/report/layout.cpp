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

Layout lay_out(const Box& world, const Paper& paper, const Surroundings& room) {
  const double f = paper.font, gap = 1.5 * f, below = 3.6 * f, edge = 0.8 * f;
  const double right = room.legend_width > 0.0 ? gap + room.legend_width + edge : 1.5 * f;
  const auto n = static_cast<double>(room.drawings);
  Layout l;
  l.font = f;
  const double for_drawings =
      std::max(paper.width - room.left - right - (n - 1.0) * gap, 0.2 * paper.width);
  const double tallest = std::max(1.05 * paper.width - room.top - below, 0.2 * paper.width);
  const double scale = std::min(for_drawings / n / world.width(), tallest / world.height());
  const double wide = scale * world.width(), high = scale * world.height();
  // A slim model gives a narrow page, but the title must still fit.
  const double used = room.left + n * wide + (n - 1.0) * gap + right;
  l.width = std::max(used, paper.whole ? paper.width : 0.55 * paper.width);
  l.height = room.top + std::max(high + below, room.legend_height) + room.legend_below + edge;
  const double drawings = n * wide + (n - 1.0) * gap;
  const bool drawings_are_wide = drawings >= 20.0 * f;
  l.below = drawings_are_wide ? drawings : l.width - 2.0 * edge;
  double x = room.left + 0.5 * (l.width - used);
  for (std::size_t k = 0; k < room.drawings; ++k) {
    l.views.push_back({{{x, room.top}, {x + wide, room.top + high}}, world, scale});
    x += wide + gap;
  }
  l.legend = {x, room.top};
  if (room.legend_below > 0.0)
    l.legend = {drawings_are_wide ? l.views.front().frame.low.x : edge, room.top + high + below};
  return l;
}

}  // namespace edda
