// What a file of lines holds, before units, shifts and joint laws.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

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
  std::vector<std::pair<Vec2, Vec2>> held;  ///< fixed lines and points
  std::optional<LengthUnit> units;          ///< as the file says
  std::map<std::string, int> skipped;       ///< what was left out: how many of each kind
};

/// Two-dimensional lines of a DXF drawing: LINE, LWPOLYLINE, POLYLINE, bulges as arcs. All else is
/// counted in `skipped`, and so is what does not lie in the plane of the drawing.
Result<Drawing> parse_dxf(std::string_view text, const std::string& path);

/// Rows x1,y1,x2,y2 and, where a fifth field is there, the name of a joint. A first row of names,
/// empty lines and lines that begin with # are passed over.
Result<Drawing> parse_traces(std::string_view text, const std::string& path);

/// Lines of a geometry file of DDA, as numbers or as tags; docs/geometry.md describes both.
Result<Drawing> parse_geo(std::string_view text, const std::string& path);

}  // namespace edda
