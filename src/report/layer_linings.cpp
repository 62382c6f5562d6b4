// Thrust, moment or shear along linings, as areas across them.
#include <algorithm>
#include <cmath>

#include "report/scene.hpp"

namespace edda {
namespace {

constexpr double rim = 0.8, fill = 0.3;  // pt, and how much covers

/// The ends of the values of piece k, m.
std::array<Vec2, 2> tips(const LiningDiagram& d, std::size_t k, double per_unit) {
  const Vec2 a = d.points[2 * k], b = d.points[2 * k + 1];
  const Vec2 out = per_unit * outward_normal(unit(b - a));
  return {a + d.value[2 * k] * out, b + d.value[2 * k + 1] * out};
}

}  // namespace

ArrowScale lining_scale(const std::vector<PlotScene>& scenes) {
  double most = 0.0;
  for (const PlotScene& s : scenes) {
    for (const LiningDiagram& d : s.shot.linings)
      for (const double value : d.value) most = std::max(most, std::abs(value));
  }
  return scale_for(most, longest(scenes.front()));
}

void draw_linings(Canvas& canvas, const PlotScene& s, const ArrowScale& scale) {
  if (scale.per_unit == 0.0) return;
  cairo_t* cr = canvas.cr();
  const double per_unit = scale.per_unit / s.view.scale;
  for (const LiningDiagram& d : s.shot.linings) {
    for (std::size_t k = 0; 2 * k + 1 < d.points.size(); ++k) {
      const auto [from, to] = tips(d, k, per_unit);
      for (const Vec2 p : {d.points[2 * k], d.points[2 * k + 1], to, from}) {
        const Vec2 at = s.view.at(p);
        cairo_line_to(cr, at.x, at.y);
      }
      cairo_close_path(cr);
      canvas.colour(ink::bolt, fill);
      cairo_fill(cr);
      canvas.colour(ink::bolt);
      canvas.line(s.view.at(from), s.view.at(to), rim);
    }
  }
}

}  // namespace edda
