// How a run ended, and what it cost.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "base/vec2.hpp"
#include "blocks/block_set.hpp"
#include "run/chatter.hpp"
#include "run/ledger.hpp"

namespace edda {

enum class Status { completed, equilibrium, collapsed, interrupted, failed };

constexpr std::string_view status_name(Status status) {
  constexpr std::string_view names[] = {"completed", "equilibrium", "collapsed", "interrupted",
                                        "failed"};
  return names[static_cast<int>(status)];
}

/// Wall time, s. search, forces and integrate share out the time of all steps as sampled by
/// StageClock.
struct WallSeconds {
  double total = 0.0, cut = 0.0, search = 0.0, forces = 0.0, integrate = 0.0, output = 0.0;
  double stepping = 0.0;  ///< all steps together
};

/// How far two blocks have gone into each other, by the smaller of their half widths
/// (BlockSet::inradius): as deep as that, a corner is as near to the far side of the block as to
/// the one that it came in by, and nothing says which way out is. Short edges do not matter: a
/// corner meets the faces beside them, too.
struct Overlap {
  double ratio = 0.0;  ///< depth over half width
  double depth = 0.0;  ///< m
  Vec2 place;          ///< model coordinates
  Id block_i = no_id, block_j = no_id;
  double time = 0.0;  ///< s
};

struct Outcome {
  Status status = Status::completed;
  std::string message;  ///< one sentence; of a failure: block, place, time, likely cause
  double time = 0.0;    ///< s reached
  std::uint64_t steps = 0;
  std::size_t contacts = 0;         ///< closed at the end
  Ledger ledger;                    ///< at the last row
  double largest_drift = 0.0;       ///< of all rows, in size
  double largest_transfer = 0.0;    ///< of all rows, in size, of the largest energy
  double unbalanced = 0.0;          ///< at the last row
  Overlap overlap;                  ///< the largest of the run
  double overlap_now = 0.0;         ///< ratio of the largest at the last row
  Id fastest = no_id;               ///< block with the fastest corner at the last row; none is free
  double speed = 0.0;               ///< m/s, of that corner
  bool at_rest = true;              ///< at the last row
  double critical_step = 0.0;       ///< s: the smallest bound of the run
  double step_over_critical = 0.0;  ///< largest step over the bound then in force
  double reaction_error =
      0.0;  ///< |boundary reactions + weight| over weight at the last row; 0 without either
  Chatter chatter;
  std::size_t on_nothing = 0;              ///< blocks that rested on nothing at the start
  std::size_t held_back = 0;               ///< most blocks at one row that fell freely while local
                                           ///< damping held them back
  std::size_t loose = 0;                   ///< most blocks that had come loose at the end of a
                                           ///< stage until equilibrium, but for pebbles
  std::vector<std::string> failed_checks;  ///< of summary.json, a sentence each
  WallSeconds wall;
};

}  // namespace edda
