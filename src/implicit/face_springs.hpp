// Faces within one implicit step: their forces at a trial position, and which of their springs the
// global matrix has (theory, sections 12.2 and 12.3; Eqs. 37-40).
#pragma once

#include <cstdint>
#include <vector>

#include "contacts/evaluate_faces.hpp"
#include "contacts/face_stiffness.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Data of one step, [nf] each.
struct FaceSprings {
  ShearLimits limits;          ///< shear limits from the normal forces at the start of the step
  std::vector<double> stored;  ///< J at the start of the step
  std::vector<std::uint8_t> state;  ///< at the last evaluation: 1 and 2: end a, b is closed; 4 and
                                    ///< 8: end a, b slides
  std::vector<double> acts, leans, locked_closure_a,
      locked_closure_b;  ///< values at the start of the step
  bool first = false;    ///< nothing has moved yet: ends that almost touch count as closed
};

void begin_springs(FaceSprings& springs, const FaceSet& faces);

/// Evaluates every face at the current positions, with return mapping from the slips at the start
/// of the step (FaceSet::before). `step` s. `first`: before anything has moved; ends that slid in
/// the last step are then assumed to continue sliding. Returns how many faces have changed their
/// state.
std::size_t evaluate_springs(FaceSprings& springs, FaceSet& faces, const FaceScene& scene,
                             double step, bool first);

/// The springs of face k in the matrix.
FaceStiffness springs_of(const FaceSprings& springs, const FaceSet& faces, const FaceScene& scene,
                         double step, std::size_t k);

/// Breaks the bonds and faces in tension whose strength is exceeded. Returns their numbers,
/// ascending.
std::vector<Id> break_overloaded(FaceSprings& springs, FaceSet& faces, const BlockSet& blocks,
                                 const LawTable& laws);

/// Accounts for the accepted step and makes its end the start of the next. The work of a face on
/// the blocks since x1, y1 is divided into stored energy, friction, fracture (of the faces
/// `broken`, ascending) and, as the remainder, dissipation by dashpots and the implicit scheme.
void account_springs(const FaceSprings& springs, FaceSet& faces, const Pose& pose,
                     const std::vector<Id>& broken);

}  // namespace edda
