// Contact springs within one implicit step: what they carry at a trial position, and in which of
// the three states of the open-close iteration each one is (method.md section 6, Eqs. 37-40).
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// What the global matrix takes a contact for.
enum class SpringState : std::uint8_t {
  open,   ///< no spring
  stick,  ///< normal and tangential spring
  slide,  ///< normal spring, and friction as a load
  shear   ///< bonded but apart, and without tensile strength: tangential spring alone
};

/// Memory of one step, [nc] each. Filled by begin_springs(), extended by nothing: a contact that
/// closes within the step starts from the anchor it then has.
struct ContactSprings {
  std::vector<SpringState> state;     ///< at the last evaluation
  std::vector<double> anchor;         ///< xi0 at the start of the step
  std::vector<double> limit;          ///< of shear, N, by the normal force at the start of the step
  std::vector<double> stored;         ///< J at the start of the step
  std::vector<std::uint8_t> known;    ///< closed at the start of the step, or since
  std::vector<std::uint8_t> assumed;  ///< open, and in the matrix by assume_touching()
};

void begin_springs(ContactSprings& springs, const ContactSet& contacts);

/// Normal and shear force of every contact at the gaps as they are, by return map from the anchors
/// at the start of the step; anchors, forces on the vertices and states follow. `step` s; `damping`
/// zeta of the viscous part. `first`: before anything has moved, what slid a step ago is taken to
/// slide on. Returns how many contacts have changed their state.
std::size_t evaluate_springs(ContactSprings& springs, ContactSet& contacts, const BlockSet& blocks,
                             double step, double damping, bool first);
/// Takes for the first matrix of a step what all but touches for closed, and sticking.
void assume_touching(ContactSprings& springs, const ContactSet& contacts, const BlockSet& blocks,
                     const Pose& pose);

/// Books the step once it is accepted: with positions a step ago in x1, y1, what the contact's
/// forces took from the blocks is split into stored energy, friction, fracture (of `broken`,
/// ascending) and, the rest, what the dashpots and the implicit integration dissipated.
void book_springs(const ContactSprings& springs, ContactSet& contacts, const Pose& pose,
                  const std::vector<Id>& broken);

}  // namespace edda
