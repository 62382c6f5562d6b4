// Forces of blocks that bend on their own modes and nodes (theory, section 3.4).
#pragma once

#include "forces/nodal_forces.hpp"

namespace edda {

/// Adds the elastic forces of the blocks [begin, end), which are whole groups (bent_state.hpp), on
/// their modes, and the couple that goes with them on their nodes. locked: g0, [modes] N in the
/// frame of each block; or empty.
void add_bending(BodyVectors& forces, const BlockSet& blocks, const State& state,
                 const ModeVectors& locked, std::size_t begin, std::size_t end);

/// What the modes of block i store in the terms of the energy balance, s_{n-1} . K s_n/2 and s_n .
/// g0, J; h v is subtracted from the positions of the state for those at n - 1.
double bending_energy(const BlockSet& blocks, const State& state, const ModeVectors& locked,
                      double h, std::size_t i);

/// What block i stores in these terms: by its strain and initial stress (elastic.hpp), and by its
/// modes, or in its zones.
double stored_energy(const BlockSet& blocks, const State& state, const RockInside& rock, double h,
                     std::size_t i);

}  // namespace edda
