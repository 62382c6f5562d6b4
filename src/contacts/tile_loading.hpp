// To the tiles of the faces (contacts/face_tiles.hpp): their states, and what is decided of them.
// tile_rows.hpp has the way back.
#pragma once

#include "contacts/face_states.hpp"
#include "contacts/face_tiles.hpp"

namespace edda {

/// Fills everything from the states of the faces at the end of a step, with the positions of that
/// step. divide_blocks() must have been called for these blocks.
void load_faces(FaceTiles& tiles, const FaceSet& faces, const FaceStates& states,
                const BlockSet& blocks, const Pose& pose);

/// Copies to the tiles what decisions change of face k: stiffness, strength, locked closures, and
/// its accumulated work.
void load_decisions(FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks, std::size_t k);

/// The constants of a chunk of a tile. changed: bits of the lanes to be loaded; the others have
/// their constants already.
void load_chunk_constants(FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks,
                          std::size_t tile, std::size_t chunk, unsigned changed = 0xff);

/// Copies strength, locked closures and accumulated work of these faces of a chunk to the tiles:
/// lanes with a bit in `changed`.
void load_strengths(FaceTiles& tiles, const FaceSet& faces, std::size_t tile, std::size_t chunk,
                    unsigned changed);

/// The constants of all chunks of a tile, for which it has been laid out.
void load_constants(FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks,
                    std::size_t tile);

/// Copies to the tiles what the correction of switching has changed of face k (recompute_shear()):
/// its slip at n - 1 (`before`) and its accumulated work.
void load_correction(FaceTiles& tiles, const FaceSet& faces, const FaceFields& before,
                     std::size_t k);

/// The accumulated work of face k, of which a copy is at a place.
void load_sums(FaceTiles& tiles, const FaceSet& faces, std::size_t place, std::size_t k);

/// Coordinates of the corners of the face at a place, at step n (which = FaceTiles::now) or n - 1.
void load_corners(FaceTiles& tiles, const EdgeCoordinates& at, int which, std::size_t place);

}  // namespace edda
