// A block's step set right for a force that was not what it was taken for.
#pragma once

#include <array>

#include "base/vec2.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "integrate/strain_damping.hpp"

namespace edda {

/// Steps behind and ahead of the force, and damping, as advance() used them.
struct StepTaken {
  double h_old = 0.0, h_new = 0.0, mass_damping = 0.0;
  StrainDamping* strain = nullptr;
};

/// Change of velocity per change of acceleration, as advance() makes it, s.
double kick_of(const StepTaken& taken);

/// Moves block i as the step would have with these nodal forces on top (N): its velocities, nodes
/// and vertices in pose.x, y. kick: kick_of(taken).
void push_block(const BlockSet& blocks, State& state, Pose& pose, Id i,
                const std::array<Vec2, 3>& force, double kick, double h_new, StrainDamping* strain);

}  // namespace edda
