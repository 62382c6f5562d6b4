// Selective mass scaling: the few blocks that hold the step are made slower to move, so that the
// others need not wait for them. Weights stay what they are.
#pragma once

#include <vector>

#include "forces/stiffness.hpp"

namespace edda {

/// Raises the inertia of every free block that alone, every bare corner of it touching, would need
/// a step below `step` (s), until it does not; or, where `most` is given, until its mass has been
/// multiplied by that, [nb]. Returns what the masses were multiplied by, [nb], or nothing where all
/// stayed as they were.
std::vector<double> raise_inertia(BlockSet& blocks, const State& state, const Pose& pose,
                                  const ContactSet& contacts, const BoundarySprings& springs,
                                  const LawTable& laws, const Damping& damping, double step,
                                  const Bolts* bolts = nullptr,
                                  const std::vector<double>* most = nullptr);

/// Mass that the blocks only seem to have, kg. inertia: [nb] factors on their masses, or none.
double added_mass(const BlockSet& blocks, const std::vector<double>& inertia);

}  // namespace edda
