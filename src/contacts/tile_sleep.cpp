#include "contacts/tile_sleep.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numbers>

#include "contacts/chunk_loops.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_packing.hpp"

namespace edda {
namespace {

/// Steps after which the skipped faces are chosen again and all are sorted: the more where little
/// changes.
constexpr unsigned shortest_sleep = 32, longest_sleep = 256;

/// Margin of resting faces, as a part of that of sleeping ones.
constexpr double rest_part = 0.2;

RestMargins margins_of(const SweepScene& scene, const TileSleep& sleep) {
  return {std::max(rest_part * sleep.margin, scene.least_margin), sleep.margin};
}

constexpr double without_end = 1e300;

/// A distance is at most its larger component over this.
constexpr double per_component = 1.0 / std::numbers::sqrt2;

EDDA_INLINE Four size_of(Four x) {
  return x < 0.0 ? -x : x;
}
EDDA_INLINE double largest_of(Four x) {
  return larger(larger(x[0], x[1]), larger(x[2], x[3]));
}

/// How far the ends of an edge have strayed from their paths, by components, m.
EDDA_INLINE Four strayed_at(const double* at, const double* from, const double* pace, double age,
                            std::size_t slot) {
  return size_of(four_at(at + 4 * slot) - four_at(from + 4 * slot) -
                 age * four_at(pace + 4 * slot));
}

/// Edges that are looked at together.
constexpr std::size_t run = 16;

/// Returns the largest component of all edges. excess: of each run, by how much an edge has strayed
/// farther than it is allowed; 0: none has.
EDDA_VECTOR double look_for_strayed(const double* at, const double* from, const double* pace,
                                    double age, const double* allowed, std::size_t edges,
                                    double* excess) {
  Four largest{};
  for (std::size_t begin = 0; begin < edges; begin += run) {
    const std::size_t end = begin + run < edges ? begin + run : edges;
    Four beyond{};
    for (std::size_t n = begin; n < end; ++n) {
      const Four off = strayed_at(at, from, pace, age, n), over = off - per_component * allowed[n];
      largest = off > largest ? off : largest;
      beyond = over > beyond ? over : beyond;
    }
    *excess++ = largest_of(beyond);
  }
  return largest_of(largest);
}

/// Upper bound of how far any vertex has strayed, m. Fills SweepScratch::excess.
double look_for_strayed(const TileSleep& sleep, SweepScratch& scratch) {
  const std::size_t edges = sleep.from.size() / 4;
  scratch.excess.resize((edges + run - 1) / run);
  return look_for_strayed(scratch.at.data(), sleep.from.data(), sleep.pace.data(), sleep.age,
                          sleep.allowed.data(), edges, scratch.excess.data()) /
         per_component;
}

/// Fills SweepScratch::too_far. Returns whether there is any such edge. Their limit is lifted:
/// wake_chunks() sets it anew where a chunk goes on.
bool note_strayed(TileSleep& sleep, SweepScratch& scratch) {
  const std::size_t edges = sleep.from.size() / 4;
  bool any = false;
  for (std::size_t r = 0; r < scratch.excess.size(); ++r) {
    if (scratch.excess[r] == 0.0) continue;
    if (!any) scratch.too_far.assign(sleep.allowed.size(), 0.0);
    any = true;
    for (std::size_t n = r * run; n < std::min(edges, (r + 1) * run); ++n) {
      const double off = largest_of(strayed_at(scratch.at.data(), sleep.from.data(),
                                               sleep.pace.data(), sleep.age, n)) /
                         per_component;
      if (off <= sleep.allowed[n]) continue;
      scratch.too_far[n] = off;
      sleep.allowed[n] = without_end;
    }
  }
  return any;
}

/// The next margin: 1.5 times the deviation that the last period would have reached in full. With a
/// wider one fewer faces are skipped, a narrower one is exceeded sooner.
double next_margin(const TileSleep& sleep, double strayed, double least) {
  constexpr double more = 1.5, change = 4.0, first = 4.0;
  if (sleep.age == 0) return std::max(first * sleep.fastest, least);
  const double part = static_cast<double>(sleep.age) / sleep.length;
  return std::max(
      std::clamp(more * strayed / (part * part), sleep.margin / change, sleep.margin * change),
      least);
}

void begin_sleep(const SweepScene& scene, TileSleep& sleep, SweepScratch& scratch,
                 std::size_t edges) {
  const double so_far = sleep.age == 0 ? 0.0 : look_for_strayed(sleep, scratch);
  sleep.from.assign(scratch.at.begin(),
                    scratch.at.begin() + static_cast<std::ptrdiff_t>(4 * edges));
  sleep.pace.resize(4 * (edges + 1));  // with the empty edge
  double fastest = 0.0;
  for (std::size_t n = 0; n < 4 * edges; ++n) {
    sleep.pace[n] = scratch.at[n] - scratch.then[n];
    fastest = std::max(fastest, std::abs(sleep.pace[n]));
  }
  sleep.fastest = std::numbers::sqrt2 * fastest;
  sleep.margin = next_margin(sleep, so_far, scene.least_margin);
  if (sleep.age >= sleep.length && sleep.calm) {
    sleep.length = std::min(longest_sleep, 2 * sleep.length);
  } else if (sleep.age > 0) {
    sleep.length = std::max(shortest_sleep, sleep.length / 2);
  }
  sleep.strayed = 0.0;
  sleep.age = 0;
  sleep.over = false;
}

constexpr std::uint8_t was_skipped =
    8;  ///< added to the class of a face that was skipped until now

/// Where fewer faces than this part of the edges would rest, none does: to check their margins
/// takes as long as to test them.
constexpr double worth_resting = 0.25;

/// Fills SweepScratch::kind. Returns how many faces there are of each kind.
std::array<Id, face_kinds> classify(FaceTiles& t, const SweepScene& scene, std::size_t tile,
                                    const RestMargins& margins, SweepScratch& scratch) {
  const Tile& of = t.tiles[tile];
  const int old = 1 - t.now;
  scratch.kind.resize((of.last_chunk - of.first_chunk) * lanes);
  std::array<Id, face_kinds> count{};
  const SweepTables tables = tables_of(t, tile, nullptr, scene.step, scene.faces);
  Records e, f, pace_e, pace_f;
  std::uint8_t* next = scratch.kind.data();
  for (std::size_t q = of.first_chunk; q < of.last_chunk; ++q) {
    read_edges(scratch.at.data(), &t.slot_e[q * lanes], &t.slot_f[q * lanes], e, f);
    read_edges(of.sleep.pace.data(), &t.slot_e[q * lanes], &t.slot_f[q * lanes], pace_e, pace_f);
    ChunkView view = view_of_constants(tables, q);
    view.e = &e;
    view.f = &f;
    view.e_then = &pace_e;
    view.f_then = &pace_f;
    const LaneBits loaded = t.found[old][q] >> lane_bits::loaded & lane_bits::field(0);
    const OpenLanes open =
        loaded == lane_bits::field(0) ? OpenLanes{} : open_lanes(view, margins, of.sleep.length);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto found = [&](unsigned what) {
        return lane_bits::test(t.found[old][q], what, lane);
      };
      unsigned kind =
          lane_bits::test(open.near, 0, lane) ? face_kind::touching : face_kind::open_awake;
      for (unsigned level = 0; level < rest_levels; ++level) {
        if (lane_bits::test(open.stay, lanes * level, lane)) kind = face_kind::resting + level;
      }
      if (found(lane_bits::loaded))
        kind = kind_of_loaded(!found(lane_bits::rare), found(lane_bits::busy));
      if (t.face[q * lanes + lane] == no_id) kind = face_kind::asleep;
      ++count[kind];
      const bool rests = t.rest[q] > 0.0 || !t.numbers[tile].holds(q);
      *next++ = static_cast<std::uint8_t>(kind | (rests ? was_skipped : 0));
    }
  }
  Id resting = 0;
  for (unsigned level = 0; level < rest_levels; ++level)
    resting += count[face_kind::resting + level];
  if (resting >= worth_resting * of.slots()) return count;
  for (std::size_t n = 0; n < scratch.kind.size(); ++n) {
    std::uint8_t& kind = scratch.kind[n];
    const std::uint8_t was = kind % was_skipped;
    if (was < face_kind::resting || t.face[of.first_chunk * lanes + n] == no_id) continue;
    kind = static_cast<std::uint8_t>(face_kind::open_awake | (kind & was_skipped));
    --count[was];
    ++count[face_kind::open_awake];
  }
  return count;
}

/// Chunks in which the faces of a tile lie that do not sleep.
Id chunks_awake(const Tile& of, const std::array<Id, face_kinds>& count) {
  constexpr auto faces = static_cast<Id>(lanes);
  const Id awake = (of.last_chunk - of.first_chunk) * faces - count[face_kind::asleep];
  return (awake + faces - 1) / faces;
}

/// Computes the corners at n - 1 of a face that wakes; its gate has not changed while it was
/// skipped.
void recall_corners(FaceTiles& t, const FaceSet& faces, const Pose& pose, std::size_t place) {
  load_corners(t, coordinates_at(faces, pose.x1, pose.y1, t.face[place]), 1 - t.now, place);
}

/// Gives the faces of the first chunks of a tile, so many, room for what they remember; those of
/// chunks that had none have carried nothing.
void make_room(FaceTiles& t, const SweepScene& scene, std::size_t tile, std::size_t chunks) {
  TileNumbers& numbers = t.numbers[tile];
  const std::size_t had = numbers.chunks;
  if (chunks <= had) return;
  numbers.resize(chunks, t);
  const std::size_t first = t.tiles[tile].first_chunk;
  for (std::size_t place = (first + had) * lanes; place < (first + chunks) * lanes; ++place) {
    if (t.face[place] != no_id) recall_corners(t, scene.faces, scene.pose, place);
  }
}

/// Marks of a chunk after faces have come and gone.
void mark_chunk(FaceTiles& t, std::size_t q, bool open_awake) {
  const int now = t.now, old = 1 - t.now;
  const auto any = [&](unsigned of) { return (t.found[old][q] & lane_bits::field(of)) != 0; };
  const std::uint8_t idle = any(lane_bits::loaded) ? 0 : 1;
  t.plain[q] = any(lane_bits::rare) ? 0 : 1;
  t.idle[old][q] = t.idle[now][q] = idle;
  if (open_awake) return;
  t.bits[old][q] &= lane_bits::field(lane_bits::on);
  t.bits[now][q] = t.bits[old][q];
  t.found[old][q] = t.found[now][q] = 0;
  t.fresh[old][q] = t.fresh[now][q] = 0;
}

/// By how much the corners of the faces of a chunk may stray while it rests; 0: one of its faces
/// does not.
double rest_of(const FaceTiles& t, std::size_t q, const std::uint8_t* kind,
               const RestMargins& margins) {
  double rest = margins.back();
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    const unsigned does = kind[lane] % was_skipped;
    if (t.face[q * lanes + lane] == no_id) continue;
    if (does < face_kind::resting) return 0.0;
    rest = std::min(rest, margins[does - face_kind::resting]);
  }
  return rest;
}

/// The edges of a chunk may not stray farther than by `rest`.
void allow(const FaceTiles& t, TileSleep& sleep, std::size_t q) {
  sleep.least = std::min(sleep.least, t.rest[q]);
  for (std::size_t place = q * lanes; place < (q + 1) * lanes; ++place) {
    for (const Id slot : {t.slot_e[place], t.slot_f[place]})
      sleep.allowed[slot] = std::min(sleep.allowed[slot], t.rest[q]);
  }
}

void set_allowed(const FaceTiles& t, std::size_t tile, TileSleep& sleep) {
  const Tile& of = t.tiles[tile];
  sleep.allowed.assign(of.slots(), without_end);
  sleep.least = without_end;
  for (std::size_t q = of.first_chunk; q < of.last_chunk; ++q) {
    if (t.rest[q] > 0.0) allow(t, sleep, q);
  }
}

/// Wakes the chunks with an edge that has strayed too far. Returns whether faces that sleep are to
/// wake.
bool wake_chunks(FaceTiles& t, const SweepScene& scene, std::size_t tile,
                 const AlignedNumbers& too_far) {
  Tile& of = t.tiles[tile];
  of.sleep.least = without_end;
  for (std::size_t q = of.first_chunk; q < of.last_chunk; ++q) {
    if (t.rest[q] == 0.0) continue;
    double farthest = 0.0;
    for (std::size_t place = q * lanes; place < (q + 1) * lanes; ++place)
      farthest = larger(farthest, larger(too_far[t.slot_e[place]], too_far[t.slot_f[place]]));
    if (farthest > t.rest[q]) {
      wake_chunk(t, scene.faces, scene.pose, q);
      if (of.sleep.over) return true;
    } else if (farthest > 0.0) {
      allow(t, of.sleep, q);
    } else {
      of.sleep.least = std::min(of.sleep.least, t.rest[q]);
    }
  }
  return false;
}

}  // namespace

void wake_chunk(FaceTiles& t, const FaceSet& faces, const Pose& pose, std::size_t q) {
  Tile& of = t.tiles[t.tile_of_chunk[q]];
  if (q >= of.awake_end) {
    of.sleep.over = true;
    return;
  }
  t.rest[q] = 0.0;
  for (std::size_t place = q * lanes; place < (q + 1) * lanes; ++place) {
    if (t.face[place] != no_id) recall_corners(t, faces, pose, place);
  }
}

bool sleep_is_over(FaceTiles& t, const SweepScene& scene, std::size_t tile, SweepScratch& scratch) {
  TileSleep& sleep = t.tiles[tile].sleep;
  if (scene.least_margin == 0.0) {
    const Tile& of = t.tiles[tile];
    make_room(t, scene, tile, of.awake_end - of.first_chunk);
    return false;
  }
  if (sleep.over) return true;
  sleep.strayed += scene.largest_move + sleep.fastest + scene.pushed;
  if (!scene.corrects) ++sleep.age;
  if (sleep.age >= sleep.length) return true;
  if (sleep.strayed <= sleep.least) return false;
  sleep.strayed = look_for_strayed(sleep, scratch);
  return note_strayed(sleep, scratch) && wake_chunks(t, scene, tile, scratch.too_far);
}

void let_sleep(FaceTiles& t, const SweepScene& scene, std::size_t tile, SweepScratch& scratch) {
  Tile& of = t.tiles[tile];
  begin_sleep(scene, of.sleep, scratch, of.slots() - 1);
  const RestMargins margins = margins_of(scene, of.sleep);
  const std::array<Id, face_kinds> count = classify(t, scene, tile, margins, scratch);
  const Id chunks = chunks_awake(of, count);
  make_room(t, scene, tile, chunks);
  std::vector<std::uint8_t>& kind = scratch.kind;
  std::vector<std::uint8_t>& touched = scratch.touched;
  touched.assign(of.last_chunk - of.first_chunk, 0);
  const auto touch = [&](std::size_t n) {
    touched[n / lanes] = static_cast<std::uint8_t>(touched[n / lanes] | 1u << n % lanes);
  };
  std::array<std::size_t, face_kinds> next{}, end{};
  for (std::size_t r = 0, begin = 0; r < face_kinds; ++r) {
    next[r] = begin;
    end[r] = begin += count[r];
  }
  const std::size_t first = of.first_chunk * lanes;
  const auto of_kind = [&](std::size_t n) { return std::size_t{kind[n]} % was_skipped; };
  for (std::size_t r = 0; r < face_kinds; ++r) {
    for (std::size_t n = next[r]; n < end[r]; ++n) {
      while (of_kind(n) != r) {
        const std::size_t to = of_kind(n);
        while (of_kind(next[to]) == to) ++next[to];
        const std::size_t m = next[to]++;
        swap_faces(t, first + n, first + m);
        std::swap(kind[n], kind[m]);
        touch(n);
        touch(m);
      }
    }
  }
  const Id was = of.awake_end;
  of.awake_end = of.first_chunk + chunks;
  std::size_t changed = 0;
  for (std::size_t n = 0; n < touched.size(); ++n) {
    const std::size_t q = of.first_chunk + n;
    const double before = t.rest[q];
    t.rest[q] = rest_of(t, q, &kind[n * lanes], margins);
    const bool turns = (t.rest[q] > 0.0) != (before > 0.0);  // begins or ceases to rest
    if (touched[n] == 0 && !turns) continue;
    ++changed;
    if (touched[n] != 0) load_chunk_constants(t, scene.faces, scene.blocks, tile, q, touched[n]);
    mark_chunk(t, q, t.rest[q] == 0.0);
    if (t.rest[q] > 0.0) continue;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t place = q * lanes + lane;
      if (kind[n * lanes + lane] >= was_skipped && t.face[place] != no_id)
        recall_corners(t, scene.faces, scene.pose, place);
    }
  }
  t.numbers[tile].resize(chunks, t);
  set_allowed(t, tile, of.sleep);
  constexpr std::size_t few = 8;  // one chunk in so many
  of.sleep.calm = few * changed <= touched.size();
  if (changed == 0 && of.awake_end == was) return;
  order_records(t, scene.faces, scene.blocks, tile);
}

}  // namespace edda
