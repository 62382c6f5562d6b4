// Which faces act.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// Decides what of face k may change while it stores nothing. It acts if it comes to life open, or
/// if the points where it would press lie in both blocks: the far sides of two thin ones are
/// opposed, too. Later it does once it is open. Whether anything is other than before.
bool judge_face(FaceSet& faces, const BlockSet& blocks, const Pose& pose, std::size_t k);

}  // namespace edda
