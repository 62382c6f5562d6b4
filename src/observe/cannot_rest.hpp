// Whether a model is meant to move from the start.
#pragma once

#include "step/simulation.hpp"

namespace edda {

/// Whether a free block moves at the start whatever the others do: it has a velocity, or weight and
/// loads on it exceed what friction on its faces could carry if all blocks beside it were fixed (it
/// slides, rolls or topples). Blocks with cohesion, bolts or boundary springs count as held. Call
/// for a simulation as created, in which the blocks touch by faces.
bool some_block_moves(const Simulation& sim);

}  // namespace edda
