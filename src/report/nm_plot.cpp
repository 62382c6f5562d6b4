#include "report/nm_plot.hpp"

#include <algorithm>
#include <cmath>

#include "report/canvas.hpp"
#include "report/chart.hpp"
#include "report/legend.hpp"
#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr Colour dark{0.15, 0.15, 0.17}, zero{0.60, 0.60, 0.62};
constexpr double panel_height = 24.0;   // in sizes of the font
constexpr double dot = 1.6, rim = 1.0;  // pt

/// What all panels show: moment in x and thrust in y.
struct Extent {
  double moment = 0.0, least = 0.0, most = 0.0;
  void grow(const std::vector<Vec2>& points) {
    for (const Vec2 p : points) {
      moment = std::max(moment, std::abs(p.y));
      least = std::min(least, p.x);
      most = std::max(most, p.x);
    }
  }
};

Extent extent_of(const NmPanel& panel) {
  Extent e;
  for (const NmPoints& at : panel.times) {
    e.grow(at.sections);
    e.grow(at.strength);
    e.grow(at.residual);
  }
  if (e.moment == 0.0) e.moment = 1.0;
  if (!(e.most > e.least)) e.most = e.least + 1.0;
  return e;
}

/// Times go from dark to light.
Colour colour_of(const NmPanel& panel, std::size_t k) {
  const double last = static_cast<double>(std::max<std::size_t>(panel.times.size(), 2) - 1);
  return sequential(0.85 * static_cast<double>(k) / last);
}

/// The outlines that panels show beside the sections, thick and thin.
struct Outline {
  const char* name;
  std::vector<Vec2> NmPoints::*points;
  double width;
};
constexpr Outline outlines[] = {{"strength", &NmPoints::strength, rim},
                                {"residual", &NmPoints::residual, 0.4 * rim}};

/// Whether the legend has to tell the outlines apart.
bool has_residual(const NmPanel& panel) {
  return std::any_of(panel.times.begin(), panel.times.end(),
                     [](const NmPoints& at) { return !at.residual.empty(); });
}

/// Beside the panel: the times, and what its outlines are.
void draw_legend(Canvas& canvas, const Box& frame, const NmPanel& panel, double font) {
  const double x = frame.high.x + 1.2 * font;
  double y = frame.low.y + font;
  const auto name = [&](const std::string& text) {
    canvas.colour(dark);
    canvas.text(text, {x + font, y}, {.size = font});
    y += 1.3 * font;
  };
  for (std::size_t k = 0; k < panel.times.size(); ++k) {
    canvas.colour(colour_of(panel, k));
    cairo_arc(canvas.cr(), x, y - 0.3 * font, 2.0 * dot, 0.0, 6.3);
    cairo_fill(canvas.cr());
    name(panel.times[k].name);
  }
  if (!has_residual(panel)) return;
  for (const Outline& outline : outlines) {
    canvas.colour(dark);
    canvas.line({x - 0.5 * font, y - 0.3 * font}, {x + 0.5 * font, y - 0.3 * font}, outline.width);
    name(outline.name);
  }
}

void draw_panel(Canvas& canvas, const Box& frame, const NmPanel& panel, double font) {
  const Extent e = extent_of(panel);
  const ScaledUnit force = scaled_unit("N", std::max(e.most, -e.least)),
                   couple = scaled_unit("N m", e.moment);
  const double room = 0.06 * (e.most - e.least);
  Chart chart(canvas, frame,
              {{-1.08 * e.moment * couple.factor, (e.least - room) * force.factor},
               {1.08 * e.moment * couple.factor, (e.most + room) * force.factor}},
              font);
  chart.draw_axes("moment (" + couple.name + "), positive with tension at the wall",
                  "thrust (" + force.name + ")");
  const auto scaled = [&](const std::vector<Vec2>& points) {
    std::vector<Vec2> at;
    for (const Vec2 p : points) at.push_back({p.y * couple.factor, p.x * force.factor});
    return at;
  };
  chart.draw_upright(0.0, zero);
  canvas.colour(zero);
  canvas.line({frame.low.x, chart.at(0.0, 0.0).y}, {frame.high.x, chart.at(0.0, 0.0).y},
              2.0 * rule);
  for (std::size_t k = 0; k < panel.times.size(); ++k) {
    for (const Outline& outline : outlines) {
      std::vector<Vec2> round = scaled(panel.times[k].*outline.points);
      if (round.empty()) continue;
      round.push_back(round.front());
      chart.draw_line(round, outline.width, colour_of(panel, k));
    }
  }
  for (std::size_t k = 0; k < panel.times.size(); ++k) {
    for (const Vec2 p : scaled(panel.times[k].sections))
      chart.draw_point(p, dot, colour_of(panel, k));
  }
  draw_legend(canvas, frame, panel, font);
  canvas.colour(dark);
  canvas.text(panel.lining, {frame.low.x, frame.low.y - 0.5 * font}, {.size = font, .bold = true});
}

}  // namespace

Trouble plot_nm(const NmPicture& p, const std::string& path) {
  const double f = p.paper.font, left = 6.0 * f, above = 2.0 * f, below = 4.0 * f;
  double names = 0.0;
  std::vector<std::string> title;
  {
    Canvas measure("", 1.0, 1.0, 1.0);
    for (const NmPanel& panel : p.panels) {
      for (const NmPoints& at : panel.times)
        names = std::max(names, measure.text_width(at.name, f));
      if (!has_residual(panel)) continue;
      for (const Outline& outline : outlines)
        names = std::max(names, measure.text_width(outline.name, f));
    }
    title = wrapped(measure, p.title, 1.2 * f, p.paper.width - 2.0 * f, true);
  }
  const double right = p.paper.width - std::min(names, 0.3 * p.paper.width) - 3.5 * f,
               top = f * (0.6 + 1.5 * static_cast<double>(title.size())),
               panel = above + panel_height * f + below;
  Canvas canvas(path, p.paper.width, top + panel * static_cast<double>(p.panels.size()),
                p.paper.pixels_per_point);
  canvas.colour(dark);
  for (std::size_t k = 0; k < title.size(); ++k)
    canvas.text(title[k], {0.5 * p.paper.width, f * (0.6 + 1.5 * static_cast<double>(k + 1))},
                {.size = 1.2 * f, .align = Align::centre, .bold = true});
  for (std::size_t k = 0; k < p.panels.size(); ++k) {
    const double y = top + panel * static_cast<double>(k) + above;
    draw_panel(canvas, {{left, y}, {right, y + panel_height * f}}, p.panels[k], f);
  }
  return canvas.finish();
}

}  // namespace edda
