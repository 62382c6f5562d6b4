#include "report/plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/canvas.hpp"
#include "report/colour_scale.hpp"
#include "report/layout.hpp"
#include "report/shapes.hpp"
#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr Colour ink{0.12, 0.12, 0.14}, held_fill{0.80, 0.80, 0.80}, held_hatch{0.62, 0.62, 0.62};
constexpr Colour plain_block{0.87, 0.85, 0.80}, force_colour{0.75, 0.10, 0.10};
constexpr Colour vector_colour{0.05, 0.05, 0.05}, monitor_colour{0.80, 0.05, 0.45};
constexpr Colour bolt_colour{0.05, 0.25, 0.65}, joint_colour{0.85, 0.10, 0.05};

/// Everything that the parts of a picture share.
struct Scene {
  const Grid& grid;
  Layout layout;
  std::vector<Vec2> points;  ///< as drawn, m
  std::vector<BlockShape> shapes;
  double exaggeration;  ///< of displacements
};

bool held(const Grid& g, std::size_t cell) {
  const Field* fixed = g.cell_field("fixed");
  return fixed != nullptr && fixed->values[cell] != 0.0;
}

void trace_outline(cairo_t* cr, const Scene& s, const BlockShape& shape) {
  std::int64_t last = -1;
  for (const auto& [a, b] : shape.outline) {
    const Vec2 p = s.layout.px(s.points[static_cast<std::size_t>(a)]);
    const Vec2 q = s.layout.px(s.points[static_cast<std::size_t>(b)]);
    if (a != last) cairo_move_to(cr, p.x, p.y);
    cairo_line_to(cr, q.x, q.y);
    last = b;
  }
}

/// The cells in one path, so that no seam shows between those of one block.
void trace_cells(cairo_t* cr, const Scene& s, const BlockShape& shape) {
  for (std::size_t c = shape.first_cell; c < shape.end_cell; ++c) {
    const auto from = c == 0 ? std::size_t{0} : static_cast<std::size_t>(s.grid.ends[c - 1]);
    for (std::size_t k = from; k < static_cast<std::size_t>(s.grid.ends[c]); ++k) {
      const Vec2 p = s.layout.px(s.points[static_cast<std::size_t>(s.grid.corners[k])]);
      if (k == from) {
        cairo_move_to(cr, p.x, p.y);
      } else {
        cairo_line_to(cr, p.x, p.y);
      }
    }
    cairo_close_path(cr);
  }
}

void hatch(Canvas& canvas, const Scene& s, const BlockShape& shape) {
  cairo_t* cr = canvas.cr();
  double x0 = 1e300, x1 = -1e300, y0 = 1e300, y1 = -1e300;
  for (const auto& edge : shape.outline) {
    const Vec2 p = s.layout.px(s.points[static_cast<std::size_t>(edge.first)]);
    x0 = std::min(x0, p.x), x1 = std::max(x1, p.x), y0 = std::min(y0, p.y), y1 = std::max(y1, p.y);
  }
  x0 = std::max(x0, s.layout.frame.low.x), x1 = std::min(x1, s.layout.frame.high.x);
  y0 = std::max(y0, s.layout.frame.low.y), y1 = std::min(y1, s.layout.frame.high.y);
  cairo_save(cr);
  trace_cells(cr, s, shape);
  cairo_clip(cr);
  canvas.colour(held_hatch);
  // On one raster for all blocks, so that neighbours match.
  const double gap = 12.0 * s.layout.unit;
  for (double c = std::floor((x0 + y0) / gap) * gap; c <= x1 + y1; c += gap) {
    cairo_move_to(cr, c - y0, y0);
    cairo_line_to(cr, c - y1, y1);
  }
  cairo_set_line_width(cr, 1.2 * s.layout.unit);
  cairo_stroke(cr);
  cairo_restore(cr);
}

/// Thinner where blocks are small, so that they stay visible between their outlines.
double outline_width(const Scene& s) {
  const double area = s.layout.frame.width() * s.layout.frame.height();
  const double block =
      std::sqrt(area / static_cast<double>(std::max<std::size_t>(s.shapes.size(), 1)));
  return std::clamp(0.02 * block, 0.25, 1.6) * s.layout.unit;
}

bool is_dark(Colour c) {
  return 0.21 * c.r + 0.72 * c.g + 0.07 * c.b < 0.3;
}

void draw_blocks(Canvas& canvas, const Scene& s, const ShownField& field,
                 const ColourScale& scale) {
  cairo_t* cr = canvas.cr();
  const bool coloured = field.kind != ScaleKind::plain && !field.of_contacts;
  for (const BlockShape& shape : s.shapes) {
    const bool is_held = held(s.grid, shape.first_cell);
    trace_cells(cr, s, shape);
    canvas.colour(is_held    ? held_fill
                  : coloured ? scale.of(field.values[shape.first_cell])
                             : plain_block);
    cairo_fill(cr);
    if (is_held) hatch(canvas, s, shape);
  }
  // Dark lines vanish on dark blocks: those get a light one on top, which leaves their neighbours'
  // dark rim.
  cairo_set_line_width(cr, outline_width(s));
  canvas.colour(ink);
  for (const BlockShape& shape : s.shapes) {
    trace_outline(cr, s, shape);
    cairo_stroke(cr);
  }
  if (!coloured) return;
  cairo_set_line_width(cr, 0.6 * outline_width(s));
  canvas.colour({1.0, 1.0, 1.0}, 0.6);
  for (const BlockShape& shape : s.shapes) {
    if (held(s.grid, shape.first_cell) || !is_dark(scale.of(field.values[shape.first_cell])))
      continue;
    trace_outline(cr, s, shape);
    cairo_stroke(cr);
  }
}

void draw_contact_field(Canvas& canvas, const Scene& s, const Grid& contacts,
                        const ShownField& field, const ColourScale& scale) {
  cairo_t* cr = canvas.cr();
  const double radius =
      std::clamp(4.0 * outline_width(s), 2.0 * s.layout.unit, 7.0 * s.layout.unit);
  const std::vector<Vec2> points = drawn_points(contacts, s.exaggeration);
  // Contacts of one corner lie on one another: the largest values on top.
  std::vector<std::size_t> order(points.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(field.values[a]) < std::abs(field.values[b]);
  });
  for (const std::size_t c : order) {
    const Vec2 p = s.layout.px(points[c]);
    cairo_arc(cr, p.x, p.y, radius, 0.0, 6.2831853);
    canvas.colour(scale.of(field.values[c]));
    cairo_fill_preserve(cr);
    canvas.colour(ink);
    cairo_set_line_width(cr, 0.8 * s.layout.unit);
    cairo_stroke(cr);
  }
}

struct Arrow {
  Vec2 at, vector;
};

/// Arrows of one kind, the longest `longest` px. Returns the size of the longest vector.
double draw_arrows(Canvas& canvas, const Scene& s, const std::vector<Arrow>& arrows, double longest,
                   bool ends_at) {
  double most = 0.0;
  for (const Arrow& a : arrows) {
    if (std::isfinite(norm(a.vector))) most = std::max(most, norm(a.vector));
  }
  if (most == 0.0) return 0.0;
  for (const Arrow& a : arrows) {
    const Vec2 p = s.layout.px(a.at), v = longest / most * Vec2{a.vector.x, -a.vector.y};
    if (!std::isfinite(norm(v))) continue;
    canvas.arrow(ends_at ? p - v : p, ends_at ? p : p + v, 1.8 * s.layout.unit);
  }
  return most;
}

std::vector<Arrow> block_arrows(const Scene& s, const std::string& name) {
  std::vector<Arrow> arrows;
  const Field* field = s.grid.cell_field(name);
  if (field == nullptr || field->components < 2) return arrows;
  for (const BlockShape& shape : s.shapes) {
    const double* v = field->values.data() + shape.first_cell * field->components;
    arrows.push_back({centre_of(s.grid, shape, s.points), {v[0], v[1]}});
  }
  return arrows;
}

std::vector<Arrow> force_arrows(const Scene& s, const Grid& contacts) {
  std::vector<Arrow> arrows;
  const Field* force = contacts.cell_field("force");
  if (force == nullptr) return arrows;
  const std::vector<Vec2> points = drawn_points(contacts, s.exaggeration);
  for (std::size_t c = 0; c < points.size(); ++c) {
    arrows.push_back({points[c], {force->values[3 * c], force->values[3 * c + 1]}});
  }
  return arrows;
}

/// Arrows that were asked for; returns what the subtitle says of them.
std::string draw_vectors(Canvas& canvas, const Scene& s, const Grid* contacts,
                         const PlotOptions& options) {
  std::string note;
  const double longest = 0.08 * std::min(s.layout.frame.width(), 1.4 * s.layout.frame.height());
  auto describe = [&](const std::string& name, const char* unit, double most) {
    const ScaledUnit u = scaled_unit(unit, most);
    note += fmt::format("; {}: longest arrow {:.3g} {}", name, most * u.factor, u.name);
  };
  if (!options.vectors.empty()) {
    canvas.colour(vector_colour);
    const double most = draw_arrows(canvas, s, block_arrows(s, options.vectors), longest, false);
    describe(options.vectors, options.vectors == "velocity" ? "m/s" : "m", most);
  }
  if (options.forces && contacts != nullptr) {
    canvas.colour(force_colour);
    describe("contact forces", "N",
             draw_arrows(canvas, s, force_arrows(s, *contacts), longest, true));
  }
  return note;
}

void draw_monitors(Canvas& canvas, const Scene& s, const PlotOptions& options) {
  const double u = s.layout.unit, r = 9.0 * u;
  for (const PlotMonitor& m : options.monitors) {
    Vec2 now;
    if (!follow(s.grid, s.points, m.start, now)) continue;
    const Vec2 p = s.layout.px(now);
    cairo_arc(canvas.cr(), p.x, p.y, 0.7 * r, 0.0, 6.2831853);
    canvas.colour({1.0, 1.0, 1.0});
    cairo_fill_preserve(canvas.cr());
    canvas.colour(monitor_colour);
    cairo_set_line_width(canvas.cr(), 2.5 * u);
    cairo_stroke(canvas.cr());
    // Beside the point, on the side where there is room.
    const double size = 22.0 * u;
    const bool left = p.x + r + canvas.text_width(m.name, size, true) > s.layout.frame.high.x - r;
    const double y = std::max(p.y - r, s.layout.frame.low.y + size);
    canvas.colour(monitor_colour);
    canvas.text(m.name, {left ? p.x - r : p.x + r, y}, size, left ? Align::right : Align::left,
                true, true);
  }
}

/// Lines whose ends come nearer, from block to block.
void draw_lines(Canvas& canvas, const Scene& s, const PlotOptions& options) {
  const double u = s.layout.unit;
  for (const PlotLine& line : options.lines) {
    const Vec2 way = line.start[1] - line.start[0];
    // Ends lie on the walls: a hair beyond they are within a block.
    const auto end = [&](Vec2 at, Vec2 beyond, Vec2& now) {
      return follow(s.grid, s.points, at, now) || follow(s.grid, s.points, at + beyond, now);
    };
    Vec2 a, b;
    if (!end(line.start[0], -1e-3 * way, a) || !end(line.start[1], 1e-3 * way, b)) continue;
    const Vec2 p = s.layout.px(a), q = s.layout.px(b);
    const double dash = 8.0 * u;
    canvas.colour(monitor_colour);
    cairo_set_dash(canvas.cr(), &dash, 1, 0.0);
    cairo_set_line_width(canvas.cr(), 2.0 * u);
    cairo_move_to(canvas.cr(), p.x, p.y);
    cairo_line_to(canvas.cr(), q.x, q.y);
    cairo_stroke(canvas.cr());
    cairo_set_dash(canvas.cr(), nullptr, 0, 0.0);
    canvas.text(line.name, 0.5 * (p + q) + Vec2{6.0 * u, -6.0 * u}, 22.0 * u, Align::left, true,
                true);
  }
}

/// Bolts, carried along by the blocks that they go through.
void draw_bolts(Canvas& canvas, const Scene& s, const PlotOptions& options) {
  constexpr int pieces = 12;
  for (const auto& [from, to] : options.bolts) {
    bool drawing = false;
    for (int q = 0; q <= pieces; ++q) {
      Vec2 now;
      // A hair inside of its ends, which lie on faces.
      const double part = std::clamp(static_cast<double>(q) / pieces, 1e-3, 1.0 - 1e-3);
      if (!follow(s.grid, s.points, from + part * (to - from), now)) continue;
      const Vec2 p = s.layout.px(now);
      if (drawing) {
        cairo_line_to(canvas.cr(), p.x, p.y);
      } else {
        cairo_move_to(canvas.cr(), p.x, p.y);
      }
      drawing = true;
    }
    canvas.colour(bolt_colour);
    cairo_set_line_width(canvas.cr(), 4.0 * s.layout.unit);
    cairo_stroke(canvas.cr());
  }
}

void draw_joints(Canvas& canvas, const Scene& s, const PlotOptions& options) {
  canvas.colour(joint_colour);
  for (const auto& [from, to] : options.joints) {
    canvas.line(s.layout.px(from), s.layout.px(to), 5.0 * s.layout.unit);
  }
}

void draw_axes(Canvas& canvas, const Layout& l) {
  const double u = l.unit, size = 20.0 * u;
  canvas.colour(ink);
  cairo_rectangle(canvas.cr(), l.frame.low.x, l.frame.low.y, l.frame.width(), l.frame.height());
  cairo_set_line_width(canvas.cr(), 1.4 * u);
  cairo_stroke(canvas.cr());
  const int across = std::max(2, static_cast<int>(l.frame.width() / (150.0 * u)));
  for (const Tick& t : ticks(l.world.low.x, l.world.high.x, across)) {
    const double x = l.px({t.value, 0.0}).x;
    canvas.line({x, l.frame.high.y}, {x, l.frame.high.y + 8.0 * u}, 1.4 * u);
    canvas.text(t.label, {x, l.frame.high.y + 32.0 * u}, size, Align::centre);
  }
  const int up = std::max(2, static_cast<int>(l.frame.height() / (80.0 * u)));
  for (const Tick& t : ticks(l.world.low.y, l.world.high.y, up)) {
    const double y = l.px({0.0, t.value}).y;
    canvas.line({l.frame.low.x - 8.0 * u, y}, {l.frame.low.x, y}, 1.4 * u);
    canvas.text(t.label, {l.frame.low.x - 14.0 * u, y + 0.36 * size}, size, Align::right);
  }
  canvas.text("x (m)", {0.5 * (l.frame.low.x + l.frame.high.x), l.frame.high.y + 66.0 * u}, size,
              Align::centre);
  cairo_save(canvas.cr());
  cairo_translate(canvas.cr(), l.frame.low.x - 92.0 * u, 0.5 * (l.frame.low.y + l.frame.high.y));
  cairo_rotate(canvas.cr(), -1.5707963267948966);
  canvas.text("y (m)", {0.0, 0.0}, size, Align::centre);
  cairo_restore(canvas.cr());
}

/// A heading, smaller where it would not fit.
void draw_line_of_text(Canvas& canvas, const Layout& l, const std::string& text, double y,
                       double size, bool bold) {
  const double room = l.width - 60.0 * l.unit, wide = canvas.text_width(text, size, bold);
  if (wide > room) size *= room / wide;
  canvas.text(text, {0.5 * l.width, y}, size, Align::centre, bold);
}

}  // namespace

Trouble plot(const Grid& blocks, const Grid* contacts, const ShownField& field,
             const PlotOptions& options, const std::string& path) {
  std::vector<bool> counted(field.values.size(), true);
  for (std::size_t c = 0; c < counted.size(); ++c)
    counted[c] = field.of_contacts || !held(blocks, c);
  const ColourScale scale(field, counted);
  std::vector<Vec2> points = drawn_points(blocks, options.scale);
  const Layout layout = layout_for(box_around(points), options.width, scale.has_legend());
  const Scene scene{blocks, layout, std::move(points), block_shapes(blocks), options.scale};

  Canvas canvas(path, layout.width, layout.height);
  cairo_save(canvas.cr());
  cairo_rectangle(canvas.cr(), layout.frame.low.x, layout.frame.low.y, layout.frame.width(),
                  layout.frame.height());
  cairo_clip(canvas.cr());
  draw_blocks(canvas, scene, field, scale);
  if (field.of_contacts && contacts != nullptr)
    draw_contact_field(canvas, scene, *contacts, field, scale);
  draw_joints(canvas, scene, options);
  const std::string note = draw_vectors(canvas, scene, contacts, options);
  draw_bolts(canvas, scene, options);
  draw_lines(canvas, scene, options);
  draw_monitors(canvas, scene, options);
  cairo_restore(canvas.cr());
  draw_axes(canvas, layout);
  canvas.colour(ink);
  std::string subtitle = options.subtitle;
  if (options.scale != 1.0)
    subtitle += fmt::format("; displacements drawn {:.4g} times", options.scale);
  draw_line_of_text(canvas, layout, options.title, 48.0 * layout.unit, 30.0 * layout.unit, true);
  draw_line_of_text(canvas, layout, subtitle + note, 88.0 * layout.unit, 22.0 * layout.unit, false);
  const std::vector<std::string> states{"open", "stick", "slide", "bonded"};
  scale.draw_legend(canvas, layout, field, field.of_contacts ? states : options.materials);
  return canvas.finish();
}

}  // namespace edda
