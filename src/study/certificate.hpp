// The proof that a model fails: rigid statics without a solution (static and kinematic theorems).
#pragma once

#include <optional>
#include <vector>

#include "study/limit_mechanisms.hpp"

namespace edda {

/// The mechanism of blocks that have no equilibrium in their present places under the last values
/// of their loads, with their bonds as they are, each law's strength divided by divided_by: rigid
/// blocks on which the loads do more work than joints dissipate, of at least this area (m2). Every
/// face counts as closed whose gap is less than the part `allowed` of the size of the smaller block
/// beside it, joints as a little longer than they are, and bolts with all their capacity: more
/// support is never worse, so what has no equilibrium with it has none without. Blocks that have
/// come loose (Relaxation::loose), and those that dashpots act on, stay where they are. What blocks
/// reach by sliding further along their joints is not seen.
///
/// Nothing where there is an equilibrium, and where none can be ruled out: for joints whose
/// friction depends on their stress, for more than 5,000 blocks, for which it takes minutes, and
/// where `watch` stops it.
std::optional<LimitMotion> without_equilibrium(const Simulation& sim,
                                               const std::vector<double>& divided_by,
                                               double allowed, double least_area,
                                               const ProgramWatch* watch = nullptr);

}  // namespace edda
