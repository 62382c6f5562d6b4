// An unstructured grid of VTK, as a frame has it: points, cells and named fields.
#pragma once

#include <cstdint>
#include <functional>
#include <string>
#include <vector>

namespace edda {

/// Values of all points or all cells, `components` each, one after another.
struct Field {
  std::string name;
  std::size_t components = 1;
  std::vector<double> values;
  std::vector<std::string> component_names;  ///< may be empty
  bool whole = false;                        ///< written as Int32
};

/// VTK's numbers of the cells used here.
namespace cell_type {
inline constexpr std::uint8_t vertex = 1, triangle = 5, polygon = 7;
}

struct Grid {
  std::vector<double> points;         ///< x, y, 0 of each, m
  std::vector<std::int64_t> corners;  ///< points of all cells, cell after cell
  std::vector<std::int64_t> ends;     ///< of each cell in `corners`
  std::vector<std::uint8_t> types;    ///< of each cell
  std::vector<Field> point_fields, cell_fields;
  bool cells_are_points =
      false;  ///< every cell is one point: written files have the cell fields at points, too
  double time = 0.0;  ///< s

  std::size_t point_count() const { return points.size() / 3; }
  std::size_t cell_count() const { return ends.size(); }
  /// Index in `corners` at which the points of a cell begin.
  std::size_t begin(std::size_t cell) const {
    return cell == 0 ? 0 : static_cast<std::size_t>(ends[cell - 1]);
  }
  /// The cell field of that name, or null.
  const Field* cell_field(const std::string& name) const;
  const Field* point_field(const std::string& name) const;
};

/// A field whose values are made when they are needed.
struct FieldSource {
  std::string name;
  std::size_t components = 1;
  std::vector<std::string> component_names;  ///< may be empty
  bool whole = false;                        ///< written as Int32
  std::size_t count = 0;                     ///< of points or cells
  /// Puts the values of the points or cells [first, end) into memory, one after another.
  std::function<void(std::size_t first, std::size_t end, double* into)> fill;
};

/// A Grid, as it is written: most of its size are its fields, which are not in memory.
struct GridSource {
  Grid shape;  ///< without fields
  std::vector<FieldSource> point_fields, cell_fields;
};

/// With its fields in memory.
Grid grid_of(GridSource source);

}  // namespace edda
