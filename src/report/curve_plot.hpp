// The curve of a ramp: what was varied against the displacements of monitors (pushover).
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "results/files.hpp"

namespace edda {

struct CurveLine {
  std::string name;
  std::vector<Vec2> points;  ///< displacement (m) and value, of the increments that hold
};

struct CurvePicture {
  std::string title, axis;  ///< what was varied
  std::vector<CurveLine> lines;
  std::optional<double> fails;  ///< value at which the model fails; empty: at none
};

/// Draws into `path` (.png, .svg or .pdf). At least one line has two points or more.
Trouble plot_curve(const CurvePicture& picture, const std::string& path);

}  // namespace edda
