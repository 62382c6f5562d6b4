// The legend of a narrow page: below the drawings, the colours from left to right.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/legend.hpp"
#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr double bar_height = 1.1, bar_room = 4.9;  // in sizes of the font; with heading and ticks
constexpr double kind_row = 1.6, heading_row = 1.5, heading_line = 1.25;  // the same

}  // namespace

Legend::Rows Legend::rows_below(double width) const {
  Rows rows;
  double x = 0.0, y = 0.0, row = 0.0;
  for (const LegendKey& key : keys_) {
    if (x > 0.0 && x + this->width() > width) {
      x = 0.0;
      y += row;
      row = 0.0;
    }
    rows.places.push_back({x, y});
    row = std::max(row, key_height(key));
    x += this->width();
  }
  rows.height = y + row;
  return rows;
}

double Legend::colours_height_below(double width) const {
  if (!scale_.has_legend()) return 0.0;
  const double further =
      heading_line * font_ * (static_cast<double>(heading_below(width).size()) - 1.0);
  if (scale_.kind() == ScaleKind::numbers) return bar_room * font_ + further;
  const double in_a_row = std::max(1.0, std::floor(width / (0.5 * this->width())));
  const double rows = std::ceil(static_cast<double>(scale_.kinds().size()) / in_a_row);
  return (heading_row + rows * kind_row) * font_ + further;
}

std::vector<std::string> Legend::heading_below(double width) const {
  Canvas measure("", 1.0, 1.0, 1.0);
  return wrapped(measure, label_, font_, width);
}

double Legend::height_below(double width) const {
  return colours_height_below(width) + rows_below(width).height + 0.5 * font_;
}

void Legend::draw_below(Canvas& canvas, double left, double top, double width) const {
  if (scale_.has_legend()) {
    canvas.colour(ink::line);
    double y = top + 0.8 * font_;
    for (const std::string& line : heading_below(width)) {
      canvas.text(line, {left, y}, {.size = font_});
      y += heading_line * font_;
    }
    const double below = y + (heading_row - 0.8 - heading_line) * font_;
    if (scale_.kind() == ScaleKind::numbers) {
      draw_bar_across(canvas, left, below, width);
    } else {
      draw_kinds_across(canvas, left, below, width);
    }
  }
  const double keys_top = top + colours_height_below(width);
  const Rows rows = rows_below(width);
  for (std::size_t k = 0; k < keys_.size(); ++k) {
    draw_key(canvas, keys_[k], left + rows.places[k].x, keys_top + rows.places[k].y);
  }
}

void Legend::draw_kinds_across(Canvas& canvas, double left, double top, double width) const {
  const double step = 0.5 * this->width();
  Vec2 at{left, top};
  for (const std::size_t k : scale_.kinds()) {
    if (at.x > left && at.x + step > left + width) at = {left, at.y + kind_row * font_};
    draw_kind(canvas, k, at + Vec2{0.0, 0.9 * font_});
    at.x += step;
  }
}

void Legend::draw_bar_across(Canvas& canvas, double left, double top, double width) const {
  const double low = scale_.low(), high = scale_.high();
  if (!(high > low)) return draw_bar(canvas, left, top, top);
  const double point = 0.9 * font_;
  const Box bar{{left + (scale_.values_below() ? point : 0.0), top},
                {left + width - (scale_.values_above() ? point : 0.0), top + bar_height * font_}};
  paint_bar(canvas, bar, false);
  for (const Tick& t : ticks(low * factor_, high * factor_, bar.width() / (4.0 * font_))) {
    const double x = bar.low.x + (t.value / factor_ - low) / (high - low) * bar.width();
    canvas.line({x, bar.high.y}, {x, bar.high.y + 0.35 * font_}, rule);
    canvas.text(typeset(t.label), {x, bar.high.y + 1.3 * font_},
                {.size = font_, .align = Align::centre});
  }
}

}  // namespace edda
