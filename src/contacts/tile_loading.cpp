#include "contacts/tile_loading.hpp"

#include <algorithm>
#include <cstring>
#include <iterator>
#include <limits>

#include "base/parallel.hpp"
#include "contacts/joint_strength.hpp"
#include "contacts/tile_columns.hpp"

namespace edda {
namespace {

/// N per m, tensile strength of faces that soften: they are decided in every step.
constexpr double always_exceeded = -1e200;

/// The constants of one face.
EdgeConstants<double> edge_constants(const FaceSet& c, const BlockSet& b, const FacePair& p,
                                     std::size_t k) {
  return {p.stiffness,
          c.shear_stiffness[k],
          p.inverse_e,
          p.inverse_f,
          p.length_ratio,
          p.gate_from,
          p.gate_scale,
          p.passing,
          drawn_gap * smaller_size(c, b, k),
          p.turn_p1.x,
          p.turn_p1.y,
          p.turn_p2.x,
          p.turn_p2.y,
          p.turn_q1.x,
          p.turn_q1.y,
          p.turn_q2.x,
          p.turn_q2.y};
}
StrengthConstants<double> strength_constants(const FaceSet& c, std::size_t k) {
  const auto one = [](bool is) { return is ? 1.0 : 0.0; };
  const FacesOfLaw& law = c.of_law(k);
  return {one(law.at_ends && c.leans(k)),
          c.friction[k],
          c.cohesion[k],
          c.locked_closure_a[k],
          c.locked_closure_b[k],
          one(c.carries_tension(k)),
          one(c.bonded(k)),
          law.zeta,
          law.shear_zeta,
          law.rebound,
          c.is(FaceFlag::softens, k) ? always_exceeded : c.tension[k],
          one(c.glued(k))};
}
/// Of a lane without a face: no length and no stiffness; `passing` is divided by.
EdgeConstants<double> no_constants() {
  EdgeConstants<double> none{};
  none.gate_scale = none.passing = 1.0;
  return none;
}

/// Gives a chunk, which had the set `was` so far, these constants: an equal set of the last ones in
/// the table, or one of its own. In regular masonry there are few, elsewhere no two are equal.
Id set_of(ConstantSets& sets, Id was, const double* numbers, std::size_t columns) {
  const std::size_t size = columns * lanes, count = sets.users.size();
  const auto at = [&](std::size_t set) { return sets.numbers.data() + set * size; };
  if (was != no_id && --sets.users[was] == 0) sets.unused.push_back(was);
  constexpr std::size_t last = 12;
  for (std::size_t n = count - std::min(count, last); n < count; ++n) {
    if (sets.users[n] == 0 || std::memcmp(at(n), numbers, size * sizeof(double)) != 0) continue;
    ++sets.users[n];
    return static_cast<Id>(n);
  }
  if (!sets.unused.empty()) {
    const Id set = sets.unused.back();
    sets.unused.pop_back();
    std::copy_n(numbers, size, at(set));
    sets.users[set] = 1;
    return set;
  }
  sets.numbers.insert(sets.numbers.end(), numbers, numbers + size);
  sets.users.push_back(1);
  return static_cast<Id>(count);
}

/// What face k remembers of a step, where its state is m, at these positions.
void load_memory(FaceTiles& t, const FaceSet& c, const FaceFields& m, const std::vector<double>& x,
                 const std::vector<double>& y, int which, std::size_t place, std::size_t k) {
  if (t.holds(place / lanes)) {
    for_memory(t, [&]<class Fields>() { put(t, which, place, columns_of_state<Fields>(m)); });
    load_corners(t, coordinates_at(c, x, y, k), which, place);
  }
  const bool stored = m.energy > 0.0, touches = stored || m.spring > 0.0;
  LaneBits& bits = t.bits[which][place / lanes];
  const auto mark = [&](unsigned of, bool is) { set_bit(bits, of, place % lanes, is); };
  mark(lane_bits::stored, stored);
  mark(lane_bits::on, m.gate > 0.0);
  mark(lane_bits::closed_a, touches && m.closure_a > c.noise);
  mark(lane_bits::closed_b, touches && m.closure_b > c.noise);
  mark(lane_bits::switched, m.switched > 0.0);
}

bool slides(const FaceFields& m) {
  return is_cut(FaceEnds{m.trial_a, m.trial_b}, FaceEnds{m.slip_a, m.slip_b});
}
/// Whether the work of the step differs from no_work() and must be kept.
bool is_busy(const FaceFields& m) {
  const bool sticks = m.shear_a == -m.spring * m.slip_a && m.shear_b == -m.spring * m.slip_b;
  return slides(m) || !sticks || m.friction_work != 0.0 || m.transfer != 0.0 ||
         m.damping_work != 0.0 || m.damping_due != 0.0;
}

/// A face at steps n and n - 1.
struct FaceState {
  const FaceFields &now, &before;

  /// Whether it stored energy at n - 1 and stores none now.
  bool opens() const { return before.energy > 0.0 && now.energy == 0.0; }
  bool needs_record() const { return opens() || is_busy(now); }
};
FaceState state_of(const FaceStates& states, std::size_t k) {
  return {states.now[k], states.before[k]};
}

/// The work of the step that ended in the state m, in which the face opened or did not. Of a chunk
/// in which no face has done any nothing is kept.
void load_work(FaceTiles& t, const FaceFields& m, bool opens, int which, std::size_t place) {
  const std::size_t q = place / lanes;
  if (opens || is_busy(m)) begin_work(t, which, q);
  if (t.fresh[which][q] != 0) {
    put(t, which, place, columns_of_state<FaceWorkColumns<double>>(m));
  }
  set_bit(t.found[which][q], lane_bits::opens, place % lanes, opens);
  set_bit(t.found[which][q], lane_bits::slides, place % lanes, slides(m));
}

bool remembers(const FaceFields& m) {
  return m.energy > 0.0 || m.spring > 0.0 || m.slip_a != 0.0 || m.slip_b != 0.0;
}

/// What each face does as far as its states tell, [nf].
std::vector<std::uint8_t> kinds_by_states(const FaceStates& states) {
  std::vector<std::uint8_t> kind(states.now.size(), face_kind::open_awake);
  for (std::size_t k = 0; k < kind.size(); ++k) {
    const FaceState f = state_of(states, k);
    if (f.needs_record() || is_busy(f.before)) {
      kind[k] = face_kind::long_work;
    } else if (remembers(f.now) || remembers(f.before)) {
      kind[k] = face_kind::long_stick;
    }
  }
  return kind;
}

/// Fills memory and work of a copy of face k.
void load_copy(FaceTiles& t, const FaceSet& c, const FaceState& f, const Pose& pose,
               std::size_t place, std::size_t k) {
  const int now = t.now, old = 1 - t.now;
  const bool carried = remembers(f.before);
  const bool worked = remembers(f.now) || carried || f.needs_record();
  const std::size_t q = place / lanes;
  load_memory(t, c, f.now, pose.x, pose.y, now, place, k);
  load_memory(t, c, f.before, pose.x1, pose.y1, old, place, k);
  load_work(t, f.now, f.opens(), now, place);
  load_work(t, f.before, false, old, place);
  load_sums(t, c, place, k);
  set_bit(t.found[now][q], lane_bits::loaded, place % lanes, worked);
  if (worked) t.idle[now][q] = 0;
  if (carried) t.idle[old][q] = 0;
}

}  // namespace

void load_sums(FaceTiles& t, const FaceSet& c, std::size_t place, std::size_t k) {
  put(t.sums, place, FaceSumColumns<double>{c.friction_work[k], c.transfer[k], c.damping_work[k]});
  const std::size_t q = place / lanes;
  set_bit(t.ever[q], lane_bits::opens, place % lanes, c.is(FaceFlag::opened, k));
  set_bit(t.ever[q], lane_bits::slides, place % lanes, c.is(FaceFlag::slipped, k));
}

void load_correction(FaceTiles& t, const FaceSet& c, const FaceFields& before, std::size_t k) {
  using Memory = FaceMemoryColumns<double>;
  for (const Id place : t.place[k]) {
    if (place == no_id) continue;
    number_at(t, 1 - t.now, place, &Memory::slip_a) = before.slip_a;
    number_at(t, 1 - t.now, place, &Memory::slip_b) = before.slip_b;
    load_sums(t, c, place, k);
  }
}

void load_chunk_constants(FaceTiles& t, const FaceSet& c, const BlockSet& b, std::size_t tile,
                          std::size_t q, unsigned changed) {
  alignas(64) double edges[edge_columns * lanes], strengths[strength_columns * lanes];
  if (changed != 0xff) {
    std::copy_n(t.edges_of(tile, q), std::size(edges), edges);
    std::copy_n(t.strengths_of(tile, q), std::size(strengths), strengths);
  }
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if ((changed >> lane & 1u) == 0) continue;
    const Id k = t.face[q * lanes + lane];
    if (k == no_id) {
      put(edges, lane, no_constants());
      put(strengths, lane, StrengthConstants<double>{});
      continue;
    }
    const FacePair pair = face_pair(c, b, k);
    put(edges, lane, edge_constants(c, b, pair, k));
    put(strengths, lane, strength_constants(c, k));
    if (c.is(FaceFlag::softens, k)) t.tiles[tile].takes_then = true;
  }
  const auto of = columns_from<StrengthConstants<const double*>>(&strengths[0]);
  bool bonds = false;
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    bonds = bonds || of.bonded[lane] > 0.0 || of.carries_tension[lane] > 0.0;
  }
  t.bonds[q] = bonds ? 1 : 0;
  TileConstants& constants = t.constants[tile];
  t.edge_set[q] = set_of(constants.edges, t.edge_set[q], edges, edge_columns);
  t.strength_set[q] = set_of(constants.strengths, t.strength_set[q], strengths, strength_columns);
}

void load_strengths(FaceTiles& t, const FaceSet& c, std::size_t tile, std::size_t q,
                    unsigned changed) {
  alignas(64) double strengths[strength_columns * lanes];
  std::copy_n(t.strengths_of(tile, q), std::size(strengths), strengths);
  for (std::size_t lane = 0; lane < lanes; ++lane) {
    if ((changed >> lane & 1u) == 0) continue;
    const Id k = t.face[q * lanes + lane];
    put(strengths, lane, strength_constants(c, k));
    load_sums(t, c, q * lanes + lane, k);
    if (c.locked_closure_a[k] != 0.0 || c.locked_closure_b[k] != 0.0)
      t.tiles[tile].takes_then = true;
  }
  ConstantSets& sets = t.constants[tile].strengths;
  Id& set = t.strength_set[q];
  if (sets.users[set] == 1) {
    std::copy_n(strengths, std::size(strengths), sets.numbers.data() + set * std::size(strengths));
  } else {
    set = set_of(sets, set, strengths, strength_columns);
  }
}

void load_constants(FaceTiles& t, const FaceSet& c, const BlockSet& b, std::size_t tile) {
  const Tile& of = t.tiles[tile];
  TileConstants& constants = t.constants[tile];
  for (ConstantSets* sets : {&constants.edges, &constants.strengths}) sets->clear();
  for (std::size_t q = of.first_chunk; q < of.last_chunk; ++q)
    load_chunk_constants(t, c, b, tile, q);
  for (ConstantSets* sets : {&constants.edges, &constants.strengths}) {
    constexpr double room = 1.25;  // std::vector may have taken twice as much as it needs
    AlignedNumbers& numbers = sets->numbers;
    if (static_cast<double>(numbers.capacity()) > room * static_cast<double>(numbers.size()))
      numbers.shrink_to_fit();
  }
}

void load_faces(FaceTiles& t, const FaceSet& c, const FaceStates& states, const BlockSet& b,
                const Pose& pose) {
  lay_out(t, c, b, kinds_by_states(states));
  t.deepest.assign(t.chunks(), std::numeric_limits<double>::infinity());  // an upper bound
  t.now = 0;
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), 60 * t.face.size(), no_scratch, [&](std::size_t tile, char&) {
    const Tile& of = t.tiles[tile];
    load_constants(t, c, b, tile);
    for (std::size_t q = of.first_chunk; q < of.last_chunk; ++q) {
      t.idle[0][q] = t.idle[1][q] = 1;
      for (std::size_t place = q * lanes; place < (q + 1) * lanes; ++place) {
        const Id k = t.face[place];
        if (k != no_id) load_copy(t, c, state_of(states, k), pose, place, k);
      }
    }
    order_records(t, c, b, tile);
  });
}

void load_decisions(FaceTiles& t, const FaceSet& c, const BlockSet& b, std::size_t k) {
  for (const Id place : t.place[k]) {
    if (place == no_id) continue;
    load_chunk_constants(t, c, b, t.tile_of_chunk[place / lanes], place / lanes,
                         1u << place % lanes);
    load_sums(t, c, place, k);
  }
}

void load_corners(FaceTiles& t, const EdgeCoordinates& at, int which, std::size_t place) {
  using Memory = FaceMemoryColumns<double>;
  number_at(t, which, place, &Memory::s2) = at.s2;
  number_at(t, which, place, &Memory::y2) = at.y2;
  number_at(t, which, place, &Memory::r1) = at.r1;
  number_at(t, which, place, &Memory::r2) = at.r2;
  number_at(t, which, place, &Memory::z2) = at.z2;
}

}  // namespace edda
