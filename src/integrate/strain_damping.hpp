// Viscous damping of the blocks' own strain (Kelvin and Voigt), taken implicitly, block by block.
//
// sigma_v = eta C : dU/dt (blocks/strain_rate.hpp), with the velocity that the step leads to:
//   (M/h + D) v_{n+1/2} = M v_{n-1/2}/h + f_n,   D = eta V B^T C B,   dU/dt = B v.
// The rate is what the step changes U by (strain_rate_over), so that a block that turns feels
// nothing. With v* = v_{n-1/2} + h M^-1 f_n that is, in the three rates of strain alone,
//   s = W B v*,   W = (C^-1/(eta V) + h B M^-1 B^T)^-1,   v_{n+1/2} = v* - h M^-1 B^T s.
// W is taken for the undeformed block, a difference in the order of the strain that leaves the
// forces dissipative and without moment. Rigid motion feels nothing; the critical step is not
// shortened, whatever eta is.
#pragma once

#include <array>
#include <vector>

#include "blocks/kinematics.hpp"
#include "blocks/strain_rate.hpp"

namespace edda {

struct StrainDamping {
  std::array<std::vector<double>, 6>
      matrix;  ///< [6][nb] W, entries 11 12 13 22 23 33, J s; 0 where nothing is damped
  std::array<std::vector<double>, 3> stress;  ///< [3][nb] s = V sigma_v of the last step, J
  double step = 0.0;                          ///< s: h that W was made for; 0: none
};

/// Makes W for the step h (with mass damping a it is h/(1 + a h/2)) where it was made for another
/// one. After a change of masses or viscosities set StrainDamping::step to 0.
void prepare(StrainDamping& damping, const BlockSet& blocks, double h);

/// From v* to v_{n+1/2} at the positions of step n, which then go on by h_new v_{n+1/2}, for blocks
/// [begin, end). Keeps s.
void damp_strain_and_move(StrainDamping& damping, const BlockSet& blocks, State& state,
                          double h_new, std::size_t begin, std::size_t end);

/// What is left of a `change` of the velocities of block i that a changed force makes in the step
/// just made; s changes with it.
std::array<Vec2, 3> damped_change(StrainDamping& damping, const BlockSet& blocks,
                                  const State& state, double h_new, std::size_t i,
                                  const std::array<Vec2, 3>& change);

/// Adds what the step just made dissipated in each block, s : B (x_{n+1} - x_{n-1})/2, J.
void add_strain_dissipation(const StrainDamping& damping, const BlockSet& blocks,
                            const State& state, const Nodes& old_vx, const Nodes& old_vy,
                            double h_old, double h_new, std::vector<double>& joules);

}  // namespace edda
