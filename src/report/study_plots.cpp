#include "report/study_plots.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numeric>

#include "report/chart.hpp"

namespace edda {
namespace {

constexpr double font = 8.0;                             // pt
constexpr double pixels_per_point = 10.0 * 25.4 / 72.0;  // of a PNG
constexpr double left = 6.0 * font, below = 4.5 * font, above = 1.5 * font, right = 5.5 * font;
constexpr Colour blue{0.35, 0.55, 0.78}, red{0.80, 0.25, 0.20}, black{0.15, 0.15, 0.17},
    pale{0.82, 0.88, 0.95};

/// The range of the values, a little wider; of one value, something around it.
Vec2 range_of(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double margin =
      *high > *low ? 0.04 * (*high - *low) : std::max(1e-3 * std::abs(*low), 1e-12);
  return {*low - margin, *high + margin};
}

struct Bins {
  double low = 0.0, width = 1.0;
  std::vector<double> counts;
  double most() const { return *std::max_element(counts.begin(), counts.end()); }
};

/// As many bins as the cube root of the number asks for (Scott's order), at least six; with a
/// border at the threshold, so that no bar belongs to both sides.
Bins bins_of(const std::vector<double>& values, const std::optional<double>& threshold) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  const double span = *high > *low ? *high - *low : std::max(std::abs(*low), 1.0);
  const double count = std::clamp(2.0 * std::cbrt(static_cast<double>(values.size())), 6.0, 60.0);
  Bins bins;
  bins.width = span / std::floor(count);
  const double border = threshold.value_or(*low);
  bins.low = border + std::floor((*low - border) / bins.width) * bins.width;
  const auto n = static_cast<std::size_t>((*high - bins.low) / bins.width) + 1;
  bins.counts.assign(n, 0.0);
  for (const double x : values) {
    const auto i = static_cast<std::size_t>(std::max(0.0, (x - bins.low) / bins.width));
    bins.counts[std::min(i, n - 1)] += 1.0;
  }
  return bins;
}

std::vector<double> ranks_of(const std::vector<double>& values) {
  std::vector<std::size_t> order(values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return values[i] < values[j]; });
  std::vector<double> ranks(values.size());
  for (std::size_t i = 0; i < order.size();) {
    std::size_t end = i;
    while (end < order.size() && values[order[end]] == values[order[i]]) ++end;
    for (std::size_t k = i; k < end; ++k) ranks[order[k]] = 0.5 * static_cast<double>(i + end - 1);
    i = end;
  }
  return ranks;
}

/// One cell of the matrix of scatter plots.
void draw_scatter(Canvas& canvas, const Box& frame, const ScatterPicture& picture, std::size_t i,
                  std::size_t j, const std::string& x, const std::string& y) {
  const std::vector<double>& across = picture.columns[j].values;
  const std::vector<double>& up = picture.columns[i].values;
  const Vec2 wide = range_of(across), high = range_of(up);
  Chart chart(canvas, frame, {{wide.x, high.x}, {wide.y, high.y}}, font);
  chart.draw_axes(x, y);
  const double radius = across.size() > 1000 ? 0.6 : across.size() > 200 ? 0.9 : 1.3;
  for (std::size_t s = 0; s < across.size(); ++s)
    chart.draw_point({across[s], up[s]}, radius, picture.failed[s] != 0 ? red : blue);
}

void draw_small_histogram(Canvas& canvas, const Box& frame, const SampledColumn& column,
                          const std::string& x, const std::string& y) {
  const Bins bins = bins_of(column.values, {});
  const Vec2 wide = range_of(column.values);
  Chart chart(canvas, frame, {{wide.x, 0.0}, {wide.y, 1.08 * bins.most()}}, font);
  chart.draw_axes(x, "");
  for (std::size_t k = 0; k < bins.counts.size(); ++k) {
    const double low = bins.low + static_cast<double>(k) * bins.width;
    chart.draw_bar(std::max(low, wide.x), std::min(low + bins.width, wide.y), bins.counts[k], pale);
  }
  canvas.colour(black);
  canvas.text(y, {frame.low.x - 4.4 * font, 0.5 * (frame.low.y + frame.high.y)},
              {.size = font, .align = Align::centre, .upwards = true});
}

void draw_coefficient(Canvas& canvas, const Box& frame, double r) {
  canvas.colour(black, 0.35 + 0.65 * std::abs(r));
  const double size = font * (1.2 + 1.6 * std::abs(r));
  canvas.text(
      typeset(fmt::format("{:.2f}", r)),
      {0.5 * (frame.low.x + frame.high.x), 0.5 * (frame.low.y + frame.high.y) + 0.35 * size},
      {.size = size, .align = Align::centre});
}

}  // namespace

double rank_correlation(const std::vector<double>& a, const std::vector<double>& b) {
  const std::vector<double> x = ranks_of(a), y = ranks_of(b);
  const double mean = 0.5 * static_cast<double>(a.size() - 1);
  double xy = 0.0, xx = 0.0, yy = 0.0;
  for (std::size_t i = 0; i < x.size(); ++i) {
    xy += (x[i] - mean) * (y[i] - mean);
    xx += (x[i] - mean) * (x[i] - mean);
    yy += (y[i] - mean) * (y[i] - mean);
  }
  return xx > 0.0 && yy > 0.0 ? xy / std::sqrt(xx * yy) : 0.0;
}

Trouble plot_histogram(const HistogramPicture& p, const std::string& path) {
  constexpr double width = 340.0, height = 200.0;
  Canvas canvas(path, left + width + right, above + height + below, pixels_per_point);
  std::vector<double> shown = p.column.values;
  if (p.threshold) shown.push_back(*p.threshold);
  const Bins bins = bins_of(p.column.values, p.threshold);
  const Vec2 wide = range_of(shown);
  const Box frame{{left, above}, {left + width, above + height}};
  Chart chart(canvas, frame, {{wide.x, 0.0}, {wide.y, 1.08 * bins.most()}}, font);
  chart.draw_axes(p.column.label(), "samples");
  for (std::size_t k = 0; k < bins.counts.size(); ++k) {
    const double low = bins.low + static_cast<double>(k) * bins.width;
    const double middle = low + 0.5 * bins.width;
    const bool fails = p.threshold && (middle < *p.threshold) == p.fails_below;
    chart.draw_bar(std::max(low, wide.x), std::min(low + bins.width, wide.y), bins.counts[k],
                   fails ? red : blue);
  }
  Chart part(canvas, frame, {{wide.x, 0.0}, {wide.y, 1.0}}, font);
  std::vector<double> sorted = p.column.values;
  std::sort(sorted.begin(), sorted.end());
  std::vector<Vec2> curve{{wide.x, 0.0}};
  for (std::size_t i = 0; i < sorted.size(); ++i) {
    curve.push_back({sorted[i], curve.back().y});
    curve.push_back({sorted[i], static_cast<double>(i + 1) / static_cast<double>(sorted.size())});
  }
  curve.push_back({wide.y, 1.0});
  part.draw_line(curve, 1.0, black);
  part.draw_right_axis("part of the samples below", 1.0);
  if (p.threshold) chart.draw_upright(*p.threshold, red);
  return canvas.finish();
}

Trouble plot_scatter(const ScatterPicture& p, const std::string& path) {
  const std::size_t n = p.columns.size();
  const double cell = std::clamp(460.0 / static_cast<double>(n), 60.0, 130.0), gap = 6.0;
  const double side = static_cast<double>(n) * (cell + gap);
  Canvas canvas(path, left + side + font, above + side + below, pixels_per_point);
  for (std::size_t i = 0; i < n; ++i) {
    for (std::size_t j = 0; j < n; ++j) {
      const Vec2 low{left + static_cast<double>(j) * (cell + gap),
                     above + static_cast<double>(i) * (cell + gap)};
      const Box frame{low, low + Vec2{cell, cell}};
      const std::string x = i + 1 == n ? p.columns[j].label() : "";
      const std::string y = j == 0 ? p.columns[i].label() : "";
      if (i > j) draw_scatter(canvas, frame, p, i, j, x, y);
      if (i == j) draw_small_histogram(canvas, frame, p.columns[i], x, y);
      if (i < j)
        draw_coefficient(canvas, frame, rank_correlation(p.columns[j].values, p.columns[i].values));
    }
  }
  return canvas.finish();
}

Trouble plot_tornado(const TornadoPicture& p, const std::string& path) {
  constexpr double width = 300.0, thick = 1.5 * font, step = 2.2 * font;
  std::vector<std::size_t> order(p.values.size());
  std::iota(order.begin(), order.end(), 0U);
  std::stable_sort(order.begin(), order.end(), [&](std::size_t a, std::size_t b) {
    return std::abs(p.values[a]) > std::abs(p.values[b]);
  });
  std::size_t longest = 0;
  for (const std::string& name : p.names) longest = std::max(longest, name.size());
  const double names = 0.55 * font * static_cast<double>(longest) + 2.0 * font;
  std::vector<double> ends = p.values;
  ends.insert(ends.end(), p.low.begin(), p.low.end());
  ends.insert(ends.end(), p.high.begin(), p.high.end());
  ends.push_back(0.0);
  const Vec2 wide = range_of(ends);
  const double height = step * static_cast<double>(order.size()) + 0.5 * font;
  Canvas canvas(path, names + width + 2.0 * font, above + height + below, pixels_per_point);
  const Box frame{{names, above}, {names + width, above + height}};
  Chart chart(canvas, frame, {{wide.x, 0.0}, {wide.y, 1.0}}, font);
  chart.draw_axes(p.axis, "");
  for (std::size_t k = 0; k < order.size(); ++k) {
    const std::size_t q = order[k];
    const double top = above + 0.5 * font + step * static_cast<double>(k);
    const double zero = chart.at(0.0, 0.0).x, end = chart.at(p.values[q], 0.0).x;
    canvas.colour(p.values[q] < 0.0 ? red : blue);
    cairo_rectangle(canvas.cr(), std::min(zero, end), top, std::abs(end - zero), thick);
    cairo_fill(canvas.cr());
    canvas.colour(black);
    canvas.text(p.names[q], {names - font, top + 0.5 * thick + 0.35 * font},
                {.size = font, .align = Align::right});
    if (p.low.empty()) continue;
    const double middle = top + 0.5 * thick;
    canvas.line({chart.at(p.low[q], 0.0).x, middle}, {chart.at(p.high[q], 0.0).x, middle}, 1.0);
  }
  chart.draw_upright(0.0, black);
  return canvas.finish();
}

Trouble plot_convergence(const ConvergencePicture& p, const std::string& path) {
  constexpr double width = 340.0, height = 160.0;
  Canvas canvas(path, left + width + 2.0 * font, above + height + below, pixels_per_point);
  const double most = *std::max_element(p.high.begin(), p.high.end());
  const Box frame{{left, above}, {left + width, above + height}};
  Chart chart(canvas, frame, {{0.0, 0.0}, {p.samples.back(), 1.05 * most}}, font);
  const auto line = [&](const std::vector<double>& values) {
    std::vector<Vec2> points;
    for (std::size_t i = 0; i < values.size(); ++i) points.push_back({p.samples[i], values[i]});
    return points;
  };
  chart.draw_band(line(p.low), line(p.high), pale);
  chart.draw_axes("samples", p.axis);
  chart.draw_line(line(p.probability), 1.2, blue);
  return canvas.finish();
}

}  // namespace edda
