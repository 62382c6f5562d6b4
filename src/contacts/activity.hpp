// Decides which faces act (theory, section 4.4).
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// Decides those properties of face k that may change only while it stores no energy. The face acts
/// if it comes into being open, or if the points where it would press lie inside both blocks;
/// otherwise, as with the far sides of two thin blocks, which are opposed, too, it acts once it is
/// open. Returns whether anything has changed.
bool decide_activity(FaceSet& faces, const BlockSet& blocks, const Pose& pose, std::size_t k);

}  // namespace edda
