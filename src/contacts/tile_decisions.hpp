// What is decided of faces in tiles between two steps: the strength and the dilation of joints
// whose law depends on slip, and which joints are glued (contacts/joint_laws.hpp, face_bonds.hpp).
#pragma once

#include "contacts/face_tiles.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// update_joint_law() of all faces whose law changes, from n to n + 1, which FaceTiles::now must be
/// already.
void update_joint_laws(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks, const Pose& pose,
                       const LawTable& laws);

/// Between step n, whose state becomes final, and the evaluation at n + 1 (pose.x): adds up its
/// work, and decides what a step decides of joints before it. pose.x1: the vertices at n.
void begin_step(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks, const Pose& pose,
                const LawTable& laws);

/// Glues the faces that have been pressed for a whole step and are closed from end to end at its
/// end (glue_if_whole()), which FaceTiles::now is; x, y: the vertices then.
void glue_pressed(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks,
                  const std::vector<double>& x, const std::vector<double>& y);

}  // namespace edda
