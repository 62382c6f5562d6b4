// Blocks in colour, and their outlines.
#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/scene.hpp"

namespace edda {
namespace {

void trace(cairo_t* cr, const PlotScene& s, const BlockShape& shape) {
  for (const auto& ring : shape.rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      const Vec2 p = s.view.at(s.points[static_cast<std::size_t>(ring[k])]);
      if (k == 0) {
        cairo_move_to(cr, p.x, p.y);
      } else {
        cairo_line_to(cr, p.x, p.y);
      }
    }
    cairo_close_path(cr);
  }
}

/// Whether the cells of a shape, its zones, have values of their own.
bool has_zones(const PlotScene& s, const BlockShape& shape) {
  const std::vector<double>& values = s.shot.field.values;
  for (std::size_t c = shape.first_cell; c < shape.end_cell; ++c) {
    if (values[c] != values[shape.first_cell]) return true;
  }
  return false;
}

/// Fills each zone, with a rim: otherwise the paper would show between neighbours.
void fill_zones(Canvas& canvas, const PlotScene& s, const ColourScale& scale,
                const BlockShape& shape, double rim) {
  cairo_t* cr = canvas.cr();
  const Grid& g = s.grid();
  cairo_set_line_width(cr, rim);
  for (std::size_t c = shape.first_cell; c < shape.end_cell; ++c) {
    for (std::size_t k = g.begin(c); k < static_cast<std::size_t>(g.ends[c]); ++k) {
      const Vec2 p = s.view.at(s.points[static_cast<std::size_t>(g.corners[k])]);
      if (k == g.begin(c)) {
        cairo_move_to(cr, p.x, p.y);
      } else {
        cairo_line_to(cr, p.x, p.y);
      }
    }
    cairo_close_path(cr);
    canvas.colour(scale.of(s.shot.field.values[c]));
    cairo_fill_preserve(cr);
    cairo_stroke(cr);
  }
}

Box bounds_of(const PlotScene& s, const BlockShape& shape) {
  Box b{{1e300, 1e300}, {-1e300, -1e300}};
  for (const auto& edge : shape.outline) {
    const Vec2 p = s.view.at(s.points[static_cast<std::size_t>(edge.first)]);
    b.low = {std::min(b.low.x, p.x), std::min(b.low.y, p.y)};
    b.high = {std::max(b.high.x, p.x), std::max(b.high.y, p.y)};
  }
  return b;
}

bool is_visible(const Box& b, const Box& frame) {
  return b.high.x >= frame.low.x && b.low.x <= frame.high.x && b.high.y >= frame.low.y &&
         b.low.y <= frame.high.y;
}

void hatch(Canvas& canvas, const PlotScene& s, const BlockShape& shape) {
  cairo_t* cr = canvas.cr();
  Box b = bounds_of(s, shape);
  b.low = {std::max(b.low.x, s.view.frame.low.x), std::max(b.low.y, s.view.frame.low.y)};
  b.high = {std::min(b.high.x, s.view.frame.high.x), std::min(b.high.y, s.view.frame.high.y)};
  cairo_save(cr);
  trace(cr, s, shape);
  cairo_clip(cr);
  canvas.colour(ink::hatch);
  // On one raster for all blocks, so that neighbours match.
  const double gap = 0.5 * s.font;
  for (double c = std::floor((b.low.x + b.low.y) / gap) * gap; c <= b.high.x + b.high.y; c += gap) {
    cairo_move_to(cr, c - b.low.y, b.low.y);
    cairo_line_to(cr, c - b.high.y, b.high.y);
  }
  cairo_set_line_width(cr, 0.4);
  cairo_stroke(cr);
  cairo_restore(cr);
}

/// Thinner where blocks are small, so that they stay visible between their outlines.
double outline_width(const PlotScene& s, std::size_t blocks) {
  return std::clamp(0.025 * block_size(s, blocks), 0.08, 0.45);
}

double lightness(Colour c) {
  return 0.21 * c.r + 0.72 * c.g + 0.07 * c.b;
}

/// One colour of outlines for all coloured blocks: dark, or light where more of their area is so
/// dark that dark lines would vanish than so light that light ones would.
Colour outline_colour(const PlotScene& s, const ColourScale& scale) {
  constexpr double dark = 0.3, light = 0.6;
  const std::vector<double> areas = cell_areas(s.grid());
  double of_dark = 0.0, of_light = 0.0;
  for (std::size_t c = 0; c < areas.size(); ++c) {
    if (is_fixed(s.grid(), c)) continue;
    const double fill = lightness(scale.of(s.shot.field.values[c]));
    if (fill < dark) of_dark += areas[c];
    if (fill > light) of_light += areas[c];
  }
  return of_dark > of_light ? ink::light_line : ink::line;
}

/// One by one, so that every edge between two blocks is drawn twice and all have the same weight.
template <class Wanted>
void stroke_outlines(Canvas& canvas, const PlotScene& s, const std::vector<std::size_t>& visible,
                     Wanted wanted) {
  for (const std::size_t i : visible) {
    if (!wanted(s.shapes[i])) continue;
    trace(canvas.cr(), s, s.shapes[i]);
    cairo_stroke(canvas.cr());
  }
}

}  // namespace

void draw_blocks(Canvas& canvas, const PlotScene& s, const ColourScale& scale, bool outlines) {
  cairo_t* cr = canvas.cr();
  const ShownField& field = s.shot.field;
  const bool coloured = field.kind != ScaleKind::plain && !field.of_contacts;
  std::vector<std::size_t> visible;
  for (std::size_t i = 0; i < s.shapes.size(); ++i) {
    if (is_visible(bounds_of(s, s.shapes[i]), s.view.frame)) visible.push_back(i);
  }
  const double line = outline_width(s, visible.size());
  cairo_set_fill_rule(cr, CAIRO_FILL_RULE_EVEN_ODD);
  for (const std::size_t i : visible) {
    const BlockShape& shape = s.shapes[i];
    const bool fixed = is_fixed(s.grid(), shape.first_cell);
    if (coloured && !fixed && has_zones(s, shape)) {
      fill_zones(canvas, s, scale, shape, 0.25);
      continue;
    }
    trace(cr, s, shape);
    canvas.colour(fixed      ? ink::fixed
                  : coloured ? scale.of(field.values[shape.first_cell])
                             : ink::block);
    // Its rim, too: otherwise the paper would show between neighbours.
    cairo_fill_preserve(cr);
    cairo_set_line_width(cr, std::max(line, 0.25));
    cairo_stroke(cr);
    if (fixed) hatch(canvas, s, shape);
  }
  constexpr double too_small = 1.5;  // pt: only outlines would be visible
  if (!outlines || block_size(s, visible.size()) < too_small) return;
  cairo_set_line_width(cr, line);
  for (const bool fixed : {false, true}) {
    canvas.colour(coloured && !fixed ? outline_colour(s, scale) : ink::line);
    stroke_outlines(canvas, s, visible, [&](const BlockShape& shape) {
      return is_fixed(s.grid(), shape.first_cell) == fixed;
    });
  }
}

namespace {

/// Lines along the faces that touch and open ones with a value, the largest values on top.
void draw_face_field(Canvas& canvas, const PlotScene& s, const ColourScale& scale) {
  const std::vector<DrawnFace>& faces = s.faces;
  const std::vector<double>& values = s.shot.field.values;
  std::vector<std::size_t> order;
  for (std::size_t c = 0; c < faces.size(); ++c) {
    if ((!faces[c].open || values[c] != 0.0) && std::isfinite(values[c])) order.push_back(c);
  }
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(values[a]) < std::abs(values[b]);
  });
  const double outline = outline_width(s, s.shapes.size());
  const double width = std::clamp(4.0 * outline, 0.6, 1.8);
  canvas.colour(ink::line);
  for (const std::size_t c : order)
    canvas.line(s.view.at(faces[c].a), s.view.at(faces[c].b), width + 2.0 * outline);
  for (const std::size_t c : order) {
    canvas.colour(scale.of(values[c]));
    canvas.line(s.view.at(faces[c].a), s.view.at(faces[c].b), width);
  }
}

}  // namespace

void draw_contact_field(Canvas& canvas, const PlotScene& s, const ColourScale& scale) {
  if (!s.shot.field.of_contacts || !s.shot.contacts) return;
  if (s.shot.field.along_faces && !s.faces.empty()) return draw_face_field(canvas, s, scale);
  cairo_t* cr = canvas.cr();
  const std::vector<double>& values = s.shot.field.values;
  const double radius = std::clamp(5.0 * outline_width(s, s.shapes.size()), 0.5, 2.0);
  const std::vector<Vec2>& points = s.contacts;
  // Contacts of one corner cover each other: the largest values are on top, or those that slide.
  const bool states = s.shot.field.kind == ScaleKind::kinds;
  const auto weight = [&](std::size_t c) {
    constexpr double slides = 2.0, foremost = 9.0;
    return states && values[c] == slides ? foremost : std::abs(values[c]);
  };
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return weight(a) < weight(b); });
  cairo_set_line_width(cr, 0.12 * radius);
  for (const std::size_t c : order) {
    const Vec2 p = s.view.at(points[c]);
    cairo_new_sub_path(cr);
    cairo_arc(cr, p.x, p.y, radius, 0.0, 6.2831853);
    canvas.colour(scale.of(values[c]));
    cairo_fill_preserve(cr);
    canvas.colour(ink::line);
    cairo_stroke(cr);
  }
}

void draw_cracks(Canvas& canvas, const PlotScene& s) {
  const Field* by = s.shot.contacts ? s.shot.contacts->cell_field("broken_by") : nullptr;
  if (by == nullptr || s.faces.empty()) return;
  for (const auto& [mode, colour] :
       {std::pair{crack_in_shear, ink::compression}, std::pair{crack_in_tension, ink::tension}}) {
    canvas.colour(colour);
    for (std::size_t c = 0; c < s.faces.size(); ++c) {
      if (by->values[c] == mode)
        canvas.line(s.view.at(s.faces[c].a), s.view.at(s.faces[c].b), joint_width);
    }
  }
}

void draw_joints(Canvas& canvas, const PlotScene& s, const PlotOptions& options) {
  canvas.colour(ink::joint);
  for (const auto& [from, to] : options.joints) {
    canvas.line(s.view.at(from), s.view.at(to), joint_width);
  }
}

}  // namespace edda
