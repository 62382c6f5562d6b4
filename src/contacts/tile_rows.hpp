// Faces by value, from their tiles (contacts/face_tiles.hpp), and the accumulated work of the
// FaceSet, which a step keeps there.
#pragma once

#include "contacts/face_reading.hpp"
#include "contacts/face_states.hpp"
#include "contacts/face_tiles.hpp"

namespace edda {

/// What the tiles remember of face k at n - 1, which is all that a step reads of it: 1 stands for
/// an energy, a gate or a closure above 0.
FaceFields remembered(const FaceTiles& tiles, std::size_t k);
/// The same of step n (which = FaceTiles::now) or n - 1.
FaceFields remembered(const FaceTiles& tiles, int which, std::size_t k);

/// Face k at n; FaceTiles::now must be that of n.
FaceRow face_row(const FaceSet& faces, const FaceTiles& tiles, const BlockSet& blocks,
                 const Pose& pose, std::size_t k);

/// Brings the accumulated work of face k up to date.
void recall_work(FaceSet& faces, const FaceTiles& tiles, std::size_t k);

/// Brings the accumulated work of all faces up to date.
void recall_work(FaceSet& faces, const FaceTiles& tiles);

/// Whether face k, which has carried nothing for two steps, remains open at these positions.
bool stays_open(const FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks,
                const Pose& pose, std::size_t k);

/// The states of all faces at n, and at n - 1 what a step reads of them.
FaceStates states_of(const FaceSet& faces, const FaceTiles& tiles, const BlockSet& blocks,
                     const Pose& pose);

/// Forces of all faces on their corners at n, N, [nf][8]: x and y at start and end of `edge`, at
/// start and end of `facing`.
std::vector<double> corner_forces(const FaceSet& faces, const FaceTiles& tiles,
                                  const BlockSet& blocks, const Pose& pose);

/// Makes the state of step n final: adds its work to the accumulated work and makes its memory that
/// of the step before. Then a step to n + 1 may be evaluated.
void next_step(FaceSet& faces, FaceTiles& tiles);

/// Visits the owned copies that have a bit of field `of` set in the last step, of the chunks of
/// tile `tile`: visit(k).
template <class Visit>
void for_found(const FaceTiles& t, std::size_t tile, unsigned of, Visit visit) {
  for (Id q = t.tiles[tile].first_chunk; q < t.tiles[tile].awake_end; ++q) {
    const LaneBits found = t.found[t.now][q] >> of & t.owned[q];
    if (found == 0) continue;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      if (lane_bits::test(found, 0, lane)) visit(t.face[q * lanes + lane]);
    }
  }
}

}  // namespace edda
