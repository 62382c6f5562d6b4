// The frame of a drawing, and its ticks.
#include <algorithm>

#include "report/scene.hpp"
#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr double digit = 0.64;  // width of a digit, of the size of the font

double widest_label(const std::vector<Tick>& all, double font) {
  std::size_t most = 1;
  for (const Tick& t : all) most = std::max(most, t.label.size());
  return digit * font * static_cast<double>(most);
}

/// The number of ticks that leaves some room between labels.
std::vector<Tick> ticks_across(const Box& world, double width, double font) {
  double count = width / (2.5 * font);
  std::vector<Tick> all = ticks(world.low.x, world.high.x, count);
  while (count > 1.0 &&
         static_cast<double>(all.size()) * (widest_label(all, font) + 1.2 * font) > width) {
    count *= 0.8;
    all = ticks(world.low.x, world.high.x, count);
  }
  return all;
}

std::vector<Tick> ticks_up(const Box& world, double height, double font) {
  return ticks(world.low.y, world.high.y, std::clamp(height / (2.2 * font), 1.0, 10.0));
}

}  // namespace

double axis_room(const Box& world, double font) {
  // However high the drawing becomes, its labels have no more digits than those of ten ticks.
  return widest_label(ticks(world.low.y, world.high.y, 10.0), font) + 2.9 * font;
}

void draw_axes(Canvas& canvas, const View& v, double font, bool y_labels) {
  const Box& f = v.frame;
  const double mark = 0.35 * font;
  canvas.colour(ink::line);
  cairo_rectangle(canvas.cr(), f.low.x, f.low.y, f.width(), f.height());
  cairo_set_line_width(canvas.cr(), rule);
  cairo_stroke(canvas.cr());
  for (const Tick& t : ticks_across(v.world, f.width(), font)) {
    const double x = v.at({t.value, 0.0}).x;
    canvas.line({x, f.high.y}, {x, f.high.y + mark}, rule);
    canvas.text(typeset(t.label), {x, f.high.y + mark + 1.0 * font},
                {.size = font, .align = Align::centre});
  }
  for (const Tick& t : ticks_up(v.world, f.height(), font)) {
    const double y = v.at({0.0, t.value}).y;
    canvas.line({f.low.x - mark, y}, {f.low.x, y}, rule);
    if (!y_labels) continue;
    canvas.text(typeset(t.label), {f.low.x - mark - 0.25 * font, y + 0.36 * font},
                {.size = font, .align = Align::right});
  }
  canvas.text("x (m)", {0.5 * (f.low.x + f.high.x), f.high.y + mark + 2.4 * font},
              {.size = font, .align = Align::centre});
  if (!y_labels) return;
  canvas.text("y (m)",
              {f.low.x - axis_room(v.world, font) + 1.2 * font, 0.5 * (f.low.y + f.high.y)},
              {.size = font, .align = Align::centre, .upwards = true});
}

}  // namespace edda
