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

/// Steps after which it is decided anew who sleeps, which also brings faces together again that do
/// alike: the more where little changes.
constexpr unsigned shortest_sleep = 32, longest_sleep = 256;

/// Largest component of at - from - age pace.
EDDA_VECTOR double largest_component(const double* at, const double* from, const double* pace,
                                     double age, std::size_t count) {
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t n = 0; n < count; ++n) {
    largest = larger(largest, std::abs(at[n] - from[n] - age * pace[n]));
  }
  return largest;
}

/// Upper bound of the distance of any vertex from its path, m.
double distance_strayed(const TileSleep& sleep, const SweepScratch& scratch) {
  return std::numbers::sqrt2 * largest_component(scratch.at.data(), sleep.from.data(),
                                                 sleep.pace.data(), sleep.age, sleep.from.size());
}

/// The wider the margin, the fewer faces sleep; the narrower, the more often that is decided anew:
/// somewhat more than what the last sleep would have needed.
double next_margin(const TileSleep& sleep, double strayed, double least) {
  constexpr double more = 1.5, change = 4.0, first = 4.0;
  if (sleep.age == 0) return std::max(first * sleep.fastest, least);
  const double part = static_cast<double>(sleep.age) / sleep.length;
  return std::max(
      std::clamp(more * strayed / (part * part), sleep.margin / change, sleep.margin * change),
      least);
}

void begin_sleep(const SweepScene& scene, TileSleep& sleep, const SweepScratch& scratch,
                 std::size_t edges) {
  const double strayed = sleep.age == 0 ? 0.0 : distance_strayed(sleep, scratch);
  sleep.from.assign(scratch.at.begin(),
                    scratch.at.begin() + static_cast<std::ptrdiff_t>(4 * edges));
  sleep.pace.resize(4 * (edges + 1));  // with the empty edge
  double fastest = 0.0;
  for (std::size_t n = 0; n < 4 * edges; ++n) {
    sleep.pace[n] = scratch.at[n] - scratch.then[n];
    fastest = std::max(fastest, std::abs(sleep.pace[n]));
  }
  sleep.fastest = std::numbers::sqrt2 * fastest;
  sleep.margin = next_margin(sleep, strayed, scene.least_margin);
  if (sleep.age >= sleep.length && sleep.calm) {
    sleep.length = std::min(longest_sleep, 2 * sleep.length);
  } else if (sleep.age > 0) {
    sleep.length = std::max(shortest_sleep, sleep.length / 2);
  }
  sleep.strayed = 0.0;
  sleep.age = 0;
  sleep.over = false;
}

constexpr std::uint8_t slept = 8;  ///< and it slept before

/// Where fewer faces than this part of the edges would sleep, none does: to see whether they may
/// go on takes as long as to look at them.
constexpr double worth_sleeping = 0.25;

/// Fills SweepScratch::kind. Returns how many faces there are of each kind.
std::array<Id, face_kinds> classify(const FaceTiles& t, std::size_t tile, double noise,
                                    SweepScratch& scratch) {
  const Tile& of = t.tiles[tile];
  const int old = 1 - t.now;
  scratch.kind.resize((of.last_chunk - of.first_chunk) * lanes);
  std::array<Id, face_kinds> count{};
  Records e, f, pace_e, pace_f;
  std::uint8_t* next = scratch.kind.data();
  for (std::size_t q = of.first_chunk; q < of.last_chunk; ++q) {
    read_edges(scratch.at.data(), &t.slot_e[q * lanes], &t.slot_f[q * lanes], e, f);
    read_edges(of.sleep.pace.data(), &t.slot_e[q * lanes], &t.slot_f[q * lanes], pace_e, pace_f);
    ChunkView view{};
    view.edges = t.edges_of(tile, q);
    view.strengths = t.strengths_of(tile, q);
    view.e = &e;
    view.f = &f;
    view.noise = noise;
    view.was = t.bits[old][q];
    view.e_then = &pace_e;
    view.f_then = &pace_f;
    const LaneBits working = t.found[old][q] >> lane_bits::works & lane_bits::field(0);
    const OpenLanes open = working == lane_bits::field(0)
                               ? OpenLanes{}
                               : open_lanes(view, of.sleep.margin, of.sleep.length);
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const auto found = [&](unsigned what) {
        return lane_bits::test(t.found[old][q], what, lane);
      };
      const auto is = [&](unsigned bits) { return (bits >> lane & 1u) != 0; };
      face_kind::Kind kind = is(open.stay)   ? face_kind::asleep
                             : is(open.near) ? face_kind::touching
                                             : face_kind::looked_at;
      if (found(lane_bits::works))
        kind = kind_of_working(!found(lane_bits::rare), found(lane_bits::busy));
      if (t.face[q * lanes + lane] == no_id) kind = face_kind::asleep;
      ++count[kind];
      *next++ = static_cast<std::uint8_t>(kind | (q >= of.awake_end ? slept : 0));
    }
  }
  if (count[face_kind::asleep] >= worth_sleeping * of.slots()) return count;
  for (std::size_t n = 0; n < scratch.kind.size(); ++n) {
    std::uint8_t& kind = scratch.kind[n];
    if (kind % slept != face_kind::asleep || t.face[of.first_chunk * lanes + n] == no_id) continue;
    kind = static_cast<std::uint8_t>(face_kind::looked_at | (kind & slept));
    --count[face_kind::asleep];
    ++count[face_kind::looked_at];
  }
  return count;
}

/// Corners of a face that wakes at n - 1; its gate has remained as it was.
void recall_corners(FaceTiles& t, const SweepScene& scene, std::size_t place) {
  const Pose& pose = scene.pose;
  load_corners(t, coordinates_at(scene.faces, pose.x1, pose.y1, t.face[place]), 1 - t.now, place);
}

/// Marks of a chunk after faces have come and gone.
void mark_chunk(FaceTiles& t, std::size_t q, bool awake) {
  const int now = t.now, old = 1 - t.now;
  const auto any = [&](unsigned of) { return (t.found[old][q] & lane_bits::field(of)) != 0; };
  const std::uint8_t idle = any(lane_bits::works) ? 0 : 1;
  t.plain[q] = any(lane_bits::rare) ? 0 : 1;
  t.idle[old][q] = t.idle[now][q] = idle;
  if (awake) return;
  t.bits[old][q] &= lane_bits::field(lane_bits::on);
  t.bits[now][q] = t.bits[old][q];
  t.found[old][q] = t.found[now][q] = 0;
  t.fresh[old][q] = t.fresh[now][q] = 0;
}

}  // namespace

bool sleep_is_over(FaceTiles& t, const SweepScene& scene, std::size_t tile,
                   const SweepScratch& scratch) {
  TileSleep& sleep = t.tiles[tile].sleep;
  if (scene.least_margin == 0.0) return false;
  if (sleep.over) return true;
  sleep.strayed += scene.largest_move + sleep.fastest + scene.pushed;
  if (++sleep.age >= sleep.length) return true;
  if (t.tiles[tile].awake_end == t.tiles[tile].last_chunk) return false;
  if (sleep.strayed <= sleep.margin) return false;
  sleep.strayed = distance_strayed(sleep, scratch);
  return !(sleep.strayed <= sleep.margin);
}

void let_sleep(FaceTiles& t, const SweepScene& scene, std::size_t tile, SweepScratch& scratch) {
  Tile& of = t.tiles[tile];
  begin_sleep(scene, of.sleep, scratch, of.slots() - 1);
  const std::array<Id, face_kinds> count = classify(t, tile, scene.noise, scratch);
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
  const auto of_kind = [&](std::size_t n) { return std::size_t{kind[n]} % slept; };
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
  const Id awake =
      (of.last_chunk - of.first_chunk) * static_cast<Id>(lanes) - count[face_kind::asleep];
  const Id was = of.awake_end;
  of.awake_end = of.first_chunk + static_cast<Id>((awake + lanes - 1) / lanes);
  std::size_t changed = 0;
  for (std::size_t n = 0; n < touched.size(); ++n) {
    const std::size_t q = of.first_chunk + n;
    const bool turns = (q < was) != (q < of.awake_end);  // falls asleep or wakes
    if (touched[n] == 0 && !turns) continue;
    ++changed;
    if (touched[n] != 0) load_chunk_constants(t, scene.faces, scene.blocks, tile, q, touched[n]);
    mark_chunk(t, q, q < of.awake_end);
    if (q >= of.awake_end) continue;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const std::size_t place = q * lanes + lane;
      if (kind[n * lanes + lane] >= slept && t.face[place] != no_id)
        recall_corners(t, scene, place);
    }
  }
  drop_unused_constants(t, scene.faces, scene.blocks, tile);
  constexpr std::size_t few = 8;  // one chunk in so many
  of.sleep.calm = few * changed <= touched.size();
  if (changed == 0) return;
  order_records(t, scene.faces, scene.blocks, tile);
}

}  // namespace edda
