// Strength of faces: bonds, which keep the peak strength until they break, and glue (theory,
// sections 5.1 to 5.3).
#pragma once

#include <algorithm>

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Whether the edges of face k lie along each other within 8 degrees and touch as drawn: the larger
/// closure of the two ends is zero to within `gap` of the smaller block's size.
bool touch_as_drawn(const FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                    const Face& face, std::size_t k, double gap = touching_gap);

/// Bonds the faces that touch at the start, to within what drawing may leave, and whose law has
/// cohesion, tensile strength, glue or a peak friction angle above the residual one. Those with
/// tensile strength or glue carry tension. A face is bonded as a whole and breaks as a whole. What
/// drawing leaves is taken back by the locked closure. states: of the faces, which have never
/// carried load. of_blocks: [nb] 1: of the faces of these blocks alone; null: of all.
void bond_faces(FaceSet& faces, FaceStates& states, const BlockSet& blocks, const Pose& pose,
                const LawTable& laws, const std::vector<std::uint8_t>* of_blocks = nullptr);

/// Whether two edges lie against each other as drawn along the whole overlap, within the accuracy
/// of drawings, a thousandth of it.
inline bool lies_flush_as_drawn(FaceEnds drawn, double length) {
  constexpr double accuracy = 1e-3;
  return std::min(drawn.a, drawn.b) > -accuracy * length;
}

/// Whether any face has a bond that may fail.
inline bool has_bonds(const FaceSet& faces) {
  for (std::size_t k = 0; k < faces.size(); ++k) {
    if (faces.bonded(k) && !faces.glued(k)) return true;
  }
  return false;
}

/// Whether face k fails in this state. A bond fails where its shear force exceeds c L +
/// tan(phi) N; in tension where outer_tension() exceeds sigma_t L; without tensile strength where
/// the face gapes all along by more than drawn_gap of the smaller block's size. A face that carries
/// tension without a bond fails in tension alone.
bool bond_fails(const FaceSet& faces, const BlockSet& blocks, const FaceFields& now, std::size_t k);

/// Face k breaks. One that tension has cracked from one end, while the other is pressed, keeps its
/// cohesion and its friction, as if it had never had more than its residual tensile strength; else
/// it has its residual strength from now on. It has no tensile strength if its tension exceeds the
/// residual one, too.
void break_bond(FaceSet& faces, const BlockSet& blocks, const LawTable& laws, const FaceFields& now,
                std::size_t k);

/// Accounts for `lost` (J), the decrease of the stored energy of face k at failure: as fracture
/// energy where it is positive, as `transfer` (no physical process) where it is negative.
void account_failure_energy(FaceSet& faces, double lost, std::size_t k);

/// glue_faces: joints whose edges lie flush against each other neither open nor slide from now on.
/// A corner on an edge keeps its friction: a bond there would be a shear spring that no pressure
/// holds, on an edge that leans now to one side and now to the other, and would create energy.
/// unglue_faces gives the joints back the state they had before; tension that is then released is
/// accounted as fracture energy.
void glue_faces(FaceSet& faces, const FaceStates& states, bool also_later = true);
void unglue_faces(FaceSet& faces, const BlockSet& blocks, const Pose& pose);
/// In a stage that glues its joints: glues face k, which has come into contact since and has been
/// pressed for a whole step, if it is closed from end to end; closure: now, m. Returns whether it
/// does.
bool glue_if_whole(FaceSet& faces, FaceEnds closure, std::size_t k);

/// Sets the dashpots of all faces to `damping`, a fraction of critical, or to the values of their
/// law where it has its own.
void set_face_dashpots(FaceSet& faces, const LawTable& laws, double damping);

}  // namespace edda
