// Open-close iteration with exact switching (method.md section 4): corrects the step just made for
// the contacts that opened or closed in it.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/contact_set.hpp"
#include "run/push_block.hpp"

namespace edda {

struct OpenCloseCounts {
  std::uint64_t steps = 0;      ///< with at least one pass
  std::uint64_t passes = 0;     ///< over all steps
  std::uint64_t most = 0;       ///< passes in one step
  std::uint64_t switched = 0;   ///< contacts that opened or closed
  std::uint64_t unsettled = 0;  ///< steps that had not settled after the last pass
  std::vector<Id> of_contact;   ///< [nc] those of each, since the list of contacts was made
  std::uint64_t of_list = 0;    ///< ContactSet::rebuilds
};

/// A contact that opened, closed or turned its shear round in the step in hand.
struct Switcher {
  Id contact;
  // Where it was at step n, when its force acted.
  Vec2 t;
  double length, foot, depth;
  double push;             ///< q of contacts/switching.hpp: what its whole force takes from d, m
  double moved_per_force;  ///< m/N
  std::uint64_t seen;      ///< tick at which it was last corrected
  bool done;               ///< it changed by next to nothing then
};

/// Lists of one step, kept so that a step allocates nothing once they have grown.
struct SwitchingScratch {
  std::vector<Switcher> set;         ///< by contact
  std::vector<Id> pushed;            ///< blocks that have moved since the gaps were looked at
  std::vector<std::uint64_t> moved;  ///< [nb] tick at which a contact last moved the block
  std::uint64_t tick = 0;            ///< corrections so far
};

/// At entry: positions and gaps of step n + 1 made with alpha = 1; state flags and forces of step
/// n. At return both are final. Passes: at most 30. Returns the largest penetration of step n, m.
double correct_switching(ContactSet& contacts, const BlockSet& blocks, State& state, Pose& pose,
                         const StepTaken& taken, OpenCloseCounts& counts,
                         SwitchingScratch& scratch);

/// Largest effective penetration of a closed contact at step n, once the gaps of n + 1 are known,
/// m.
double largest_penetration(const ContactSet& contacts);

}  // namespace edda
