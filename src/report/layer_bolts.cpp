// Bolts: as recorded, with their load; else from the model, carried along by the blocks.
#include <algorithm>
#include <cmath>

#include "report/scene.hpp"

namespace edda {
namespace {

constexpr double plain_width = 1.2, widest = 4.0, thinnest = 0.5;  // pt

/// Recorded positions belong to the actual displacements; where these are drawn larger, bolts
/// follow the drawn blocks.
std::vector<Vec2> drawn_chain(const PlotScene& s, const Follower* follow, const BoltChain& bolt) {
  std::vector<Vec2> points;
  for (const Vec2 p : bolt.points) {
    const std::optional<Vec2> now = follow == nullptr ? p : (*follow)(p);
    points.push_back(s.view.at(now.value_or(p)));
  }
  return points;
}

void stroke(Canvas& canvas, const std::vector<Vec2>& points, double width) {
  cairo_t* cr = canvas.cr();
  for (std::size_t k = 0; k < points.size(); ++k) {
    if (k == 0) {
      cairo_move_to(cr, points[k].x, points[k].y);
    } else {
      cairo_line_to(cr, points[k].x, points[k].y);
    }
  }
  cairo_set_line_width(cr, width);
  cairo_stroke(cr);
}

Colour colour_of(const BoltChain& bolt) {
  return bolt.yielded || bolt.ruptured ? ink::tension : ink::bolt;
}

void draw_chain(Canvas& canvas, const BoltChain& bolt, const std::vector<Vec2>& points,
                const ArrowScale& scale) {
  canvas.colour(ink::white, 0.75);
  stroke(canvas, points, scale.per_unit > 0.0 ? thinnest + 1.0 : plain_width + 1.0);
  canvas.colour(colour_of(bolt));
  if (scale.per_unit == 0.0) return stroke(canvas, points, plain_width);
  for (std::size_t k = 0; k + 1 < points.size(); ++k) {
    const double force = 0.5 * (bolt.force[k] + bolt.force[k + 1]);
    canvas.line(points[k], points[k + 1], std::max(thinnest, scale.per_unit * std::abs(force)));
  }
}

/// Straight between the ends in the model, drawn piece by piece inside the blocks.
void draw_planned(Canvas& canvas, const PlotScene& s, const PlotOptions& options) {
  constexpr int pieces = 12;
  const Follower follow(s.grid(), drawn_points(s.grid(), 0.0), s.points);
  for (const auto& [from, to] : options.bolts) {
    std::vector<Vec2> points;
    for (int q = 0; q <= pieces; ++q) {
      // Slightly inside of the ends, which lie on faces.
      const double part = std::clamp(static_cast<double>(q) / pieces, 1e-3, 1.0 - 1e-3);
      if (const auto now = follow(from + part * (to - from))) points.push_back(s.view.at(*now));
    }
    canvas.colour(ink::white, 0.75);
    stroke(canvas, points, plain_width + 1.0);
    canvas.colour(ink::bolt);
    stroke(canvas, points, plain_width);
  }
}

}  // namespace

ArrowScale bolt_scale(const std::vector<PlotScene>& scenes) {
  double most = 0.0;
  for (const PlotScene& s : scenes) {
    if (!s.shot.bolts) continue;
    for (const BoltChain& bolt : *s.shot.bolts) {
      for (const double force : bolt.force) most = std::max(most, std::abs(force));
    }
  }
  if (most == 0.0) return {};
  return {widest / most, round_below(most)};
}

void draw_bolts(Canvas& canvas, const PlotScene& s, const PlotOptions& options,
                const ArrowScale& scale) {
  if (!s.shot.bolts) {
    if (!options.bolts.empty()) draw_planned(canvas, s, options);
    return;
  }
  std::optional<Follower> follow;
  if (s.exaggeration != 1.0) follow.emplace(s.grid(), drawn_points(s.grid(), 1.0), s.points);
  for (const BoltChain& bolt : *s.shot.bolts) {
    draw_chain(canvas, bolt, drawn_chain(s, follow ? &*follow : nullptr, bolt), scale);
  }
}

}  // namespace edda
