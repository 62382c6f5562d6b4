// The faces of a simulation, which are kept in tiles (contacts/face_tiles.hpp): their steps, and
// what else changes them.
#pragma once

#include "contacts/face_states.hpp"
#include "contacts/near_edges.hpp"

namespace edda {

struct FaceSet;
struct Simulation;
struct StepTaken;

/// The states of the faces, to be changed and put back. Brings their accumulated work up to date.
FaceStates take_faces(Simulation& sim);
FaceSet& faces_of(Simulation& sim);
/// Takes the faces, which have these states at pose.x and pose.x1, into tiles.
void put_faces(Simulation& sim, const FaceStates& states);

/// Changes the faces between two steps: change(FaceSet&, FaceStates&).
template <class Change>
void change_faces(Simulation& sim, Change change) {
  FaceStates states = take_faces(sim);
  change(faces_of(sim), states);
  put_faces(sim, states);
}

/// Before a step: divides the blocks again where other threads share them.
void fit_tiles(Simulation& sim);

/// Evaluates the faces at n + 1: memory, forces on the blocks; activity and bonds where they
/// change.
void place_in_tiles(Simulation& sim);

/// Contact activation (face_switching.hpp) of the faces.
void switch_in_tiles(Simulation& sim, const StepTaken& taken);

/// Evaluates the faces at n again, from their states at n - 1: memory, forces on the blocks. step:
/// between, s.
void reevaluate_at_n(Simulation& sim, double step);

/// Makes a new list of the faces.
void search_in_tiles(Simulation& sim, const Reach& reach);

/// Where memory has run out: tiles of a list that was not completed must not be read. The faces
/// carry nothing then.
void lose_faces(Simulation& sim);

}  // namespace edda
