// Decides which faces act (theory, section 4.4).
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// Of a face at n - 1: whether it stored energy, and whether its gate was open.
struct WasActive {
  bool stored, on;
};

/// Decides those properties of face k that may change only while it stores no energy. The face acts
/// if it comes into being open, or the blocks overlap where it would press (docs/contacts.md);
/// otherwise it acts once it is open. So spurious contacts of back faces are filtered out: the far
/// sides of two thin blocks are opposed, too. Returns whether anything has changed.
bool decide_activity(FaceSet& faces, const BlockSet& blocks, const Pose& pose, WasActive before,
                     std::size_t k);

/// Whether the blocks of face k, which is closed, overlap each other where it presses: the point of
/// either edge at the centre of pressure lies in the other block, or that midway between in both.
/// Where a corner has slid past the end of the edge on which it pressed, what is left of the face
/// fades with the aspect gate, and its closure is no penetration.
bool overlap_where_pressed(const FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                           const Face& face, std::size_t k);

}  // namespace edda
