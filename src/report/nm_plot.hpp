// Thrust and moment of the sections of linings, within the strength of a section (interaction
// diagram).
#pragma once

#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "report/layout.hpp"
#include "results/files.hpp"

namespace edda {

/// The sections at one time.
struct NmPoints {
  std::string name;            ///< such as the stage
  std::vector<Vec2> sections;  ///< thrust (N, positive in compression) and moment (N m)
  std::vector<Vec2> strength;  ///< a line once round it; empty: none
  std::vector<Vec2> residual;  ///< a thinner one
};

struct NmPanel {
  std::string lining;
  std::vector<NmPoints> times;
};

struct NmPicture {
  std::string title;
  std::vector<NmPanel> panels;
  Paper paper{};
};

/// Draws into `path` (.png, .svg or .pdf): moments across, thrusts upwards.
Trouble plot_nm(const NmPicture& picture, const std::string& path);

}  // namespace edda
