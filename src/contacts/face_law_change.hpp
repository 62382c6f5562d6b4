// Faces whose joint gets another law during a run (stage.change).
//
// Forces go on from what they are. With stiffnesses k before and k' after, the closure d of both
// ends becomes d k/k' by the locked closure, so that the pressure, linear between them, is the same
// everywhere, and the elastic slip u becomes u ks/ks'. An open joint keeps its gap. What the
// strength cannot bear any more, the next step lets go.
//
// A joint that has never opened or slipped, and whose bond is whole, has the peak strength of its
// new law; one that has, the residual one. Accumulated slip counts on.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Gives the faces on edges marked in `changed` ([nv]) the laws that follow from the joints and
/// materials of `blocks`, where they had those that follow from `old`; pose: at n and n - 1.
void change_laws(FaceSet& faces, FaceStates& states, const BlockSet& old, const BlockSet& blocks,
                 const Pose& pose, const LawTable& laws, const std::vector<std::uint8_t>& changed);

/// Whether all laws have the stiffness that they have had.
bool is_as_stiff(const LawTable& old, const LawTable& laws);
/// The laws have changed from `old` to `laws`: forces go on with the new stiffness, and bonds that
/// have got tensile strength carry tension.
void follow_laws(FaceSet& faces, FaceStates& states, const BlockSet& blocks, const Pose& pose,
                 const LawTable& old, const LawTable& laws);

}  // namespace edda
