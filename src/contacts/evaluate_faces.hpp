// Evaluation of the faces at the positions of the blocks: forces, slip, and which of them act.
// Theory, sections 4.2 to 4.4.
#pragma once

#include "blocks/masses.hpp"
#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// The blocks and laws that the faces refer to.
struct FaceScene {
  const BlockSet& blocks;
  const Masses& masses;
  const Pose& pose;
  const LawTable& laws;
};

/// Evaluates every face at the positions pose.x, y of step n, from its memory at n - 1 in `before`
/// and the positions then, pose.x1, y1: fills `now` and the forces, and breaks bonds that fail. May
/// be called again for other positions of the same step. step: from n - 1 to n, s, for dashpots.
void evaluate_faces(FaceSet& faces, const FaceScene& scene, double step);

/// evaluate_faces() for one face.
void evaluate_face(FaceSet& faces, const FaceScene& scene, double step, std::size_t k);

/// What evaluate_face() decides of a face whose state at n - 1 is this, whatever the rows hold:
/// activity, and whether its bond breaks.
void decide_face(FaceSet& faces, const FaceScene& scene, double step,
                 const FaceFields<double>& before, std::size_t k);

/// Changes the last step to one made from pose.x1, y1 instead of old_x1, old_y1: corrects what the
/// faces remember of it, and leaves their forces as they are. `now` must be evaluated again.
void correct_last_step(FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                       const std::vector<double>& old_x1, const std::vector<double>& old_y1);

/// Makes the state of this step final: adds its work to the accumulated work and swaps `now` and
/// `before`, so that `before` is that of step n. Call before the next step's evaluate_faces().
void next_step(FaceSet& faces);

/// Counts the bonds that broke in this step, and ends their failure.
void count_failures(FaceSet& faces);

/// As next_step(), for a method that starts every step from the end of the last one: `now` and
/// `before` are both those of step n.
void begin_from_step_end(FaceSet& faces);

/// The element of face k at other positions, with its current properties, or with its locked
/// closure less by `risen`.
Face face_at(const FaceSet& faces, const BlockSet& blocks, const std::vector<double>& x,
             const std::vector<double>& y, std::size_t k, double risen = 0.0);

/// Applies the activation factor alpha (theory, section 6.2) to the normal forces of face k at step
/// n - 1 (`before`) and cuts its shear forces again to the limit that belongs to it. at, then: the
/// corners at n - 1 and at n - 2. Corrects the work of the step. Returns the forces of the face.
CornerForces recompute_shear(FaceSet& faces, FaceFields<double>& before, const Face& face,
                             const FacePoints& at, const FacePoints& then, double alpha,
                             std::size_t k);

}  // namespace edda
