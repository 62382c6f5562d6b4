// Check of a model before a run: loads, number of steps, expected duration.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// Results of the check.
struct ModelCheck {
  std::size_t fixed = 0;  ///< number of fixed blocks
  std::vector<std::string> loads, initial_stress, strain_damping;
  double step = 0.0;           ///< s: first step
  double step_as_given = 0.0;  ///< s: step in stages without scaled masses, if there are any
  double scaled_step = 0.0;    ///< s: step in stages with scaled masses, if there are any
  double steps = 0.0;  ///< expected number; an upper bound where stages end at an equilibrium; 0
                       ///< where no duration is given
  bool at_most = false;
  int increments = 0;                        ///< of all ramps, whose steps nobody knows beforehand
  double rate = 0.0;                         ///< steps per second of wall time
  std::size_t closed = 0, within_reach = 0;  ///< contacts at the start
  double critical_step = 0.0;                ///< s, at the start
};

/// Call for a simulation as created. It makes a few steps, after which the simulation is not to be
/// used for a run.
ModelCheck check_model(Simulation& sim);

}  // namespace edda
