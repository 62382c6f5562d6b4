// Pressures on joints: trapezoids or triangles across them.
#include <algorithm>
#include <cmath>

#include "report/scene.hpp"

namespace edda {
namespace {

double middle_of(std::vector<double>& values) {
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

/// A corner that leans on an edge has a force, but no visible length over which a pressure could be
/// drawn.
bool is_shown(const PlotScene& s, const DrawnFace& face) {
  constexpr double narrowest = 1.0;  // pt
  const double length = face.closed * norm(face.b - face.a);
  return !face.open && s.view.scale * length >= narrowest && std::isfinite(face.pressure_a) &&
         std::isfinite(face.pressure_b) && is_inside(s, 0.5 * (face.a + face.b));
}

void trace(Canvas& canvas, const PlotScene& s, const PressureArea& area) {
  for (const Vec2 p : area.ring) {
    const Vec2 at = s.view.at(p);
    cairo_line_to(canvas.cr(), at.x, at.y);
  }
}

}  // namespace

ArrowScale pressure_scale(const std::vector<PlotScene>& scenes, const PlotOptions& options) {
  constexpr double usual = 0.45;  // of a face's length: the largest diagrams lie within a block
  std::vector<Weighed> sizes;
  std::vector<double> lengths;
  for (const PlotScene& s : scenes) {
    for (const DrawnFace& face : s.faces) {
      if (!is_shown(s, face)) continue;
      const double length = norm(face.b - face.a);
      sizes.push_back(
          {std::max(std::abs(face.pressure_a), std::abs(face.pressure_b)), face.closed * length});
      lengths.push_back(s.view.scale * length);
    }
  }
  if (lengths.empty()) return {};
  return scale_for(sizes, options.whole_range,
                   std::min(usual * middle_of(lengths), longest(scenes.front())));
}

void draw_pressures(Canvas& canvas, const PlotScene& s, const ArrowScale& scale) {
  if (scale.per_unit == 0.0) return;
  const double most = scale.longest > 0.0 ? scale.longest / scale.per_unit : 1e300;
  // The smaller the blocks, the more diagrams there are, and the closer.
  const double line = std::min(pressure_line, 0.02 * block_size(s, s.shapes.size()));
  std::vector<PressureArea> areas;
  for (const DrawnFace& face : s.faces) {
    if (!is_shown(s, face)) continue;
    const auto diagram = pressure_diagram(face, scale.per_unit / s.view.scale, most);
    areas.insert(areas.end(), diagram.begin(), diagram.end());
  }
  // So that they show on any colour.
  canvas.colour(ink::white, 0.75);
  cairo_set_line_width(canvas.cr(), 3.0 * line);
  for (const PressureArea& area : areas) {
    trace(canvas, s, area);
    cairo_stroke(canvas.cr());
  }
  cairo_set_line_width(canvas.cr(), line);
  for (const PressureArea& area : areas) {
    const Colour colour = area.tension ? ink::tension : ink::pressure;
    trace(canvas, s, area);
    cairo_close_path(canvas.cr());
    canvas.colour(colour, pressure_fill);
    cairo_fill(canvas.cr());
    // The rim, without the part on the face.
    trace(canvas, s, area);
    canvas.colour(colour);
    cairo_stroke(canvas.cr());
  }
}

}  // namespace edda
