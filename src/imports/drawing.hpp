// The contents of a file of lines, before units, shifts and joint laws are applied.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "base/digits.hpp"
#include "base/fault.hpp"
#include "base/vec2.hpp"
#include "model/geometry_inputs.hpp"

namespace edda {

struct DrawnLine {
  std::vector<Vec2> points;  ///< in the file's unit
  std::string layer;         ///< of a drawing; name of the joint, or type of the line
  int line = 0;              ///< of the file
};

struct Drawing {
  std::vector<DrawnLine> lines;
  std::vector<std::pair<Vec2, Vec2>> fixed;  ///< fixed lines and points
  std::optional<LengthUnit> units;           ///< as given in the file
  std::map<std::string, int> skipped;        ///< what was left out: how many of each kind
  int faulty = 0;                            ///< entities left out for a fault in them
  std::optional<Fault> fault;                ///< the first of these faults
  Digits digits;                             ///< of its coordinates, in the file's unit
};

/// Two-dimensional lines of a DXF drawing: LINE, LWPOLYLINE, POLYLINE, ARC, CIRCLE, ELLIPSE and
/// SPLINE, also those of the blocks that it inserts, with curves as straight pieces. All other
/// entities are counted in `skipped`, and so are those outside the plane of the drawing, with a
/// fault, or on a layer that is off or frozen and not in `shown`.
Result<Drawing> parse_dxf(std::string_view text, const std::string& path,
                          const std::vector<std::string>& shown = {});

/// Rows x1,y1,x2,y2 with, as an optional fifth field, the name of a joint, separated by commas,
/// semicolons or tabs. A first row of names says which column is which, and the others are left out
/// and counted; a fault where it does not name both ends. Empty lines and lines that begin with #
/// are skipped.
Result<Drawing> parse_traces(std::string_view text, const std::string& path);

/// Lines of a geometry file of DDA, as numbers or as tags; docs/geometry.md describes both.
Result<Drawing> parse_geo(std::string_view text, const std::string& path);

}  // namespace edda
