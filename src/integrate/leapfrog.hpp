// Leapfrog (Eq. 13) with a step that may change, and its damping (method.md section 5).
#pragma once

#include <vector>

#include "blocks/kinematics.hpp"
#include "integrate/strain_damping.hpp"

namespace edda {

/// Global damping of the step.
struct StepDamping {
  double mass = 0.0;   ///< a, 1/s
  double local = 0.0;  ///< beta
  /// Blocks that local damping spares, ascending: those on dashpots, which damp them already, and
  /// would grow where beta of their own force came on top. Null: none.
  const std::vector<Id>* spared = nullptr;
  /// Of the blocks' strain, prepared for this step; null: none.
  StrainDamping* strain = nullptr;
};

/// Work dissipated by damping at the nodes, per block.
struct DampingWork {
  std::vector<double> joules;  ///< [nb]
};

/// v_{n+1/2} = v_{n-1/2} + a_n (h_old + h_new)/2, x_{n+1} = x_n + h_new v_{n+1/2} for every free
/// block. Mass-proportional damping is centred: v+ = ((1 - a h/2) v- + h f/m)/(1 + a h/2); local
/// damping takes beta |f| against v-, node by node. forces: [3][nb] N.
void advance(State& state, const BlockSet& blocks, const Nodes& force_x, const Nodes& force_y,
             double h_old, double h_new, const StepDamping& damping);

/// The same for the blocks [begin, end), from the velocities old_vx, old_vy to those of `state`
/// (which may be the same).
void advance(State& state, const BlockSet& blocks, const Nodes& force_x, const Nodes& force_y,
             const Nodes& old_vx, const Nodes& old_vy, double h_old, double h_new,
             const StepDamping& damping, std::size_t begin, std::size_t end);

/// Books what damping took in the step just made, once its velocities are final: damping force
/// times (x_{n+1} - x_{n-1})/2. old_vx, old_vy: velocities before it.
void book_damping(const State& state, const BlockSet& blocks, const Nodes& force_x,
                  const Nodes& force_y, const Nodes& old_vx, const Nodes& old_vy, double h_old,
                  double h_new, const StepDamping& damping, DampingWork& work);

/// Undoes the last advance().
void retreat(State& state, const BlockSet& blocks, double h_new, const Nodes& old_vx,
             const Nodes& old_vy);

/// v_{-1/2} = v_0 - (f/m - a v_0) h/2, for the start; a: mass-proportional damping, 1/s.
void start_velocities(State& state, const BlockSet& blocks, const Nodes& force_x,
                      const Nodes& force_y, double h, double mass_damping = 0.0);

/// Acceleration of the three nodes of block i under nodal forces, m/s2: f_k/m_k, or M^{-1} f for
/// `consistent`.
std::array<Vec2, 3> accelerations(const BlockSet& blocks, std::size_t i,
                                  const std::array<Vec2, 3>& force);

/// Kinetic energy of block i, J.
double kinetic_energy(const BlockSet& blocks, const Nodes& vx, const Nodes& vy, std::size_t i);

}  // namespace edda
