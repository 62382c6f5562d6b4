#include "contacts/chunk_loops.hpp"

#include <cmath>

#include "contacts/face_step.hpp"
#include "contacts/tile_columns.hpp"

namespace edda {
namespace {

/// The bit of each lane; loops over lanes have no shifts by the lane.
alignas(64) constexpr LaneBits bit_of_lane[lanes] = {1, 2, 4, 8, 16, 32, 64, 128};

EDDA_INLINE FacePoints points_of(const Records& e, const Records& f, std::size_t k) {
  return {{e.column[0][k], e.column[1][k]},
          {e.column[2][k], e.column[3][k]},
          {f.column[0][k], f.column[1][k]},
          {f.column[2][k], f.column[3][k]}};
}

/// A chunk by its columns.
struct ChunkColumns : EdgeConstants<const double*>, StrengthConstants<const double*> {
  FaceMemoryColumns<const double*> before;
  FaceMemoryColumns<double*> memory;
  DashpotMemoryColumns<const double*> damped_before;
  DashpotMemoryColumns<double*> damped;
  FaceWorkColumns<double*> work;
  const Records *e, *f, *e_then, *f_then, *mass_e, *mass_f;
  Records *on_e, *on_f;
  LaneBits was;
  double per_step, noise;
};
/// What a loop reads and writes beside the constants and the edges.
enum class Tables { none, memory, memory_and_dashpots };

/// A table that a loop does not use may be missing.
template <Tables tables>
EDDA_INLINE ChunkColumns columns_of(const ChunkView& v) {
  ChunkColumns c{columns_from<EdgeConstants<const double*>>(v.edges),
                 columns_from<StrengthConstants<const double*>>(v.strengths),
                 {},
                 {},
                 {},
                 {},
                 {},
                 v.e,
                 v.f,
                 v.e_then,
                 v.f_then,
                 v.mass_e,
                 v.mass_f,
                 v.on_e,
                 v.on_f,
                 v.was,
                 1.0 / v.step,
                 v.noise};
  if constexpr (tables != Tables::none) {
    c.before = columns_from<FaceMemoryColumns<const double*>>(v.before);
    c.memory = columns_from<FaceMemoryColumns<double*>>(v.memory);
    c.work = columns_from<FaceWorkColumns<double*>>(v.work);
  }
  if constexpr (tables == Tables::memory_and_dashpots) {
    c.damped_before = columns_from<DashpotMemoryColumns<const double*>>(v.damped_before);
    c.damped = columns_from<DashpotMemoryColumns<double*>>(v.damped);
  }
  return c;
}
template <bool dashpots>
EDDA_INLINE ChunkColumns columns_of(const ChunkView& v) {
  return columns_of<dashpots ? Tables::memory_and_dashpots : Tables::memory>(v);
}

EDDA_INLINE FacePair pair_of(const ChunkColumns& c, std::size_t k) {
  FacePair p;
  p.stiffness = c.stiffness[k];
  p.ends = c.ends[k];
  p.carries_tension = c.carries_tension[k];
  p.inverse_e = c.inverse_e[k];
  p.inverse_f = c.inverse_f[k];
  p.gate_from = c.gate_from[k];
  p.gate_scale = c.gate_scale[k];
  p.passing = c.passing[k];
  p.offset = {c.locked_closure_a[k], c.locked_closure_b[k]};
  p.turn_p1 = {c.cosine_p1[k], c.sine_p1[k]};
  p.turn_p2 = {c.cosine_p2[k], c.sine_p2[k]};
  p.turn_q1 = {c.cosine_q1[k], c.sine_q1[k]};
  p.turn_q2 = {c.cosine_q2[k], c.sine_q2[k]};
  return p;
}

/// books: with the corners at n - 1, of which only the work of the step follows.
template <bool dashpots, bool books>
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
           c.shear_zeta[k]},
          points_of(*c.e, *c.f, k),
          !books ? FacePoints{} : points_of(*c.e_then, *c.f_then, k),
          {c.before.slip_a[k],
           c.before.slip_b[k],
           c.before.overlap[k],
           c.before.spring[k],
           was(lane_bits::stored),
           was(lane_bits::on),
           was(lane_bits::closed_a),
           was(lane_bits::closed_b),
           was(lane_bits::switched),
           {c.before.s2[k], dashpots ? d.y2[k] : 0.0, c.before.r1[k], dashpots ? d.z1[k] : 0.0,
            c.before.r2[k], dashpots ? d.z2[k] : 0.0},
           dashpots ? FaceEnds{d.damping_a[k], d.damping_b[k]} : FaceEnds{},
           dashpots ? FaceEnds{d.shear_damping_a[k], d.shear_damping_b[k]} : FaceEnds{}},
          mass_of(c.mass_e),
          mass_of(c.mass_f),
          c.per_step,
          c.noise,
          {}};
}

template <bool dashpots>
EDDA_INLINE void write_memory(const ChunkColumns& c, const FaceStep& s, const EdgeCoordinates& at,
                              std::size_t k) {
  const FaceMemoryColumns<double*>& m = c.memory;
  m.slip_a[k] = s.slip.a;
  m.slip_b[k] = s.slip.b;
  m.overlap[k] = s.overlap;
  m.spring[k] = s.spring;
  m.s2[k] = at.s2;
  m.r1[k] = at.r1;
  m.r2[k] = at.r2;
  if constexpr (dashpots) {
    const DashpotMemoryColumns<double*>& d = c.damped;
    d.y2[k] = at.y2;
    d.z1[k] = at.z1;
    d.z2[k] = at.z2;
    d.damping_a[k] = s.damping.a;
    d.damping_b[k] = s.damping.b;
    d.shear_damping_a[k] = s.shear_damping.a;
    d.shear_damping_b[k] = s.shear_damping.b;
  }
}

EDDA_INLINE void write_work(const ChunkColumns& c, const FaceStep& s, std::size_t k) {
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

EDDA_INLINE void write_forces(const ChunkColumns& c, const CornerForces& f, std::size_t k) {
  c.on_e->column[0][k] = f.p1.x;
  c.on_e->column[1][k] = f.p1.y;
  c.on_e->column[2][k] = f.p2.x;
  c.on_e->column[3][k] = f.p2.y;
  c.on_f->column[0][k] = f.q1.x;
  c.on_f->column[1][k] = f.q1.y;
  c.on_f->column[2][k] = f.q2.x;
  c.on_f->column[3][k] = f.q2.y;
}

/// As bond_fails(): beyond its tensile strength, apart, or beyond its shear strength.
EDDA_INLINE bool bond_fails_in(const ChunkColumns& c, const Face& face, const FaceStep& s,
                               std::size_t k) {
  const double least = smaller(face.closure.a, face.closure.b),
               largest = larger(face.closure.a, face.closure.b);
  const bool bonded = c.bonded[k] > 0.0, carries_tension = c.carries_tension[k] > 0.0;
  const bool torn = carries_tension & (-c.stiffness[k] * least > c.tension[k]);
  const bool apart = bonded & !carries_tension & (largest < -c.touching[k]);
  const double rounding = 2.0 * s.spring * c.noise;
  const bool sheared = bonded & (std::abs(s.shear.a + s.shear.b) >
                                 rounding + c.cohesion[k] * face.cohesive +
                                     c.friction[k] * (face.normal.a + face.normal.b));
  return (torn | apart | sheared) & (c.glued[k] == 0.0);
}

template <bool dashpots, bool plain, bool books>
EDDA_INLINE void evaluate_lane(const ChunkColumns& c, std::size_t k, LaneBits& bits,
                               LaneBits& found, double& deepest) {
  const FaceInputs in = inputs_of<dashpots, books>(c, k);
  const EdgeGeometry stands = geometry_of_edges(in.at, in.pair);
  const Face face = face_between<plain>(in.at, in.pair, stands);
  const FaceStep s = step_of_face<dashpots, false, plain, books>(in, stands, face);
  write_memory<dashpots>(c, s, stands.corners(), k);
  if constexpr (books) write_work(c, s, k);
  write_forces(c, s.force, k);
  const LaneBits bit = bit_of_lane[k];
  const bool stores = face.energy > 0.0;
  const bool opens = in.before.stored & !stores;
  const bool slides = (s.trial.a != s.slip.a) | (s.trial.b != s.slip.b);
  const double work = std::abs(s.friction) + std::abs(s.transfer);
  const bool busy = dashpots | opens | s.unrest | (work != 0.0);
  bits |= (stores ? bit << lane_bits::stored : 0) | (face.gate > 0.0 ? bit << lane_bits::on : 0) |
          (s.closed_a ? bit << lane_bits::closed_a : 0) |
          (s.closed_b ? bit << lane_bits::closed_b : 0) |
          (s.switched ? bit << lane_bits::switched : 0);
  found |= (s.decides ? bit << lane_bits::decides : 0) |
           (s.switching ? bit << lane_bits::switching : 0) |
           (s.works ? bit << lane_bits::works : 0) | (s.rare ? bit << lane_bits::rare : 0) |
           (busy ? bit << lane_bits::busy : 0) | (opens ? bit << lane_bits::opens : 0) |
           (slides ? bit << lane_bits::slides : 0);
  if constexpr (!plain) {
    found |= bond_fails_in(c, face, s, k) ? bit << lane_bits::fails : 0;
  }
  deepest = larger(deepest, s.depth);
}

/// Stores the forces unless the chunk must be evaluated in another way.
template <bool dashpots, bool plain, bool books>
EDDA_INLINE ChunkFound evaluate_lanes(const ChunkView& given) {
  const ChunkColumns c = columns_of<dashpots>(given);  // a copy that no store can change
  LaneBits bits = 0, found = 0;
  double deepest = 0.0;
#pragma omp simd reduction(| : bits, found) reduction(max : deepest)
  for (std::size_t k = 0; k < lanes; ++k) {
    evaluate_lane<dashpots, plain, books>(c, k, bits, found, deepest);
  }
  const LaneBits unfit = (plain ? lane_bits::field(lane_bits::rare) : 0) |
                         (books ? 0 : lane_bits::field(lane_bits::busy));
  if ((found & unfit) == 0) {
    store_records(given.on, given.record_e, *c.on_e);
    store_records(given.on, given.record_f, *c.on_f);
  }
  return {bits, found, deepest};
}
template <bool dashpots>
EDDA_INLINE ChunkFound look_at_lanes(const ChunkView& given) {
  const ChunkColumns c = columns_of<dashpots>(given);
  LaneBits bits = 0, asking = 0;
#pragma omp simd reduction(| : bits, asking)
  for (std::size_t k = 0; k < lanes; ++k) {
    const OpenFace s = look_at_open_face(inputs_of<false, false>(c, k));
    c.memory.s2[k] = s.corners.s2;
    c.memory.r1[k] = s.corners.r1;
    c.memory.r2[k] = s.corners.r2;
    if constexpr (dashpots) {
      c.damped.y2[k] = s.corners.y2;
      c.damped.z1[k] = s.corners.z1;
      c.damped.z2[k] = s.corners.z2;
    }
    const LaneBits bit = bit_of_lane[k];
    bits |= s.gate > 0.0 ? bit << lane_bits::on : 0;
    asking |= s.may_close ? bit << lane_bits::decides : 0;
  }
  return {bits, asking, 0.0};
}
}  // namespace

EDDA_VECTOR ChunkFound evaluate_with_work(const ChunkView& c) {
  return evaluate_lanes<false, false, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_at_rest(const ChunkView& c) {
  return evaluate_lanes<false, false, false>(c);
}
EDDA_VECTOR ChunkFound evaluate_plain_with_work(const ChunkView& c) {
  return evaluate_lanes<false, true, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_plain_at_rest(const ChunkView& c) {
  return evaluate_lanes<false, true, false>(c);
}
EDDA_VECTOR ChunkFound evaluate_damped(const ChunkView& c) {
  return evaluate_lanes<true, false, true>(c);
}
EDDA_VECTOR ChunkFound evaluate_plain_damped(const ChunkView& c) {
  return evaluate_lanes<true, true, true>(c);
}

EDDA_VECTOR ChunkFound look_at_undamped(const ChunkView& c) {
  return look_at_lanes<false>(c);
}
EDDA_VECTOR ChunkFound look_at_damped(const ChunkView& c) {
  return look_at_lanes<true>(c);
}

namespace {

/// Whether nothing of a face can change that carries nothing: its gate was shut and remains so; or
/// it was open and remains so, and the surfaces apart. Both edges and the vectors between their
/// corners change by at most `relative` (r below); |g| is the length of E - F with both edges over
/// their lengths.
///   The sine of the angle by which the frame turns is at most r (1/le + 1/lf)/|g|, and so a
///   coordinate s along it changes by at most r + (L + r) times about that, where no corner lies
///   farther from p1 than L; the ends of the overlap by the same, its length by twice that. Where
///   all of f lies beyond all of e by more than r along n, their surfaces stay apart as long as n
///   turns by less than a right angle.
EDDA_INLINE bool stays_as_it_is(const ChunkColumns& c, const FacePair& pair, const EdgeGeometry& o,
                                std::size_t k, double relative) {
  const double change = relative * (pair.inverse_e + pair.inverse_f);  // of g
  const double turn = 1.1 * change * o.per_base;                       // of t, no more than this
  const auto far_from_p1 = [](double s, double y) { return std::abs(s) + std::abs(y); };
  const double farthest =
      larger(far_from_p1(o.s2, o.y2), larger(far_from_p1(o.r1, o.z1), far_from_p1(o.r2, o.z2)));
  const double shift = relative + (farthest + relative) * turn;
  constexpr double stretch = 1.5;  // the cosine is that of edges stretched by less than this
  const double overlap = o.mb - o.ma, faces_by = o.cosine - pair.gate_from;
  const bool firm = (turn < 0.5) & (change < 0.25);
  const bool shut = (change < 0.25) & (faces_by + stretch * change < 0.0);
  const bool beside = firm & (overlap + 2.0 * shift < 0.0);
  const bool opposed = firm & (faces_by - stretch * change > 0.0) & (o.s2 > shift) &
                       (o.r1 - o.r2 > 2.0 * shift) & (overlap > 2.0 * shift);
  const double gap = smaller(o.z1, o.z2) - larger(o.y2, 0.0);
  const double locked = larger(larger(pair.offset.a, pair.offset.b), 0.0);
  const bool open = opposed & (gap > relative + locked) & (pair.stiffness > 0.0);
  const bool loose = (c.bonded[k] == 0.0) & (pair.carries_tension == 0.0);
  const bool was_off = (c.was & (bit_of_lane[k] << lane_bits::on)) == 0;
  return loose & ((was_off & (shut | beside)) | ((was_off == 0) & open));
}

/// Half of the largest distance that any two of these points can have at most.
EDDA_INLINE double apart(const FacePoints& p) {
  const auto square = [&](Vec2 v) { return dot(v - p.p1, v - p.p1); };
  return std::sqrt(larger(square(p.p2), larger(square(p.q1), square(p.q2))));
}

/// Whether the edges are opposed and a corner touches the other edge, to rounding.
EDDA_INLINE bool touches_as_drawn(const FacePair& pair, const EdgeGeometry& o, double noise) {
  const double most = larger(pair.offset.a + o.closure_at_0 + o.closure_slope * o.ma,
                             pair.offset.b + o.closure_at_0 + o.closure_slope * o.mb);
  return (o.cosine > pair.gate_from) & (o.mb > o.ma) & (most > -noise);
}

}  // namespace

EDDA_VECTOR void read_edges(const double* from, const Id* slot_e, const Id* slot_f, Records& e,
                            Records& f) {
  read_records(from, slot_e, e);
  read_records(from, slot_f, f);
}

EDDA_VECTOR OpenLanes open_lanes(const ChunkView& given, double margin, double steps) {
  const ChunkColumns c = columns_of<Tables::none>(given);
  LaneBits stay = 0, near = 0;
#pragma omp simd reduction(| : stay, near)
  for (std::size_t k = 0; k < lanes; ++k) {
    const FacePair pair = pair_of(c, k);
    const EdgeGeometry o = geometry_of_edges(points_of(*c.e, *c.f, k), pair);
    const LaneBits bit = bit_of_lane[k];
    const double relative = 2.0 * (margin + steps * apart(points_of(*c.e_then, *c.f_then, k)));
    stay |= stays_as_it_is(c, pair, o, k, relative) ? bit : 0;
    near |= touches_as_drawn(pair, o, c.noise) ? bit : 0;
  }
  return {static_cast<unsigned>(near), static_cast<unsigned>(stay)};
}

}  // namespace edda
