// Viscosity of the blocks (integrate/strain_damping.hpp has the strain damping).
#pragma once

#include "blocks/block_set.hpp"
#include "blocks/masses.hpp"
#include "zones/zone_set.hpp"

namespace edda {

/// Lowest angular frequency of free vibration of block i, 1/s: the smallest of its three strain
/// modes, det(V C - w^2 (B M^-1 B^T)^-1) = 0.
double lowest_frequency(const BlockSet& blocks, const Masses& masses, std::size_t i);

/// Fills Masses::viscosity, eta = 2 zeta/w with zeta of BlockSet::damping and w the block's lowest
/// frequency; with Rayleigh damping, its stiffness-proportional part instead, and Masses::decay for
/// the other part. The same for the modes of blocks that bend, Masses::mode_damping, each with its
/// own frequency. Linings have zeta at the highest frequency of their pieces, but not with adaptive
/// damping; other meshed blocks only Rayleigh's: zeta of zones would damp the waves in them. Call
/// again whenever masses or damping change.
void fill_viscosity(Masses& masses, const BlockSet& blocks, const Damping& damping,
                    const ZoneModel& zones = {});

}  // namespace edda
