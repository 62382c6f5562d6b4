// The critical step as it is: of the system assembled from all blocks and contacts, where
// StepBound looks at one block at a time.
#pragma once

#include "run/simulation.hpp"

namespace edda {

/// 2/omega_max of the system linearised where it stands, contacts that carry taken as sticking, by
/// power iteration: `rounds` of it. From above: more rounds can only make it smaller.
double true_critical_step(const Simulation& sim, int rounds);

}  // namespace edda
