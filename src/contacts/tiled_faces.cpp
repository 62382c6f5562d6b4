#include "contacts/tiled_faces.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <span>
#include <tuple>

#include "base/parallel.hpp"
#include "contacts/activity.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_renewal.hpp"
#include "contacts/tile_sleep.hpp"

namespace edda {

void load_tiles(TiledFaces& own, const FaceSet& c, const FaceStates& states, const BlockSet& b,
                const State& state, const Pose& pose, bool with_fixed, std::size_t of_tile) {
  own.blocks = of_tile;
  divide_blocks(own.tiles, b, state, with_fixed, of_tile);
  load_faces(own.tiles, c, states, b, pose);
  own.results.resize(own.tiles.tiles.size());
  own.in_two_tiles = part_in_two_tiles(own.tiles);
  own.pushed = 0.0;
}

SweepScene FacesInStep::sweep_scene() const {
  return {.blocks = scene_.blocks,
          .masses = scene_.masses,
          .faces = c_,
          .pose = scene_.pose,
          .largest_move = largest_move_,
          .pushed = own_.pushed,
          .least_margin = skips_ ? own_.sleep_part * c_.reach : 0.0,
          .step = step_,
          .corrects = own_.corrects};
}

SweepResult FacesInStep::sweep(std::size_t tile, bool keep, SweepScratch& scratch) {
  return sweep_tile(own_.tiles, sweep_scene(), tile, keep, scratch, on_);
}

void FacesInStep::sweep() {
  std::vector<std::size_t> weights;
  for (const SweepResult& last : own_.results)
    weights.push_back(std::max<std::size_t>(1, last.cost));
  const auto sweep_one = [&](std::size_t tile, SweepScratch& scratch) {
    own_.results[tile] = sweep(tile, keeps_, scratch);
  };
  parallel_tasks(own_.tiles.tiles.size(), 10 * own_.tiles.face.size(), own_.scratch, sweep_one,
                 weights);
  own_.pushed = 0.0;
}

std::vector<Id> FacesInStep::found(unsigned of, bool SweepResult::*that) const {
  std::vector<Id> found;
  for (std::size_t q = 0; q < own_.tiles.tiles.size(); ++q) {
    if (own_.results[q].*that) for_found(own_.tiles, q, of, [&](Id k) { found.push_back(k); });
  }
  std::sort(found.begin(), found.end());
  return found;
}

std::vector<Id> FacesInStep::undecided() const {
  std::vector<Id> undecided = found(lane_bits::decides, &SweepResult::decides);
  if (!own_.tiles.limits.empty()) return undecided;
  const std::vector<Id> failing = found(lane_bits::fails, &SweepResult::fails);
  undecided.insert(undecided.end(), failing.begin(), failing.end());
  std::sort(undecided.begin(), undecided.end());
  undecided.erase(std::unique(undecided.begin(), undecided.end()), undecided.end());
  return undecided;
}

void FacesInStep::decide_and_evaluate(const std::vector<Id>& undecided) {
  const std::vector<Id> changed = decide(undecided);
  if (changed.empty()) return;
  evaluate(changed, 0.0);
  gather(changed);
}

/// Whether a face in a chunk that rests may go on, although blocks have been pushed so far (m).
bool FacesInStep::rests_on(Id chunk, double pushed, Id k) const {
  const FaceTiles& t = own_.tiles;
  return t.tiles[t.tile_of_chunk[chunk]].sleep.strayed + pushed <= t.rest[chunk] ||
         stays_open(t, c_, scene_.blocks, scene_.pose, k);
}

bool FacesInStep::takes_part(double pushed, Id k) const {
  const FaceTiles& t = own_.tiles;
  return std::any_of(t.place[k].begin(), t.place[k].end(), [&](Id place) {
    if (place == no_id) return false;
    const Id q = place / static_cast<Id>(lanes);
    return t.rest[q] == 0.0 || !rests_on(q, pushed, k);
  });
}

/// Chunks, ascending, in which these faces lie. A tile of which one must wake is to be swept anew.
std::vector<Id> FacesInStep::chunks_of(const std::vector<Id>& faces, double pushed) {
  FaceTiles& t = own_.tiles;
  std::vector<Id> chunks;
  for (const Id k : faces) {
    for (const Id place : t.place[k]) {
      if (place == no_id) continue;
      const Id q = place / static_cast<Id>(lanes);
      if (t.rest[q] > 0.0) {
        if (rests_on(q, pushed, k)) continue;
        wake_chunk(t, c_, scene_.pose, q);
      }
      chunks.push_back(q);
    }
  }
  std::sort(chunks.begin(), chunks.end());
  chunks.erase(std::unique(chunks.begin(), chunks.end()), chunks.end());
  return chunks;
}

/// Evaluates these chunks once more, and the whole tile where its forces are not kept or a face of
/// it must wake.
void FacesInStep::evaluate_chunks(const std::vector<Id>& chunks) {
  const FaceTiles& tiles = own_.tiles;
  struct Part {
    std::size_t tile;
    std::span<const Id> chunks;  ///< none: the whole tile
    SweepResult found;
  };
  constexpr std::size_t most = 4;  // chunks, so that threads have equal shares
  std::vector<Part> parts;
  for (std::size_t n = 0, end = 0; n < chunks.size(); n = end) {
    const std::size_t tile = tiles.tile_of_chunk[chunks[n]];
    const bool wakes = skips_ && tiles.tiles[tile].sleep.over;
    const bool some = tiles.kept[tile] != 0 && !wakes;
    while (end < chunks.size() && tiles.tile_of_chunk[chunks[end]] == tile &&
           !(some && end - n == most))
      ++end;
    parts.push_back({tile, {&chunks[n], some ? end - n : 0}, {}});
  }
  parallel_tasks(
      parts.size(), 200 * chunks.size(), own_.scratch, [&](std::size_t n, SweepScratch& scratch) {
        Part& p = parts[n];
        p.found = p.chunks.empty() ? sweep(p.tile, true, scratch)
                                   : sweep_chunks(own_.tiles, sweep_scene(), p.tile, p.chunks);
      });
  for (const Part& p : parts) {
    SweepResult& so_far = own_.results[p.tile];
    so_far.decides = so_far.decides || p.found.decides;
    so_far.switching = so_far.switching || p.found.switching;
    so_far.fails = so_far.fails || p.found.fails;
  }
}

void FacesInStep::evaluate(const std::vector<Id>& faces, double pushed) {
  evaluate_chunks(chunks_of(faces, pushed));
}

namespace {

/// Properties that a decision may change and on which the forces of a face depend.
auto properties(const FaceSet& c, Id k) {
  return std::tuple{c.acts(k),     c.leans(k),    c.locked_closure_a[k],
                    c.bonded(k),   c.glued(k),    c.locked_closure_b[k],
                    c.friction[k], c.cohesion[k], c.carries_tension(k),
                    c.tension[k]};
}

}  // namespace

std::vector<Id> FacesInStep::decide(const std::vector<Id>& faces, const StateAtN& ahead) {
  FaceTiles& t = own_.tiles;
  const bool breaks = t.limits.empty();
  std::vector<Id> undecided;
  for (const Id k : faces) {
    if ((breaks && t.has_found(lane_bits::fails, k)) || t.has_found(lane_bits::decides, k))
      undecided.push_back(k);
  }
  std::vector<std::uint8_t> changes(undecided.size(), 0);
  const auto decide_one = [&](std::size_t q) {
    const Id k = undecided[q];
    const FaceFields* const known = ahead ? ahead(k) : nullptr;
    if (known == nullptr) recall_work(c_, t, k);
    const FaceFields before = known == nullptr ? remembered(t, k) : *known;
    const auto had = properties(c_, k);
    if (breaks && (t.has_found(lane_bits::fails, k) || c_.bonded(k) || c_.carries_tension(k))) {
      decide_face(c_, scene_, step_, before, k);
    } else {
      decide_activity(c_, scene_.blocks, scene_.pose, {before.energy > 0.0, before.gate > 0.0}, k);
    }
    changes[q] = properties(c_, k) == had ? 0 : 1;
  };
  parallel_for(undecided.size(), decide_one, 1000);
  std::vector<Id> changed;
  for (std::size_t q = 0; q < undecided.size(); ++q) {
    if (changes[q] == 0) continue;
    load_decisions(t, c_, scene_.blocks, undecided[q]);
    changed.push_back(undecided[q]);
  }
  return changed;
}

void FacesInStep::gather(const std::vector<Id>& faces) {
  const BlockSet& b = scene_.blocks;
  std::vector<std::uint8_t>& wanted = own_.wanted;
  wanted.resize(b.size(), 0);
  std::vector<std::uint8_t> in_tile(own_.tiles.tiles.size(), 0);
  const auto mark = [&](std::uint8_t as) {
    for (const Id k : faces)
      wanted[b.vertex_block[c_.edge[k]]] = wanted[b.vertex_block[c_.facing[k]]] = as;
  };
  mark(1);
  for (const Id k : faces) {
    for (const Id place : own_.tiles.place[k]) {
      if (place != no_id) in_tile[own_.tiles.tile_of_chunk[place / lanes]] = 1;
    }
  }
  std::vector<char> no_scratch;
  parallel_tasks(in_tile.size(), 80 * faces.size(), no_scratch, [&](std::size_t tile, char&) {
    if (in_tile[tile] == 0 || own_.tiles.kept[tile] == 0) return;
    gather_tile(own_.tiles, b, tile, wanted, on_);
  });
  mark(0);
}

void add_sizes_of_forces(const TiledFaces& own, const BlockSet& b, std::vector<double>& to) {
  const FaceTiles& t = own.tiles;
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), 10 * t.face.size(), no_scratch, [&](std::size_t tile, char&) {
    const Tile& of = t.tiles[tile];
    const Id* begin = &t.record_begin[of.first_edge];  // of the records of an edge
    for (Id n = of.first_block; n < of.last_block; ++n) {
      const Id i = t.blocks[n], edges = b.vertex_begin[i + 1] - b.vertex_begin[i];
      for (Id record = begin[0]; record < begin[edges]; ++record) {
        const double* const on = &t.forces[tile][4 * std::size_t{record}];
        to[i] += std::abs(on[0] + on[2]) + std::abs(on[1] + on[3]);
      }
      begin += edges;
    }
  });
}

double largest_closure(const TiledFaces& own) {
  double depth = 0.0;
  for (const double d : own.tiles.deepest) depth = std::max(depth, d);
  return depth;
}

}  // namespace edda
