// From the tiles of one list of faces to those of the next (contacts/face_tiles.hpp).
#pragma once

#include "contacts/face_tiles.hpp"

namespace edda {

/// Lays the tiles out for a new list of faces, at the end of a step. The blocks stay in their
/// tiles, and faces keep what they remember. old_row: [nf] row of each face in the old list, or
/// no_id; pose: vertices at n and n - 1.
void renew_tiles(FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                 const std::vector<Id>& old_row);

/// Whether any dashpot has done work in the last step or has yet to do it.
bool dashpots_work(const FaceTiles& tiles);

/// Part of the faces that lie in two tiles.
double part_in_two_tiles(const FaceTiles& tiles);

}  // namespace edda
