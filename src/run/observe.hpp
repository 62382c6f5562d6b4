// A look at a simulation between two steps, without disturbing it.
#pragma once

#include <array>
#include <vector>

#include "results/records.hpp"
#include "run/simulation.hpp"

namespace edda {

/// Everything at step n: the leapfrog holds velocities at n - 1/2 and forces at n - 1, so the
/// forces at n are worked out here on copies, and v_n = (v_{n-1/2} + v_{n+1/2})/2 (method.md
/// section 5). They are large: not to be kept from row to row.
struct Instant {
  State state;                    ///< x, y and v at n
  FaceSet contacts;               ///< with the forces at n
  NodalForces forces;             ///< at n, N
  std::vector<Vec2> on_dashpots;  ///< at n, N
};

/// Fills `at` from the simulation as it stands after start() or step().
void observe(const Simulation& sim, Instant& at);

/// The tables and frames of that instant. Model coordinates.
Picture picture_of(const Simulation& sim, const Instant& at);

/// Of the material point of area coordinates w since the start or the last reset, m: node by node,
/// so that it is exactly 0 there.
Vec2 displacement_of(const State& state, std::size_t i, const std::array<double, 3>& w);

/// The row of block i in the tables, of positions and velocities in `state`.
BlockRecord block_record(const Simulation& sim, const State& state, std::size_t i);

/// Cauchy stress of block i in the model's plane: xx yy xy (Pa), and zz: the initial one and nu
/// times what xx + yy have changed by; in plane stress 0.
struct BlockStress {
  double xx = 0.0, yy = 0.0, zz = 0.0, xy = 0.0;
};
BlockStress block_stress(const Simulation& sim, const State& state, std::size_t i);

/// The mean normal force of an end of a face that carries, N; where none does, the mean over
/// `blocks` of weight and loads.
double force_scale(const Simulation& sim, const FaceSet& contacts, const std::vector<Id>& blocks);

/// The mean over blocks not held of the resultant force, over force_scale(); 0 where no force is, 1
/// where there is nothing to measure it by.
double unbalanced_ratio(const Simulation& sim, const Instant& at);

/// Faces that carry.
std::size_t closed_contacts(const FaceSet& contacts);

/// Brings State::turns up to date. To be called often enough that no block turns by half a turn
/// between two calls; `angle` keeps the polar angles of the last call (rad, empty at first).
void count_turns(Simulation& sim, std::vector<double>& angle);

}  // namespace edda
