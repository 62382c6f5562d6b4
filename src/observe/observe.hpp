// Reads the state of a simulation between two steps, without changing it.
#pragma once

#include <vector>

#include "results/records.hpp"
#include "step/contact_pairs.hpp"
#include "step/instant.hpp"
#include "step/simulation.hpp"

namespace edda {

/// The tables and frames at that instant, model coordinates.
Picture picture_of(const Simulation& sim, const Instant& at);

/// Displacement of the material point of area coordinates w since the start or the last reset, m;
/// summed node by node, so that it is exactly 0 there.
Vec2 displacement_of(const State& state, std::size_t i, const NodeWeights& w);

/// The row of block i in the tables, with positions and velocities of `state`.
BlockRecord block_record(const Simulation& sim, const State& state, std::size_t i);

/// Cauchy stress of block i in the model's plane: xx yy xy (Pa), and zz: the initial one plus nu
/// times the change of xx + yy; 0 in plane stress.
struct BlockStress {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0;
};
BlockStress block_stress(const Simulation& sim, const State& state, std::size_t i);

/// Mean normal force per end of the faces that carry load, N; where none does, the mean of weight
/// and loads over `blocks`.
double force_scale(const Simulation& sim, const std::vector<Id>& blocks);
double force_scale(const Simulation& sim, const std::vector<Id>& blocks,
                   const NormalForces& contacts);

/// Mean resultant force of the free blocks, over force_scale(); 0 without any force, 1 where there
/// is no reference.
double unbalanced_ratio(const Simulation& sim, const Instant& at);
double unbalanced_ratio(const Simulation& sim, const Instant& at, const NormalForces& contacts);

/// Updates State::turns. Must be called often enough that no block rotates by pi between two calls;
/// `angle` keeps the polar angles of the last call (rad, empty at first).
void count_revolutions(Simulation& sim, std::vector<double>& angle);

}  // namespace edda
