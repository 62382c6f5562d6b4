// How a run ended, and its cost.
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec2.hpp"
#include "blocks/block_set.hpp"
#include "observe/chatter.hpp"
#include "step/energy_balance.hpp"

namespace edda {

enum class Status { completed, equilibrium, collapsed, interrupted, failed };

constexpr std::string_view status_name(Status status) {
  constexpr std::string_view names[] = {"completed", "equilibrium", "collapsed", "interrupted",
                                        "failed"};
  return names[static_cast<int>(status)];
}

/// Wall time, s. search, forces and integrate divide the time of all steps in the proportions
/// sampled by StepClock.
struct WallSeconds {
  double total = 0.0, cut = 0.0, search = 0.0, forces = 0.0, integrate = 0.0, output = 0.0;
  double stepping = 0.0;  ///< all steps together
};

/// Penetration of two blocks relative to the smaller of their half-widths (BlockSet::inradius). At
/// ratio 1 a corner is as near to the far side of the block as to the side where it entered, and
/// the direction of the contact force is ambiguous. Short edges do not matter, since a corner also
/// meets the faces beside them.
struct Overlap {
  double ratio = 0.0;  ///< depth over half width
  double depth = 0.0;  ///< m
  Vec2 place;          ///< model coordinates
  Id block_i = no_id, block_j = no_id;
  double time = 0.0;  ///< s
};

/// Between which values of what it varies the ramp of a stage has failed.
struct RampOutcome {
  std::size_t stage = 0;  ///< row of Model::stages
  std::string vary;
  std::optional<double> holds, fails;
};

struct Outcome {
  Status status = Status::completed;
  std::string message;  ///< one sentence; for a failure: block, place, time, likely cause
  double time = 0.0;    ///< s, time reached
  std::uint64_t steps = 0;
  std::size_t contacts = 0;           ///< number of closed contacts at the end
  EnergyBalance energy;               ///< at the last row
  double largest_energy_error = 0.0;  ///< largest absolute value of all rows
  double largest_transfer = 0.0;  ///< largest absolute value of all rows, over the largest energy
  double unbalanced = 0.0;        ///< at the last row
  Overlap overlap;                ///< the largest of the run
  double overlap_now = 0.0;       ///< largest ratio at the end
  Id fastest = no_id;   ///< block with the fastest vertex at the last row; none: no block is free
  double speed = 0.0;   ///< m/s, of that vertex
  bool at_rest = true;  ///< at the last row
  double critical_step = 0.0;       ///< s: the smallest bound of the run
  double step_over_critical = 0.0;  ///< largest ratio of the step to the bound in force at the time
  double reaction_error =
      0.0;  ///< |boundary reactions + weight| over weight at the last row; 0 without either
  Chatter chatter;
  std::size_t on_nothing = 0;      ///< blocks without support at the start
  std::size_t slowed_in_fall = 0;  ///< most blocks at one row that fell freely while local damping
                                   ///< slowed them
  std::size_t loose = 0;           ///< most loose blocks at the end of a stage until equilibrium
  std::size_t unsettled = 0;       ///< stages until equilibrium that have ended without one
  std::optional<double> rigid_factor;  ///< of safety, of the blocks at the end as rigid ones; none
                                       ///< where nothing asks for it (RunOptions::rigid_factor)
  std::vector<RampOutcome> ramps;
  std::vector<std::string> failed_checks;  ///< checks of summary.json that failed, a sentence each
  WallSeconds wall;
};

}  // namespace edda
