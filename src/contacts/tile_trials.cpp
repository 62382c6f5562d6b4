#include "contacts/tile_trials.hpp"

#include <algorithm>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/tile_columns.hpp"
#include "contacts/tile_decisions.hpp"
#include "contacts/tile_loading.hpp"

namespace edda {
namespace {

/// Makes one of the two memories that of the other.
void copy_memory(FaceTiles& t, int to, int from) {
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), t.face.size(), no_scratch, [&](std::size_t tile, char&) {
    TileNumbers& n = t.numbers[tile];
    for (AlignedNumbers* table : {n.memory, n.dashpots, n.pressures, n.work})
      table[to] = table[from];
  });
  t.bits[to] = t.bits[from];
  t.found[to] = t.found[from];
  t.idle[to] = t.idle[from];
  t.fresh[to] = t.fresh[from];
}

}  // namespace

void begin_limits(FaceTiles& t) {
  t.limits.assign(t.chunks() * limit_columns * lanes, 0.0);
}

void limit_shear(FaceTiles& t, FaceEnds limit, std::size_t k) {
  for (const Id place : t.place[k]) {
    if (place != no_id) put(t.limits, place, LimitColumns<double>{limit.a, limit.b});
  }
}

void keep_trial(FaceTiles& t, const FaceSet& c) {
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), 5 * t.face.size(), no_scratch, [&](std::size_t tile, char&) {
    for (Id q = t.tiles[tile].first_chunk; q < t.tiles[tile].last_chunk; ++q) {
      for (std::size_t place = q * lanes; place < (q + 1) * lanes; ++place) {
        if (t.face[place] != no_id) load_sums(t, c, place, t.face[place]);
      }
      if (t.fresh[t.now][q] == 0) continue;
      const auto work =
          columns_from<FaceWorkColumns<double*>>(chunk_of<FaceWorkColumns<double>>(t, t.now, q));
      for (double* done : {work.friction_work, work.transfer, work.damping_work, work.damping_due})
        std::fill_n(done, lanes, 0.0);
    }
  });
  copy_memory(t, 1 - t.now, t.now);
  t.limits.clear();
}

void end_at_rest(FaceSet& c, FaceTiles& t, const BlockSet& b, const Pose& pose) {
  if (c.gluing) glue_pressed(c, t, b, pose.x, pose.y);
  next_step(c, t);
  t.now = 1 - t.now;
  recall_work(c, t);
  keep_trial(t, c);
}

void drop_trial(FaceTiles& t) {
  copy_memory(t, t.now, 1 - t.now);
  t.limits.clear();
  t.deepest.assign(t.chunks(), std::numeric_limits<double>::infinity());  // an upper bound
}

}  // namespace edda
