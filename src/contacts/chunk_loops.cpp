#include "contacts/chunk_loops.hpp"

#include <cmath>

#include "contacts/chunk_columns.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_step.hpp"

namespace edda {
namespace {

EDDA_INLINE EdgeGeometry geometry_of(const ChunkColumns& c, const FacePair& pair, std::size_t k) {
  const GeometryColumns<double*>& s = c.stands;
  EdgeGeometry o;
  o.tx = s.tx[k];
  o.ty = s.ty[k];
  o.per_base = s.per_base[k];
  o.s2 = c.memory.s2[k];
  o.y2 = c.memory.y2[k];
  o.r1 = c.memory.r1[k];
  o.z1 = s.z1[k];
  o.r2 = c.memory.r2[k];
  o.z2 = c.memory.z2[k];
  o.per_e = s.per_e[k];
  o.per_f = s.per_f[k];
  o.slope_e = s.slope_e[k];
  o.slope_f = s.slope_f[k];
  o.closure_at_0 = s.closure_at_0[k];
  o.length_cosine = s.length_cosine[k];
  o.length_sine = s.length_sine[k];
  complete(o, pair);
  return o;
}
EDDA_INLINE void write_geometry(const ChunkColumns& c, const EdgeGeometry& o, std::size_t k) {
  const GeometryColumns<double*>& s = c.stands;
  s.tx[k] = o.tx;
  s.ty[k] = o.ty;
  s.per_base[k] = o.per_base;
  c.memory.s2[k] = o.s2;
  c.memory.y2[k] = o.y2;
  c.memory.r1[k] = o.r1;
  s.z1[k] = o.z1;
  c.memory.r2[k] = o.r2;
  c.memory.z2[k] = o.z2;
  s.per_e[k] = o.per_e;
  s.per_f[k] = o.per_f;
  s.slope_e[k] = o.slope_e;
  s.slope_f[k] = o.slope_f;
  s.closure_at_0[k] = o.closure_at_0;
  s.length_cosine[k] = o.length_cosine;
  s.length_sine[k] = o.length_sine;
}

template <Formulas use>
EDDA_INLINE OverlapEnds overlap_of(const ChunkColumns& c, const EdgeGeometry& o,
                                   const FacePair& pair, std::size_t k) {
  if constexpr (use == Formulas::plain) return overlap_of<use>(o, pair);
  const OverlapColumns<double*>& s = c.overlaps;
  OverlapEnds v;
  v.sa = s.sa[k];
  v.sb = s.sb[k];
  v.exists = s.exists[k] != 0.0;
  v.a_by_p = o.r2 <= 0.0;
  v.b_by_p = o.s2 <= o.r1;
  v.la = s.la[k];
  v.lb = s.lb[k];
  v.per_passing = s.per_passing[k];
  v.near_a.by_other = s.near_a[k];
  v.near_b.by_other = s.near_b[k];
  v.pass_a.by_other = s.pass_a[k];
  v.pass_b.by_other = s.pass_b[k];
  v.pass_a.by_reach = s.reach_a[k];
  v.pass_b.by_reach = s.reach_b[k];
  v.reach.by_a = s.reach_by_a[k];
  v.reach.by_b = s.reach_by_b[k];
  return v;
}
EDDA_INLINE void write_overlap(const ChunkColumns& c, std::size_t k) {
  const FacePair pair = pair_of(c, k);
  const EdgeGeometry stands = geometry_of(c, pair, k);
  const OverlapEnds v = overlap_of<Formulas::all>(stands, pair);
  const OverlapColumns<double*>& s = c.overlaps;
  s.sa[k] = v.sa;
  s.sb[k] = v.sb;
  s.exists[k] = v.exists ? 1.0 : 0.0;
  s.la[k] = v.la;
  s.lb[k] = v.lb;
  s.per_passing[k] = v.per_passing;
  s.near_a[k] = v.near_a.by_other;
  s.near_b[k] = v.near_b.by_other;
  s.pass_a[k] = v.pass_a.by_other;
  s.pass_b[k] = v.pass_b.by_other;
  s.reach_a[k] = v.pass_a.by_reach;
  s.reach_b[k] = v.pass_b.by_reach;
  s.reach_by_a[k] = v.reach.by_a;
  s.reach_by_b[k] = v.reach.by_b;
}

/// with_work: the corners at n and n - 1 are read, from which only the work of the step follows.
template <bool dashpots, bool with_work, bool limited = false>
EDDA_INLINE FaceInputs inputs_of(const ChunkColumns& c, std::size_t k) {
  const LaneBits bit = bit_of_lane[k];
  const auto was = [&](unsigned of) { return (c.was & (bit << of)) != 0; };
  const auto mass_of = [&](const Records* r) {
    return dashpots ? EdgeInverseMass{r->column[0][k], r->column[1][k], r->column[2][k]}
                    : EdgeInverseMass{};
  };
  const DashpotMemoryColumns<const double*>& d = c.damped_before;
  return {pair_of(c, k),
          {c.shear_stiffness[k], c.friction[k], c.cohesion[k], c.bonded[k] > 0.0, c.zeta[k],
           c.shear_zeta[k], c.rebound[k]},
          !with_work ? FacePoints{} : points_of(*c.e, *c.f, k),
          !with_work ? FacePoints{} : points_of(*c.e_then, *c.f_then, k),
          {c.before.slip_a[k],
           c.before.slip_b[k],
           c.before.overlap[k],
           c.before.spring[k],
           was(lane_bits::stored),
           was(lane_bits::on),
           was(lane_bits::closed_a),
           was(lane_bits::closed_b),
           was(lane_bits::switched),
           {c.before.s2[k], c.before.y2[k], c.before.r1[k], 0.0, c.before.r2[k], c.before.z2[k]},
           dashpots ? FaceEnds{d.damping_a[k], d.damping_b[k]} : FaceEnds{},
           dashpots ? FaceEnds{d.shear_damping_a[k], d.shear_damping_b[k]} : FaceEnds{},
           dashpots ? FaceEnds{d.strike_a[k], d.strike_b[k]} : FaceEnds{}},
          mass_of(c.mass_e),
          mass_of(c.mass_f),
          c.per_step,
          c.noise,
          limited ? FaceEnds{c.limits.a[k], c.limits.b[k]} : FaceEnds{}};
}

template <bool dashpots>
EDDA_INLINE void write_memory(const ChunkColumns& c, const FaceStep& s, std::size_t k) {
  const FaceMemoryColumns<double*>& m = c.memory;
  m.slip_a[k] = s.slip.a;
  m.slip_b[k] = s.slip.b;
  m.overlap[k] = s.overlap;
  m.spring[k] = s.spring;
  if constexpr (dashpots) {
    const DashpotMemoryColumns<double*>& d = c.damped;
    d.damping_a[k] = s.damping.a;
    d.damping_b[k] = s.damping.b;
    d.shear_damping_a[k] = s.shear_damping.a;
    d.shear_damping_b[k] = s.shear_damping.b;
    d.strike_a[k] = s.strike.a;
    d.strike_b[k] = s.strike.b;
  }
}

EDDA_INLINE void write_work(const ChunkColumns& c, const Face& face, const FaceStep& s,
                            std::size_t k) {
  c.pressures.normal_a[k] = face.normal.a;
  c.pressures.normal_b[k] = face.normal.b;
  c.pressures.length[k] = positive_part(face.length);
  c.pressures.cohesive[k] = face.cohesive;
  const FaceWorkColumns<double*>& w = c.work;
  w.friction_work[k] = s.friction;
  w.transfer[k] = s.transfer;
  w.trial_a[k] = s.trial.a;
  w.trial_b[k] = s.trial.b;
  w.shear_a[k] = s.shear.a;
  w.shear_b[k] = s.shear.b;
  w.damping_work[k] = s.damping_work;
  w.damping_due[k] = s.damping_due;
}

EDDA_INLINE void write_forces(Records& on_e, Records& on_f, const CornerForces& f, std::size_t k) {
  on_e.column[0][k] = f.p1.x;
  on_e.column[1][k] = f.p1.y;
  on_e.column[2][k] = f.p2.x;
  on_e.column[3][k] = f.p2.y;
  on_f.column[0][k] = f.q1.x;
  on_f.column[1][k] = f.q1.y;
  on_f.column[2][k] = f.q2.x;
  on_f.column[3][k] = f.q2.y;
}

EDDA_INLINE bool bond_fails(const ChunkColumns& c, const Face& face, const FaceStep& s,
                            std::size_t k) {
  return failure_of({c.bonded[k] > 0.0, c.carries_tension[k] > 0.0, c.glued[k] > 0.0, c.friction[k],
                     c.cohesion[k], c.tension[k], c.bond_strength, c.parts_at[k]},
                    {face.closure, face.normal, s.shear.a + s.shear.b, s.spring, face.length,
                     face.cohesive},
                    c.noise)
      .any();
}

/// Results of the lanes of a chunk, in fields of bits; conclude() derives the others from these and
/// from the bits of n - 1.
struct LaneResults {
  LaneBits state = 0;  ///< stored, on, closed_a, closed_b, and those below
  LaneBits found = 0;  ///< rare, busy, slides, fails
  double deepest = 0.0;
};
/// Fields of LaneResults::state alone.
constexpr unsigned touches = 32, carried = 40, may_act = 48;

template <bool dashpots, Formulas use, bool with_work, bool limited>
EDDA_INLINE void evaluate_lane(const ChunkColumns& c, std::size_t k, Records& on_e, Records& on_f,
                               LaneBits& state, LaneBits& found, double& deepest) {
  const FaceInputs in = inputs_of<dashpots, with_work, limited>(c, k);
  const EdgeGeometry stands = geometry_of(c, in.pair, k);
  const OverlapEnds overlap = overlap_of<use>(c, stands, in.pair, k);
  const Face face = face_between<use>(stands, overlap, in.pair);
  const FaceStep s = step_of_face<dashpots, limited, use, with_work>(in, stands, face);
  write_memory<dashpots>(c, s, k);
  if constexpr (with_work) write_work(c, face, s, k);
  write_forces(on_e, on_f, s.force, k);
  const LaneBits bit = bit_of_lane[k];
  const auto mark = [bit](bool is, unsigned of) __attribute__((always_inline)) {
    return is ? bit << of : 0;
  };
  const double work = std::abs(s.friction) + std::abs(s.transfer);
  const bool cut = is_cut(s.trial, s.slip);
  state |= mark(face.energy > 0.0, lane_bits::stored) | mark(face.gate > 0.0, lane_bits::on) |
           mark(s.closed_a, lane_bits::closed_a) | mark(s.closed_b, lane_bits::closed_b) |
           mark(s.touches, touches) | mark(in.before.spring > 0.0, carried) |
           mark(s.may_act, may_act);
  found |= mark(s.rare, lane_bits::rare) | mark(s.needs_work | (work != 0.0), lane_bits::busy);
  if constexpr (with_work) found |= mark(cut, lane_bits::slides);
  if constexpr (use == Formulas::all) {
    found |= mark(bond_fails(c, face, s, k), lane_bits::fails);
  }
  deepest = larger(deepest, s.depth);
}

/// What has changed in the step, for all lanes at once (as mark_changes()), and
/// lane_bits::switching and loaded.
EDDA_INLINE ChunkFound conclude(LaneBits was, const LaneResults& is, bool dashpots) {
  const auto lanes_of = [](LaneBits bits, unsigned of) { return bits >> of & 0xff; };
  const auto now = [&](unsigned of) { return lanes_of(is.state, of); };
  const auto then = [&](unsigned of) { return lanes_of(was, of); };
  const LaneBits stores = now(lane_bits::stored), stored = then(lane_bits::stored);
  const LaneBits on = now(lane_bits::on);
  const LaneBits opens = stored & ~stores;
  const LaneBits switched = (now(lane_bits::closed_a) ^ (stored & then(lane_bits::closed_a))) |
                            (now(lane_bits::closed_b) ^ (stored & then(lane_bits::closed_b)));
  const LaneBits switching = stored & (switched | then(lane_bits::switched));
  const LaneBits decides = (on & ~then(lane_bits::on)) | (on & now(may_act)) | (stores & ~stored);
  const LaneBits loaded = now(touches) | stored | now(carried);
  const LaneBits busy = dashpots ? 0xff : opens;
  constexpr LaneBits remembered = 0xffffffff;  // stored, on, closed_a, closed_b
  return {(is.state & remembered) | switched << lane_bits::switched,
          is.found | decides << lane_bits::decides | switching << lane_bits::switching |
              loaded << lane_bits::loaded | busy << lane_bits::busy | opens << lane_bits::opens,
          is.deepest};
}

/// Stores the forces unless the chunk must be evaluated in another way.
template <bool dashpots, Formulas use, bool with_work, bool limited = false>
EDDA_INLINE ChunkFound evaluate_lanes(const ChunkView& given) {
  ChunkColumns c = columns_of<dashpots>(given);  // a copy that no store can change
  if constexpr (limited) c.limits = columns_from<LimitColumns<const double*>>(given.limits);
  Records on_e, on_f;
  LaneBits state = 0, found = 0;
  double deepest = 0.0;
#pragma omp simd reduction(| : state, found) reduction(max : deepest)
  for (std::size_t k = 0; k < lanes; ++k) {
    evaluate_lane<dashpots, use, with_work, limited>(c, k, on_e, on_f, state, found, deepest);
  }
  const ChunkFound all = conclude(c.was, {state, found, deepest}, dashpots);
  const LaneBits unfit = (use == Formulas::plain ? lane_bits::field(lane_bits::rare) : 0) |
                         (with_work ? 0 : lane_bits::field(lane_bits::busy));
  if ((all.found & unfit) == 0) {
    const SweepTables& of = *given.of;
    store_records(of.on, of.record_e + given.chunk * lanes, on_e);
    store_records(of.on, of.record_f + given.chunk * lanes, on_f);
  }
  return all;
}

/// The energy that a face stores between n - 1 and n, and its normal force.
EDDA_INLINE void measure_lane(const ChunkColumns& c, ChunkMeasures& to, std::size_t k) {
  const FacePair pair = pair_of(c, k);
  const FacePoints at = points_of(*c.e, *c.f, k), then = points_of(*c.e_then, *c.f_then, k);
  const EdgeGeometry stands = geometry_of_edges(at, pair), stood = geometry_of_edges(then, pair);
  const Face now = face_between(stands, pair), old = face_between(stood, pair);
  const EndMotion moved = motion_of(now, stands.corners(), stood.corners(), pair.length_ratio);
  const LaneBits bit = bit_of_lane[k];
  const bool stores = (c.was & (bit << lane_bits::stored)) != 0;
  const bool tension = c.carries_tension[k] > 0.0;
  const double pressure = stored_between(old, then, now, at, tension);
  to.energy[k] =
      face_energy(pressure, {c.before.spring[k], {c.before.slip_a[k], c.before.slip_b[k]}, stores},
                  {moved.slip.a, moved.slip.b}, tension);
  to.normal[k] = stores ? now.normal.a + now.normal.b : 0.0;
}
}  // namespace

SweepTables tables_of(FaceTiles& t, std::size_t tile, double* on, double step,
                      const FaceSet& faces) {
  const int now = t.now, old = 1 - t.now;
  TileNumbers& numbers = t.numbers[tile];
  return {.first_chunk = numbers.first_chunk,
          .edges = t.constants[tile].edges.numbers.data(),
          .strengths = t.constants[tile].strengths.numbers.data(),
          .edge_set = t.edge_set.data(),
          .strength_set = t.strength_set.data(),
          .before = numbers.memory[old].data(),
          .damped_before = numbers.dashpots[old].data(),
          .memory = numbers.memory[now].data(),
          .damped = numbers.dashpots[now].data(),
          .work = numbers.work[now].data(),
          .pressures = t.slip_laws ? numbers.pressures[now].data() : nullptr,
          .record_e = t.record_e.data(),
          .record_f = t.record_f.data(),
          .limits = t.limits.empty() ? nullptr : t.limits.data(),
          .was = t.bits[old].data(),
          .on = on,
          .per_step = 1.0 / step,
          .noise = faces.noise,
          .bond_strength = faces.bond_strength};
}

EDDA_VECTOR void compute_geometry(const ChunkView& given) {
  const ChunkColumns c = columns_of<Tables::memory>(given);
#pragma omp simd
  for (std::size_t k = 0; k < lanes; ++k) {
    write_geometry(c, geometry_of_edges(points_of(*c.e, *c.f, k), pair_of(c, k)), k);
  }
}

EDDA_VECTOR void overlap_edges(const ChunkView& given) {
  const ChunkColumns c = columns_of<Tables::memory>(given);
#pragma omp simd
  for (std::size_t k = 0; k < lanes; ++k) write_overlap(c, k);
}

EDDA_VECTOR ChunkFound evaluate_bonded_without_work(const ChunkView& c) {
  return evaluate_lanes<false, Formulas::all, false>(c);
}
EDDA_VECTOR ChunkFound evaluate_bonded_with_work(const ChunkView& c) {
  return evaluate_lanes<false, Formulas::all, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_bonded_damped(const ChunkView& c) {
  return evaluate_lanes<true, Formulas::all, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_without_work(const ChunkView& c) {
  return evaluate_lanes<false, Formulas::unbonded, false>(c);
}
EDDA_VECTOR ChunkFound evaluate_with_work(const ChunkView& c) {
  return evaluate_lanes<false, Formulas::unbonded, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_damped(const ChunkView& c) {
  return evaluate_lanes<true, Formulas::unbonded, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_plain_without_work(const ChunkView& c) {
  return evaluate_lanes<false, Formulas::plain, false>(c);
}
EDDA_VECTOR ChunkFound evaluate_plain_with_work(const ChunkView& c) {
  return evaluate_lanes<false, Formulas::plain, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_plain_damped(const ChunkView& c) {
  return evaluate_lanes<true, Formulas::plain, true>(c);
}

EDDA_VECTOR ChunkFound evaluate_limited(const ChunkView& c) {
  return evaluate_lanes<false, Formulas::all, true, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_limited_damped(const ChunkView& c) {
  return evaluate_lanes<true, Formulas::all, true, true>(c);
}

EDDA_VECTOR ChunkFound test_open_faces(const ChunkView& given) {
  const ChunkColumns c = columns_of<Tables::memory>(given);
  LaneBits bits = 0, undecided = 0;
#pragma omp simd reduction(| : bits, undecided)
  for (std::size_t k = 0; k < lanes; ++k) {
    const FaceInputs in = inputs_of<false, false>(c, k);
    const OpenFace s = test_open_face(in, geometry_of(c, in.pair, k));
    const LaneBits bit = bit_of_lane[k];
    bits |= s.gate > 0.0 ? bit << lane_bits::on : 0;
    undecided |= s.may_close ? bit << lane_bits::decides : 0;
  }
  return {bits, undecided, 0.0};
}

EDDA_VECTOR void measure_faces(const ChunkView& given, ChunkMeasures& to) {
  ChunkColumns c = columns_of<Tables::constants_alone>(given);
  c.before = columns_from<FaceMemoryColumns<const double*>>(given.before);
#pragma omp simd
  for (std::size_t k = 0; k < lanes; ++k) measure_lane(c, to, k);
}

EDDA_VECTOR void read_edges(const double* from, const Id* slot_e, const Id* slot_f, Records& e,
                            Records& f) {
  const auto record = [from](Id slot) __attribute__((always_inline)) {
    return four_at(from + 4 * std::size_t{slot});
  };
  read_records(record, slot_e, e);
  read_records(record, slot_f, f);
}

EDDA_VECTOR void read_masses(const Masses& masses, const Id* next, const Id* edge, const Id* facing,
                             Records& e, Records& f) {
  const auto record = [&](Id v) __attribute__((always_inline)) {
    const EdgeInverseMass m = inverse_mass_of_edge(masses, v, next[v]);
    return Four{m.start, m.both, m.end, 0.0};
  };
  read_records(record, edge, e);
  read_records(record, facing, f);
}

}  // namespace edda
