// Monitors and convergence lines.
#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>

#include "report/labels.hpp"
#include "report/scene.hpp"

namespace edda {
namespace {

constexpr double radius = 1.8;  // pt

/// Both ends of a line as drawn; nothing where an end was excavated with its block.
std::optional<std::array<Vec2, 2>> ends_of(const Follower& follow, const PlotLine& line) {
  const Vec2 way = line.start[1] - line.start[0];
  // Ends lie on the walls; slightly beyond they are inside a block.
  const auto end = [&](Vec2 at, Vec2 beyond) {
    const std::optional<Vec2> now = follow(at);
    return now ? now : follow(at + beyond);
  };
  const auto a = end(line.start[0], -1e-3 * way), b = end(line.start[1], 1e-3 * way);
  if (!a || !b) return {};
  return std::array<Vec2, 2>{*a, *b};
}

/// The part of a line that lies in the frame, if any.
std::optional<std::array<Vec2, 2>> part_within(const Box& frame, Vec2 a, Vec2 b) {
  const Vec2 way = b - a;
  double from = 0.0, to = 1.0;
  // Each side clips the line to the part before it: at + s way <= 0.
  for (const auto& [at, by] :
       {std::pair{frame.low.x - a.x, -way.x}, std::pair{a.x - frame.high.x, way.x},
        std::pair{frame.low.y - a.y, -way.y}, std::pair{a.y - frame.high.y, way.y}}) {
    if (by > 0.0) to = std::min(to, -at / by);
    if (by < 0.0) from = std::max(from, -at / by);
    if (by == 0.0 && at > 0.0) return {};
  }
  if (from > to) return {};
  return std::array<Vec2, 2>{a + from * way, a + to * way};
}

/// Where two lines cross, if they do.
std::optional<Vec2> crossing(const std::array<Vec2, 2>& a, const std::array<Vec2, 2>& b) {
  const Vec2 u = a[1] - a[0], v = b[1] - b[0], w = b[0] - a[0];
  const double det = cross(u, v), along_a = cross(w, v), along_b = cross(w, u);
  const auto is_part = [&](double t) { return t / det >= 0.0 && t / det <= 1.0; };
  if (det == 0.0 || !is_part(along_a) || !is_part(along_b)) return {};
  return a[0] + along_a / det * u;
}

void draw_dashed(Canvas& canvas, Vec2 a, Vec2 b) {
  const double dash = 2.5;
  cairo_set_dash(canvas.cr(), &dash, 1, 0.0);
  canvas.line(a, b, 0.8);
  cairo_set_dash(canvas.cr(), nullptr, 0, 0.0);
}

void draw_point(Canvas& canvas, Vec2 p) {
  cairo_new_sub_path(canvas.cr());
  cairo_arc(canvas.cr(), p.x, p.y, radius, 0.0, 6.2831853);
  canvas.colour(ink::white);
  cairo_fill_preserve(canvas.cr());
  canvas.colour(ink::monitor);
  cairo_set_line_width(canvas.cr(), 0.9);
  cairo_stroke(canvas.cr());
}

}  // namespace

void draw_marks(Canvas& canvas, const PlotScene& s, const PlotOptions& options) {
  if (options.monitors.empty() && options.lines.empty()) return;
  const Follower follow(s.grid(), drawn_points(s.grid(), 0.0), s.points);
  Labels labels(s.view.frame, s.font);
  std::vector<std::pair<std::string, Vec2>> points;
  std::vector<std::pair<std::string, std::array<Vec2, 2>>> lines;
  for (const PlotLine& line : options.lines) {
    const auto ends = ends_of(follow, line);
    if (!ends) continue;
    const Vec2 a = s.view.at((*ends)[0]), b = s.view.at((*ends)[1]);
    canvas.colour(ink::monitor);
    const auto seen = part_within(s.view.frame, a, b);
    if (!seen) continue;
    draw_dashed(canvas, a, b);
    lines.emplace_back(line.name, *seen);
  }
  for (const PlotMonitor& m : options.monitors) {
    const auto now = follow.on_surface(m.start);
    if (!now) continue;
    const Vec2 p = s.view.at(*now);
    const Box& f = s.view.frame;
    if (p.x < f.low.x || p.x > f.high.x || p.y < f.low.y || p.y > f.high.y) continue;
    draw_point(canvas, p);
    labels.avoid(p, radius);
    points.emplace_back(m.name, p);
  }
  canvas.colour(ink::monitor);
  for (const auto& [name, at] : points) labels.write(canvas, name, {at}, radius);
  // Names of lines keep away from crossings, where it would be unclear to which line they belong.
  for (std::size_t i = 0; i < lines.size(); ++i) {
    for (std::size_t j = 0; j < i; ++j) {
      if (const auto at = crossing(lines[i].second, lines[j].second))
        labels.avoid(*at, 1.5 * s.font);
    }
  }
  for (const auto& [name, ends] : lines) {
    std::vector<Vec2> places;
    for (const double part : {0.5, 0.3, 0.7, 0.15, 0.85})
      places.push_back(ends[0] + part * (ends[1] - ends[0]));
    labels.write(canvas, name, places, 0.0);
  }
}

}  // namespace edda
