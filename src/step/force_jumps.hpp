// Forces that begin or end between two steps. Loads count half in the step in which they do
// (attachments/loads.hpp). Contacts and springs begin or end at once; the velocities half a step
// ago are corrected for that. Theory, section 7.4.
#pragma once

#include "forces/nodal_forces.hpp"

namespace edda {

struct Simulation;

/// Forces of step n; none before the first step, and none where velocities belong to the same
/// instant as positions.
BodyVectors forces_now(const Simulation& sim);

/// Adds the change of the forces to the jump that the next step corrects for. `before`:
/// forces_now() before the change.
void note_jump(Simulation& sim, const BodyVectors& before);

/// Corrects the velocities for the jump, at the beginning of a step. v_{n-1/2} was made by the
/// forces before the jump. v_n = v_{n-1/2} + a h/2 is not to change, so with the new accelerations
/// a + da the velocity becomes v_{n-1/2} - da h/2.
void split_jump(Simulation& sim);

}  // namespace edda
