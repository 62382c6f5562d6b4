// Narrow phase, first half: where every candidate stands.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"
#include "contacts/gap.hpp"

namespace edda {

/// Gap, foot and range of candidate k at step n (Eq. 32 over l).
void update_gap(ContactSet& contacts, const Pose& pose, std::size_t k);

/// All of them, after moving the gaps of the steps before back by one; and which chunks stir.
void update_gaps(ContactSet& contacts, const Pose& pose);

/// All of them where the vertices are now, the gaps of the steps before left as they are.
void remeasure_gaps(ContactSet& contacts, const Pose& pose);

/// Makes the gaps of the steps before those of step n. In the ledger's terms the contacts then
/// store what springs at rest do, p d^2/2: for a method whose positions and velocities belong to
/// one instant.
void stand_still(ContactSet& contacts);

/// The edge of candidate k as pose.x1, y1 have it, and where its vertex was against it.
inline EdgeFrame previous_edge(const ContactSet& c, const Pose& pose, std::size_t k) {
  return edge_frame(at(pose.x1, pose.y1, c.edge[k]), at(pose.x1, pose.y1, c.edge_end[k]));
}
inline Gap previous_gap(const ContactSet& c, const Pose& pose, std::size_t k) {
  return gap_to(previous_edge(c, pose, k), at(pose.x1, pose.y1, c.vertex[k]));
}

/// Gaps a step ago from pose.x1, y1, at the start of a run.
void look_at_previous_gaps(ContactSet& contacts, const Pose& pose);

/// Slips against the present anchors with the vertices at pose.x1, y1, [contacts] m.
std::vector<double> previous_slips(const ContactSet& contacts, const Pose& pose);
/// The slip s_n - s_{n-1} of closed contacts becomes that of the step from pose.x1, y1, from what
/// previous_slips() was `before`: s_{n-1} moves where they hold, where they slide the anchor. The
/// ledger then counts what springs store, and what friction takes, along that step.
void move_previous_slips(ContactSet& contacts, const Pose& pose, const std::vector<double>& before);

/// Books what the dashpots of the last step took: what the springs gave off, less what the
/// contacts' forces did on the blocks, p e_n (e_{n-1} - e_{n+1})/2 + alpha N (d_{n+1} - d_{n-1})/2.
void book_dashpots(ContactSet& contacts);

}  // namespace edda
