// The critical step, block by block (method.md section 5; Eq. 41 with a bound that is safe and
// sharp).
#pragma once

#include <cstdint>
#include <vector>

#include "attachments/bolts.hpp"
#include "attachments/boundary_springs.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"
#include "contacts/points.hpp"

namespace edda {

/// omega_max^2 <= max_i lambda_max{ M_i^-1 [K_i + boundary springs + bolts + 2 K_faces] }, K_faces
/// of a block whose faces touch all round, its shape alone deciding: springs k and ks along every
/// edge, taken at its two corners, of the stiffest that it may meet; factor 1 against a held block.
/// The step is constant while the list of faces is. Bolts count by bolt_matrix(). Dashpots at
/// boundaries do not: they are centred (dashpot_forces.hpp). With dashpots at faces, C, and viscous
/// blocks, D, the step h is the largest for which M + h D/2 - h C/2 - h^2 K/4 of every block is
/// positive: dashpots at faces shorten it, viscous blocks make it longer.
struct StepBound {
  double critical_step = 0.0;  ///< s; +inf if no block is free
  Id block = no_id;            ///< whose eigenvalue it is
  Id contact = no_id;          ///< face with the largest part in it, no_id if none has
  double elastic_part = 0.0;   ///< parts of the Rayleigh quotient, summing to 1
  double contact_part = 0.0;
  double boundary_part = 0.0;
  double bolt_part = 0.0;
};

/// What blocks allowed when they were last asked. A step is taken from here where all that it was
/// worked out from is the same, bit by bit (a hash of it is); that of a block with boundary springs
/// or bolts never is. No part of a simulation's state: nothing but time depends on it.
struct KnownSteps {
  std::vector<std::uint64_t> made_of;  ///< [nb] 0: nothing known
  std::vector<double> estimate;        ///< [nb] s, not above the step
  std::vector<double> exact;           ///< [nb] s; < 0: not worked out
};

/// Local damping beta makes a node that moves against its force see (1 + beta) of it, so w^2 grows
/// by that; and mass-proportional damping a turns velocities round beyond 2/a, so 1/a is the limit.
/// `points`: contacts at points that are near, in place of faces all round.
StepBound step_bound(const BlockSet& blocks, const State& state, const FaceSet& contacts,
                     const BoundarySprings& springs, const LawTable& laws, const Damping& damping,
                     const Bolts* bolts = nullptr, const PointSet* points = nullptr,
                     KnownSteps* known = nullptr);

/// The step that each block would allow alone, [nb] s: exact
/// where it is below `limit`, elsewhere not below `limit` and perhaps too small; infinite for held
/// ones.
std::vector<double> steps_of_blocks(const BlockSet& blocks, const State& state,
                                    const FaceSet& contacts, const BoundarySprings& springs,
                                    const LawTable& laws, const Damping& damping, double limit,
                                    const Bolts* bolts = nullptr, KnownSteps* known = nullptr);

}  // namespace edda
