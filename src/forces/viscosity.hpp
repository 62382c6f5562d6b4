// How viscous the blocks' strain is (integrate/strain_damping.hpp says what that does).
#pragma once

#include "blocks/block_set.hpp"

namespace edda {

/// Angular frequency of the softest vibration of block i by itself, 1/s: the least of the three of
/// its strain, det(V C - w^2 (B M^-1 B^T)^-1) = 0.
double lowest_frequency(const BlockSet& blocks, std::size_t i);

/// Fills BlockSet::viscosity, eta = 2 zeta/w with zeta of BlockSet::damping and w the block's
/// softest frequency; or where Rayleigh's damping is in force its part of the stiffness. Again
/// whenever masses or damping change.
void fill_viscosity(BlockSet& blocks, const Damping& damping);

}  // namespace edda
