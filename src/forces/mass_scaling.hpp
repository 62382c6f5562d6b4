// Selective mass scaling: the few blocks that govern the step get more inertia, so that all others
// may take a larger step. Weights do not change. Theory, section 8.
#pragma once

#include <vector>

#include "forces/step_bound.hpp"

namespace edda {

/// Raises the inertia of every free block that alone would need a step below `step` (s) until it
/// allows that step or, where `most` [nb] is given, until its mass has been multiplied by most[i].
/// masses: those of `inputs`. Returns the factors on the masses, [nb], or nothing where none
/// changed.
std::vector<double> scale_block_masses(Masses& masses, const StiffnessInputs& inputs, double step,
                                       const std::vector<double>* most = nullptr,
                                       StepCache* known = nullptr);

/// Inertial mass that was added, kg. inertia: [nb] factors on the masses, or none.
double added_mass(const BlockSet& blocks, const std::vector<double>& inertia);

/// Limit of the added mass, as a part of the mass of all free blocks: accelerations and squared
/// frequencies of the whole then change by at most a tenth, about the accuracy to which other data
/// are known. The few small blocks for which mass scaling is meant need far less.
inline constexpr double most_added = 0.1;

/// The largest step (s) that mass scaling can reach by adding `mass` (kg) in all, where block i
/// alone needs steps below own[i] (s).
double step_that_adds(const BlockSet& blocks, const std::vector<double>& own, double mass);

/// Mass of the free blocks, kg.
double free_mass(const BlockSet& blocks);

}  // namespace edda
