#include "report/curve_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>

#include "report/chart.hpp"

namespace edda {
namespace {

constexpr double letter = 8.0;               // pt
constexpr double dots = 10.0 * 25.4 / 72.0;  // pixels per point of a PNG
constexpr Colour failure{0.80, 0.25, 0.20}, ink_of_text{0.15, 0.15, 0.17};
constexpr std::array<Colour, 6> line_colours{{{0.12, 0.40, 0.71},
                                              {0.85, 0.45, 0.10},
                                              {0.20, 0.55, 0.30},
                                              {0.55, 0.30, 0.60},
                                              {0.45, 0.35, 0.25},
                                              {0.30, 0.30, 0.32}}};

/// The unit in which displacements up to `most` (m) are read well, and its length in m.
std::pair<const char*, double> unit_for(double most) {
  if (most >= 0.5) return {"m", 1.0};
  return most >= 1e-4 ? std::pair{"mm", 1e-3} : std::pair{"\u00b5m", 1e-6};
}

/// Names at the ends of the lines, moved apart where they would overlap.
void draw_names(Canvas& canvas, const Chart& chart, const CurvePicture& p, double unit,
                double at_x) {
  std::vector<std::pair<double, std::size_t>> ends;
  for (std::size_t k = 0; k < p.lines.size(); ++k) {
    const Vec2 end = p.lines[k].points.back();
    ends.emplace_back(chart.at(end.x / unit, end.y).y, k);
  }
  std::sort(ends.begin(), ends.end());
  double last = -1e9;
  for (const auto& [y, k] : ends) {
    last = std::max(y + 0.35 * letter, last + 1.2 * letter);
    canvas.colour(line_colours[k % line_colours.size()]);
    canvas.text(p.lines[k].name, {at_x, last}, {.size = letter});
  }
}

}  // namespace

Trouble plot_curve(const CurvePicture& p, const std::string& path) {
  constexpr double width = 330.0, height = 200.0;
  constexpr double left = 6.0 * letter, above = 3.0 * letter, below = 4.5 * letter;
  double furthest = 0.0, low = 0.0, high = 0.0;
  if (p.fails) {
    low = std::min(low, *p.fails);
    high = std::max(high, *p.fails);
  }
  for (const CurveLine& line : p.lines) {
    for (const Vec2 point : line.points) {
      furthest = std::max(furthest, point.x);
      low = std::min(low, point.y);
      high = std::max(high, point.y);
    }
  }
  const auto [unit, length] = unit_for(furthest);
  std::size_t longest = 0;
  for (const CurveLine& line : p.lines) longest = std::max(longest, line.name.size());
  const double right =
      letter * (1.5 + 0.62 * static_cast<double>(std::min<std::size_t>(longest, 30)));
  Canvas canvas(path, left + width + right, above + height + below, dots);
  const Box frame{{left, above}, {left + width, above + height}};
  const double margin = 0.06 * (high - low);
  Chart chart(canvas, frame,
              {{0.0, low == 0.0 ? 0.0 : low - margin},
               {furthest > 0.0 ? 1.04 * furthest / length : 1.0, high + margin}},
              letter);
  chart.draw_axes(fmt::format("displacement ({})", unit), p.axis);
  if (p.fails) {
    const Vec2 end = chart.at(0.0, *p.fails);
    canvas.colour(failure);
    canvas.line(end, {frame.high.x, end.y}, 0.6);
    canvas.text(fmt::format("fails at {:.4g}", *p.fails),
                {end.x + 0.6 * letter, end.y - 0.4 * letter}, {.size = letter, .halo = true});
  }
  for (std::size_t k = 0; k < p.lines.size(); ++k) {
    const Colour colour = line_colours[k % line_colours.size()];
    std::vector<Vec2> points = p.lines[k].points;
    for (Vec2& point : points) point.x /= length;
    chart.draw_line(points, 1.2, colour);
    chart.draw_point(points.back(), 1.8, colour);
  }
  draw_names(canvas, chart, p, length, frame.high.x + 0.6 * letter);
  canvas.colour(ink_of_text);
  canvas.text(p.title, {left, above - letter}, {.size = letter + 1.0, .bold = true});
  return canvas.finish();
}

}  // namespace edda
