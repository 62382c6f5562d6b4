// The faces of the explicit step, in tiles (contacts/face_tiles.hpp): loaded when a step needs
// them, left when something else changes the faces. While they are in use Motion::contacts has
// no states of the faces: only what is decided of them is that of the step.
#pragma once

#include <cstdint>
#include <vector>

#include "contacts/near_edges.hpp"
#include "contacts/tile_sweep.hpp"

namespace edda {

struct Simulation;
struct StepTaken;

struct TiledFaces {
  FaceTiles tiles;
  bool use = true;  ///< false, for tests: the rows are evaluated, which gives the same bits
  /// SweepScene::least_margin as a part of the list's reach. 0, for tests: no face sleeps.
  double sleep_part = 1e-9;
  double pushed = 0.0;                        ///< m, SweepScene::pushed
  std::size_t most_blocks = blocks_per_tile;  ///< of a tile
  int threads = 1;            ///< the most that have made a step: tiles are divided for so many
  std::size_t blocks = 0;     ///< of a tile, as they were divided
  double in_two_tiles = 0.0;  ///< part_in_two_tiles() as the blocks were divided
  bool corrects = false;      ///< SweepScene::corrects
  bool loaded = false;        ///< they hold the faces of the simulation
  bool ahead = false;         ///< and the rows of the faces have no states
  std::vector<SweepScratch> scratch;  ///< by thread
  std::vector<SweepResult> results;   ///< [tiles]
  std::vector<std::uint8_t> wanted;   ///< [nb] working memory: 0 everywhere between uses
};

/// Whether the next step keeps the faces in tiles: where all that it reads of them is in there.
bool steps_in_tiles(const Simulation& sim);

/// Takes the faces at n into tiles, unless they are; to be called before the blocks move.
void load_tiles(Simulation& sim);

/// Evaluates the faces at n + 1: memory, forces on the blocks; activity and bonds where they
/// change.
void place_in_tiles(Simulation& sim);

/// Contact activation (face_switching.hpp) of the faces in tiles.
void switch_in_tiles(Simulation& sim, const StepTaken& taken);

/// Largest drawn closure of a face that carries load, m.
double largest_closure(const TiledFaces& tiled);

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
