// Viscosity of the blocks (integrate/strain_damping.hpp has the strain damping).
#pragma once

#include "blocks/block_set.hpp"
#include "blocks/masses.hpp"

namespace edda {

/// Lowest angular frequency of free vibration of block i, 1/s: the smallest of its three strain
/// modes, det(V C - w^2 (B M^-1 B^T)^-1) = 0.
double lowest_frequency(const BlockSet& blocks, const Masses& masses, std::size_t i);

/// Fills Masses::viscosity, eta = 2 zeta/w with zeta of BlockSet::damping and w the block's lowest
/// frequency; with Rayleigh damping, its stiffness-proportional part instead. The same for the
/// modes of blocks that bend, Masses::mode_damping, each with its own frequency. Meshed blocks
/// have none: it would damp the waves in them. Call again whenever masses or damping change.
void fill_viscosity(Masses& masses, const BlockSet& blocks, const Damping& damping);

}  // namespace edda
