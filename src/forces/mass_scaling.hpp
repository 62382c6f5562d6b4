// Selective mass scaling: the few blocks that hold the step are made slower to move, so that the
// others need not wait for them. Weights stay what they are.
#pragma once

#include <vector>

#include "forces/stiffness.hpp"

namespace edda {

/// Raises the inertia of every free block that alone would need
/// a step below `step` (s), until it does not; or, where `most` is given, until its mass has been
/// multiplied by that, [nb]. Returns what the masses were multiplied by, [nb], or nothing where all
/// stayed as they were.
std::vector<double> raise_inertia(BlockSet& blocks, const State& state, const FaceSet& contacts,
                                  const BoundarySprings& springs, const LawTable& laws,
                                  const Damping& damping, double step, const Bolts* bolts = nullptr,
                                  const std::vector<double>* most = nullptr,
                                  KnownSteps* known = nullptr);

/// Mass that the blocks only seem to have, kg. inertia: [nb] factors on their masses, or none.
double added_mass(const BlockSet& blocks, const std::vector<double>& inertia);

/// The most of it that leaves motion what it is, of the mass of all free blocks: accelerations and
/// the squares of frequencies are then off by a tenth on the whole, which is about what else is
/// known of them. The blocks that it is meant for are few and small, and stay far below.
inline constexpr double most_added = 0.1;

/// The largest step (s) that masses can be raised for by `mass` (kg) in all, where block i alone
/// needs steps below own[i] (s).
double step_that_adds(const BlockSet& blocks, const std::vector<double>& own, double mass);

/// Mass of the blocks that are not held, kg.
double free_mass(const BlockSet& blocks);

}  // namespace edda
