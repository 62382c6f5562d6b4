// Joints that come out of the rock in an inner corner of its surface: what slides on one is held by
// its tip.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// Tip of a free block that would slide down the joint under it, beside free air, but for the rock
/// in front of it.
struct LockedToe {
  Id block = 0;
  Id vertex = 0;       ///< the tip
  Index joint = none;  ///< it lies on
  double into = 0.0;   ///< rad, angle by which the joint runs on into the rock in front
};

/// At the start, by vertex. Rock that lies against the tip with no vertex there counts as none.
std::vector<LockedToe> locked_toes(const Simulation& sim);

/// A warning that names them.
void warn_of_locked_toes(const Simulation& sim, std::vector<std::string>& warnings);

}  // namespace edda
