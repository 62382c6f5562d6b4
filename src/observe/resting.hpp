// Blocks without support: neither they nor the blocks that they touch are fixed, and nothing fixed
// lies below them. A run of such a model is an unintended fall.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

using BlockGroup = std::vector<Id>;  ///< blocks that touch each other or share a bolt, ascending

/// Whether a spring of this symmetric matrix (N/m) carries force along a unit vector.
bool carries_along(double kxx, double kyy, double kxy, Vec2 direction);

/// The groups without support at the start, by their first block. Without gravity there are none.
/// Blocks with a given velocity are meant to fly, those with loads may be supported by them, and
/// those above something fixed are meant to fall on it: none of these counts. A boundary supports
/// where it carries force along gravity. Call for a simulation as created, before start().
std::vector<BlockGroup> unsupported_blocks(const Simulation& sim);

/// One warning where all free blocks fall, else one for each of the first few groups.
std::vector<std::string> warnings_of(const Simulation& sim, const std::vector<BlockGroup>& groups);

}  // namespace edda
