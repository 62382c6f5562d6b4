// Selective mass scaling: the few blocks that hold the step are made slower to move, so that the
// others need not wait for them. Weights stay what they are.
#pragma once

#include <vector>

#include "forces/stiffness.hpp"

namespace edda {

/// Raises the inertia of every free block that alone, every bare corner of it touching, would need
/// a step below `step` (s), until it does not: `inertia` [nb] is the factor on its masses so far
/// (empty: 1 everywhere), and grows with them. Returns the blocks whose inertia was raised.
std::vector<Id> raise_inertia(BlockSet& blocks, std::vector<double>& inertia, const State& state,
                              const Pose& pose, const ContactSet& contacts,
                              const BoundarySprings& springs, const LawTable& laws,
                              const Damping& damping, double step);

/// Multiplies the masses of the nodes of block i, its weight left as it is.
void multiply_inertia(BlockSet& blocks, std::size_t i, double factor);

/// Mass that the blocks only seem to have, kg.
double added_mass(const BlockSet& blocks, const std::vector<double>& inertia);

}  // namespace edda
