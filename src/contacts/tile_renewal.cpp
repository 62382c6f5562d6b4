#include "contacts/tile_renewal.hpp"

#include <algorithm>
#include <utility>

#include "base/parallel.hpp"
#include "contacts/tile_columns.hpp"
#include "contacts/tile_loading.hpp"
#include "contacts/tile_packing.hpp"

namespace edda {
namespace {

/// Kernel classes of the faces of the old list, [nf].
std::vector<std::uint8_t> kinds_of(const FaceTiles& t) {
  std::vector<std::uint8_t> kind(t.place.size(), face_kind::open_awake);
  for (const Tile& tile : t.tiles) {
    for (Id q = tile.first_chunk; q < tile.last_chunk; ++q) {
      for (std::size_t lane = 0; lane < lanes; ++lane) {
        const Id k = t.face[q * lanes + lane];
        if (k == no_id) continue;
        const auto found = [&](unsigned of) {
          return lane_bits::test(t.found[t.now][q], of, lane);
        };
        if (t.rest[q] > 0.0) {
          kind[k] = face_kind::asleep;
        } else if (found(lane_bits::loaded)) {
          kind[k] = kind_of_loaded(!found(lane_bits::rare), found(lane_bits::busy));
        }
      }
    }
  }
  return kind;
}

/// The tiles of both lists, with the faces and vertices of the new one.
struct Renewal {
  FaceTiles& next;
  const FaceTiles& old;
  const FaceSet& faces;
  const Pose& pose;
};

/// Copies the bits of one face in every field.
void copy_bits(LaneBits& to, std::size_t lane, LaneBits from, std::size_t old_lane) {
  constexpr LaneBits every = 0x0101010101010101;
  to |= (from >> old_lane & every) << lane;
}

/// What a face remembers of one step, and what it has done in it.
void copy_step(const Renewal& r, int which, std::size_t place, std::size_t from) {
  const std::size_t q = place / lanes, p = from / lanes;
  copy_bits(r.next.bits[which][q], place % lanes, r.old.bits[which][p], from % lanes);
  copy_bits(r.next.found[which][q], place % lanes, r.old.found[which][p], from % lanes);
  if (lane_bits::test(r.old.found[which][p], lane_bits::loaded, from % lanes))
    r.next.idle[which][q] = 0;
  if (!r.next.holds(q)) return;
  for_memory(r.next,
             [&]<class Fields>() { put(r.next, which, place, get<Fields>(r.old, which, from)); });
  const bool kept = r.old.fresh[which][p] != 0;
  if (kept) begin_work(r.next, which, q);
  if (r.next.fresh[which][q] != 0) {
    put(r.next, which, place,
        kept ? get<FaceWorkColumns<double>>(r.old, which, from)
             : no_work(get<FaceMemoryColumns<double>>(r.old, which, from)));
  }
}

/// The corners of a face that has just been listed, or has slept, at both steps. Where there is no
/// room they are found when the face wakes.
void place_corners(const Renewal& r, std::size_t place, std::size_t k) {
  const std::size_t q = place / lanes;
  if (!r.next.holds(q)) return;
  const Pose& p = r.pose;
  load_corners(r.next, coordinates_at(r.faces, p.x, p.y, k), r.next.now, place);
  load_corners(r.next, coordinates_at(r.faces, p.x1, p.y1, k), 1 - r.next.now, place);
}

/// The copy of a face of the old list in this tile.
Id copy_in(const FaceTiles& t, std::size_t tile, Id k) {
  const auto [owned, other] = t.place[k];
  const bool is_other = owned == no_id || t.tile_of_chunk[owned / lanes] != tile;
  return is_other ? other : owned;
}

void renew_copy(const Renewal& r, std::size_t tile, std::size_t place, Id old, bool slept) {
  const Id k = r.next.face[place];
  const Id from = old == no_id ? no_id : copy_in(r.old, tile, old);
  if (from != no_id) {
    for (const int which : {0, 1}) copy_step(r, which, place, from);
    double& deepest = r.next.deepest[place / lanes];
    deepest = std::max(deepest, r.old.deepest[from / lanes]);
    put(r.next.sums, place, get<FaceSumColumns<double>>(r.old.sums, from));
    copy_bits(r.next.ever[place / lanes], place % lanes, r.old.ever[from / lanes], from % lanes);
  }
  if (from == no_id || slept) place_corners(r, place, k);
}

}  // namespace

void renew_tiles(FaceTiles& t, const FaceSet& c, const BlockSet& b, const Pose& pose,
                 const std::vector<Id>& old_row) {
  const std::vector<std::uint8_t> did = kinds_of(t);
  std::vector<std::uint8_t> kind(c.size(), face_kind::open_awake);
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (old_row[k] != no_id) kind[k] = did[old_row[k]];
  }
  FaceTiles old = std::exchange(t, FaceTiles());
  t.tiles.swap(old.tiles);
  t.blocks.swap(old.blocks);
  t.constants.swap(old.constants);
  t.forces.swap(old.forces);
  t.now = old.now;
  lay_out(t, c, b, kind);
  t.deepest.assign(t.chunks(), 0.0);
  const Renewal renewal{t, old, c, pose};
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), 40 * t.face.size(), no_scratch, [&](std::size_t tile, char&) {
    const Tile& of = t.tiles[tile];
    load_constants(t, c, b, tile);
    for (std::size_t q = of.first_chunk; q < of.last_chunk; ++q) {
      t.idle[0][q] = t.idle[1][q] = 1;
      for (std::size_t place = q * lanes; place < (q + 1) * lanes; ++place) {
        const Id k = t.face[place];
        if (k != no_id) renew_copy(renewal, tile, place, old_row[k], kind[k] == face_kind::asleep);
      }
    }
    order_records(t, c, b, tile);
    old.numbers[tile] = TileNumbers();
  });
}

bool dashpots_work(const FaceTiles& t) {
  if (!t.dashpots) return false;
  const auto works = [&](const TileNumbers& of, std::size_t place) {
    if (t.face[place] == no_id) return false;
    if (t.fresh[t.now][place / lanes] != 0) {
      const auto work = get<FaceWorkColumns<double>>(of, t.now, place);
      if (work.damping_work != 0.0 || work.damping_due != 0.0) return true;
    }
    const auto d = get<DashpotMemoryColumns<double>>(of, t.now, place);
    return d.damping_a != 0.0 || d.damping_b != 0.0 || d.shear_damping_a != 0.0 ||
           d.shear_damping_b != 0.0;
  };
  for (const TileNumbers& of : t.numbers) {
    const std::size_t first = of.first_chunk * lanes, end = first + of.chunks * lanes;
    for (std::size_t place = first; place < end; ++place) {
      if (works(of, place)) return true;
    }
  }
  return false;
}

double part_in_two_tiles(const FaceTiles& t) {
  const auto in_two = std::count_if(t.place.begin(), t.place.end(),
                                    [](const auto& place) { return place[1] != no_id; });
  return static_cast<double>(in_two) /
         static_cast<double>(std::max<std::size_t>(t.place.size(), 1));
}

}  // namespace edda
