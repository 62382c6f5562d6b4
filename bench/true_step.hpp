// The critical step as it is: of the system assembled from all blocks and contacts, where
// StepBound looks at one block at a time.
#pragma once

#include "step/simulation.hpp"

namespace edda {

/// Which contacts count.
enum class Carrying {
  now,  ///< those that carry where the system stands
  may,  ///< and all candidates that would if they touched
};

/// 2/omega_max of the system linearised where it stands, without damping, all contacts taken as
/// sticking, by power iteration: `rounds` of it. From above: more rounds can only make it smaller.
double true_critical_step(const Simulation& sim, Carrying which, int rounds);

}  // namespace edda
