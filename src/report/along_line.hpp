// Values of fields along a straight line through a frame.
#pragma once

#include <string>
#include <vector>

#include "base/fault.hpp"
#include "base/vec2.hpp"
#include "report/history_plot.hpp"
#include "report/shown_field.hpp"
#include "results/grid.hpp"
#include "results/read_table.hpp"

namespace edda {

/// The part of a line that lies in one cell: a block, a piece of one, or a zone.
struct LinePart {
  double from = 0.0, to = 0.0;  ///< distances from the beginning of the line, m
  std::size_t cell = 0;
};

/// In the order of the line, without those shorter than a billionth of it.
std::vector<LinePart> parts_along(const Grid& grid, Vec2 begin, Vec2 end);

struct LineField {
  std::string name;  ///< as in shown_field()
  ShownField shown;
};

/// A row for each part, of its middle: distance, x, y, length, block, then the fields.
Table table_along(const Grid& grid, const std::vector<LinePart>& parts, Vec2 begin, Vec2 end,
                  const std::vector<LineField>& fields);

/// The same with an empty row wherever the line leaves all blocks, as lines are drawn.
Table with_gaps(const Table& along);

/// A panel for each unit; their lines point into the table.
std::vector<HistoryPanel> panels_along(const Table& along, const std::vector<LineField>& fields);

}  // namespace edda
