// Faces from where the blocks are: forces, slip, and which of them act.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Works out every face at the positions pose.x, y of step n, from its memory at n - 1 in `before`
/// and the positions then, pose.x1, y1: fills `now` and the forces. May be called again for other
/// positions of the same step. Bonds that give way break. step: from n - 1
/// to n, s, for dashpots.
void place_faces(FaceSet& faces, const BlockSet& blocks, const Pose& pose, const LawTable& laws,
                 double step);

/// The same for one face.
void place_face(FaceSet& faces, const BlockSet& blocks, const Pose& pose, const LawTable& laws,
                double step, std::size_t k);

/// Limits of the shear forces at the ends of the faces for a whole step of the implicit method, N.
struct ShearLimits {
  std::vector<double> a, b;
};

/// As place_faces(), under these limits whatever the normal forces are; no bond breaks.
void try_faces(FaceSet& faces, const BlockSet& blocks, const Pose& pose, double step,
               const ShearLimits& limits);

/// The step behind is taken to have been made from pose.x1, y1 and no longer from old_x1, old_y1:
/// what the faces remember of it is set right, their forces stay. `now` is to be placed again.
void change_step_behind(FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                        const std::vector<double>& old_x1, const std::vector<double>& old_y1);

/// What has been worked out is final; `before` is ready to be written. Before the next step's
/// place_faces().
void next_step(FaceSet& faces);

/// As next_step(), for a method that starts every step from the end of the one before: `now` and
/// `before` are those of step n.
void stand_still(FaceSet& faces);

/// The face at other positions, as it acts now.
Face face_at(const FaceSet& faces, const BlockSet& blocks, const std::vector<double>& x,
             const std::vector<double>& y, std::size_t k);

/// The part alpha of the normal forces of face k is all that friction feels at step n - 1 (in
/// `before`): its shear forces are cut again. at, then: the corners then and a step earlier.
/// Returns the forces of the face. The work of the step is set right.
CornerForces cut_again(FaceSet& faces, const Face& face, const FacePoints& at,
                       const FacePoints& then, double alpha, std::size_t k);

}  // namespace edda
