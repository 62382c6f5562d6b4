// The faces of a step, in tiles (contacts/face_tiles.hpp): loaded when a step needs
// them, left when something else changes the faces. While they are in use Motion::contacts has
// no states of the faces: only what is decided of them is that of the step.
#pragma once

#include "contacts/near_edges.hpp"

namespace edda {

struct Simulation;
struct StepTaken;

/// Whether the next step keeps the faces in tiles: where all that it reads of them is in there.
bool steps_in_tiles(const Simulation& sim);

/// Where a step begins: between two positions, as the leapfrog's, or at the end of the last step,
/// the state at which is then all that counts (begin_from_step_end()).
enum class Begins { between_steps, at_step_end };

/// Takes the faces at n into tiles, unless they are; to be called before the blocks move.
void load_tiles(Simulation& sim, Begins begins = Begins::between_steps);

/// Evaluates the faces at n + 1: memory, forces on the blocks; activity and bonds where they
/// change.
void place_in_tiles(Simulation& sim);

/// Contact activation (face_switching.hpp) of the faces in tiles.
void switch_in_tiles(Simulation& sim, const StepTaken& taken);

/// Makes a new list of the faces, which remain in tiles.
void search_in_tiles(Simulation& sim, const Reach& reach);

/// Brings the rows of the faces up to date, with their states.
void update_face_rows(Simulation& sim);

/// Where memory has run out: tiles of a list that was not completed must not be read. The faces
/// carry nothing then.
void lose_faces(Simulation& sim);

/// The faces, to be changed: up to date, and no longer in tiles.
FaceSet& faces_to_change(Simulation& sim);

}  // namespace edda
