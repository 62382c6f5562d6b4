#include "report/along_line.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace edda {
namespace {

constexpr double shortest = 1e-9;  // of the line

/// Where a line lies in a convex cell, as fractions of it; empty where low >= high (Cyrus and
/// Beck).
struct Span {
  double low = 0.0, high = 1.0;
};
Span span_in(const Grid& g, std::size_t cell, Vec2 begin, Vec2 end) {
  const auto point = [&](std::size_t k) {
    const auto at = 3 * static_cast<std::size_t>(g.corners[k]);
    return Vec2{g.points[at], g.points[at + 1]};
  };
  Span span;
  const std::size_t first = g.begin(cell), last = static_cast<std::size_t>(g.ends[cell]);
  for (std::size_t k = first; k < last; ++k) {
    const Vec2 p = point(k), q = point(k + 1 < last ? k + 1 : first);
    const double inside = cross(q - p, begin - p), change = cross(q - p, end - begin);
    if (change > 0.0) {
      span.low = std::max(span.low, -inside / change);
    } else if (change < 0.0) {
      span.high = std::min(span.high, -inside / change);
    } else if (inside < 0.0) {
      return {1.0, 0.0};
    }
  }
  return span;
}

/// "principal stress" of principal_stress.major.
std::string label_of(const std::string& name) {
  std::string label = name.substr(0, name.find('.'));
  std::replace(label.begin(), label.end(), '_', ' ');
  return label;
}

}  // namespace

std::vector<LinePart> parts_along(const Grid& grid, Vec2 begin, Vec2 end) {
  const double length = norm(end - begin);
  std::vector<LinePart> all, parts;
  for (std::size_t c = 0; c < grid.cell_count(); ++c) {
    const Span span = span_in(grid, c, begin, end);
    if (span.high - span.low > shortest) all.push_back({span.low * length, span.high * length, c});
  }
  std::sort(all.begin(), all.end(),
            [](const LinePart& a, const LinePart& b) { return a.from + a.to < b.from + b.to; });
  // Along an edge both of its cells have the same part.
  for (const LinePart& part : all) {
    if (parts.empty() || 0.5 * (part.from + part.to) > parts.back().to) parts.push_back(part);
  }
  return parts;
}

Table table_along(const Grid& grid, const std::vector<LinePart>& parts, Vec2 begin, Vec2 end,
                  const std::vector<LineField>& fields) {
  Table table;
  for (const char* name : {"distance", "x", "y", "length", "block"})
    table.columns.push_back({name, {}});
  for (const LineField& field : fields) table.columns.push_back({field.name, {}});
  const Field* id = grid.cell_field("id");
  const Vec2 along = unit(end - begin);
  for (const LinePart& part : parts) {
    const double middle = 0.5 * (part.from + part.to);
    const Vec2 at = begin + middle * along;
    std::vector<double> row{middle, at.x, at.y, part.to - part.from,
                            id == nullptr ? 0.0 : id->values[part.cell]};
    for (const LineField& field : fields) row.push_back(field.shown.values[part.cell]);
    for (std::size_t c = 0; c < row.size(); ++c) table.columns[c].values.push_back(row[c]);
  }
  return table;
}

Table with_gaps(const Table& along) {
  const std::vector<double>&distance = along.columns[0].values, &length = along.columns[3].values;
  Table table;
  for (const Column& column : along.columns) table.columns.push_back({column.name, {}});
  const double whole = distance.empty() ? 0.0 : distance.back() + 0.5 * length.back();
  for (std::size_t r = 0; r < along.rows(); ++r) {
    constexpr double closed = 1e-3;  // of the line: joints are no gaps
    const double before = r == 0 ? 0.0 : distance[r - 1] + 0.5 * length[r - 1],
                 from = distance[r] - 0.5 * length[r];
    if (r > 0 && from - before > closed * whole) {
      for (Column& column : table.columns)
        column.values.push_back(std::numeric_limits<double>::quiet_NaN());
      table.columns[0].values.back() = 0.5 * (before + from);
    }
    for (std::size_t c = 0; c < along.columns.size(); ++c)
      table.columns[c].values.push_back(along.columns[c].values[r]);
  }
  return table;
}

std::vector<HistoryPanel> panels_along(const Table& along, const std::vector<LineField>& fields) {
  std::vector<HistoryPanel> panels;
  for (const LineField& field : fields) {
    const auto own = std::find_if(panels.begin(), panels.end(), [&](const HistoryPanel& panel) {
      return panel.unit == field.shown.unit;
    });
    const auto panel = own != panels.end()
                           ? own
                           : panels.insert(own, {label_of(field.name), field.shown.unit, {}});
    panel->lines.push_back(along.column(field.name));
  }
  return panels;
}

}  // namespace edda
