#include "step/tile_step.hpp"

#include <omp.h>

#include <algorithm>
#include <array>
#include <span>

#include "base/parallel.hpp"
#include "contacts/activity.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/find_faces.hpp"
#include "contacts/tile_decisions.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_renewal.hpp"
#include "contacts/tile_rows.hpp"
#include "contacts/tile_sleep.hpp"
#include "step/contact_search.hpp"
#include "step/face_switching.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

SweepScene sweep_scene(const Simulation& sim) {
  const Motion& motion = sim.motion;
  const TiledFaces& own = sim.leapfrog.tiled;
  return {.blocks = sim.scene->blocks,
          .masses = motion.masses,
          .faces = motion.contacts,
          .pose = motion.pose,
          .largest_move = sim.control.last_displacement,
          .pushed = own.pushed,
          .least_margin = own.sleep_part * motion.contacts.reach,
          .step = motion.state.step,
          .corrects = own.corrects};
}

SweepResult sweep(Simulation& sim, std::size_t tile, bool keep, SweepScratch& scratch) {
  TiledFaces& own = sim.leapfrog.tiled;
  return sweep_tile(own.tiles, sweep_scene(sim), tile, keep, scratch, sim.motion.on_contacts.x,
                    sim.motion.on_contacts.y, sim.motion.on_contacts.modes);
}

/// Whether a face in a chunk that rests may go on, although blocks have been pushed so far (m).
bool rests_on(const Simulation& sim, Id chunk, double pushed, Id k) {
  const FaceTiles& t = sim.leapfrog.tiled.tiles;
  return t.tiles[t.tile_of_chunk[chunk]].sleep.strayed + pushed <= t.rest[chunk] ||
         stays_open(t, sim.motion.contacts, sim.scene->blocks, sim.motion.pose, k);
}

/// Whether a copy of face k is awake, or must wake since blocks have been pushed so far (m).
bool takes_part(const Simulation& sim, double pushed, Id k) {
  const FaceTiles& t = sim.leapfrog.tiled.tiles;
  return std::any_of(t.place[k].begin(), t.place[k].end(), [&](Id place) {
    if (place == no_id) return false;
    const Id q = place / static_cast<Id>(lanes);
    return t.rest[q] == 0.0 || !rests_on(sim, q, pushed, k);
  });
}

/// Chunks, ascending, in which these faces lie. A tile of which one must wake is to be swept anew.
std::vector<Id> chunks_of(Simulation& sim, const std::vector<Id>& faces, double pushed) {
  FaceTiles& t = sim.leapfrog.tiled.tiles;
  std::vector<Id> chunks;
  for (const Id k : faces) {
    for (const Id place : t.place[k]) {
      if (place == no_id) continue;
      const Id q = place / static_cast<Id>(lanes);
      if (t.rest[q] > 0.0) {
        if (rests_on(sim, q, pushed, k)) continue;
        wake_chunk(t, sim.motion.contacts, sim.motion.pose, q);
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
void evaluate_chunks(Simulation& sim, const std::vector<Id>& chunks) {
  TiledFaces& own = sim.leapfrog.tiled;
  const FaceTiles& tiles = own.tiles;
  struct Part {
    std::size_t tile;
    std::span<const Id> chunks;  ///< none: the whole tile
    SweepResult found;
  };
  constexpr std::size_t most = 4;  // chunks, so that threads have equal shares
  std::vector<Part> parts;
  for (std::size_t n = 0, end = 0; n < chunks.size(); n = end) {
    const std::size_t tile = tiles.tile_of_chunk[chunks[n]];
    const bool some = tiles.kept[tile] != 0 && !tiles.tiles[tile].sleep.over;
    while (end < chunks.size() && tiles.tile_of_chunk[chunks[end]] == tile &&
           !(some && end - n == most))
      ++end;
    parts.push_back({tile, {&chunks[n], some ? end - n : 0}, {}});
  }
  parallel_tasks(
      parts.size(), 200 * chunks.size(), own.scratch, [&](std::size_t n, SweepScratch& scratch) {
        Part& p = parts[n];
        p.found = p.chunks.empty() ? sweep(sim, p.tile, true, scratch)
                                   : sweep_chunks(own.tiles, sweep_scene(sim), p.tile, p.chunks);
      });
  for (const Part& p : parts) {
    SweepResult& so_far = own.results[p.tile];
    so_far.decides = so_far.decides || p.found.decides;
    so_far.switching = so_far.switching || p.found.switching;
    so_far.fails = so_far.fails || p.found.fails;
  }
}

/// Properties that a decision may change and on which the forces of a face depend.
auto properties(const FaceSet& c, Id k) {
  return std::array{c.acts[k],     c.leans[k],    c.locked_closure_a[k],
                    c.bonded[k],   c.glued[k],    c.locked_closure_b[k],
                    c.friction[k], c.cohesion[k], c.carries_tension[k],
                    c.tension[k]};
}

/// Decides activity and breaks bonds of those of these faces that ask for it. Returns those of
/// which anything has changed. corrected: faces of which the state at n is ahead of the tiles.
std::vector<Id> decide(Simulation& sim, const std::vector<Id>& faces,
                       const std::vector<SwitchingFace>& corrected) {
  FaceTiles& t = sim.leapfrog.tiled.tiles;
  FaceSet& c = sim.motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  std::vector<Id> asking;
  for (const Id k : faces) {
    if (t.has_found(lane_bits::fails, k) || t.has_found(lane_bits::decides, k)) asking.push_back(k);
  }
  std::vector<std::uint8_t> changes(asking.size(), 0);
  const auto decide_one = [&](std::size_t q) {
    const Id k = asking[q];
    const auto known = std::find_if(corrected.begin(), corrected.end(),
                                    [k](const SwitchingFace& f) { return f.face == k; });
    if (known == corrected.end()) recall_work(c, t, k);
    const FaceFields<double> before = known == corrected.end() ? remembered(t, k) : known->before;
    const auto had = properties(c, k);
    if (t.has_found(lane_bits::fails, k) || c.bonded[k] > 0.0 || c.carries_tension[k] > 0.0) {
      decide_face(c, face_scene(sim), sim.motion.state.step, before, k);
    } else {
      decide_activity(c, b, sim.motion.pose, {before.energy > 0.0, before.gate > 0.0}, k);
    }
    changes[q] = properties(c, k) == had ? 0 : 1;
  };
  parallel_for(asking.size(), decide_one, 1000);
  std::vector<Id> changed;
  for (std::size_t q = 0; q < asking.size(); ++q) {
    if (changes[q] == 0) continue;
    load_decisions(t, c, b, asking[q]);
    changed.push_back(asking[q]);
  }
  return changed;
}

/// Evaluates faces once more while switching is corrected, with what is decided of them then.
void evaluate_again(Simulation& sim, const std::vector<Id>& faces,
                    const std::vector<SwitchingFace>& corrected) {
  const double pushed = sim.leapfrog.switching.pushed_by;
  evaluate_chunks(sim, chunks_of(sim, faces, pushed));
  const std::vector<Id> changed = decide(sim, faces, corrected);
  if (!changed.empty()) evaluate_chunks(sim, chunks_of(sim, changed, pushed));
}

/// Faces with a bit of the field in the tiles of which `has` holds, in the order of the list.
template <class Has>
std::vector<Id> faces_found(const TiledFaces& own, unsigned of, Has has) {
  std::vector<Id> found;
  for (std::size_t q = 0; q < own.tiles.tiles.size(); ++q) {
    if (has(own.results[q])) for_found(own.tiles, q, of, [&](Id k) { found.push_back(k); });
  }
  std::sort(found.begin(), found.end());
  return found;
}

/// Sums the forces anew on the blocks of these faces.
void gather(Simulation& sim, const std::vector<Id>& faces) {
  TiledFaces& own = sim.leapfrog.tiled;
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& c = sim.motion.contacts;
  std::vector<std::uint8_t>& wanted = own.wanted;
  wanted.resize(b.size(), 0);
  std::vector<std::uint8_t> in_tile(own.tiles.tiles.size(), 0);
  const auto mark = [&](std::uint8_t as) {
    for (const Id k : faces)
      wanted[b.vertex_block[c.edge[k]]] = wanted[b.vertex_block[c.facing[k]]] = as;
  };
  mark(1);
  for (const Id k : faces) {
    for (const Id place : own.tiles.place[k]) {
      if (place != no_id) in_tile[own.tiles.tile_of_chunk[place / lanes]] = 1;
    }
  }
  std::vector<char> no_scratch;
  parallel_tasks(in_tile.size(), 80 * faces.size(), no_scratch, [&](std::size_t tile, char&) {
    if (in_tile[tile] == 0 || own.tiles.kept[tile] == 0) return;
    gather_tile(own.tiles, b, tile, wanted, sim.motion.on_contacts.x, sim.motion.on_contacts.y,
                sim.motion.on_contacts.modes);
  });
  mark(0);
}

/// Decides what the sweep asks for.
void decide_after_sweep(Simulation& sim) {
  const TiledFaces& own = sim.leapfrog.tiled;
  std::vector<Id> asking =
      faces_found(own, lane_bits::decides, [](const SweepResult& r) { return r.decides; });
  const std::vector<Id> failing =
      faces_found(own, lane_bits::fails, [](const SweepResult& r) { return r.fails; });
  asking.insert(asking.end(), failing.begin(), failing.end());
  std::sort(asking.begin(), asking.end());
  asking.erase(std::unique(asking.begin(), asking.end()), asking.end());
  const std::vector<Id> changed = decide(sim, asking, {});
  if (changed.empty()) return;
  evaluate_chunks(sim, chunks_of(sim, changed, 0.0));
  gather(sim, changed);
}

/// The faces in tiles, as the correction of switching reads them.
class FacesInTiles : public FaceAccess {
 public:
  explicit FacesInTiles(Simulation& sim) : sim_(sim) {}

  bool switches(Id k) const override {
    const FaceTiles& t = sim_.leapfrog.tiled.tiles;
    return t.remembers(lane_bits::switched, k);
  }
  FaceFields<double> before(Id k) override {
    recall_work(sim_.motion.contacts, sim_.leapfrog.tiled.tiles, k);
    return remembered(sim_.leapfrog.tiled.tiles, k);
  }

  void evaluate(const std::vector<Id>& blocks, const std::vector<SwitchingFace>& corrected,
                std::vector<Id>& switching) override {
    const BlockSet& b = sim_.scene->blocks;
    const std::size_t known = changed_.size();
    const double pushed = sim_.leapfrog.switching.pushed_by;
    for (const Id i : blocks) {
      sim_.motion.contacts.for_faces(b.vertex_begin[i], b.vertex_begin[i + 1], [&](Id k, bool) {
        if (takes_part(sim_, pushed, k)) changed_.push_back(k);
      });
    }
    std::vector<Id> faces(changed_.begin() + static_cast<std::ptrdiff_t>(known), changed_.end());
    std::sort(faces.begin(), faces.end());
    faces.erase(std::unique(faces.begin(), faces.end()), faces.end());
    evaluate_again(sim_, faces, corrected);
    for (const Id k : faces) {
      if (sim_.leapfrog.tiled.tiles.has_found(lane_bits::switching, k)) switching.push_back(k);
    }
  }

  void finish(const std::vector<SwitchingFace>& corrected) override {
    std::vector<Id> faces;
    for (const SwitchingFace& f : corrected) {
      faces.push_back(f.face);
      load_correction(sim_.leapfrog.tiled.tiles, sim_.motion.contacts, f.before, f.face);
    }
    std::sort(faces.begin(), faces.end());
    evaluate_again(sim_, faces, corrected);
    changed_.insert(changed_.end(), faces.begin(), faces.end());
    gather(sim_, changed_);
  }

 private:
  Simulation& sim_;
  std::vector<Id> changed_;
};

}  // namespace

bool steps_in_tiles(const Simulation& sim) {
  return sim.leapfrog.tiled.use;
}

namespace {

/// Blocks of a tile, at most. Threads that share a model have eight tiles each, or else tiles of
/// half the size, or still smaller ones in a model too small for two of these each.
std::size_t blocks_of_tile(const Simulation& sim) {
  constexpr std::size_t fewest = 24;
  const std::size_t most = sim.leapfrog.tiled.most_blocks, blocks = sim.scene->blocks.size(),
                    threads = static_cast<std::size_t>(sim.leapfrog.tiled.threads);
  if (threads == 1 || blocks >= 8 * threads * most) return most;
  return std::min((most + 1) / 2, std::max(fewest, blocks / (2 * threads) + 1));
}

}  // namespace

void load_tiles(Simulation& sim) {
  TiledFaces& own = sim.leapfrog.tiled;
  own.threads = std::max(own.threads, omp_get_max_threads());
  const std::size_t of_tile = blocks_of_tile(sim);
  if (own.loaded && own.blocks == of_tile) return;
  faces_to_change(sim);
  own.blocks = of_tile;
  const BlockSet& blocks = sim.scene->blocks;
  divide_blocks(own.tiles, blocks, sim.motion.state, sim.attached.ground.moves, of_tile);
  load_faces(own.tiles, sim.motion.contacts, blocks, sim.motion.pose);
  own.results.resize(own.tiles.tiles.size());
  own.in_two_tiles = part_in_two_tiles(own.tiles);
  own.loaded = true;
  own.ahead = false;
  own.pushed = 0.0;
}

void place_in_tiles(Simulation& sim) {
  TiledFaces& own = sim.leapfrog.tiled;
  Motion& motion = sim.motion;
  FaceSet& c = motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  if (c.gluing) glue_pressed(c, own.tiles, b, motion.pose);
  next_step(c, own.tiles);
  if (motion.laws.any_changes) update_joint_laws(c, own.tiles, b, motion.pose, motion.laws);
  if (!own.ahead) c.drop_states();
  own.ahead = true;
  std::vector<std::size_t> weights;
  for (const SweepResult& last : own.results)
    weights.push_back(std::max<std::size_t>(1, last.work));
  const auto sweep_one = [&](std::size_t tile, SweepScratch& scratch) {
    own.results[tile] = sweep(sim, tile, false, scratch);
  };
  parallel_tasks(own.tiles.tiles.size(), 10 * own.tiles.face.size(), own.scratch, sweep_one,
                 weights);
  own.pushed = 0.0;
  decide_after_sweep(sim);
}

void switch_in_tiles(Simulation& sim, const StepTaken& taken) {
  TiledFaces& own = sim.leapfrog.tiled;
  const std::vector<Id> switching =
      faces_found(own, lane_bits::switching, [](const SweepResult& r) { return r.switching; });
  if (switching.empty()) return;
  FacesInTiles access(sim);
  own.corrects = true;
  correct_switching(sim.motion.contacts, taken, sim.accounts.open_close, sim.leapfrog.switching,
                    switching, access);
  own.corrects = false;
  own.pushed = sim.leapfrog.switching.pushed_by;
}

double largest_closure(const TiledFaces& own) {
  double depth = 0.0;
  for (const double d : own.tiles.deepest) depth = std::max(depth, d);
  return depth;
}

namespace {

/// Whether each face stores energy, [nf].
std::vector<std::uint8_t> faces_that_carry(const FaceTiles& t) {
  std::vector<std::uint8_t> carry(t.place.size(), 0);
  for (std::size_t k = 0; k < carry.size(); ++k)
    carry[k] = t.remembers(lane_bits::stored, k) ? 1 : 0;
  return carry;
}

}  // namespace

void search_in_tiles(Simulation& sim, const Reach& reach) {
  TiledFaces& own = sim.leapfrog.tiled;
  Motion& motion = sim.motion;
  const BlockSet& b = sim.scene->blocks;
  recall_work(motion.contacts, own.tiles);
  motion.contacts.dashpots = dashpots_work(own.tiles);
  const std::vector<Id> old_row =
      renew_faces(motion.contacts, b, motion.state, motion.pose, motion.laws, reach,
                  sim.control.near_edges, faces_that_carry(own.tiles), FaceStates::elsewhere);
  set_face_dashpots(motion.contacts, motion.laws, motion.damping.contact);
  renew_tiles(own.tiles, motion.contacts, b, motion.pose, old_row);
  own.ahead = true;
  own.pushed = 0.0;
  constexpr double worth = 0.15;  // of the faces, evaluated twice because neighbours have changed
  if (part_in_two_tiles(own.tiles) > own.in_two_tiles + worth) faces_to_change(sim);
}

void update_face_rows(Simulation& sim) {
  TiledFaces& own = sim.leapfrog.tiled;
  if (!own.ahead) return;
  unload_faces(sim.motion.contacts, own.tiles, face_scene(sim), sim.control.step_before);
  own.ahead = false;
}

void lose_faces(Simulation& sim) {
  TiledFaces& own = sim.leapfrog.tiled;
  FaceSet& c = sim.motion.contacts;
  own.tiles = FaceTiles();
  sim.control.near_edges = NearEdges();
  const bool fits =
      c.now.rows() == c.size() && c.before.rows() == c.size() && c.force.size() == c.force_size();
  if (own.ahead || !fits) c.clear_states();
  own.ahead = own.loaded = false;
}

FaceSet& faces_to_change(Simulation& sim) {
  update_face_rows(sim);
  sim.leapfrog.tiled.loaded = false;
  return sim.motion.contacts;
}

}  // namespace edda
