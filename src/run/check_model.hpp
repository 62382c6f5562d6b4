// A look at a model before a run: what acts, how many steps it will take, and how long.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// What is found out about a model before it is run.
struct ModelCheck {
  std::size_t held = 0;  ///< blocks
  std::vector<std::string> loads, initial_stress, strain_damping;
  double step = 0.0;           ///< s: the first
  double step_as_given = 0.0;  ///< s: in stages without static masses, where there are any
  double static_step = 0.0;    ///< s: in stages with static masses, where there are any
  double steps = 0.0;          ///< to expect; at most, where stages end at an equilibrium; 0
                               ///< where no duration is given
  bool at_most = false;
  double rate = 0.0;                         ///< steps per second of wall time
  std::size_t closed = 0, within_reach = 0;  ///< contacts, at the start
  double critical_step = 0.0;                ///< s, at the start
};

/// Of a simulation as created; it makes a few steps with it, of which nothing is kept.
ModelCheck check_model(Simulation& sim);

}  // namespace edda
