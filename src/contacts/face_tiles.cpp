#include "contacts/face_tiles.hpp"

#include <algorithm>
#include <atomic>
#include <numeric>

#include "base/parallel.hpp"

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
  // As few tiles as possible, of equal size, so that all cost the same.
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
  /// Begins a tile with the edges of its own blocks; halo: takes those of others.
  void begin(const FaceTiles& t, const BlockSet& b, std::size_t tile, std::vector<Id>& halo) {
    slot_.resize(b.vertex_count());
    tile_.resize(b.vertex_count(), no_id);
    here_ = static_cast<Id>(tile);
    halo_ = &halo;
    next_ = 0;
    const Tile& of = t.tiles[tile];
    for (Id n = of.first_block; n < of.last_block; ++n) {
      const Id i = t.blocks[n];
      for (Id e = b.vertex_begin[i]; e < b.vertex_begin[i + 1]; ++e) give(e);
    }
  }
  Id of(Id edge) {
    if (tile_[edge] != here_) {
      give(edge);
      halo_->push_back(edge);
    }
    return slot_[edge];
  }
  Id next() const { return next_; }

 private:
  void give(Id edge) {
    tile_[edge] = here_;
    slot_[edge] = next_++;
  }
  std::vector<Id>* halo_ = nullptr;
  Id here_ = 0, next_ = 0;
  std::vector<Id> slot_, tile_;
};

/// Sets the size of a table without the room that std::vector would take for more.
void resize_table(AlignedNumbers& table, std::size_t size) {
  if (size > table.capacity()) table.reserve(size + size / 16);
  table.resize(size);
  if (table.capacity() > 2 * size) table.shrink_to_fit();
}

void resize_chunks(FaceTiles& t, std::size_t chunks) {
  for (auto* ids : {&t.face, &t.slot_e, &t.slot_f, &t.record_e, &t.record_f})
    resize_afresh(*ids, chunks * lanes);
  resize_afresh(t.tile_of_chunk, chunks);
  t.owned.assign(chunks, 0);
  t.plain.assign(chunks, 1);
  t.bonds.assign(chunks, 0);
  t.rest.assign(chunks, 0.0);
  t.edge_set.assign(chunks, no_id);
  t.strength_set.assign(chunks, no_id);
  resize_afresh(t.sums, chunks * sum_columns * lanes);
  t.ever.assign(chunks, 0);
  for (int which : {0, 1}) {
    t.idle[which].assign(chunks, 0);
    t.fresh[which].assign(chunks, 0);
    t.bits[which].assign(chunks, 0);
    t.found[which].assign(chunks, 0);
  }
}

/// Says where the chunks and the edges of each tile begin. Returns how many chunks there are.
std::size_t place_tiles(FaceTiles& t, const FacesOfTiles& of, const BlockSet& b) {
  std::size_t chunks = 0;
  Id edges = 0;
  for (std::size_t q = 0; q < t.tiles.size(); ++q) {
    Tile& tile = t.tiles[q];
    tile.own_edges = 0;
    for (Id n = tile.first_block; n < tile.last_block; ++n)
      tile.own_edges += b.vertex_begin[t.blocks[n] + 1] - b.vertex_begin[t.blocks[n]];
    tile.first_edge = edges;
    edges += tile.own_edges + 1;
    tile.first_chunk = static_cast<Id>(chunks);
    chunks += (of.begin[q + 1] - of.begin[q] + lanes - 1) / lanes;
    tile.last_chunk = tile.awake_end = static_cast<Id>(chunks);
    tile.takes_then = false;
    tile.sleep.begin_anew();
  }
  t.record_begin.assign(edges, 0);
  return chunks;
}

/// Gives the faces of a tile their places. A face of two tiles belongs to the first.
void lay_out_tile(FaceTiles& t, const FacesOfTiles& of, const FaceSet& c, const BlockSet& b,
                  const std::vector<Id>& tile_of, std::size_t q, Slots& slots,
                  std::vector<Id>& halo) {
  Tile& tile = t.tiles[q];
  std::fill(t.tile_of_chunk.data() + tile.first_chunk, t.tile_of_chunk.data() + tile.last_chunk,
            static_cast<Id>(q));
  slots.begin(t, b, q, halo);
  std::size_t place = tile.first_chunk * lanes;
  for (Id n = of.begin[q]; n < of.begin[q + 1]; ++n, ++place) {
    const Id k = of.face[n];
    const bool owns =
        std::min(tile_of[b.vertex_block[c.edge[k]]], tile_of[b.vertex_block[c.facing[k]]]) == q;
    t.place[k][owns ? 0 : 1] = static_cast<Id>(place);
    std::uint8_t& owned = t.owned[place / lanes];
    if (owns) owned = static_cast<std::uint8_t>(owned | 1u << (place % lanes));
    t.face[place] = k;
    t.slot_e[place] = slots.of(c.edge[k]);
    t.slot_f[place] = slots.of(c.facing[k]);
    tile.takes_then = tile.takes_then || !c.locked_start.empty() || c.locked_closure_a[k] != 0.0 ||
                      c.locked_closure_b[k] != 0.0;
  }
  for (; place < tile.last_chunk * lanes; ++place) {
    t.face[place] = no_id;
    t.slot_e[place] = t.slot_f[place] = slots.next();
  }
}

/// Gives the faces of a tile that carry load room for what they remember.
void begin_numbers(FaceTiles& t, const FacesOfTiles& of, const std::vector<std::uint8_t>& kind,
                   std::size_t q) {
  const auto begin = of.face.begin() + of.begin[q], end = of.face.begin() + of.begin[q + 1];
  const auto carry = static_cast<std::size_t>(
      std::count_if(begin, end, [&](Id k) { return kind[k] < face_kind::touching; }));
  const Tile& tile = t.tiles[q];
  TileNumbers numbers;
  numbers.first_chunk = tile.first_chunk;
  numbers.resize((carry + lanes - 1) / lanes, t);
  t.numbers[q] = std::move(numbers);
  // A tile without faces may begin where the table ends.
  std::fill_n(t.sums.data() + tile.first_chunk * sum_columns * lanes,
              (tile.last_chunk - tile.first_chunk) * sum_columns * lanes, 0.0);
}

/// Joins the edges of others of all tiles.
void join_halos(FaceTiles& t, const std::vector<std::vector<Id>>& halos) {
  t.halo.clear();
  for (std::size_t q = 0; q < t.tiles.size(); ++q) {
    t.tiles[q].first_halo = static_cast<Id>(t.halo.size());
    t.halo.insert(t.halo.end(), halos[q].begin(), halos[q].end());
    t.tiles[q].last_halo = static_cast<Id>(t.halo.size());
  }
}

}  // namespace

void TileNumbers::resize(std::size_t count, const FaceTiles& of) {
  chunks = static_cast<Id>(count);
  for (const int which : {0, 1}) {
    resize_table(memory[which], count * memory_columns * lanes);
    resize_table(dashpots[which], of.dashpots ? count * dashpot_memory_columns * lanes : 0);
    resize_table(pressures[which], of.slip_laws ? count * pressure_columns * lanes : 0);
    resize_table(work[which], count * work_columns * lanes);
  }
}

void divide_blocks(FaceTiles& t, const BlockSet& b, const State& state, bool with_fixed,
                   std::size_t most) {
  std::vector<Vec2> place(b.size());
  t.blocks.clear();
  t.tiles.clear();
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (state.alive[i] == 0 || (b.fixed[i] != 0 && !with_fixed)) continue;
    place[i] = centroid(state.position, i);
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

void lay_out(FaceTiles& t, const FaceSet& c, const BlockSet& b,
             const std::vector<std::uint8_t>& kind) {
  const std::vector<Id> tile_of = tiles_of_blocks(t, b.size());
  FacesOfTiles of = faces_of_tiles(t, c, b, tile_of);
  sort_by_kind(of, kind);
  resize_chunks(t, place_tiles(t, of, b));
  t.dashpots = c.dashpots;
  t.slip_laws = c.slip_laws;
  t.numbers.resize(t.tiles.size());
  t.place.assign(c.size(), {no_id, no_id});
  std::vector<std::vector<Id>> halos(t.tiles.size());
  std::vector<Slots> slots;
  parallel_tasks(t.tiles.size(), 15 * c.size(), slots, [&](std::size_t q, Slots& of_thread) {
    lay_out_tile(t, of, c, b, tile_of, q, of_thread, halos[q]);
    begin_numbers(t, of, kind, q);
  });
  join_halos(t, halos);
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
    const Id of_others = next + static_cast<Id>((place - first) / lanes);
    if (t.slot_e[place] >= of.own_edges) t.record_e[place] = of_others;
    if (t.slot_f[place] >= of.own_edges) t.record_f[place] = of_others;
  }
}

}  // namespace edda
