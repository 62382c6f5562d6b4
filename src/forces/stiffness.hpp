// The critical step, block by block (method.md section 5; Eq. 41 with a bound that is safe and
// sharp).
#pragma once

#include <vector>

#include "attachments/bolts.hpp"
#include "attachments/boundary_springs.hpp"
#include "blocks/state.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// omega_max^2 <= max_i lambda_max{ M_i^-1 [K_i + boundary springs + bolts + 2 sum_c (p_n h h^T +
/// p_t k k^T)] }, h and k the weights of the contact along its normal and tangent, factor 1 against
/// a held block. Every candidate that may come to carry counts, closed or not. Bolts count by
/// bolt_matrix(). Dashpots at boundaries do not: they are centred (dashpot_forces.hpp). With
/// dashpots at contacts, C, and viscous blocks, D, the step h is the largest for which M + h D/2 -
/// h C/2 - h^2 K/4 of every block is positive: contact dashpots shorten it, viscous blocks make it
/// longer.
struct StepBound {
  double critical_step = 0.0;  ///< s; +inf if no block is free
  double likely_step = 0.0;    ///< the same if every bare corner of a block touched something, s
  Id block = no_id;            ///< whose eigenvalue it is
  Id contact = no_id;          ///< candidate with the largest part in it, no_id if none has
  double elastic_part = 0.0;   ///< parts of the Rayleigh quotient, summing to 1
  double contact_part = 0.0;
  double boundary_part = 0.0;
  double bolt_part = 0.0;
};

/// Local damping beta makes a node that moves against its force see (1 + beta) of it, so w^2 grows
/// by that; and mass-proportional damping a turns velocities round beyond 2/a, so 1/a is the limit.
StepBound step_bound(const BlockSet& blocks, const State& state, const Pose& pose,
                     const ContactSet& contacts, const BoundarySprings& springs,
                     const LawTable& laws, const Damping& damping, const Bolts* bolts = nullptr);

/// The step that each block would allow alone, every bare corner of it touching, [nb] s: exact
/// where it is below `limit`, elsewhere not below `limit` and perhaps too small; infinite for held
/// ones.
std::vector<double> steps_of_blocks(const BlockSet& blocks, const State& state, const Pose& pose,
                                    const ContactSet& contacts, const BoundarySprings& springs,
                                    const LawTable& laws, const Damping& damping, double limit,
                                    const Bolts* bolts = nullptr);

}  // namespace edda
