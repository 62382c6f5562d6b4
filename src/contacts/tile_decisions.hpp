// What is decided of faces in tiles between two steps: the strength and the dilation of joints
// whose law depends on slip, and which joints are glued (contacts/joint_laws.hpp, face_bonds.hpp).
#pragma once

#include "contacts/face_tiles.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// As update_joint_laws() of the rows; FaceTiles::now must be that of n + 1 already.
void update_joint_laws(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks, const Pose& pose,
                       const LawTable& laws);

/// Glues the faces that have been pressed for a whole step and are closed from end to end at its
/// end (glue_if_whole()), which FaceTiles::now is; x, y: the vertices then.
void glue_pressed(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks,
                  const std::vector<double>& x, const std::vector<double>& y);

}  // namespace edda
