// The critical step, block by block (theory, section 7.2; Eq. 41 with a bound that is safe and
// sharp).
#pragma once

#include <cstdint>
#include <vector>

#include "forces/block_equations.hpp"

namespace edda {

/// The critical step is 2/omega_max with the highest angular frequency of the system,
///  omega_max^2 <= max_i lambda_max{ M_i^-1 [K_i + 2 K_faces] },
/// where M_i and K_i are those of block i and K_i contains its elasticity, boundary springs and
/// bolts (bolt_matrix()). K_faces is that of a block in contact all round: springs k and ks along
/// every edge, taken at its two corners, of the edges in the list of faces and of a neighbour like
/// the block itself, the stiffest nearest to the corner. The factor 2 is 1 against a fixed block.
/// Boundary springs and bolts apart, the bound is constant as long as the list of faces is.
///
/// With dashpots at faces, C, and strain damping, D, the step h is the largest for which
/// M + h D/2 - h C/2 - h^2 K/4 of every block has no negative eigenvalue, K being the matrix in
/// brackets: dashpots at faces shorten the step, strain damping lengthens it. Dashpots at
/// boundaries do not count: they are centred (dashpot_forces.hpp).
struct StepBound {
  double critical_step = 0.0;  ///< s; +inf if no block is free
  Id block = no_id;            ///< the block that governs the step
  Id contact = no_id;  ///< its face with the largest part in that; no_id: none, or a neighbour like
                       ///< the block itself
  double elastic_part = 0.0;  ///< parts in the Rayleigh quotient of the fastest mode; sum 1
  double contact_part = 0.0;
  double boundary_part = 0.0;
  double bolt_part = 0.0;
};

/// Steps of blocks computed before. A step is reused where everything it depends on is the same,
/// bit by bit (compared by a hash); for a block with boundary springs or bolts it never is. This is
/// no part of a simulation's state: nothing but computing time depends on it.
struct StepCache {
  std::vector<std::uint64_t> equations_hash;  ///< [nb] hash; 0: no step known
  std::vector<double> estimate;               ///< [nb] s, lower estimate of the step
  std::vector<double> exact;                  ///< [nb] s; < 0: not computed
};

/// The bound over all blocks, damping included. Local damping beta acts on a node that moves
/// against its force like a force larger by the factor 1 + beta, so omega^2 grows by this factor.
/// Mass-proportional damping a would reverse velocities at steps beyond 2/a; the step is limited to
/// 1/a.
StepBound step_bound(const StiffnessInputs& inputs, StepCache* known = nullptr);

/// The step that each block would allow alone, [nb] s: exact where it is below `limit`, elsewhere a
/// lower estimate that is not below `limit`; infinite for fixed blocks.
std::vector<double> steps_of_blocks(const StiffnessInputs& inputs, double limit,
                                    StepCache* known = nullptr);

}  // namespace edda
