#include "report/history_plot.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

#include "report/canvas.hpp"
#include "report/legend.hpp"
#include "report/peaks.hpp"
#include "report/scene.hpp"
#include "report/ticks.hpp"

namespace edda {
namespace {

constexpr double line_width = 1.0;     // pt
constexpr double panel_height = 13.0;  // in sizes of the font

// Okabe and Ito's colours, which the colour-blind can distinguish, without the yellow; dashes
// distinguish lines in grey.
constexpr std::array<Colour, 7> line_colours{{{0.000, 0.447, 0.698},
                                              {0.835, 0.369, 0.000},
                                              {0.000, 0.620, 0.451},
                                              {0.800, 0.475, 0.655},
                                              {0.120, 0.120, 0.140},
                                              {0.337, 0.706, 0.914},
                                              {0.902, 0.624, 0.000}}};
constexpr Colour stage_colour{0.55, 0.55, 0.55}, grid_colour{0.90, 0.90, 0.90};

/// Values to heights, linear or logarithmic.
struct Axis {
  bool logarithmic = false;
  double low = 0.0, high = 1.0;  ///< of the values, or of their logarithms; in the unit shown
  double factor = 1.0;           ///< from SI to the unit shown
  std::string label;
  double position(double value) const {
    return ((logarithmic ? std::log10(value) : value * factor) - low) / (high - low);
  }
  bool has(double value) const { return std::isfinite(value) && (!logarithmic || value > 0.0); }
};

/// The range of the rows that are shown, or the one that was given.
Axis axis_of(const HistoryPanel& panel, const std::vector<double>& time,
             const std::optional<Vec2>& span, const std::optional<Vec2>& range) {
  double least = 1e300, most = -1e300, least_positive = 1e300;
  for (const Column* line : panel.lines) {
    for (std::size_t r = 0; r < line->values.size(); ++r) {
      const double v = line->values[r];
      if (!std::isfinite(v)) continue;
      if (span && r < time.size() && (time[r] < span->x || time[r] > span->y)) continue;
      least = std::min(least, v);
      most = std::max(most, v);
      if (v > 0.0) least_positive = std::min(least_positive, v);
    }
  }
  Axis axis;
  axis.label = panel.label;
  if (range) {
    least = range->x;
    most = range->y;
  }
  if (!(most >= least)) return axis;
  const ScaledUnit unit = scaled_unit(panel.unit, std::max(std::abs(least), std::abs(most)));
  if (!unit.name.empty()) axis.label += " (" + unit.name + ")";
  axis.logarithmic =
      panel.unit.empty() && least >= 0.0 && most > 1e3 * least_positive && (!range || least > 0.0);
  if (range) {
    axis.factor = axis.logarithmic ? 1.0 : unit.factor;
    axis.low = axis.logarithmic ? std::log10(least) : least * unit.factor;
    axis.high = axis.logarithmic ? std::log10(most) : most * unit.factor;
    return axis;
  }
  if (axis.logarithmic) {
    axis.low = std::floor(std::log10(least_positive));
    axis.high = std::ceil(std::log10(most));
    return axis;
  }
  axis.factor = unit.factor;
  axis.low = std::min(least, 0.0 < least && least < 0.5 * most ? 0.0 : least) * unit.factor;
  axis.high = most * unit.factor;
  if (!(axis.high > axis.low)) axis.low -= 0.5, axis.high += 0.5;
  const double margin = 0.05 * (axis.high - axis.low);
  if (axis.low != 0.0) axis.low -= margin;
  axis.high += margin;
  return axis;
}

std::vector<Tick> ticks_of(const Axis& axis, double count) {
  if (!axis.logarithmic) return ticks(axis.low, axis.high, count);
  std::vector<Tick> all;
  const int every = std::max(1, static_cast<int>(std::ceil((axis.high - axis.low) / count)));
  const int first = static_cast<int>(std::ceil(axis.low - 1e-9));
  for (int p = first; p <= axis.high + 1e-9; p += every) {
    all.push_back({static_cast<double>(p), fmt::format("1e{}", p)});
  }
  return all;
}

/// Heights of labels, as near as possible to `wanted`, at least `apart` from each other, within
/// [top, bottom] as far as there is room; in the order given.
std::vector<double> spread(const std::vector<double>& wanted, double apart, double top,
                           double bottom) {
  std::vector<std::size_t> order(wanted.size());
  std::iota(order.begin(), order.end(), std::size_t{0});
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return wanted[a] < wanted[b]; });
  std::vector<double> placed(wanted.size());
  double next = top;
  for (const std::size_t i : order) {
    placed[i] = std::max(wanted[i], next);
    next = placed[i] + apart;
  }
  double last = bottom;
  for (std::size_t k = order.size(); k-- > 0;) {
    const std::size_t i = order[k];
    placed[i] = std::min(placed[i], last);
    last = placed[i] - apart;
  }
  return placed;
}

/// 1, 2 and 5 times powers of ten at their logarithms within [low, high]; powers alone where that
/// is much more than `count`: these labels are short.
std::vector<Tick> ticks_of_ratios(double low, double high, double count) {
  std::vector<Tick> all, powers;
  for (double p = std::floor(low); p <= high; p += 1.0) {
    for (const double digit : {1.0, 2.0, 5.0}) {
      const double at = p + std::log10(digit);
      if (at < low - 1e-9 || at > high + 1e-9) continue;
      all.push_back({at, fmt::format("{:g}", digit * std::pow(10.0, p))});
      if (digit == 1.0) powers.push_back(all.back());
    }
  }
  return static_cast<double>(all.size()) > 1.5 * count ? powers : all;
}

class HistoryPage {
 public:
  HistoryPage(const HistoryPicture& picture, const std::string& path)
      : picture_(picture), across_(picture.time), f_(picture.paper.font) {
    if (picture.ratios) {
      for (double& x : across_) x = std::log10(x);
    }
    for (const HistoryPanel& panel : picture.panels) {
      axes_.push_back(axis_of(panel, picture.time, picture.span, picture.range));
      panel_heights_.push_back(
          f_ * std::max(panel_height, 1.2 * static_cast<double>(panel.lines.size()) + 2.0));
    }
    measure();
    canvas_.emplace(path, picture.paper.width, height_, picture.paper.pixels_per_point);
  }

  Trouble draw() {
    draw_title();
    double y = top_;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      const Box frame{{left_, y}, {right_, y + panel_heights_[k]}};
      draw_panel(k, frame);
      y = frame.high.y + gap();
    }
    return canvas_->finish();
  }

 private:
  double gap() const { return 1.2 * f_; }
  double x_of(double time) const {
    return left_ + (right_ - left_) * (time - first_) / (last_ - first_);
  }

  void measure() {
    Canvas canvas("", 1.0, 1.0, 1.0);
    double names = 0.0, labels = 0.0;
    for (std::size_t k = 0; k < axes_.size(); ++k) {
      for (const Column* line : picture_.panels[k].lines) {
        names = std::max(names, canvas.text_width(line->name, f_));
      }
      for (const Tick& t : ticks_of(axes_[k], tick_count(k))) {
        labels = std::max(labels, canvas.text_width(typeset(t.label), f_));
      }
    }
    title_ = wrapped(canvas, picture_.title, 1.2 * f_, picture_.paper.width - 2.0 * f_, true);
    left_ = labels + 3.4 * f_;
    right_ = picture_.paper.width - names - 2.2 * f_;
    top_ = f_ *
           (1.2 + 1.5 * static_cast<double>(title_.size()) + (picture_.stages.empty() ? 0.0 : 1.4));
    height_ = top_ + 3.6 * f_ - gap();
    for (const double h : panel_heights_) height_ += h + gap();
    if (!across_.empty()) {
      first_ = across_.front();
      last_ = across_.back();
    }
    if (picture_.span) {
      first_ = picture_.span->x;
      last_ = picture_.span->y;
    }
    if (!(last_ > first_)) last_ = first_ + 1.0;
    // Rows that are shown, and one more on each side, so that the lines continue to the edge.
    const auto from = std::lower_bound(across_.cbegin(), across_.cend(), first_);
    const auto to = std::upper_bound(from, across_.cend(), last_);
    row_begin_ = from == across_.cbegin() ? from : from - 1;
    row_end_ = to == across_.cend() ? to : to + 1;
  }

  double tick_count(std::size_t k) const { return panel_heights_[k] / (2.2 * f_); }

  void draw_title() {
    canvas_->colour(ink::line);
    double y = 0.6 * f_;
    for (const std::string& line : title_) {
      y += 1.5 * f_;
      canvas_->text(line, {0.5 * picture_.paper.width, y},
                    {.size = 1.2 * f_, .align = Align::centre, .bold = true});
    }
  }

  void draw_panel(std::size_t k, const Box& frame) {
    draw_grid(k, frame);
    draw_stages(k, frame);
    draw_lines(k, frame);
    canvas_->colour(ink::line);
    cairo_rectangle(canvas_->cr(), frame.low.x, frame.low.y, frame.width(), frame.height());
    cairo_set_line_width(canvas_->cr(), rule);
    cairo_stroke(canvas_->cr());
    draw_time_axis(frame, k + 1 == axes_.size());
  }

  void draw_grid(std::size_t k, const Box& frame) {
    const Axis& axis = axes_[k];
    for (const Tick& t : ticks_of(axis, tick_count(k))) {
      const double y =
          frame.high.y - frame.height() * (t.value - axis.low) / (axis.high - axis.low);
      canvas_->colour(grid_colour);
      canvas_->line({frame.low.x, y}, {frame.high.x, y}, rule);
      canvas_->colour(ink::line);
      canvas_->line({frame.low.x - 0.35 * f_, y}, {frame.low.x, y}, rule);
      canvas_->text(typeset(t.label), {frame.low.x - 0.6 * f_, y + 0.36 * f_},
                    {.size = f_, .align = Align::right});
    }
    canvas_->text(axis.label, {1.4 * f_, 0.5 * (frame.low.y + frame.high.y)},
                  {.size = f_, .align = Align::centre, .upwards = true});
  }

  /// Lines at the ends of stages; names above the first panel, where they fit.
  void draw_stages(std::size_t k, const Box& frame) {
    for (std::size_t i = 0; i < picture_.stages.size(); ++i) {
      const StageSpan& stage = picture_.stages[i];
      const double from = std::max(x_of(stage.start), left_),
                   to = std::min(x_of(stage.end), right_);
      if (!(from < to)) continue;
      if (i + 1 < picture_.stages.size() && to < right_) {
        canvas_->colour(stage_colour);
        canvas_->line({to, frame.low.y}, {to, frame.high.y}, rule);
      }
      if (k > 0) continue;
      const std::string number = fmt::format("{}", i + 1);
      std::string name = stage.name.empty() ? number : stage.name;
      if (canvas_->text_width(name, f_) > to - from - 0.4 * f_) name = number;
      if (canvas_->text_width(name, f_) > to - from - 0.4 * f_) continue;
      canvas_->colour(ink::line);
      canvas_->text(name, {0.5 * (from + to), frame.low.y - 0.5 * f_},
                    {.size = f_, .align = Align::centre});
    }
  }

  void draw_lines(std::size_t k, const Box& frame) {
    const std::vector<const Column*>& lines = picture_.panels[k].lines;
    std::vector<double> ends;
    cairo_save(canvas_->cr());
    cairo_rectangle(canvas_->cr(), frame.low.x, frame.low.y - line_width, frame.width(),
                    frame.height() + 2.0 * line_width);
    cairo_clip(canvas_->cr());
    for (std::size_t i = 0; i < lines.size(); ++i) {
      canvas_->colour(line_colours[i % line_colours.size()]);
      ends.push_back(draw_line(lines[i]->values, axes_[k], frame, i / line_colours.size()));
    }
    cairo_restore(canvas_->cr());
    const std::vector<double> heights = spread(ends, 1.15 * f_, frame.low.y, frame.high.y);
    for (std::size_t i = 0; i < lines.size(); ++i) {
      canvas_->colour(line_colours[i % line_colours.size()]);
      const Vec2 at{frame.high.x + 1.2 * f_, heights[i]};
      canvas_->line({frame.high.x + 0.2 * f_, ends[i]}, {at.x - 0.2 * f_, at.y}, rule);
      canvas_->text(lines[i]->name, at + Vec2{0.0, 0.36 * f_}, {.size = f_});
    }
  }

  /// Returns the height of its end. `round`: number of times that all colours have been used
  /// before.
  double draw_line(const std::vector<double>& values, const Axis& axis, const Box& frame,
                   std::size_t round) {
    cairo_t* cr = canvas_->cr();
    const std::vector<double> time(row_begin_, row_end_);
    const auto first = row_begin_ - across_.cbegin();
    const std::vector<double> shown(values.begin() + first,
                                    values.begin() + first + std::ssize(time));
    double end = frame.high.y;
    bool drawing = false;
    constexpr double slivers_per_point = 4.0;
    const auto slivers = static_cast<std::size_t>(slivers_per_point * (right_ - left_)) + 1;
    for (const std::size_t r : rows_with_peaks(time, shown, slivers)) {
      if (!axis.has(shown[r])) {
        drawing = false;
        continue;
      }
      const double x = x_of(time[r]), y = frame.high.y - frame.height() * axis.position(shown[r]);
      if (time[r] <= last_) end = std::clamp(y, frame.low.y, frame.high.y);
      if (drawing) {
        cairo_line_to(cr, x, y);
      } else {
        cairo_move_to(cr, x, y);
      }
      drawing = true;
    }
    const double dash = 2.5 * static_cast<double>(round);
    if (round > 0) cairo_set_dash(cr, &dash, 1, 0.0);
    cairo_set_line_width(cr, line_width);
    cairo_stroke(cr);
    cairo_set_dash(cr, nullptr, 0, 0.0);
    return end;
  }

  void draw_time_axis(const Box& frame, bool labels) {
    const double count = frame.width() / (6.0 * f_);
    canvas_->colour(ink::line);
    for (const Tick& t :
         picture_.ratios ? ticks_of_ratios(first_, last_, count) : ticks(first_, last_, count)) {
      const double x = x_of(t.value);
      canvas_->line({x, frame.high.y}, {x, frame.high.y + 0.35 * f_}, rule);
      if (!labels) continue;
      canvas_->text(typeset(t.label), {x, frame.high.y + 1.35 * f_},
                    {.size = f_, .align = Align::centre});
    }
    if (!labels) return;
    canvas_->text(typeset(picture_.across),
                  {0.5 * (frame.low.x + frame.high.x), frame.high.y + 2.75 * f_},
                  {.size = f_, .align = Align::centre});
  }

  const HistoryPicture& picture_;
  std::vector<double> across_;  ///< the picture's times, or their logarithms
  double f_;
  std::vector<Axis> axes_;
  std::vector<double> panel_heights_;  ///< pt
  std::vector<std::string> title_;
  double left_ = 0.0, right_ = 0.0, top_ = 0.0, height_ = 0.0;  ///< pt
  double first_ = 0.0, last_ = 1.0;                             ///< of across_
  std::vector<double>::const_iterator row_begin_, row_end_;     ///< of across_
  std::optional<Canvas> canvas_;
};

}  // namespace

Trouble plot_history(const HistoryPicture& picture, const std::string& path) {
  return HistoryPage(picture, path).draw();
}

}  // namespace edda
