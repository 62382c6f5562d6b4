#include "report/scene.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace edda {

PlotScene make_scene(const Snapshot& shot, double exaggeration) {
  PlotScene s{
      shot, {},          drawn_points(shot.blocks, exaggeration), block_shapes(shot.blocks), {},
      {},   exaggeration};
  if (!shot.contacts) return s;
  s.faces = drawn_faces(*shot.contacts, shot.blocks, exaggeration);
  for (const DrawnFace& face : s.faces) s.contacts.push_back(0.5 * (face.a + face.b));
  if (s.faces.empty()) s.contacts = drawn_points(*shot.contacts, exaggeration);
  return s;
}

bool is_fixed(const Grid& grid, std::size_t cell) {
  const Field* fixed = grid.cell_field("fixed");
  return fixed != nullptr && fixed->values[cell] != 0.0;
}

double block_size(const PlotScene& s, std::size_t blocks) {
  const double area = s.view.frame.width() * s.view.frame.height();
  return std::sqrt(area / static_cast<double>(std::max<std::size_t>(blocks, 1)));
}

bool is_inside(const PlotScene& s, Vec2 p) {
  const Box& w = s.view.world;
  return p.x >= w.low.x && p.x <= w.high.x && p.y >= w.low.y && p.y <= w.high.y;
}

double longest(const PlotScene& s) {
  return 0.08 * std::min(s.view.frame.width(), 1.4 * s.view.frame.height());
}

ArrowScale scale_for(double most, double length) {
  if (!(most > 0.0)) return {};
  return {length / most, round_below(most)};
}

ArrowScale scale_for(std::vector<Weighed>& sizes, bool whole, double length) {
  double most = 0.0;
  for (const Weighed& size : sizes) most = std::max(most, size.value);
  const double drawn = whole ? most : drawn_ends({0.0, most}, inner_ends(sizes)).high;
  ArrowScale scale = scale_for(drawn, length);
  if (drawn < most) scale.longest = longest_beyond * length;
  return scale;
}

double round_below(double largest) {
  if (!(largest > 0.0) || !std::isfinite(largest)) return 0.0;
  const double power = std::pow(10.0, std::floor(std::log10(largest)));
  double round = power;
  for (const double digit : {2.0, 5.0, 10.0}) {
    if (digit * power <= largest * (1.0 + 1e-12)) round = digit * power;
  }
  return round;
}

}  // namespace edda
