// Which open contacts of a tile are skipped: a Verlet skin of its own for each contact. A face that
// carries nothing is not evaluated as long as the ends of its edges stay within a margin of their
// extrapolated paths, within which it cannot close (open_lanes()). The paths are straight, at the
// velocity of the step in which the skipped faces were chosen, and the deviation from them is
// bounded and checked, edge by edge. There are two kinds of skipped faces: one that rests has a
// narrow margin and keeps the records of its forces, so that its chunk may be evaluated again
// alone; one that sleeps has no memory, and where one must wake, the skipped faces of the whole
// tile are chosen again. (In other programs bodies at rest sleep; here it is open contacts, of
// bodies that move.) The results do not depend on which faces are skipped, to the bit.
#pragma once

#include "contacts/tile_sweep.hpp"

namespace edda {

/// Adds the motion of the last step; the edges have been placed at n (SweepScratch::at). Wakes the
/// resting chunks whose margin may be exceeded. Returns whether let_sleep() must be called before
/// the tile is evaluated: a sleeping face may have left its margin, or the skipped faces are due to
/// be chosen again. Where no face may be skipped, all have been awake and are given memory.
bool sleep_is_over(FaceTiles& tiles, const SweepScene& scene, std::size_t tile,
                   SweepScratch& scratch);

/// Wakes a chunk that rests, before it is evaluated at n; where it sleeps, the skipped faces of its
/// tile are marked as to be chosen again. pose: vertices at n and n - 1.
void wake_chunk(FaceTiles& tiles, const FaceSet& faces, const Pose& pose, std::size_t chunk);

/// Chooses the faces that are skipped, and sorts all by their kernel class. The edges have been
/// placed at n and n - 1 (SweepScratch::then); FaceTiles::now is that of n, which has yet to be
/// evaluated.
void let_sleep(FaceTiles& tiles, const SweepScene& scene, std::size_t tile, SweepScratch& scratch);

}  // namespace edda
