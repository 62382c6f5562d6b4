// Which faces of a tile sleep. A face that carries nothing, and of which nothing else that counts
// can change as long as the corners of its edges stay near their paths (open_lanes()), need not be
// looked at meanwhile. Where they are is bounded, never guessed: each vertex of the tile's edges
// goes on along a straight path at the pace of the step in which it was decided who sleeps, but for
// a margin that is checked, edge by edge. Faces with a narrow margin rest: they have records for
// their forces, and their chunk may wake alone; where a face that sleeps is to wake, it is decided
// anew for the whole tile. Nothing depends on which faces sleep, to the bit.
#pragma once

#include "contacts/tile_sweep.hpp"

namespace edda {

/// Adds the motion of the last step; the edges have been placed at n (SweepScratch::at). Wakes the
/// chunks that rest and may have to be looked at. Returns whether a face that sleeps might have to
/// wake, so that let_sleep() must be called before the tile is evaluated. Where none may sleep, it
/// gives all faces of the tile room.
bool sleep_is_over(FaceTiles& tiles, const SweepScene& scene, std::size_t tile,
                   SweepScratch& scratch);

/// Wakes a chunk that rests, before it is evaluated at n; where it sleeps, that must be decided
/// anew for its tile. pose: vertices at n and n - 1.
void wake_chunk(FaceTiles& tiles, const FaceSet& faces, const Pose& pose, std::size_t chunk);

/// Wakes and lets sleep; also brings faces together that do alike. The edges have been placed at n
/// and n - 1 (SweepScratch::then); FaceTiles::now is that of n, which has yet to be evaluated.
void let_sleep(FaceTiles& tiles, const SweepScene& scene, std::size_t tile, SweepScratch& scratch);

}  // namespace edda
