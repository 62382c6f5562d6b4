// The list of faces (theory, section 7.5): rebuilt when an edge may have come within reach of
// another, with the memory of the faces carried over.
#pragma once

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"
#include "contacts/near_edges.hpp"

namespace edda {

/// Lists all pairs of edges of two blocks that may act before any vertex has moved by half of
/// reach.apart, sorted by `edge`, then by `facing`, and carries over the kept columns and the flags
/// of those that were in the old list. near: what this search leaves to the next one; carry: [nf]
/// 1: the face stores energy. Returns for each face of the new list its row in the old one, or
/// no_id.
std::vector<Id> find_faces(FaceSet& faces, const BlockSet& blocks, const State& state,
                           const Pose& pose, const LawTable& laws, const Reach& reach,
                           NearEdges& near, const std::vector<std::uint8_t>& carry);

/// Notes where the blocks are as the list is made, and its reach.
void note_list(FaceSet& faces, const Pose& pose, const Reach& reach);

/// Fills everything that follows from the edges and laws of the faces.
void complete_faces(FaceSet& faces, const BlockSet& blocks, const LawTable& laws);

}  // namespace edda
