#include "contacts/face_tiles.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>

namespace edda {
namespace {

/// Cuts [first, last) of `blocks` in halves along the longer side of its bounding box, and appends
/// the ends of the tiles.
void halve(std::vector<Id>& blocks, const std::vector<Vec2>& place, std::size_t first,
           std::size_t last, std::size_t most, std::vector<std::size_t>& ends) {
  if (last - first <= most) {
    std::sort(blocks.begin() + static_cast<std::ptrdiff_t>(first),
              blocks.begin() + static_cast<std::ptrdiff_t>(last));
    return ends.push_back(last);
  }
  Vec2 low = place[blocks[first]], high = low;
  for (std::size_t q = first; q < last; ++q) {
    const Vec2 p = place[blocks[q]];
    low = {std::min(low.x, p.x), std::min(low.y, p.y)};
    high = {std::max(high.x, p.x), std::max(high.y, p.y)};
  }
  const bool across = high.x - low.x >= high.y - low.y;
  // Tiles are whole but for the last one, so that all have the same work.
  const std::size_t tiles = (last - first + most - 1) / most;
  const std::size_t middle = first + (last - first) * (tiles / 2) / tiles;
  const auto at = [&](std::size_t q) { return blocks.begin() + static_cast<std::ptrdiff_t>(q); };
  std::nth_element(at(first), at(middle), at(last), [&](Id i, Id j) {
    const double a = across ? place[i].x : place[i].y, b = across ? place[j].x : place[j].y;
    return a < b || (a == b && i < j);
  });
  halve(blocks, place, first, middle, most, ends);
  halve(blocks, place, middle, last, most, ends);
}

/// The faces of each tile, in the order of the list: [tiles + 1] offsets and the faces.
struct FacesOfTiles {
  std::vector<Id> begin, face;
};
FacesOfTiles faces_of_tiles(const FaceTiles& t, const FaceSet& c, const BlockSet& b,
                            const std::vector<Id>& tile_of) {
  FacesOfTiles of;
  of.begin.assign(t.tiles.size() + 1, 0);
  const auto each = [&](auto&& visit) {
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Id i = tile_of[b.vertex_block[c.edge[k]]], j = tile_of[b.vertex_block[c.facing[k]]];
      if (i != no_id) visit(i, static_cast<Id>(k));
      if (j != no_id && j != i) visit(j, static_cast<Id>(k));
    }
  };
  each([&](Id tile, Id) { ++of.begin[tile + 1]; });
  std::partial_sum(of.begin.begin(), of.begin.end(), of.begin.begin());
  of.face.resize(of.begin.back());
  std::vector<Id> next(of.begin.begin(), of.begin.end() - 1);
  each([&](Id tile, Id k) { of.face[next[tile]++] = k; });
  return of;
}

/// Lets the faces of lower kinds come first in each tile.
void sort_by_kind(FacesOfTiles& of, const std::vector<std::uint8_t>& kind) {
  const std::vector<Id> as_listed = of.face;
  for (std::size_t q = 0; q + 1 < of.begin.size(); ++q) {
    std::array<Id, face_kinds + 1> next{};
    for (Id n = of.begin[q]; n < of.begin[q + 1]; ++n) ++next[kind[as_listed[n]] + 1u];
    next[0] = of.begin[q];
    std::partial_sum(next.begin(), next.end(), next.begin());
    for (Id n = of.begin[q]; n < of.begin[q + 1]; ++n)
      of.face[next[kind[as_listed[n]]]++] = as_listed[n];
  }
}

std::vector<Id> tiles_of_blocks(const FaceTiles& t, std::size_t blocks) {
  std::vector<Id> tile_of(blocks, no_id);
  for (std::size_t q = 0; q < t.tiles.size(); ++q) {
    for (Id n = t.tiles[q].first_block; n < t.tiles[q].last_block; ++n) {
      tile_of[t.blocks[n]] = static_cast<Id>(q);
    }
  }
  return tile_of;
}

/// Gives edges their slots in a tile.
class Slots {
 public:
  explicit Slots(std::size_t edges) : slot_(edges), tile_(edges, no_id) {}

  void begin(FaceTiles& t, const BlockSet& b, std::size_t tile) {
    t_ = &t;
    here_ = static_cast<Id>(tile);
    Tile& of = t.tiles[tile];
    next_ = 0;
    for (Id n = of.first_block; n < of.last_block; ++n) {
      const Id i = t.blocks[n];
      for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) give(e);
    }
    of.own_edges = next_;
    of.first_halo = of.last_halo = static_cast<Id>(t.halo.size());
  }
  Id of(Id edge) {
    if (tile_[edge] != here_) {
      give(edge);
      t_->halo.push_back(edge);
      t_->tiles[here_].last_halo = static_cast<Id>(t_->halo.size());
    }
    return slot_[edge];
  }

 private:
  void give(Id edge) {
    tile_[edge] = here_;
    slot_[edge] = next_++;
  }
  FaceTiles* t_ = nullptr;
  Id here_ = 0, next_ = 0;
  std::vector<Id> slot_, tile_;
};

void resize_chunks(FaceTiles& t, std::size_t chunks, bool dashpots) {
  t.plain.assign(chunks, 1);
  t.bonds.assign(chunks, 0);
  t.edge_set.assign(chunks, 0);
  t.strength_set.assign(chunks, 0);
  t.record_e.assign(chunks * lanes, 0);
  t.record_f.assign(chunks * lanes, 0);
  t.sums.assign(chunks * sum_columns * lanes, 0.0);
  t.ever.assign(chunks, 0);
  for (int which : {0, 1}) {
    t.idle[which].assign(chunks, 0);
    t.fresh[which].assign(chunks, 0);
    t.bits[which].assign(chunks, 0);
    t.found[which].assign(chunks, 0);
    t.work[which].resize(chunks * work_columns * lanes);
    t.memory[which].assign(chunks * memory_columns * lanes, 0.0);
    t.dashpots[which].assign(dashpots ? chunks * dashpot_memory_columns * lanes : 0, 0.0);
  }
}

}  // namespace

void divide_blocks(FaceTiles& t, const BlockSet& b, const State& state, bool with_fixed,
                   std::size_t most) {
  std::vector<Vec2> place(b.size());
  t.blocks.clear();
  t.tiles.clear();
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (state.alive[i] == 0 || (b.fixed[i] != 0 && !with_fixed)) continue;
    place[i] = centroid(state.x, state.y, i);
    t.blocks.push_back(static_cast<Id>(i));
  }
  std::vector<std::size_t> ends;
  if (!t.blocks.empty()) halve(t.blocks, place, 0, t.blocks.size(), most, ends);
  Id first = 0;
  for (const std::size_t end : ends) {
    Tile tile;
    tile.first_block = first;
    tile.last_block = first = static_cast<Id>(end);
    t.tiles.push_back(tile);
  }
}

std::size_t FaceTiles::tile_of_chunk(std::size_t chunk) const {
  const auto next =
      std::upper_bound(tiles.begin(), tiles.end(), chunk,
                       [](std::size_t q, const Tile& t) { return q < t.first_chunk; });
  return static_cast<std::size_t>(next - tiles.begin()) - 1;
}

void lay_out(FaceTiles& t, const FaceSet& c, const BlockSet& b,
             const std::vector<std::uint8_t>& kind) {
  FacesOfTiles of = faces_of_tiles(t, c, b, tiles_of_blocks(t, b.size()));
  if (!kind.empty()) sort_by_kind(of, kind);
  Slots slots(b.vertex_count());
  t.halo.clear();
  t.face.clear();
  t.slot_e.clear();
  t.slot_f.clear();
  t.owned.clear();
  t.place.assign(c.size(), {no_id, no_id});
  Id edges = 0;
  for (std::size_t q = 0; q < t.tiles.size(); ++q) {
    Tile& tile = t.tiles[q];
    slots.begin(t, b, q);
    tile.first_edge = edges;
    edges += tile.own_edges + 1;
    tile.first_chunk = static_cast<Id>(t.face.size() / lanes);
    tile.takes_then = false;
    tile.sleep = {};
    for (Id n = of.begin[q]; n < of.begin[q + 1]; ++n) {
      const Id k = of.face[n], place = static_cast<Id>(t.face.size());
      if (place % lanes == 0) t.owned.push_back(0);
      const bool owns = t.place[k][0] == no_id;
      t.place[k][owns ? 0 : 1] = place;
      if (owns) t.owned.back() = static_cast<std::uint8_t>(t.owned.back() | 1u << (place % lanes));
      t.face.push_back(k);
      t.slot_e.push_back(slots.of(c.edge[k]));
      t.slot_f.push_back(slots.of(c.facing[k]));
      tile.takes_then = tile.takes_then || !c.locked_start.empty() ||
                        c.locked_closure_a[k] != 0.0 || c.locked_closure_b[k] != 0.0;
    }
    while (t.face.size() % lanes != 0) {
      t.face.push_back(no_id);
      t.slot_e.push_back(tile.slots() - 1);
      t.slot_f.push_back(tile.slots() - 1);
    }
    tile.last_chunk = tile.awake_end = static_cast<Id>(t.face.size() / lanes);
  }
  resize_chunks(t, t.face.size() / lanes, c.dashpots);
  t.record_begin.assign(edges, 0);
  t.constants.resize(t.tiles.size());
  t.forces.resize(t.tiles.size());
  t.kept.assign(t.tiles.size(), 0);
}

void order_records(FaceTiles& t, const FaceSet& c, const BlockSet& b, std::size_t tile) {
  const Tile& of = t.tiles[tile];
  const std::size_t first = of.first_chunk * lanes, end = of.awake_end * lanes;
  Id* const begin = t.record_begin.data() + of.first_edge;
  Id next = 0, slot = 0;
  for (Id n = of.first_block; n < of.last_block; ++n) {
    const Id i = t.blocks[n];
    for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) {
      begin[slot++] = next;
      c.for_faces(e, e + 1, [&](Id k, bool of_edge) {
        // At most one of the two copies is in this tile.
        for (Id& copy : t.place[k]) {
          const Id place = std::atomic_ref<Id>(copy).load(std::memory_order_relaxed);
          if (place < first || place >= end) continue;
          (of_edge ? t.record_e : t.record_f)[place] = next++;
        }
      });
    }
  }
  begin[slot] = next;
  for (std::size_t place = first; place < end; ++place) {
    if (t.slot_e[place] >= of.own_edges) t.record_e[place] = next;
    if (t.slot_f[place] >= of.own_edges) t.record_f[place] = next;
  }
}

}  // namespace edda
