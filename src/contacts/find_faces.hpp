// The list of faces (theory, section 7.5): rebuilt when an edge may have come within reach of
// another, with the memory of the faces carried over.
#pragma once

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Lists all pairs of edges of two blocks that may act before any vertex has moved by half of
/// `reach` (m), and carries over the memory of those that were in the old list.
void find_faces(FaceSet& faces, const BlockSet& blocks, const State& state, const Pose& pose,
                const LawTable& laws, double reach);

/// Fills everything that follows from the edges and laws of the faces.
void complete_faces(FaceSet& faces, const BlockSet& blocks, const LawTable& laws);

}  // namespace edda
