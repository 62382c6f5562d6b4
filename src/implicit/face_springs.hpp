// Faces within one implicit step: their forces at a trial position, and which of their springs the
// global matrix has (theory, sections 12.2 and 12.3; Eqs. 37-40).
#pragma once

#include <cstdint>
#include <map>
#include <vector>

#include "contacts/face_stiffness.hpp"
#include "contacts/laws.hpp"
#include "contacts/tiled_faces.hpp"

namespace edda {

/// The faces of a step. As it begins both memories of the tiles are that of step n; of a trial
/// position `now` is changed alone.
struct TrialFaces {
  FaceSet& faces;
  TiledFaces& tiled;
};

/// Face k at the positions where the faces have last been evaluated.
FaceRow face_row(const TrialFaces& of, const BlockSet& blocks, const Pose& pose, std::size_t k);

/// Data of one step, [nf] each but `undecided`.
struct FaceSprings {
  std::vector<FaceEnds> normal;     ///< forces at the start of the step, N
  std::vector<double> cohesive;     ///< FaceFields::cohesive then
  std::vector<FaceEnds> limits;     ///< of shear, that follow from these
  std::vector<double> stored;       ///< J at the start of the step
  std::vector<std::uint8_t> state;  ///< at the last evaluation: 1 and 2: end a, b is closed; 4 and
                                    ///< 8: end a, b slides
  /// Faces of which something was decided in the step, as they were before.
  std::map<Id, FaceRecord> undecided;
  bool first = false;  ///< nothing has moved yet: ends that almost touch count as closed
};

/// Begins a step; no face sleeps from now on.
void begin_springs(FaceSprings& springs, const TrialFaces& of, const FaceScene& scene);

/// Evaluates every face at the current positions, with return mapping from the slips at the start
/// of the step, and sums the forces on the blocks. `step` s. `first`: before anything has moved;
/// ends that slid in the last step are then assumed to continue sliding. Returns how many faces
/// have changed their state.
std::size_t evaluate_springs(FaceSprings& springs, const TrialFaces& of, const FaceScene& scene,
                             double step, bool first, BodyVectors& on);

/// The springs of face k in the matrix.
FaceStiffness springs_of(const FaceSprings& springs, const FaceSet& faces, const FaceScene& scene,
                         double step, std::size_t k);

/// Breaks the bonds and faces in tension whose strength is exceeded. Returns their numbers,
/// ascending; the faces must then be evaluated again.
std::vector<Id> break_overloaded(FaceSprings& springs, const TrialFaces& of,
                                 const FaceScene& scene);

/// Accounts for the accepted step and makes its end the start of the next. The work of a face on
/// the blocks since x1, y1 is divided into stored energy, friction, fracture (of the faces
/// `broken`, ascending) and, as the remainder, dissipation by dashpots and the implicit scheme.
void account_springs(const FaceSprings& springs, const TrialFaces& of, const FaceScene& scene,
                     const std::vector<Id>& broken);

/// Returns to the start of a step that is not accepted.
void go_back(FaceSprings& springs, const TrialFaces& of, const BlockSet& blocks);

}  // namespace edda
