// What a user should know before a run: what holds the step, and settings that look right and are
// not.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// "block 12 (slider) at (1, 2): 80 % contacts, 20 % its own elasticity; most by vertex ... of
/// block ..".
std::string governed_by(const Simulation& sim);

/// One sentence per warning, with what to do. Of a simulation as created, before start().
std::vector<std::string> guard_rails(const Simulation& sim);

/// What a block is called in messages: "block 12", with its name where it has one.
std::string block_label(const BlockSet& blocks, std::size_t i);

/// "(1.25, -3)", model coordinates.
std::string place_label(Vec2 place);

}  // namespace edda
