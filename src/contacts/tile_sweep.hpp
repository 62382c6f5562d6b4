// The sweep over a tile of blocks: it evaluates the faces and sums their forces on the blocks.
// Layout: contacts/face_tiles.hpp; formulas: contacts/face_step.hpp.
#pragma once

#include <span>

#include "blocks/masses.hpp"
#include "contacts/face_tiles.hpp"

namespace edda {

/// What all tiles read; pose: vertices at n and n - 1.
struct SweepScene {
  const BlockSet& blocks;
  const Masses& masses;
  const FaceSet& faces;  ///< properties alone, noise and bond_strength
  const Pose& pose;
  double largest_move;  ///< m: no vertex has moved farther in the step
  double pushed;        ///< m: nor farther by corrections after the last sweep
  double least_margin;  ///< m: of TileSleep; 0: no face sleeps
  double step;          ///< from n - 1 to n, s, for dashpots
  bool corrects;        ///< the faces have been evaluated in this step, before blocks were pushed
};

/// Working memory of a thread, records of four numbers for each slot of a tile.
struct SweepScratch {
  AlignedNumbers at;               ///< [slots][4] start and end of the edge at n, x and y
  AlignedNumbers then;             ///< [slots][4] the same at n - 1; empty unless a face takes them
  AlignedNumbers on;               ///< [records][4] forces on start and end of an edge, N
  std::vector<std::uint8_t> kind;  ///< [places of a tile] kernel classes (tile_sleep.cpp)
  AlignedNumbers excess;           ///< [runs of slots] m: as TileSleep::allowed is exceeded there
  AlignedNumbers too_far;  ///< [slots] m: by how much the edge has strayed where that is too far
  std::vector<std::uint8_t> touched;  ///< [chunks of a tile] lanes where faces have come and gone
};

/// What the faces of a tile need besides their forces.
struct SweepResult {
  bool decides = false;    ///< decide_activity() must be called for a face
  bool switching = false;  ///< a face may need an activation factor
  bool fails = false;      ///< a bond fails
  std::size_t cost = 0;    ///< what the sweep of the tile has taken, compared with others; >= 1
};

/// Evaluates the faces of a tile at step n: memory of n - 1 to memory of n (FaceTiles::now must be
/// that of n already), bits, work. Stores the forces of the faces on the own blocks, N. Keeps the
/// records of the forces where it finds anything, or where `keep` asks for it.
SweepResult sweep_tile(FaceTiles& tiles, const SweepScene& scene, std::size_t tile, bool keep,
                       SweepScratch& scratch, BodyVectors& on);

/// Evaluates these chunks of a tile whose records are kept once more, after their faces have been
/// changed or blocks have been moved. The forces on the blocks are left to gather_tile().
SweepResult sweep_chunks(FaceTiles& tiles, const SweepScene& scene, std::size_t tile,
                         std::span<const Id> chunks);

/// The energy that the faces of a tile store between steps n - 1 and n, J, and their normal forces
/// at n without those of dashpots, N; [nf] each, of which those of owned copies are set that have
/// carried anything.
void measure_tile(const FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks,
                  const Pose& pose, std::size_t tile, std::vector<double>& energy,
                  std::vector<double>& normal);

/// Stores the forces of the faces on those own blocks of a tile that are `wanted` ([nb]), N. The
/// records of the tile must be kept.
void gather_tile(const FaceTiles& tiles, const BlockSet& blocks, std::size_t tile,
                 const std::vector<std::uint8_t>& wanted, BodyVectors& on);

}  // namespace edda
