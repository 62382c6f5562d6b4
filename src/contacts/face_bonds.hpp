// Strength of faces: bonds, which hold the peak strength until they break, and glue.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Whether the edges of face k lie along each other and touch as drawn: within 8 degrees, and at
/// one end at least within 1e-6 of the smaller block's size.
bool touch_as_drawn(const FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                    const Face& face, std::size_t k);

/// Bonds the faces that touch at the start (their gap is within 1e-6 of the smaller block's size)
/// and whose law has cohesion, tension, glue or a peak friction above the residual. Those with
/// tensile strength, or glue, pull. A face is bonded as a whole, and breaks as a whole.
void bond_faces(FaceSet& faces, const BlockSet& blocks, const Pose& pose, const LawTable& laws);

/// Gives face k the residual strength of its law.
void take_residual(FaceSet& faces, const LawTable& laws, std::size_t k);

/// Whether face k has to give way, as it stands in `now`. A bond does where its shear force exceeds
/// c L + tan(phi) N; where it is torn, -k min(da, db) > sigma_t; without tensile strength, where it
/// gapes all over, by more than 1e-6 of the smaller block's size. What pulls without a bond does
/// where it is torn.
bool gives_way(const FaceSet& faces, const BlockSet& blocks, std::size_t k);

/// Face k breaks: it has its residual strength from now on, or none where that is spent, too.
void break_bond(FaceSet& faces, const LawTable& laws, std::size_t k);

/// What face k stored goes with its bond (J): to fracture. What it stores more is no physics.
void take_lost_energy(FaceSet& faces, double lost, std::size_t k);

/// Joints that touch neither open nor slide from now on; and do again, with what they had before:
/// what is in tension then lets go, which is booked as fracture energy.
void glue_faces(FaceSet& faces);
void unglue_faces(FaceSet& faces, const BlockSet& blocks, const Pose& pose);
/// Meanwhile, what has come to touch is glued once it has been pressed for a whole step.
void glue_pressed(FaceSet& faces);

/// Fills `bonds`.
void note_bonds(FaceSet& faces);

/// Dashpots of all faces, `damping` a fraction of critical, and of laws that have their own.
void set_face_dashpots(FaceSet& faces, const LawTable& laws, double damping);

}  // namespace edda
