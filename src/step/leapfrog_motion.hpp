// The motion of the blocks in a step of the leapfrog (theory, section 7.1).
#pragma once

#include "attachments/loads.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Energy that a change of the step creates (theory, section 7.3): sum of m |v+ - v-|^2
/// (h_old - h_new)/(4 h_mean), J, with the definition of work of the energy balance.
double energy_of_step_change(const State& state, const Leap& leap);

/// Prepares the damping of a step of the mean length h, s.
void prepare_damping(const Simulation& sim, double h, DampingOfStep& damping);

/// The step from n to n + 1, with the state at n.
Leap leap_of(const Simulation& sim, double h_old, double h_new);

/// Forces at n, velocities at n + 1/2, positions at n + 1. Returns whether no vertex has moved
/// beyond the displacement limit. `not_yet_gathered`: the loads at n; null where the step is made
/// again, and of the forces only those of the dashpots, which depend on the step, are to change.
bool move(Simulation& sim, double h_old, double h_new, const LoadsNow* not_yet_gathered);

}  // namespace edda
