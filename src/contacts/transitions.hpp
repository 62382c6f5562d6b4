// Narrow phase, second half: which candidates carry (method.md section 4, "Which contacts exist").
//
//   open, penetrated from outside, allowed       -> closed
//   open, already penetrated when it appears     -> stays open with rest penetration d0 = d, or
//   takes
//                                                   over from the contact it succeeds
//   closed, d <= d0, not bonded                  -> open
//   closed, foot off the edge                    -> handed to its successor, or lets go within r_v
//   penetrated, not allowed                      -> blocked until it may, then born where it is
#pragma once

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

struct TransitionCounts {
  std::uint64_t closed = 0, opened = 0, handed_over = 0, born_inside = 0;
  std::uint64_t unshielded = 0;  ///< may carry from now on: the step bound does not know them yet
};

/// Lists of one step, kept so that a step allocates nothing once they have grown.
struct TransitionScratch {
  std::vector<Id> opens, leaves, returns, closes, still_blocked;
  std::vector<Blocked> verdict;  ///< of closes
};

/// Brings every candidate's state in line with the gaps at step n; needs update_gaps() and
/// update_shares(). `start`: nothing is born inside yet, so what overlaps as drawn is preloaded.
TransitionCounts settle_contacts(ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                                 const LawTable& laws, std::uint64_t step, bool start,
                                 TransitionScratch& scratch);

/// Closes what has come to touch within the step in hand (from outside, allowed) and nothing else,
/// so that an implicit method can go on with it in the same step. Returns how many.
std::uint64_t close_in_step(ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                            const LawTable& laws, TransitionScratch& scratch);

/// Blocks the open candidates of a new list that a shield covers (contacts/shield.hpp), before they
/// touch.
void block_shielded(ContactSet& contacts, const BlockSet& blocks, const Pose& pose);

/// Blocks what only seems to be penetrated as drawn: the vertex lies below the line of an edge, but
/// not in the block, as where it touches the near side of a thin wedge, and the edge is the far
/// one. Before anything is bonded or closed.
void block_far_sides(ContactSet& contacts, const BlockSet& blocks, const Pose& pose);

/// Whether candidate k may close now, and why not. `long_step`: a vertex may have gone deeper in
/// one step than it lies from the next edge, so the edge that it has crossed counts and not the one
/// least penetrated. Public for the tests.
Blocked hindrance(const ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                  std::size_t k, bool long_step = false);

}  // namespace edda
