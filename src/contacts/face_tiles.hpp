// The faces as a step keeps them: tiles of neighbouring blocks, in each the faces of its
// blocks in chunks of eight.
//
// A tile reads the positions of its own blocks and of the edges that face them (its halo), and
// writes the forces on its own blocks alone; so tiles can be evaluated side by side. A face between
// two tiles is in both: both copies are computed from the same numbers and stay equal to the bit.
//
// Each face has its place for its forces, and those on an edge are added in the order of the edges
// on the other side. So nothing depends on the tiles, nor on the order of the faces within a tile:
// they are sorted by kernel class (contacts/tile_packing.hpp), and open ones that cannot close for
// a while are skipped, at the end (contacts/tile_sleep.hpp).
//
// All arrays are flat and hold numbers and indices only.
#pragma once

#include <array>
#include <cstddef>
#include <cstdint>
#include <utility>
#include <vector>

#include "base/columns.hpp"
#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"

namespace edda {

inline constexpr std::size_t lanes = 8;  ///< faces of a chunk
inline constexpr std::size_t blocks_per_tile = 512;

/// What a step reads of a face and does not change. Members as in FacePair and FaceStrength. First
/// what follows from its two edges.
template <class C>
struct EdgeConstants {
  C stiffness, shear_stiffness, inverse_e, inverse_f, length_ratio, gate_from, gate_scale, passing;
  C parts_at;  ///< m: bonded faces without tension fail at a larger gap
  C cosine_p1, sine_p1, cosine_p2, sine_p2, cosine_q1, sine_q1, cosine_q2, sine_q2;
};
inline constexpr std::size_t edge_columns = sizeof(EdgeConstants<double>) / sizeof(double);
/// Then what most faces of a joint have in common.
template <class C>
struct StrengthConstants {
  C ends, friction, cohesion, locked_closure_a, locked_closure_b, carries_tension, bonded;
  C zeta, shear_zeta, rebound;
  C tension, glued;  ///< as in FaceSet
};
inline constexpr std::size_t strength_columns = sizeof(StrengthConstants<double>) / sizeof(double);

/// What a face remembers from step to step. Members as in FaceBefore; s2 to z2 of its corners.
template <class C>
struct FaceMemoryColumns {
  C slip_a, slip_b, overlap, spring, s2, y2, r1, r2, z2;
};
inline constexpr std::size_t memory_columns = sizeof(FaceMemoryColumns<double>) / sizeof(double);

/// The same where faces have dashpots: their forces, and the speeds at which the ends closed.
template <class C>
struct DashpotMemoryColumns {
  C damping_a, damping_b, shear_damping_a, shear_damping_b, strike_a, strike_b;
};
inline constexpr std::size_t dashpot_memory_columns =
    sizeof(DashpotMemoryColumns<double>) / sizeof(double);

/// What laws that depend on slip read of a face that carries load. Members as in FaceFields.
template <class C>
struct PressureColumns {
  C normal_a, normal_b, length, cohesive;
};
inline constexpr std::size_t pressure_columns = sizeof(PressureColumns<double>) / sizeof(double);

/// Work of a step, slip before Coulomb's limit, and shear. Members as in FaceFields; kept for the
/// chunks where any work is not 0, or a face slides.
template <class C>
struct FaceWorkColumns {
  C friction_work, transfer, trial_a, trial_b, shear_a, shear_b, damping_work, damping_due;
};
inline constexpr std::size_t work_columns = sizeof(FaceWorkColumns<double>) / sizeof(double);

/// Limits of the shear forces at the ends for a whole step of the implicit method, N.
template <class C>
struct LimitColumns {
  C a, b;
};
inline constexpr std::size_t limit_columns = sizeof(LimitColumns<double>) / sizeof(double);

/// Work accumulated until step n - 1, or until n where steps are tried (tile_trials.hpp), J.
/// Members as in FaceProperties.
template <class C>
struct FaceSumColumns {
  C friction_work, transfer, damping_work;
};
inline constexpr std::size_t sum_columns = sizeof(FaceSumColumns<double>) / sizeof(double);

/// One bit for each lane of a chunk, in a field of eight bits for each of these.
using LaneBits = std::uint64_t;
namespace lane_bits {
// Remembered from step to step (FaceBefore).
inline constexpr unsigned stored = 0, on = 8, closed_a = 16, closed_b = 24, switched = 32;
// Found in a step; `switching`: it may need an activation factor (theory, section 6.2): it stored
// energy at n - 1, and an end opens or closes in this step or did so in the one before; `loaded`:
// it carries load, or did so at n - 1; `rare`: it is bonded, or is_plain() does not hold; `busy`:
// it does work, or opens.
inline constexpr unsigned decides = 0, switching = 8, loaded = 16, rare = 24, busy = 32, opens = 40,
                          slides = 48, fails = 56;
constexpr LaneBits field(unsigned of) {
  return LaneBits{0xff} << of;
}
constexpr bool test(LaneBits bits, unsigned of, std::size_t lane) {
  return (bits >> (of + lane) & 1) != 0;
}
}  // namespace lane_bits

/// Kernel class of a face, by which the faces of a tile are sorted: carries load, by the short
/// formulas (is_plain()) or by the long ones, without or with work; open with a corner on the edge;
/// open and evaluated; skipped with a narrow margin (resting) or a wide one (asleep;
/// tile_sleep.hpp).
namespace face_kind {
enum Kind : std::uint8_t {
  short_stick,
  short_work,
  long_work,
  long_stick,
  touching,
  open_awake,
  resting,
  asleep
};
}
inline constexpr std::size_t face_kinds = 8;
inline constexpr unsigned rest_levels = 2;  ///< the last kinds, one for each of RestMargins

using AlignedNumbers = std::vector<double, InWholeLines<double>>;

/// How long faces of a tile are skipped: until an end of their edges deviates from its extrapolated
/// path by more than the margin of their chunk (FaceTiles::rest), or for a number of steps.
struct TileSleep {
  double margin = 0.0;     ///< m, of those that sleep; once it is exceeded, `over` is set
  double strayed = 0.0;    ///< m: upper bound of the distance of any vertex from its path
  double least = 0.0;      ///< m: smallest `rest` of the chunks that rest
  double fastest = 0.0;    ///< m: motion along the paths in a step, of any vertex
  unsigned age = 0;        ///< steps since the skipped faces were chosen, or one fewer
  unsigned length = 32;    ///< steps for which they may be skipped
  bool calm = false;       ///< few faces had changed their class then
  bool over = true;        ///< the choice of skipped faces is invalid
  AlignedNumbers from;     ///< [slots][4] where the ends of the edges were then, m
  AlignedNumbers pace;     ///< [slots][4] how far they had come in the last step, m
  AlignedNumbers allowed;  ///< [slots] by how much they may stray, m

  /// Nothing is decided; keeps the memory of its arrays.
  void begin_anew() {
    TileSleep next;
    next.from.swap(from);
    next.pace.swap(pace);
    next.allowed.swap(allowed);
    *this = std::move(next);
  }
};

struct Tile {
  Id first_block = 0, last_block = 0;  ///< own blocks, in FaceTiles::blocks
  Id first_halo = 0, last_halo = 0;    ///< edges of other blocks, in FaceTiles::halo
  Id first_chunk = 0, last_chunk = 0;
  Id awake_end = 0;   ///< the chunks from here on hold faces that sleep; others may rest
  Id first_edge = 0;  ///< of its own edges, in FaceTiles::record_begin
  Id own_edges = 0;  ///< slots of the own blocks' edges; then those of the halo, then an empty edge
  bool takes_then = false;  ///< a face needs the corners at n - 1 (FaceInputs::then)
  TileSleep sleep;
  Id slots() const { return own_edges + (last_halo - first_halo) + 1; }
};

/// Constants of the chunks of a tile: sets of numbers that chunks with equal ones share, as far as
/// they are found to be equal.
struct ConstantSets {
  AlignedNumbers numbers;  ///< [sets][columns][8]
  std::vector<Id> users;   ///< [sets] how many chunks have it
  std::vector<Id> unused;  ///< those that none has

  void clear() {
    numbers.clear();
    users.clear();
    unused.clear();
  }
};
struct TileConstants {
  ConstantSets edges, strengths;  ///< of edge_columns and strength_columns
};

struct FaceTiles;

/// What a tile remembers of the faces in its first chunks, of steps n and n - 1 in turn
/// (FaceTiles::now). Those in the others sleep, or have just been listed: they have carried
/// nothing and done no work.
struct TileNumbers {
  Id first_chunk = 0;           ///< that of the tile
  Id chunks = 0;                ///< of how many it remembers anything
  AlignedNumbers memory[2];     ///< [chunks][memory_columns][8]
  AlignedNumbers dashpots[2];   ///< [chunks][dashpot_memory_columns][8]; empty: no dashpots
  AlignedNumbers pressures[2];  ///< [chunks][pressure_columns][8]; empty: no such laws
  AlignedNumbers work[2];       ///< [chunks][work_columns][8], where FaceTiles::fresh

  bool holds(std::size_t chunk) const { return chunk - first_chunk < chunks; }
  /// Remembers the faces of so many chunks; of those that are new nothing: all is 0.
  void resize(std::size_t count, const FaceTiles& of);
};

struct FaceTiles {
  std::vector<Tile> tiles;
  std::vector<Id> blocks;  ///< of the tiles, one after the other; in each ascending
  std::vector<Id> halo;    ///< edges that face those of a tile

  std::size_t chunks() const { return plain.size(); }
  std::vector<Id> tile_of_chunk;    ///< [chunks]
  std::vector<Id> face;             ///< [chunks][8] row of the FaceSet, or no_id
  std::vector<Id> slot_e, slot_f;   ///< [chunks][8] the edges, by their slots in the tile
  std::vector<std::uint8_t> owned;  ///< [chunks] bit of each lane: this copy's work counts
  std::vector<std::uint8_t>
      plain;  ///< [chunks] 1: is_plain() held for all its faces in the last step
  std::vector<std::uint8_t> bonds;  ///< [chunks] 1: a face in it is bonded or carries tension
  std::vector<double> rest;  ///< [chunks] m: skip margin (TileSleep): its faces are not evaluated
                             ///< until an end of their edges deviates by more; 0: they are
  std::vector<std::uint8_t>
      idle[2];  ///< [chunks] 1: no face carried load in that step or at its start
  std::vector<std::uint8_t> fresh[2];  ///< [chunks] 1: `work` holds the work of that step

  /// Copies of face k: places [nf][2] in chunks (8 chunk + lane), first that which is owned; no_id:
  /// none.
  std::vector<std::array<Id, 2>> place;

  /// Records of four numbers for the forces of the awake faces on the edges of a tile: those on an
  /// own edge lie side by side, in the order of FaceSet::on_edge.
  std::vector<Id> record_begin;        ///< [tiles][own edges + 1]
  std::vector<Id> record_e, record_f;  ///< [chunks][8]; edges of other tiles have a dummy record,
                                       ///< one for each chunk

  /// The records of the last sweep of a tile, where some of its faces may be evaluated again.
  std::vector<AlignedNumbers> forces;  ///< [tiles] [records][4] on start and end of an edge, N
  std::vector<std::uint8_t> kept;      ///< [tiles] 1: they are those of the last sweep

  std::vector<TileConstants> constants;    ///< [tiles]
  std::vector<Id> edge_set, strength_set;  ///< [chunks] their constants; no_id: none yet

  bool dashpots = false;             ///< as FaceSet::dashpots
  bool slip_laws = false;            ///< as FaceSet::slip_laws
  std::vector<TileNumbers> numbers;  ///< [tiles]
  std::vector<LaneBits> bits[2];     ///< [chunks] of steps n and n - 1 in turn
  std::vector<LaneBits> found[2];    ///< [chunks] of that step
  AlignedNumbers sums;               ///< [chunks][sum_columns][8]
  AlignedNumbers limits;  ///< [chunks][2][8] LimitColumns; empty: they follow from normal forces.
                          ///< While they are given no faces may be skipped: these change places
  std::vector<LaneBits> ever;   ///< [chunks] `opens`, `slides` of any step until n - 1
  std::vector<double> deepest;  ///< [chunks] as FaceStep::depth, largest in the step so far, m;
                                ///< of a new list an upper bound of that
  int now = 0;                  ///< which of the two is that of step n

  /// A bit of face k of step n, by its owned copy; false where it has none. Of those remembered:
  bool remembers(unsigned of, std::size_t k) const { return bit_of(bits[now], of, k); }
  bool remembered_before(unsigned of, std::size_t k) const {  ///< of step n - 1
    return bit_of(bits[1 - now], of, k);
  }
  /// Of those found in the step:
  bool has_found(unsigned of, std::size_t k) const { return bit_of(found[now], of, k); }
  bool found_before(unsigned of, std::size_t k) const { return bit_of(found[1 - now], of, k); }
  /// Of any step up to n - 1 (FaceSumColumns):
  bool has_ever(unsigned of, std::size_t k) const { return bit_of(ever, of, k); }
  /// Whether anything is remembered of the faces of a chunk (TileNumbers).
  bool holds(std::size_t chunk) const { return numbers[tile_of_chunk[chunk]].holds(chunk); }
  const double* edges_of(std::size_t tile, std::size_t chunk) const {
    return constants[tile].edges.numbers.data() + edge_set[chunk] * edge_columns * lanes;
  }
  const double* strengths_of(std::size_t tile, std::size_t chunk) const {
    return constants[tile].strengths.numbers.data() +
           strength_set[chunk] * strength_columns * lanes;
  }

 private:
  bool bit_of(const std::vector<LaneBits>& values, unsigned of, std::size_t k) const {
    const Id owned_copy = place[k][0];
    return owned_copy != no_id &&
           lane_bits::test(values[owned_copy / lanes], of, owned_copy % lanes);
  }
};

/// Divides the blocks among tiles by their places, across the longer side first, until none has
/// more than `most`. Fixed blocks are left out unless `with_fixed`; so are excavated ones.
void divide_blocks(FaceTiles& tiles, const BlockSet& blocks, const State& state, bool with_fixed,
                   std::size_t most = blocks_per_tile);

/// Gives each face of the list its places in the tiles, and all that has a size its size. Blocks
/// must have been divided. All faces are awake; nothing is remembered. kind: [nf] their kernel
/// classes: faces of lower ones come first in a tile (contacts/tile_packing.hpp), and those that
/// carry load or have done work have room in TileNumbers.
void lay_out(FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks,
             const std::vector<std::uint8_t>& kind);

/// Gives the forces of the awake faces of a tile their records.
void order_records(FaceTiles& tiles, const FaceSet& faces, const BlockSet& blocks,
                   std::size_t tile);

}  // namespace edda
