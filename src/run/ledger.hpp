// The energy ledger, in the leapfrog's own terms (method.md section 4): kinetic energy at half
// steps, stored energies as products of two neighbouring steps. In these terms it closes to
// rounding, but for what rotation and sliding along an edge really create.
#pragma once

#include "attachments/boundary_springs.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "integrate/leapfrog.hpp"

namespace edda {

/// All in J.
struct Ledger {
  double kinetic = 0.0, strain = 0.0, contact = 0.0;
  double gravity = 0.0;                                  ///< since t = 0
  double friction = 0.0, damping = 0.0, fracture = 0.0;  ///< dissipated, >= 0
  double external = 0.0;                                 ///< work done on the blocks
  double transfer = 0.0;                                 ///< taken by rules that are no physics
  double step_change = 0.0;                              ///< what changes of the step took out
  double drift = 0.0;  ///< balance, less that at the start, over the largest scale so far

  double balance() const {
    return kinetic + strain + contact + gravity + friction + damping + fracture + transfer +
           step_change - external;
  }
  /// What the drift is measured against.
  double scale() const { return kinetic + strain + contact + friction + damping + fracture; }
};

/// Every line but step_change and drift, from positions at step n and velocities half of `behind` s
/// earlier: the step for the leapfrog, 0 where both belong to one instant (and pose.x1 = pose.x).
Ledger sum_ledger(const BlockSet& blocks, const State& state, double behind, const Pose& pose,
                  const FaceSet& contacts, const BoundarySprings& springs, const DampingWork& work,
                  Vec2 gravity);

/// What rounding alone may store in springs and rock, and shake loose over a long run, J: all
/// blocks with the stiffest spring drawn out by 1e4 roundings of a coordinate. Changes of energy
/// below some part of it mean nothing.
double rounding_energy(const BlockSet& blocks, const FaceSet& contacts);

}  // namespace edda
