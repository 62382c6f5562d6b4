// Accounts of the steps made so far: energies, counts, times. The motion does not depend on them.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "integrate/leapfrog.hpp"
#include "step/face_switching.hpp"
#include "step/initial_balance.hpp"
#include "step/step_clock.hpp"

namespace edda {

struct StepStatistics {
  double smallest = 0.0, largest = 0.0, sum = 0.0;  ///< s
  std::uint64_t changes = 0;                        ///< number of changes of the step
  double over_critical = 0.0;  ///< largest ratio of the step to the bound in force at the time
  std::uint64_t redone = 0;    ///< steps repeated with half the step ("step cuts")
};

/// A block that could not be stepped any further and was taken out of the model.
struct SetAside {
  Id block = no_id;
  double time = 0.0;  ///< s
  Vec2 place;         ///< m, model coordinates
};

struct Accounts {
  DampingWork damping_work;
  double step_change_energy = 0.0;  ///< J, created by changes of the step
  double external_work = 0.0;  ///< J, work of loads, ground motion and velocity boundaries so far
  std::optional<double> start_energy;     ///< J, balance of the energies at the start
  double largest_energy = 0.0;            ///< J, largest scale of the energy balance so far
  double penetration = 0.0;               ///< m: largest penetration at the last step
  double max_penetration = 0.0;           ///< m, over the run
  std::optional<InitialBalance> initial;  ///< of the initial stress, as created; empty without one
  StepStatistics steps;
  OpenCloseCounts open_close;  ///< iterations of an implicit step count as passes
  std::vector<SetAside> set_aside;
  StepSeconds seconds;  ///< sampled; only their ratios are meaningful
};

}  // namespace edda
