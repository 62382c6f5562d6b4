// Trial positions of a step in tiles: as it begins both memories are that of step n, and a trial
// changes that of FaceTiles::now alone. For the implicit method, which evaluates several trials in
// a step.
#pragma once

#include "contacts/tile_rows.hpp"

namespace edda {

/// Begins a step in which the limits of the shear forces are given, until its trial is kept or
/// dropped; they are 0 until they are set.
void begin_limits(FaceTiles& tiles);
/// The limits at the ends of face k, N.
void limit_shear(FaceTiles& tiles, FaceEnds limit, std::size_t k);

/// Accepts the trial: it becomes that of step n, with no work of its own. The accumulated work of
/// the faces is that of the FaceSet.
void keep_trial(FaceTiles& tiles, const FaceSet& faces);
/// Drops the trial: what is remembered of step n holds again.
void drop_trial(FaceTiles& tiles);

/// Ends a step at rest: its work is accumulated, and the state just evaluated becomes that of step
/// n and of the step before.
void end_at_rest(FaceSet& faces, FaceTiles& tiles, const BlockSet& blocks, const Pose& pose);

}  // namespace edda
