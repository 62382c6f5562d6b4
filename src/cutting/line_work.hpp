// The lines that cut the domain: outline, openings, joint sets and traces as polylines with a
// source.
#pragma once

#include <optional>
#include <span>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "base/polygon.hpp"
#include "base/vec2.hpp"
#include "imports/imports.hpp"
#include "model/model.hpp"

namespace edda {

enum class LineKind { trace, import, joint_set, network, voronoi, region, opening, outline };

/// A table of the model from which lines come.
struct LineSource {
  LineKind kind = LineKind::outline;
  Index index = 0;     ///< in the model's list of that kind
  Index joint = none;  ///< law of its edges: domain.joint where a trace or set names none
  double unit = 0.0;  ///< m, of the last digit to which its coordinates are rounded; 0: not rounded
  std::optional<double> snap = {};  ///< m, import.snap where it is given
};

/// A polyline; rings (outline, openings) repeat their first point and run counter-clockwise.
struct LineString {
  std::vector<Vec2> points;  ///< m, local
  Index source = 0;
};

struct LineWork {
  std::vector<LineSource> sources;  ///< in order of precedence where lines coincide: the first wins
  std::vector<LineString> lines;
  Ring outline;                    ///< counter-clockwise, local
  std::vector<Ring> openings;      ///< counter-clockwise, local, in file order
  std::vector<std::string> notes;  ///< what was drawn at random, for the user to read
};

/// One unit of the last digit of these coordinates, m.
double last_digit(std::span<const Ring> rings);
/// `unit` where coordinates can have been rounded to it; 0 where it would be too coarse for a model
/// of that size, so that its coordinates are short because they are exact.
double rounding(double unit, double size);

/// The line work of model.domain relative to `origin`. Joint-set lines run from just outside the
/// outline to just outside it, or to the edge of their region. Fault: a set of more lines than
/// max_blocks. Precondition: model.domain is set.
Result<LineWork> line_work(const Model& model, Vec2 origin, double snap,
                           const Imports& imports = {});

}  // namespace edda
