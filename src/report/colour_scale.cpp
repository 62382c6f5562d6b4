#include "report/colour_scale.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr Colour ink{0.12, 0.12, 0.14};
constexpr Colour plain_block{0.87, 0.85, 0.80};
constexpr std::size_t most_kinds = 12;

/// Breaks a label into lines no wider than `width` px.
std::vector<std::string> wrapped(Canvas& canvas, const std::string& text, double size,
                                 double width) {
  std::vector<std::string> lines(1);
  std::string word;
  auto put = [&] {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || canvas.text_width(longer, size) <= width) {
      lines.back() = longer;
    } else {
      lines.push_back(word);
    }
    word.clear();
  };
  for (const char c : text) {
    if (c == ' ') {
      put();
    } else {
      word += c;
    }
  }
  put();
  return lines;
}

}  // namespace

ColourScale::ColourScale(const ShownField& field, const std::vector<bool>& counted)
    : kind_(field.kind) {
  bool any = false;
  for (std::size_t c = 0; c < field.values.size(); ++c) {
    const double v = field.values[c];
    if (!counted[c] || !std::isfinite(v)) continue;
    low_ = any ? std::min(low_, v) : v;
    high_ = any ? std::max(high_, v) : v;
    any = true;
  }
  if (kind_ == ScaleKind::kinds) {
    for (std::size_t c = 0; c < field.values.size(); ++c) {
      if (counted[c] && field.values[c] >= 0.0)
        kinds_.push_back(static_cast<std::size_t>(field.values[c]));
    }
    std::sort(kinds_.begin(), kinds_.end());
    kinds_.erase(std::unique(kinds_.begin(), kinds_.end()), kinds_.end());
    many_kinds_ = kinds_.size() > most_kinds;
    return;
  }
  // Rounding about zero, as before anything moves, is no range to paint.
  const double size = std::max(std::abs(low_), std::abs(high_));
  if (high_ - low_ <= 1e-9 * size) {
    if (low_ > 0.0) low_ = 0.0;
    if (high_ < 0.0) high_ = 0.0;
  }
  two_sided_ = low_ < -1e-3 * size && high_ > 1e-3 * size;
  if (two_sided_) {
    low_ = -size;
    high_ = size;
  }
}

Colour ColourScale::of(double value) const {
  if (kind_ == ScaleKind::plain || !std::isfinite(value)) return plain_block;
  if (kind_ == ScaleKind::kinds) return kind_colour(static_cast<std::size_t>(std::max(value, 0.0)));
  if (!(high_ > low_)) return two_sided_ ? diverging(0.5) : sequential(0.0);
  const double s = (value - low_) / (high_ - low_);
  return two_sided_ ? diverging(s) : sequential(s);
}

void ColourScale::draw_legend(Canvas& canvas, const Layout& l, const ShownField& field,
                              const std::vector<std::string>& kind_names) const {
  if (!has_legend()) return;
  if (kind_ == ScaleKind::numbers) return draw_bar(canvas, l, field);
  const double x = l.frame.high.x + 30.0 * l.unit, size = 22.0 * l.unit;
  double y = l.frame.low.y + size;
  canvas.colour(ink);
  for (const std::string& line : wrapped(canvas, field.label, size, l.width - x - 10.0 * l.unit)) {
    canvas.text(line, {x, y}, size, Align::left);
    y += 1.25 * size;
  }
  for (const std::size_t k : kinds_) {
    y += 36.0 * l.unit;
    cairo_rectangle(canvas.cr(), x, y - 0.8 * size, size, size);
    canvas.colour(kind_colour(k));
    cairo_fill_preserve(canvas.cr());
    canvas.colour(ink);
    cairo_set_line_width(canvas.cr(), l.unit);
    cairo_stroke(canvas.cr());
    canvas.text(k < kind_names.size() ? kind_names[k] : fmt::format("{}", k), {x + 1.5 * size, y},
                size, Align::left);
  }
}

void ColourScale::draw_bar(Canvas& canvas, const Layout& l, const ShownField& field) const {
  const double u = l.unit, size = 20.0 * u, x = l.frame.high.x + 30.0 * u, wide = 28.0 * u;
  const ScaledUnit unit = scaled_unit(field.unit, std::max(std::abs(low_), std::abs(high_)));
  const std::string label = unit.name.empty() ? field.label : field.label + ", " + unit.name;
  const auto lines = wrapped(canvas, label, size, l.width - x - 10.0 * u);
  double y = l.frame.low.y + size;
  canvas.colour(ink);
  for (const std::string& line : lines) {
    canvas.text(line, {x, y}, size, Align::left);
    y += 1.25 * size;
  }
  const double top = y, bottom = l.frame.high.y;
  if (!(high_ > low_)) {
    canvas.text(fmt::format("{:.4g} everywhere", low_ * unit.factor + 0.0), {x, y + size}, size,
                Align::left);
    return;
  }
  const int rows = std::max(2, static_cast<int>(bottom - top));
  for (int r = 0; r < rows; ++r) {
    const double s = 1.0 - (r + 0.5) / rows;
    canvas.colour(of(low_ + s * (high_ - low_)));
    cairo_rectangle(canvas.cr(), x, top + (bottom - top) * r / rows, wide,
                    (bottom - top) / rows + 0.5);
    cairo_fill(canvas.cr());
  }
  canvas.colour(ink);
  cairo_rectangle(canvas.cr(), x, top, wide, bottom - top);
  cairo_set_line_width(canvas.cr(), 1.2 * u);
  cairo_stroke(canvas.cr());
  for (const Tick& t : ticks(low_ * unit.factor, high_ * unit.factor, 6)) {
    const double at = bottom - (t.value / unit.factor - low_) / (high_ - low_) * (bottom - top);
    canvas.line({x + wide, at}, {x + wide + 7.0 * u, at}, 1.2 * u);
    canvas.text(t.label, {x + wide + 12.0 * u, at + 0.36 * size}, size, Align::left);
  }
}

}  // namespace edda
