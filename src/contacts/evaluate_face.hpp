// A single face at the positions of the blocks, and what is decided of it there. The faces of a
// step are evaluated in tiles (contacts/tiled_faces.hpp), with the same bits. Theory, sections 4.2
// to 4.4.
#pragma once

#include "blocks/masses.hpp"
#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// The blocks and laws that the faces refer to.
struct FaceScene {
  const BlockSet& blocks;
  const Masses& masses;
  const Pose& pose;
  const LawTable& laws;
};

/// A face at step n: its state, the forces on its corners, N, and whether decide_activity() must
/// be called for it.
struct EvaluatedFace {
  FaceFields state;
  CornerForces force;
  bool undecided;
};

/// Face k at the positions pose.x, y of step n, from its state at n - 1 and the positions then,
/// pose.x1, y1. step: from n - 1 to n, s, for dashpots.
EvaluatedFace evaluate_face(const FaceSet& faces, const FaceScene& scene, double step,
                            const FaceFields& before, std::size_t k);

/// Decides whether face k acts, and whether its bond breaks, where its state at n - 1 is this.
void decide_face(FaceSet& faces, const FaceScene& scene, double step, const FaceFields& before,
                 std::size_t k);

/// Changes the last step to one made from pose.x1, y1 instead of old_x1, old_y1: corrects what the
/// faces remember of it. They must be evaluated again.
void correct_last_step(const FaceSet& faces, FaceStates& states, const BlockSet& blocks,
                       const Pose& pose, const std::vector<double>& old_x1,
                       const std::vector<double>& old_y1);

/// Counts the bonds that broke in this step, and ends their failure.
void count_failures(FaceSet& faces);

/// The element of face k at other positions, with its current properties, or with its locked
/// closure less by `risen`.
Face face_at(const FaceSet& faces, const BlockSet& blocks, const std::vector<double>& x,
             const std::vector<double>& y, std::size_t k, double risen = 0.0);

/// EndMotion::slip of face k from the corners `then` to `at`, at which it is this element, m.
FaceEnds slip_of(const FaceSet& faces, const Face& face, const FacePoints& at,
                 const FacePoints& then, std::size_t k);

/// Applies the activation factor alpha (theory, section 6.2) to the normal forces of face k at step
/// n - 1 (`before`) and cuts its shear forces again to the limit that belongs to it. at, then: the
/// corners at n - 1 and at n - 2. Corrects the work of the step. Returns the forces of the face.
CornerForces recompute_shear(FaceSet& faces, FaceFields& before, const Face& face,
                             const FacePoints& at, const FacePoints& then, double alpha,
                             std::size_t k);

}  // namespace edda
