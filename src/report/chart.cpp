#include "report/chart.hpp"

#include <algorithm>
#include <numbers>

#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr Colour dark{0.15, 0.15, 0.17}, pale_grid{0.90, 0.90, 0.90};
constexpr double tick_length = 3.0;  // pt

}  // namespace

void Chart::draw_axes(const std::string& x, const std::string& y) {
  const double wide = std::max(2.0, frame_.width() / (7.0 * font_));
  for (const Tick& t : ticks(world_.low.x, world_.high.x, wide)) {
    const Vec2 foot = at(t.value, world_.low.y);
    canvas_.colour(pale_grid);
    canvas_.line(foot, {foot.x, frame_.low.y}, rule);
    if (x.empty()) continue;
    canvas_.colour(dark);
    canvas_.line(foot, {foot.x, foot.y + tick_length}, rule);
    canvas_.text(typeset(t.label), {foot.x, foot.y + tick_length + font_},
                 {.size = font_, .align = Align::centre});
  }
  for (const Tick& t :
       ticks(world_.low.y, world_.high.y, std::max(2.0, frame_.height() / (3.0 * font_)))) {
    const Vec2 foot = at(world_.low.x, t.value);
    canvas_.colour(pale_grid);
    canvas_.line(foot, {frame_.high.x, foot.y}, rule);
    if (y.empty()) continue;
    canvas_.colour(dark);
    canvas_.line(foot, {foot.x - tick_length, foot.y}, rule);
    canvas_.text(typeset(t.label), {foot.x - tick_length - 2.0, foot.y + 0.35 * font_},
                 {.size = font_, .align = Align::right});
  }
  canvas_.colour(dark);
  for (const double height : {frame_.low.y, frame_.high.y})
    canvas_.line({frame_.low.x, height}, {frame_.high.x, height}, rule);
  for (const double place : {frame_.low.x, frame_.high.x})
    canvas_.line({place, frame_.low.y}, {place, frame_.high.y}, rule);
  const double middle = 0.5 * (frame_.low.x + frame_.high.x);
  canvas_.text(x, {middle, frame_.high.y + tick_length + 2.4 * font_},
               {.size = font_, .align = Align::centre});
  canvas_.text(y, {frame_.low.x - 4.4 * font_, 0.5 * (frame_.low.y + frame_.high.y)},
               {.size = font_, .align = Align::centre, .upwards = true});
}

void Chart::draw_right_axis(const std::string& name, double most) {
  canvas_.colour(dark);
  for (const Tick& t : ticks(0.0, most, std::max(2.0, frame_.height() / (3.0 * font_)))) {
    const double y = frame_.high.y - t.value / most * frame_.height();
    canvas_.line({frame_.high.x, y}, {frame_.high.x + tick_length, y}, rule);
    canvas_.text(typeset(t.label), {frame_.high.x + tick_length + 2.0, y + 0.35 * font_},
                 {.size = font_});
  }
  canvas_.text(name, {frame_.high.x + 3.6 * font_, 0.5 * (frame_.low.y + frame_.high.y)},
               {.size = font_, .align = Align::centre, .upwards = true});
}

void Chart::draw_bar(double low, double high, double value, Colour colour) {
  const Vec2 a = at(low, world_.low.y), b = at(high, value);
  canvas_.colour(colour);
  cairo_rectangle(canvas_.cr(), a.x, b.y, b.x - a.x, a.y - b.y);
  cairo_fill(canvas_.cr());
}

void Chart::draw_line(const std::vector<Vec2>& points, double width, Colour colour) {
  canvas_.colour(colour);
  cairo_set_line_width(canvas_.cr(), width);
  for (std::size_t i = 0; i < points.size(); ++i) {
    const Vec2 p = at(points[i].x, points[i].y);
    (i == 0 ? cairo_move_to : cairo_line_to)(canvas_.cr(), p.x, p.y);
  }
  cairo_stroke(canvas_.cr());
}

void Chart::draw_band(const std::vector<Vec2>& low, const std::vector<Vec2>& high, Colour colour) {
  canvas_.colour(colour);
  for (std::size_t i = 0; i < low.size(); ++i) {
    const Vec2 p = at(low[i].x, low[i].y);
    (i == 0 ? cairo_move_to : cairo_line_to)(canvas_.cr(), p.x, p.y);
  }
  for (std::size_t i = high.size(); i-- > 0;) {
    const Vec2 p = at(high[i].x, high[i].y);
    cairo_line_to(canvas_.cr(), p.x, p.y);
  }
  cairo_fill(canvas_.cr());
}

void Chart::draw_point(Vec2 point, double radius, Colour colour) {
  const Vec2 p = at(point.x, point.y);
  canvas_.colour(colour);
  cairo_arc(canvas_.cr(), p.x, p.y, radius, 0.0, 2.0 * std::numbers::pi);
  cairo_fill(canvas_.cr());
}

void Chart::draw_upright(double x, Colour colour) {
  if (x < world_.low.x || x > world_.high.x) return;
  canvas_.colour(colour);
  canvas_.line(at(x, world_.low.y), at(x, world_.high.y), 2.0 * rule);
}

}  // namespace edda
