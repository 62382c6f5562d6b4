// Correction of a block's step for a change of the forces.
#pragma once

#include "blocks/pose.hpp"
#include "integrate/leapfrog.hpp"

namespace edda {

/// Forces on both ends of an edge, N.
struct EdgeForce {
  Id edge, end;
  Vec2 at_edge, at_end;
};

/// A step that has been made: `leap` as advance() took it.
struct StepTaken {
  Leap leap;
  State& state;
  Pose& pose;
};

/// Moves block i as the step would have with this additional force: changes its velocities, nodes,
/// modes, and vertices in Pose::x, y. Returns how far the vertex has moved that has moved farthest,
/// m.
double push_block(const StepTaken& taken, Id i, const EdgeForce& force);

/// Change of the velocity of block i along the force in the step, times the force, W.
double mobility(const Leap& leap, Id i, const EdgeForce& force);

}  // namespace edda
