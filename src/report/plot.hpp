// A picture of a frame: blocks, a field in colour, vectors, contact forces, monitors, axes, legend.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "report/shown_field.hpp"
#include "results/files.hpp"
#include "results/grid.hpp"

namespace edda {

struct PlotMonitor {
  std::string name;
  Vec2 start;  ///< where the point was at the start, m
};

/// A line between two material points.
struct PlotLine {
  std::string name;
  std::array<Vec2, 2> start;  ///< where its ends were at the start, m
};

struct PlotOptions {
  std::string title;
  std::string subtitle;                ///< such as the time
  std::vector<std::string> materials;  ///< names, for the legend
  std::vector<PlotMonitor> monitors;
  std::vector<PlotLine> lines;              ///< [[convergence]]
  std::vector<std::array<Vec2, 2>> bolts;   ///< from where to where they were at the start, m
  std::vector<std::array<Vec2, 2>> joints;  ///< drawn thick, where they are drawn, m
  double scale = 1.0;                       ///< of the displacements drawn
  std::string vectors;    ///< "displacement" or "velocity": arrows at block centres; empty: none
  bool forces = false;    ///< contact forces as arrows
  double width = 1600.0;  ///< px, of a picture that is not taller than wide
};

/// Draws into `path` (.png or .svg). `contacts` may be null where nothing of them is shown.
Trouble plot(const Grid& blocks, const Grid* contacts, const ShownField& field,
             const PlotOptions& options, const std::string& path);

}  // namespace edda
