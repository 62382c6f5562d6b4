// The faces of a step in their tiles (contacts/face_tiles.hpp): evaluated all at once at positions
// that may still be tried, and some of them once more with what is decided of them there.
#pragma once

#include <cstdint>
#include <functional>
#include <vector>

#include "contacts/evaluate_face.hpp"
#include "contacts/tile_rows.hpp"
#include "contacts/tile_sweep.hpp"

namespace edda {

struct TiledFaces {
  FaceTiles tiles;
  /// SweepScene::least_margin as a part of the list's reach. 0: no face sleeps.
  double sleep_part = 1e-9;
  double pushed = 0.0;                        ///< m, SweepScene::pushed
  std::size_t most_blocks = blocks_per_tile;  ///< of a tile
  int threads = 1;            ///< the most that have made a step: tiles are divided for so many
  std::size_t blocks = 0;     ///< of a tile, as they were divided
  double in_two_tiles = 0.0;  ///< part_in_two_tiles() as the blocks were divided
  bool corrects = false;      ///< SweepScene::corrects
  std::vector<SweepScratch> scratch;  ///< by thread
  std::vector<SweepResult> results;   ///< [tiles]
  std::vector<std::uint8_t> wanted;   ///< [nb] working memory: 0 everywhere between uses
};

/// Takes the faces, which have these states at n and n - 1, into tiles of `of_tile` blocks at most.
void load_tiles(TiledFaces& tiled, const FaceSet& faces, const FaceStates& states,
                const BlockSet& blocks, const State& state, const Pose& pose, bool with_fixed,
                std::size_t of_tile);

/// The state at n of a face that is ahead of what the tiles remember; null: it is not.
using StateAtN = std::function<const FaceFields*(Id)>;

/// A step in which the faces go to the positions of the scene, once or several times.
class FacesInStep {
 public:
  /// step: s. largest_move: m, no vertex has moved farther. keeps: the records of the forces of all
  /// tiles are kept. skips: open faces may be skipped (contacts/tile_sleep.hpp).
  FacesInStep(FaceSet& faces, TiledFaces& tiled, const FaceScene& scene, double step,
              double largest_move, BodyVectors& on, bool keeps = false, bool skips = true)
      : c_(faces),
        own_(tiled),
        scene_(scene),
        step_(step),
        largest_move_(largest_move),
        on_(on),
        keeps_(keeps),
        skips_(skips && tiled.sleep_part > 0.0) {}

  /// Evaluates all faces: memory, forces on the blocks. May be called again for other positions.
  void sweep();
  /// Faces with a bit of `of` in the tiles of which that was found, in the order of the list.
  std::vector<Id> found(unsigned of, bool SweepResult::*that) const;
  /// Faces that need a decision (needs_decision()), or whose bond fails.
  std::vector<Id> undecided() const;
  /// Makes their decisions, and evaluates those once more of which anything has changed.
  void decide_and_evaluate(const std::vector<Id>& undecided);
  /// Evaluates these faces once more, with those of the same chunks. pushed: upper bound of the
  /// motion of any vertex since the sweep, m; a resting chunk that it may take beyond its margin
  /// wakes.
  void evaluate(const std::vector<Id>& faces, double pushed);
  /// Decides activity and, unless limits of shear are given, breaks bonds of those of these faces
  /// that need it. Returns those of which anything has changed.
  std::vector<Id> decide(const std::vector<Id>& faces, const StateAtN& ahead = {});
  /// Sums the forces anew on the blocks of these faces.
  void gather(const std::vector<Id>& faces);
  /// Whether a copy of face k is awake, or must wake after vertices have moved by `pushed`, m.
  bool takes_part(double pushed, Id k) const;

 private:
  SweepScene sweep_scene() const;
  SweepResult sweep(std::size_t tile, bool keep, SweepScratch& scratch);
  bool rests_on(Id chunk, double pushed, Id k) const;
  std::vector<Id> chunks_of(const std::vector<Id>& faces, double pushed);
  void evaluate_chunks(const std::vector<Id>& chunks);

  FaceSet& c_;
  TiledFaces& own_;
  FaceScene scene_;
  double step_, largest_move_;
  BodyVectors& on_;
  bool keeps_, skips_;
};

/// Adds the sizes |fx| + |fy| of the forces of the faces on each block of the tiles, N, [nb]. Their
/// records must be kept.
void add_sizes_of_forces(const TiledFaces& tiled, const BlockSet& blocks, std::vector<double>& to);

/// Largest drawn closure of a face that carries load, m.
double largest_closure(const TiledFaces& tiled);

}  // namespace edda
