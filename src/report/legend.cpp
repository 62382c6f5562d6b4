#include "report/legend.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr double columns = 10.0;    // width, in sizes of the font
constexpr double line_step = 1.25;  // from line to line, in sizes of the font
constexpr double least_bar = 7.5;   // height, in sizes of the font

using Sign = LegendKey::Sign;

std::string quantity(double value, const std::string& unit) {
  const ScaledUnit scaled = scaled_unit(unit, value);
  return fmt::format("{:.3g} {}", value * scaled.factor, scaled.name);
}

/// On an upright face at `a`, out to `b`.
void draw_pressure(Canvas& canvas, Vec2 a, Vec2 b, Colour colour, double font) {
  const double half = 0.35 * font;
  cairo_rectangle(canvas.cr(), a.x, a.y - half, b.x - a.x, 2.0 * half);
  canvas.colour(colour, pressure_fill);
  cairo_fill_preserve(canvas.cr());
  canvas.colour(colour);
  cairo_set_line_width(canvas.cr(), pressure_line);
  cairo_stroke(canvas.cr());
  canvas.colour(ink::line);
  canvas.line({a.x, a.y - half}, {a.x, a.y + half}, 2.0 * pressure_line);
}

/// Rows of a key: a sample on the left and what it means beside it.
class KeyRows {
 public:
  KeyRows(Canvas& canvas, double font, double left, double top, double sample)
      : canvas_(canvas), font_(font), left_(left), y_(top + 0.8 * font), sample_(sample) {}

  void title(const std::string& text) {
    canvas_.colour(ink::line);
    canvas_.text(text, {left_, y_}, {.size = font_});
  }
  /// draw(a, b): the sample, between these points.
  template <class Draw>
  void row(const std::string& text, Draw draw) {
    y_ += line_step * font_;
    const double middle = y_ - 0.35 * font_;
    draw(Vec2{left_, middle}, Vec2{left_ + sample_, middle});
    canvas_.colour(ink::line);
    canvas_.text(text, {left_ + sample_ + 0.6 * font_, y_}, {.size = font_});
  }
  void line(const std::string& text, Colour colour, double width) {
    row(text, [&](Vec2 a, Vec2 b) {
      canvas_.colour(colour);
      canvas_.line(a, b, width);
    });
  }
  void note(const std::string& text) {
    canvas_.text(text, {left_, y_ + line_step * font_}, {.size = font_});
  }

 private:
  Canvas& canvas_;
  double font_, left_, y_, sample_;
};

void draw_pressure_rows(Canvas& canvas, KeyRows& rows, const LegendKey& key,
                        const std::string& value, double font) {
  rows.row(value, [&](Vec2 a, Vec2 b) { draw_pressure(canvas, a, b, ink::pressure, font); });
  if (key.also_red) {
    rows.row("tension", [&](Vec2 a, Vec2 b) { draw_pressure(canvas, a, b, ink::tension, font); });
  }
  if (key.scale.longest > 0.0) {
    rows.note("cut at " + quantity(key.scale.longest / key.scale.per_unit, key.unit));
  }
}

void draw_stress_rows(Canvas& canvas, KeyRows& rows, const std::string& value) {
  rows.row("\u2212" + value, [&](Vec2 a, Vec2 b) {
    canvas.colour(ink::compression);
    canvas.line(a, b, 0.8);
  });
  rows.row("+" + value, [&](Vec2 a, Vec2 b) {
    canvas.colour(ink::tension);
    canvas.arrow(0.5 * (a + b), a, 0.8);
    canvas.arrow(0.5 * (a + b), b, 0.8);
  });
}

}  // namespace

std::vector<std::string> wrapped(Canvas& canvas, const std::string& text, double size, double width,
                                 bool bold) {
  std::vector<std::string> lines(1);
  std::string word;
  const auto put = [&] {
    const std::string longer = lines.back().empty() ? word : lines.back() + " " + word;
    if (lines.back().empty() || canvas.text_width(longer, size, bold) <= width) {
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

Legend::Legend(const ColourScale& scale, const ShownField& field,
               std::vector<std::string> kind_names, std::vector<LegendKey> keys, double font)
    : scale_(scale),
      field_(field),
      kind_names_(std::move(kind_names)),
      keys_(std::move(keys)),
      font_(font) {
  if (!scale_.has_legend()) return;
  label_ = field_.label;
  if (scale_.kind() == ScaleKind::numbers) {
    const ScaledUnit unit =
        scaled_unit(field_.unit, std::max(std::abs(scale_.low()), std::abs(scale_.high())));
    factor_ = unit.factor;
    if (!unit.name.empty()) {
      const bool has_brackets = label_.find('(') != std::string::npos;
      label_ += has_brackets ? ", " + unit.name : " (" + unit.name + ")";
    }
    // A value far beyond the bar has a unit of its own: 0.8 m beside a bar in um.
    const auto number = [&](double v) {
      const ScaledUnit own = scaled_unit(field_.unit, std::abs(v));
      const bool is_far = std::abs(v) * factor_ >= 1000.0 && own.factor != factor_;
      const std::string text = fmt::format("{:.3g}", v * (is_far ? own.factor : factor_) + 0.0);
      return typeset(is_far ? text + " " + own.name : text);
    };
    if (scale_.values_below()) label_ += ", from " + number(scale_.all().low);
    if (scale_.values_above()) label_ += ", up to " + number(scale_.all().high);
  }
  Canvas measure("", 1.0, 1.0, 1.0);
  heading_ = wrapped(measure, label_, font_, width());
}

bool Legend::is_empty() const {
  return !scale_.has_legend() && keys_.empty();
}

double Legend::width() const {
  return columns * font_;
}

double Legend::key_height(const LegendKey& key) const {
  double samples = key.sign == Sign::stress || key.also_red ? 2.0 : 1.0;
  if (key.sign == Sign::pressure) samples += 1.0;
  return (1.0 + samples) * line_step * font_ + 0.9 * font_;
}

double Legend::keys_height() const {
  double sum = 0.0;
  for (const LegendKey& key : keys_) sum += key_height(key);
  return sum;
}

double Legend::height() const {
  double sum = keys_height();
  if (!scale_.has_legend()) return sum;
  sum += static_cast<double>(heading_.size()) * line_step * font_;
  if (scale_.kind() == ScaleKind::kinds) {
    return sum + static_cast<double>(scale_.kinds().size()) * 1.6 * font_ + font_;
  }
  return sum + least_bar * font_ + (keys_.empty() ? 0.0 : 1.5 * font_);
}

void Legend::draw(Canvas& canvas, double left, double top, double bottom) const {
  // The keys are at the bottom; the colours take the remaining height.
  double y = bottom - keys_height();
  const double end = keys_.empty() ? bottom : y - 1.5 * font_;
  for (const LegendKey& key : keys_) {
    draw_key(canvas, key, left, y);
    y += key_height(key);
  }
  if (!scale_.has_legend()) return;
  const double below = draw_heading(canvas, left, top);
  if (scale_.kind() == ScaleKind::kinds) return draw_kinds(canvas, left, below);
  draw_bar(canvas, left, below, end);
}

double Legend::draw_heading(Canvas& canvas, double left, double top) const {
  canvas.colour(ink::line);
  double y = top + 0.8 * font_;
  for (const std::string& text : heading_) {
    canvas.text(text, {left, y}, {.size = font_});
    y += line_step * font_;
  }
  return y - 0.5 * font_;
}

void Legend::draw_kinds(Canvas& canvas, double left, double top) const {
  double y = top + font_;
  for (const std::size_t k : scale_.kinds()) {
    draw_kind(canvas, k, {left, y});
    y += 1.6 * font_;
  }
}

void Legend::draw_kind(Canvas& canvas, std::size_t kind, Vec2 at) const {
  cairo_rectangle(canvas.cr(), at.x, at.y - 0.8 * font_, font_, font_);
  canvas.colour(scale_.of(static_cast<double>(kind)));
  cairo_fill_preserve(canvas.cr());
  canvas.colour(ink::line);
  cairo_set_line_width(canvas.cr(), rule);
  cairo_stroke(canvas.cr());
  canvas.text(kind < kind_names_.size() ? kind_names_[kind] : fmt::format("{}", kind),
              at + Vec2{1.5 * font_, 0.0}, {.size = font_});
}

void Legend::draw_bar(Canvas& canvas, double left, double top, double bottom) const {
  if (!(scale_.high() > scale_.low())) {
    canvas.text(typeset(fmt::format("{:.4g}", scale_.low() * factor_ + 0.0)) + " everywhere",
                {left, top + font_}, {.size = font_});
    return;
  }
  const double point = 0.9 * font_;
  const Box bar{{left, top + (scale_.values_above() ? point : 0.3 * font_)},
                {left + 1.3 * font_, bottom - (scale_.values_below() ? point : 0.0)}};
  paint_bar(canvas, bar, true);
  draw_ticks(canvas, bar.high.x, bar, factor_);
}

void Legend::paint_bar(Canvas& canvas, const Box& bar, bool upwards) const {
  cairo_t* cr = canvas.cr();
  const double low = scale_.low(), high = scale_.high();
  const double length = upwards ? bar.height() : bar.width();
  // A point given by its distance along the bar and across it.
  const auto at = [&](double along, double across) {
    return upwards ? Vec2{bar.low.x + across * bar.width(), bar.high.y - along * length}
                   : Vec2{bar.low.x + along * length, bar.low.y + across * bar.height()};
  };
  // In as many steps as the eye can distinguish; each extends below the next ones, so that no gap
  // shows.
  constexpr int steps = 128;
  for (int k = 0; k < steps; ++k) {
    canvas.colour(scale_.of(low + (k + 0.5) / steps * (high - low)));
    const Vec2 a = at(static_cast<double>(k) / steps, 0.0), b = at(1.0, 1.0);
    cairo_rectangle(cr, a.x, a.y, b.x - a.x, b.y - a.y);
    cairo_fill(cr);
  }
  cairo_set_line_width(cr, rule);
  const auto tip = [&](double base, double beyond, double value) {
    const double peak = base + beyond * 0.9 * font_ / length;
    for (const Vec2 p : {at(base, 0.0), at(peak, 0.5), at(base, 1.0)}) cairo_line_to(cr, p.x, p.y);
    canvas.colour(scale_.of(value));
    cairo_fill_preserve(cr);
    canvas.colour(ink::line);
    cairo_stroke(cr);
  };
  if (scale_.values_above()) tip(1.0, 1.0, high);
  if (scale_.values_below()) tip(0.0, -1.0, low);
  canvas.colour(ink::line);
  cairo_rectangle(cr, bar.low.x, bar.low.y, bar.width(), bar.height());
  cairo_stroke(cr);
}

void Legend::draw_ticks(Canvas& canvas, double left, const Box& bar, double factor) const {
  const double low = scale_.low() * factor, high = scale_.high() * factor;
  const double count = std::clamp(bar.height() / (1.4 * font_), 1.0, 8.0);
  for (const Tick& t : ticks(low, high, count)) {
    const double y = bar.high.y - (t.value - low) / (high - low) * bar.height();
    canvas.line({left, y}, {left + 0.35 * font_, y}, rule);
    canvas.text(typeset(t.label), {left + 0.6 * font_, y + 0.36 * font_}, {.size = font_});
  }
}

void Legend::draw_key(Canvas& canvas, const LegendKey& key, double left, double top) const {
  const double reference = key.scale.reference, length = key.scale.per_unit * reference;
  const bool load = key.sign == Sign::bolt_load;
  const bool plain = key.sign == Sign::bolt || key.sign == Sign::joint || key.sign == Sign::cracks;
  KeyRows rows(canvas, font_, left, top, load || plain ? 2.4 * font_ : length);
  rows.title(key.name);
  const std::string value = reference > 0.0 ? quantity(reference, key.unit) : "none";
  const bool nothing =
      !(reference > 0.0) && (key.sign == Sign::pressure || key.sign == Sign::stress);
  if (nothing) return rows.row(value, [](Vec2, Vec2) {});
  const double bolt_line = load ? length : 1.2;
  switch (key.sign) {
    case Sign::vector:
    case Sign::force:
      rows.row(value, [&](Vec2 a, Vec2 b) {
        canvas.colour(key.sign == Sign::force ? ink::force : ink::vector);
        canvas.arrow(a, b, 0.6);
      });
      break;
    case Sign::pressure:
      draw_pressure_rows(canvas, rows, key, value, font_);
      break;
    case Sign::stress:
      draw_stress_rows(canvas, rows, value);
      break;
    case Sign::diagram:
      rows.row(value, [&](Vec2 a, Vec2 b) {
        canvas.colour(ink::bolt);
        canvas.line(a, b, 1.2);
      });
      break;
    case Sign::joint:
      rows.line("slip or open", ink::joint, joint_width);
      break;
    case Sign::cracks:
      rows.line("in tension", ink::tension, joint_width);
      rows.line("in shear", ink::compression, joint_width);
      break;
    case Sign::bolt:
    case Sign::bolt_load:
      rows.line(load ? value : "below yield", ink::bolt, bolt_line);
      if (key.also_red) rows.line("yielded", ink::tension, bolt_line);
      break;
  }
}

}  // namespace edda
