// What is decided of faces in tiles between two steps: the strength and the dilation of joints
// whose law depends on slip, and which joints are glued (contacts/joint_laws.hpp, face_bonds.hpp).
#pragma once

#include "contacts/face_tiles.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// update_joint_law() of all faces whose law changes, from n to n + 1. FaceTiles::now must be that
/// of n + 1.
void update_joint_laws(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks, const Pose& pose,
                       const LawTable& laws);

/// Makes step n final, before the evaluation at n + 1 (pose.x): accumulates its work, and updates
/// the joint laws for n + 1. pose.x1: the vertices at n.
void begin_step(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks, const Pose& pose,
                const LawTable& laws);

/// Glues the faces that have been pressed for a whole step and are closed from end to end after it
/// (glue_if_whole()). FaceTiles::now must be that of its end; x, y: the vertices then.
void glue_pressed(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks,
                  const std::vector<double>& x, const std::vector<double>& y);

}  // namespace edda
