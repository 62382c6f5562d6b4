// Joints that daylight at a re-entrant corner of the rock surface: the toe of a block that slides
// on such a joint is blocked kinematically.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// Tip of a free block, beside a free face, that would slide down the joint under it but for the
/// rock in front.
struct LockedToe {
  Id block = 0;
  Id vertex = 0;       ///< the tip
  Index joint = none;  ///< the joint under it
  double into = 0.0;   ///< rad, angle by which the extension of the joint runs into the rock in
                       ///< front
};

/// All such tips at the start, by vertex. Rock in front of a tip that has no vertex there is not
/// detected.
std::vector<LockedToe> locked_toes(const Simulation& sim);

/// Adds a warning that names them.
void warn_of_locked_toes(const Simulation& sim, std::vector<std::string>& warnings);

}  // namespace edda
