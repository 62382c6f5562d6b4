// Utilisation of the strength of intact rock by the stress in a block.
#pragma once

#include "model/model.hpp"
#include "observe/observe.hpp"

namespace edda {

/// Utilisation u of intact rock: the stress divided by u would lie on the criterion of Hoek and
/// Brown (1980) for intact rock,
///  sigma_1 = sigma_3 + ucs sqrt(m sigma_3/ucs + 1),   m = ucs/T - T/ucs,
/// compression positive. The two strengths determine it: it contains sigma_1 = ucs at sigma_3 = 0
/// and sigma_3 = -T at sigma_1 = 0. Hence
///  u = (sqrt(m^2 sigma_3^2 + 4 (sigma_1 - sigma_3)^2) - m sigma_3)/(2 ucs),
/// with sigma_1 and sigma_3 the largest and least of all three principal stresses. (A straight line
/// through the same two strengths would overestimate the strength under confinement by far.)
double utilisation(const RockStrength& strength, const BlockStress& stress);

/// Utilisation of block i; 0 where its material gives no strength.
double overstress(const Simulation& sim, const State& state, std::size_t i);

}  // namespace edda
