// Faces within one implicit step: what they carry at a trial position, and which of their springs
// the global matrix has (method.md section 6, Eqs. 37-40).
#pragma once

#include <cstdint>
#include <vector>

#include "contacts/face_stiffness.hpp"
#include "contacts/laws.hpp"
#include "contacts/place_faces.hpp"

namespace edda {

/// Memory of one step, [nf] each.
struct FaceSprings {
  ShearLimits limits;               ///< by the normal forces at the start of the step
  std::vector<double> stored;       ///< J at the start of the step
  std::vector<std::uint8_t> state;  ///< at the last evaluation: 1 and 2: end a, b is closed; 4 and
                                    ///< 8: it slides
  std::vector<double> acts, leans, offset_a, offset_b;  ///< verdicts at the start of the step
  bool first = false;  ///< nothing has moved yet: what all but touches is taken for closed
};

void begin_springs(FaceSprings& springs, const FaceSet& faces);

/// Every face at the positions as they are, by return map from the slips at the start of the step
/// (FaceSet::before). `step` s. `first`: before anything has moved, what slid a step ago is taken
/// to slide on. Returns how many faces have changed their state.
std::size_t evaluate_springs(FaceSprings& springs, FaceSet& faces, const BlockSet& blocks,
                             const Pose& pose, double step, bool first);

/// The springs of face k that the matrix has.
FaceStiffness springs_of(const FaceSprings& springs, const FaceSet& faces, const BlockSet& blocks,
                         const Pose& pose, double step, std::size_t k);

/// Bonds that do not bear what they have come to carry break. Returns their faces, ascending.
std::vector<Id> break_overloaded(FaceSprings& springs, FaceSet& faces, const BlockSet& blocks,
                                 const LawTable& laws);

/// Books the step once it is accepted, and makes its end the start of the next: what the forces of
/// a face took from the blocks, which were at x1, y1, is split into stored energy, friction,
/// fracture (of `broken`, ascending) and, the rest, what the dashpots and the implicit integration
/// dissipated.
void book_springs(const FaceSprings& springs, FaceSet& faces, const Pose& pose,
                  const std::vector<Id>& broken);

}  // namespace edda
