// A picture of one or more frames: blocks, a field in colour, stresses, vectors, contact forces,
// bolts, monitors, axes, legend.
#pragma once

#include <array>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/vec2.hpp"
#include "report/layout.hpp"
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

/// A bolt at the time of a frame: its nodes in order.
struct BoltChain {
  std::vector<Vec2> points;                ///< m
  std::vector<double> force;               ///< axial, N, positive in tension
  bool yielded = false, ruptured = false;  ///< anywhere
};

/// A force along a lining at the time of a frame: two values for each piece, at its ends.
struct LiningDiagram {
  std::vector<Vec2> points;   ///< m, along the lining, the wall on the right
  std::vector<double> value;  ///< SI
};

/// The data of one of the drawings of a picture.
struct Snapshot {
  Grid blocks;
  std::optional<Grid> contacts{};  ///< may be missing where no contacts are shown
  ShownField field{};
  /// As recorded; empty where there are no records.
  std::optional<std::vector<BoltChain>> bolts{};
  std::vector<LiningDiagram> linings{};
  std::string heading{};  ///< above the drawing, where there are several
};

struct PlotOptions {
  std::string title;
  std::string subtitle;                ///< such as the time
  std::vector<std::string> materials;  ///< names, for the legend
  std::vector<PlotMonitor> monitors;
  std::vector<PlotLine> lines;              ///< [[convergence]]
  std::vector<std::array<Vec2, 2>> bolts;   ///< their ends at the start, m
  std::vector<std::array<Vec2, 2>> joints;  ///< drawn thick, at the drawn positions, m
  double scale = 1.0;                       ///< of the displacements drawn
  std::string vectors;     ///< "displacement" or "velocity": arrows at block centres; empty: none
  bool forces = false;     ///< contact forces as arrows
  bool principal = false;  ///< principal stresses as crosses at block centres
  double least_stress = 0.0;  ///< Pa; where none is larger they are rounding and are not drawn
  bool cracks = false;        ///< faces that have broken, in tension and in shear
  bool bolt_forces = false;   ///< bolts as wide as their axial force
  std::string lining;  ///< "thrust", "moment", "shear" or "utilisation" along linings; empty: none
  bool outlines = true;                              ///< of the blocks
  bool marks = true;                                 ///< monitors and convergence lines
  std::optional<std::pair<double, double>> range{};  ///< of the colours, SI units
  bool whole_range = false;  ///< else a few blocks may lie beyond the scales of colours and arrows
  std::optional<Box> window{};  ///< what is shown, m; default: everything
  Paper paper{};
};

/// A fault where the window shows nothing of what is drawn, or is very small or very large compared
/// with it.
Trouble check_window(std::span<const Snapshot> shots, const PlotOptions& options);

/// Draws into `path` (.png, .svg or .pdf), at least one snapshot, side by side, with one scale and
/// one legend for all.
Trouble plot(std::span<const Snapshot> shots, const PlotOptions& options, const std::string& path);

}  // namespace edda
