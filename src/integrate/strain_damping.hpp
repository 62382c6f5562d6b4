// Viscous damping of the blocks' strain (Kelvin-Voigt), integrated implicitly, block by block
// (theory, section 9.2).
//
// sigma_v = eta C : dU/dt (blocks/strain_rate.hpp), with the velocity at the end of the step:
//  (M/h + D) v_{n+1/2} = M v_{n-1/2}/h + f_n,   D = eta V B^T C B,   dU/dt = B v.
// The strain rate is the change of U in the step over h (strain_rate_over), so that a block that
// rotates is not damped. With v* = v_{n-1/2} + h M^-1 f_n three equations in the strain rates
// remain,
//  s = W B v*,   W = (C^-1/(eta V) + h B M^-1 B^T)^-1,   v_{n+1/2} = v* - h M^-1 B^T s.
// W is that of the undeformed block. The error is of the order of the strain; the forces remain
// dissipative and have no moment. Rigid motion is not damped, and the critical step is not reduced,
// whatever eta is.
#pragma once

#include <array>
#include <vector>

#include "blocks/free_blocks.hpp"
#include "blocks/kinematics.hpp"
#include "blocks/masses.hpp"
#include "blocks/strain_rate.hpp"
#include "integrate/kick.hpp"

namespace edda {

struct StrainDamping {
  std::array<std::vector<double>, 6>
      matrix;  ///< [6][nb] W, entries 11 12 13 22 23 33, J s; 0 for blocks without damping
  std::array<std::vector<double>, 3> stress;  ///< [3][nb] s = V sigma_v of the last step, J
  std::vector<double> work;   ///< [nb] what it dissipated in the last step, J: s : B (x_{n+1} -
                              ///< x_{n-1})/2
  double step = 0.0;          ///< s: h for which W was computed; 0: none
  std::vector<double> steps;  ///< [nb] s, that of each block; empty where all have the same
  double step_of(std::size_t i) const { return steps.empty() ? step : steps[i]; }
};

/// How the blocks came to step n, and the steps before and after it.
struct StepsAround {
  const BodyVectors& old_velocity;  ///< v_{n-1/2}, m/s
  double h_old, h_new;              ///< step before and after n, s
};

/// Computes W for the step h (with mass damping a it is h/(1 + a h/2)) unless it is that already.
/// After a change of masses or viscosities set StrainDamping::step to 0.
void prepare(StrainDamping& damping, const BlockSet& blocks, const Masses& masses, double h);
/// The same with a step of its own for each block, [nb] s.
void prepare(StrainDamping& damping, const BlockSet& blocks, const Masses& masses,
             const std::vector<double>& h);

/// Changes v* to v_{n+1/2} at the positions of step n, which then move by h_new v_{n+1/2}, for the
/// blocks [begin, end). Stores s and its work.
void damp_strain_and_move(StrainDamping& damping, const BlockSet& blocks, const Masses& masses,
                          State& state, const StepsAround& step, std::size_t begin,
                          std::size_t end);

/// The whole step of the blocks [begin, end), not more than blocks_at_once, with lumped masses:
/// adds the forces, makes v* of v_{n-1/2} by the kick, then damps and moves as above.
void add_kick_and_damp(StrainDamping& damping, const BlockSet& blocks, const Masses& masses,
                       State& state, const ForcesToAdd& forces, const StepsAround& step,
                       const OneKick& kick, std::size_t begin, std::size_t end);
void add_kick_and_damp(StrainDamping& damping, const BlockSet& blocks, const Masses& masses,
                       State& state, const ForcesToAdd& forces, const StepsAround& step,
                       const OwnKicks& kicks, std::size_t begin, std::size_t end);

/// The part of a `change` of the velocities of block i, due to a changed force in the step just
/// made, that remains under strain damping; updates s and its work accordingly.
NodeVectors damped_change(StrainDamping& damping, const BlockSet& blocks, const Masses& masses,
                          const State& state, const StepsAround& step, std::size_t i,
                          const NodeVectors& change);

}  // namespace edda
