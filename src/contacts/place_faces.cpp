#include "contacts/place_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "blocks/point_mass.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_preload.hpp"
#include "contacts/inside.hpp"

namespace edda {
namespace {

/// Columns of FaceMemory as the loops over faces see them.
struct MemoryView {
  double *closure_a, *closure_b, *energy, *normal_a, *normal_b, *shear_a, *shear_b, *damping_a,
      *damping_b, *drag_a, *drag_b, *slip_a, *slip_b, *trial_a, *trial_b, *spring, *length,
      *overlap, *gate, *xi_a, *xi_b, *eta_a, *eta_b, *switched, *friction_work, *damping_work,
      *transfer;
};
MemoryView faces_view(FaceMemory& m) {
  return {m.closure_a.data(),     m.closure_b.data(),    m.energy.data(),  m.normal_a.data(),
          m.normal_b.data(),      m.shear_a.data(),      m.shear_b.data(), m.damping_a.data(),
          m.damping_b.data(),     m.drag_a.data(),       m.drag_b.data(),  m.slip_a.data(),
          m.slip_b.data(),        m.trial_a.data(),      m.trial_b.data(), m.spring.data(),
          m.length.data(),        m.overlap.data(),      m.gate.data(),    m.xi_a.data(),
          m.xi_b.data(),          m.eta_a.data(),        m.eta_b.data(),   m.switched.data(),
          m.friction_work.data(), m.damping_work.data(), m.transfer.data()};
}

/// What a loop over faces reads and writes.
struct FaceView {
  const Id *edge, *edge_end, *facing, *facing_end;
  const double *stiffness, *shear_stiffness, *inverse_lengths, *gate_from, *gate_scale, *passing,
      *at_ends, *acts, *leans, *friction, *cohesion, *offset_a, *offset_b, *pulls, *bonded;
  const double *turn_cosine, *turn_sine;
  const double *x, *y, *x1, *y1;
  double noise;
  // of dashpots
  const double *zeta, *shear_zeta, *point_inverse, *edge_inverse;
  double step;
  bool damped;
  MemoryView now, before;
};
FaceView faces_view(FaceSet& c, const BlockSet& b, const Pose& pose, double step) {
  return {c.edge.data(),
          c.edge_end.data(),
          c.facing.data(),
          c.facing_end.data(),
          c.stiffness.data(),
          c.shear_stiffness.data(),
          c.inverse_lengths.data(),
          c.gate_from.data(),
          c.gate_scale.data(),
          c.passing.data(),
          c.at_ends.data(),
          c.acts.data(),
          c.leans.data(),
          c.friction.data(),
          c.cohesion.data(),
          c.offset_a.data(),
          c.offset_b.data(),
          c.pulls.data(),
          c.bonded.data(),
          b.turn_cosine.data(),
          b.turn_sine.data(),
          pose.x.data(),
          pose.y.data(),
          pose.x1.data(),
          pose.y1.data(),
          c.noise,
          c.zeta.data(),
          c.shear_zeta.data(),
          b.point_inverse.data(),
          b.edge_inverse.data(),
          step,
          !c.zeta.empty(),
          faces_view(c.now),
          faces_view(c.before)};
}

/// Of two material points, the one of f at eta from q2 and that of e at xi from p1: how far the
/// first lies from the second.
EDDA_INLINE Vec2 from_point_of_e(const FacePoints& p, double xi, double eta) {
  return eta * p.q1 + (1.0 - eta) * p.q2 - ((1.0 - xi) * p.p1 + xi * p.p2);
}

EDDA_INLINE Vec2 frame_of(const FacePoints& p) {
  return unit((p.p2 - p.p1) - (p.q2 - p.q1));
}

/// What the points that are at the ends now have moved by in the last step, one against the other,
/// m: slip along the frame, rho_n - rho_{n-1} with rho_n = 0, and closure across the edge that the
/// corner there is pressed against.
struct EndMotion {
  FaceEnds slip, closure;
};
EDDA_INLINE EndMotion motion_of(const Face& face, FaceEnds offset, const FacePoints& then) {
  const Vec2 t = frame_of(then), n = outward_normal(t);
  const Vec2 a = from_point_of_e(then, face.xi.a, face.eta.a);
  const Vec2 b = from_point_of_e(then, face.xi.b, face.eta.b);
  const FaceEnds slip{-dot(a, t), -dot(b, t)};
  return {slip,
          {face.closure.a - offset.a + dot(a, n) + face.slope.a * slip.a,
           face.closure.b - offset.b + dot(b, n) + face.slope.b * slip.b}};
}

/// Shear of one end under Coulomb's limit (N): T = -spring u.
struct Shear {
  double force, slip;
};
EDDA_INLINE Shear cut(double trial, double spring, double limit) {
  const double whole = -spring * trial;
  const double force = smaller(larger(whole, -limit), limit);
  return {force, force == whole ? trial : -force / (spring > 0.0 ? spring : 1.0)};
}

/// What an end's shear spring has lost in the last step: in the leapfrog's terms T_n and T_{n-1}
/// each work over half of it, on the points at their ends, which are not quite the same.
struct SlipOfStep {
  double here;         ///< of the points at the end now, m
  double there;        ///< of those that were there at n - 1, m
  double force, slip;  ///< T and u at n - 1
  double kept;         ///< part of u that is left once the spring has grown
};
struct Lost {
  double friction, transfer;
};
/// (u_tr - u_n) (T_n + T_{n-1})/2 is Coulomb's, what else is missing is no physics. A face that has
/// opened lets go what it stored by sliding.
EDDA_INLINE Lost lost(const Shear& now, double trial, double spring, const SlipOfStep& s,
                      bool touches) {
  const double all = -0.5 * (now.force * (s.here - now.slip) + s.force * (s.slip + s.there));
  const double slid = 0.5 * spring * (trial - now.slip) * (now.slip + s.kept * s.slip);
  const double friction = larger(touches ? slid : all, 0.0);
  return {friction, all - friction};
}

/// The shear springs go with the overlap: what they gain in length is free of stress, what they
/// lose takes its part of the force along. Not for every breath: L must change by this part.
constexpr double worth = 1e-4;

constexpr double unlimited = 1e300;  // N

/// What asks for a decision (see judge()).
EDDA_INLINE bool asks(const FaceView& c, const Face& face, std::size_t k) {
  const double closure = larger(face.closure.a - c.offset_a[k], face.closure.b - c.offset_b[k]);
  const bool on = face.gate > 0.0;
  const bool born = on & (c.before.gate[k] == 0.0);
  const bool frees = on & (c.acts[k] == 0.0) & (closure <= 0.0);
  const bool first = (face.energy > 0.0) & (c.before.energy[k] == 0.0);
  return born | frees | first;
}

/// Which ends are closed: 0 to 3.
EDDA_INLINE double ends_closed(double da, double db, double noise) {
  return (da > noise ? 1.0 : 0.0) + (db > noise ? 2.0 : 0.0);
}

/// Whether at an end one corner has passed the other, by which the force along the face jumps by
/// k d^2/2: the part of its edge by which the one bounds the overlap and no longer the other, now
/// and before.
EDDA_INLINE bool passes(double now, double before) {
  constexpr double worth_it = 1e-7;
  return (now * before < 0.0) & (larger(std::abs(now), std::abs(before)) > worth_it);
}

struct Placed {
  CornerForces force;
  bool asks, stirs;
  double depth;
};

/// One end of a face: its normal force, slip before Coulomb's limit, what its points have moved by.
struct EndOfFace {
  double normal, trial, closing, slipping, xi, eta;
};
/// What acts there besides the pressure.
struct EndActs {
  Shear shear;
  double damping, drag;  ///< of the dashpots across and along the face, N
};

/// Dashpots c = 2 zeta sqrt(p m), p the spring of the end and m the mass that it moves. The one
/// across lets no end pull that could not, and counts in Coulomb's limit; the one along keeps
/// within it.
template <bool dashpots>
EDDA_INLINE EndActs act(const FaceView& c, const Face& face, const EndOfFace& end, double spring,
                        double cohesion, bool touches, std::size_t k) {
  const double friction = c.friction[k];
  const bool bonded = c.bonded[k] > 0.0;
  if constexpr (!dashpots) {
    const double limit = larger(cohesion + friction * end.normal, 0.0);
    return {cut(end.trial, spring, bonded ? unlimited : limit), 0.0, 0.0};
  } else {
    const double inverse = inverse_mass_on_edge(c, c.edge[k], c.edge_end[k], end.xi) +
                           inverse_mass_on_edge(c, c.facing[k], c.facing_end[k], 1.0 - end.eta);
    const double mass = 1.0 / (inverse > 0.0 ? inverse : 1.0);
    const double across = 0.5 * c.stiffness[k] * c.acts[k] * larger(face.length, 0.0) * face.gate;
    const double whole =
        end.normal + 2.0 * c.zeta[k] * std::sqrt(across * mass) * end.closing / c.step;
    const double pushing = larger(whole, 0.0);
    const bool pulls = c.pulls[k] > 0.0, carries = end.normal != 0.0;
    const double normal = carries ? (pulls ? whole : pushing) : 0.0;
    const double limit = bonded ? unlimited : larger(cohesion + friction * normal, 0.0);
    const Shear shear = cut(end.trial, spring, limit);
    const double drag = -2.0 * c.shear_zeta[k] * std::sqrt(spring * mass) * end.slipping / c.step;
    const double within = larger(-limit - shear.force, smaller(limit - shear.force, drag));
    const bool holds = touches & (shear.slip == end.trial);
    return {shear, normal - end.normal, holds ? within : 0.0};
  }
}

template <bool dashpots>
EDDA_INLINE Placed place(const FaceView& c, std::size_t k) {
  const MemoryView &m = c.now, &old = c.before;
  const FacePoints at = face_points(c, c.x, c.y, k), then = face_points(c, c.x1, c.y1, k);
  const Face face = face_between(at, face_pair(c, c.turn_cosine, c.turn_sine, k));
  const bool bonded = c.bonded[k] > 0.0;
  const bool touches = (face.energy > 0.0) | (bonded & (face.gate > 0.0));

  // overlap and springs
  const double length = larger(face.length, 0.0), length_1 = old.overlap[k];
  const bool same = std::abs(length - length_1) <= worth * length_1;
  const double overlap = same ? length_1 : length;
  const double kept = overlap > length_1 ? length_1 / (overlap > 0.0 ? overlap : 1.0) : 1.0;
  const double spring = touches ? 0.5 * c.shear_stiffness[k] * overlap * face.gate : 0.0;

  // slip, and Coulomb's limit at each end
  const EndMotion moved = motion_of(face, {c.offset_a[k], c.offset_b[k]}, then);
  const FaceEnds here = moved.slip;
  const double xi_a = old.xi_a[k], xi_b = old.xi_b[k], eta_a = old.eta_a[k], eta_b = old.eta_b[k];
  const FaceEnds there{dot(from_point_of_e(at, xi_a, eta_a), face.t),
                       dot(from_point_of_e(at, xi_b, eta_b), face.t)};
  const double slip_1a = old.slip_a[k], slip_1b = old.slip_b[k];
  const double trial_a = touches ? kept * slip_1a + here.a : 0.0;
  const double trial_b = touches ? kept * slip_1b + here.b : 0.0;
  const double cohesion = touches ? 0.5 * c.cohesion[k] * face.length * face.gate : 0.0;
  const EndOfFace end_a{face.normal.a, trial_a, moved.closure.a, here.a, face.xi.a, face.eta.a};
  const EndOfFace end_b{face.normal.b, trial_b, moved.closure.b, here.b, face.xi.b, face.eta.b};
  const EndActs acts_a = act<dashpots>(c, face, end_a, spring, cohesion, touches, k);
  const EndActs acts_b = act<dashpots>(c, face, end_b, spring, cohesion, touches, k);
  const Shear a = acts_a.shear, b = acts_b.shear;
  const Lost lost_a =
      lost(a, trial_a, spring, {here.a, there.a, old.shear_a[k], slip_1a, kept}, touches);
  const Lost lost_b =
      lost(b, trial_b, spring, {here.b, there.b, old.shear_b[k], slip_1b, kept}, touches);

  const double da = face.closure.a, db = face.closure.b;
  const double closed = touches ? ends_closed(da, db, c.noise) : 0.0;
  const double closed_1 =
      old.energy[k] > 0.0 ? ends_closed(old.closure_a[k], old.closure_b[k], c.noise) : 0.0;
  const bool passed =
      passes(face.eta.a - face.xi.a, eta_a - xi_a) | passes(face.xi.b - face.eta.b, xi_b - eta_b);
  const double switched = (closed != closed_1) | passed ? 1.0 : 0.0;
  const bool stirs = (old.energy[k] > 0.0) & ((switched > 0.0) | (old.switched[k] > 0.0));

  m.closure_a[k] = da;
  m.closure_b[k] = db;
  m.energy[k] = face.energy;
  m.normal_a[k] = face.normal.a;
  m.normal_b[k] = face.normal.b;
  m.shear_a[k] = a.force;
  m.shear_b[k] = b.force;
  m.damping_a[k] = acts_a.damping;
  m.damping_b[k] = acts_b.damping;
  m.drag_a[k] = acts_a.drag;
  m.drag_b[k] = acts_b.drag;
  m.slip_a[k] = touches ? a.slip : 0.0;
  m.slip_b[k] = touches ? b.slip : 0.0;
  m.trial_a[k] = trial_a;
  m.trial_b[k] = trial_b;
  m.spring[k] = spring;
  m.length[k] = length;
  m.overlap[k] = touches ? overlap : length;
  m.gate[k] = face.gate;
  m.xi_a[k] = face.xi.a;
  m.xi_b[k] = face.xi.b;
  m.eta_a[k] = face.eta.a;
  m.eta_b[k] = face.eta.b;
  m.switched[k] = switched;
  m.friction_work[k] = lost_a.friction + lost_b.friction;
  m.damping_work[k] =
      0.5 * ((acts_a.damping + old.damping_a[k]) * moved.closure.a +
             (acts_b.damping + old.damping_b[k]) * moved.closure.b -
             (acts_a.drag + old.drag_a[k]) * here.a - (acts_b.drag + old.drag_b[k]) * here.b);
  m.transfer[k] = lost_a.transfer + lost_b.transfer;

  Placed placed;
  placed.force = end_forces(at, face, {acts_a.damping, acts_b.damping},
                            {a.force + acts_a.drag, b.force + acts_b.drag});
  placed.force.p1 += face.force.p1;
  placed.force.p2 += face.force.p2;
  placed.force.q1 += face.force.q1;
  placed.force.q2 += face.force.q2;
  placed.asks = asks(c, face, k);
  placed.stirs = stirs;
  placed.depth = touches ? larger(da - c.offset_a[k], db - c.offset_b[k]) : 0.0;
  return placed;
}

/// Forces of a chunk, by corner.
struct ChunkForces {
  double p1x[FaceSet::chunk], p1y[FaceSet::chunk], p2x[FaceSet::chunk], p2y[FaceSet::chunk],
      q1x[FaceSet::chunk], q1y[FaceSet::chunk], q2x[FaceSet::chunk], q2y[FaceSet::chunk];
};

struct FoundInChunk {
  bool asks, stirs;
  double deepest;
};

template <bool dashpots>
EDDA_INLINE void place_into(const FaceView& c, ChunkForces& on, std::size_t k, std::size_t q,
                            double& asking, double& stirring, double& deepest) {
  const Placed placed = place<dashpots>(c, k);
  on.p1x[q] = placed.force.p1.x;
  on.p1y[q] = placed.force.p1.y;
  on.p2x[q] = placed.force.p2.x;
  on.p2y[q] = placed.force.p2.y;
  on.q1x[q] = placed.force.q1.x;
  on.q1y[q] = placed.force.q1.y;
  on.q2x[q] = placed.force.q2.x;
  on.q2y[q] = placed.force.q2.y;
  asking = larger(asking, placed.asks ? 1.0 : 0.0);
  stirring = larger(stirring, placed.stirs ? 1.0 : 0.0);
  deepest = larger(deepest, placed.depth);
}

EDDA_VECTOR FoundInChunk place_undamped(FaceView c, ChunkForces* on, std::size_t first,
                                        std::size_t last) {
  double asking = 0.0, stirring = 0.0, deepest = 0.0;
#pragma omp simd reduction(max : asking, stirring, deepest)
  for (std::size_t k = first; k < last; ++k) {
    place_into<false>(c, *on, k, k - first, asking, stirring, deepest);
  }
  return {asking > 0.0, stirring > 0.0, deepest};
}

EDDA_VECTOR FoundInChunk place_damped(FaceView c, ChunkForces* on, std::size_t first,
                                      std::size_t last) {
  double asking = 0.0, stirring = 0.0, deepest = 0.0;
#pragma omp simd reduction(max : asking, stirring, deepest)
  for (std::size_t k = first; k < last; ++k) {
    place_into<true>(c, *on, k, k - first, asking, stirring, deepest);
  }
  return {asking > 0.0, stirring > 0.0, deepest};
}

FoundInChunk place_chunk(const FaceView& c, ChunkForces* on, std::size_t first, std::size_t last) {
  return c.damped ? place_damped(c, on, first, last) : place_undamped(c, on, first, last);
}

void keep_forces(FaceSet& c, const ChunkForces& on, std::size_t first, std::size_t last) {
  for (std::size_t k = first; k < last; ++k) {
    const std::size_t q = k - first;
    double* const e = c.force.data() + 4 * std::size_t{c.slot[k]};
    double* const f = c.force.data() + 4 * std::size_t{c.facing_slot[k]};
    e[0] = on.p1x[q];
    e[1] = on.p1y[q];
    e[2] = on.p2x[q];
    e[3] = on.p2y[q];
    f[0] = on.q1x[q];
    f[1] = on.q1y[q];
    f[2] = on.q2x[q];
    f[3] = on.q2y[q];
  }
}

/// The points of both edges at the part x of the overlap.
struct Opposite {
  Vec2 on_edge, on_facing;
};
Opposite opposite_at(const FacePoints& p, const Face& face, double x) {
  const double xi = face.xi.a + x * (face.xi.b - face.xi.a);
  const double eta = face.eta.a + x * (face.eta.b - face.eta.a);
  return {(1.0 - xi) * p.p1 + xi * p.p2, eta * p.q1 + (1.0 - eta) * p.q2};
}

/// Where the pressure would act, as a part of the overlap; at least one end is closed.
double centre_of_pressure(double da, double db) {
  if (da >= 0.0 && db >= 0.0) return da + db > 0.0 ? (da + 2.0 * db) / (3.0 * (da + db)) : 0.5;
  return da > 0.0 ? da / (da - db) / 3.0 : 1.0 - db / (db - da) / 3.0;
}

bool lies_in(const BlockSet& b, const Pose& pose, Vec2 p, Id block) {
  return inside_of(b, pose, p, block).depth > 0.0;
}

/// Whether the corner that bounds the deeper end leans on the other edge: beside it, between the
/// two edges, lies no third block. Where one does, as at a point where five wedges meet, what lies
/// across carries as much as its closure says and no corner's spring.
bool corner_leans(const FaceSet& c, const BlockSet& b, const Pose& pose, const FacePoints& at,
                  const Face& face, std::size_t k) {
  constexpr double beside = 0.1;  // of the overlap
  const Opposite points =
      opposite_at(at, face, face.closure.b >= face.closure.a ? 1.0 - beside : beside);
  const Vec2 between = 0.5 * (points.on_edge + points.on_facing);
  const Id own[2] = {b.vertex_block[c.edge[k]], b.vertex_block[c.facing[k]]};
  for (const Id j : own) {
    bool third = false;
    c.for_faces(b.vertex_begin[j], b.vertex_begin[j + 1], [&](Id q, bool of_edge) {
      const Id i = b.vertex_block[of_edge ? c.facing[q] : c.edge[q]];
      third = third || (i != own[0] && i != own[1] && lies_in(b, pose, between, i));
    });
    if (third) return false;
  }
  return true;
}

/// Decides what of face k may change while it stores nothing. It acts if it comes to life open, or
/// if the points where it would press lie in both blocks: the far sides of two thin ones are
/// opposed, too. Later it does once it is open.
void judge(FaceSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  const FacePoints at = face_points(c, pose.x, pose.y, k);
  const Face face = face_at(c, b, pose.x, pose.y, k);
  const double closure = std::max(face.closure.a - c.offset_a[k], face.closure.b - c.offset_b[k]);
  if (c.before.gate[k] == 0.0) {
    const FaceEnds locked = locked_closure(c, face, k);
    c.offset_a[k] = locked.a;
    c.offset_b[k] = locked.b;
  }
  if (closure <= c.noise) {
    c.acts[k] = 1.0;
  } else if (c.before.gate[k] == 0.0) {
    const Opposite p = opposite_at(at, face, centre_of_pressure(face.closure.a, face.closure.b));
    const bool inside = std::max(face.closure.a, face.closure.b) > 0.0 &&
                        lies_in(b, pose, p.on_facing, b.vertex_block[c.edge[k]]) &&
                        lies_in(b, pose, p.on_edge, b.vertex_block[c.facing[k]]);
    c.acts[k] = inside ? 1.0 : 0.0;
  }
  if (c.before.energy[k] == 0.0) c.leans[k] = corner_leans(c, b, pose, at, face, k) ? 1.0 : 0.0;
}

/// Breaks what gives way of the faces [first, last). Whether anything does.
bool break_bonds(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                 std::size_t first, std::size_t last) {
  bool any = false;
  for (std::size_t k = first; k < last; ++k) {
    if ((c.bonded[k] == 0.0 && c.pulls[k] == 0.0) || !gives_way(c, b, k)) continue;
    const double stored = normal_energy(c, b, pose, k);
    break_bond(c, laws, k);
    c.fracture_work[k] += std::max(stored - normal_energy(c, b, pose, k), 0.0);
    any = true;
  }
  return any;
}

void place_chunks(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                  double step, std::size_t begin, std::size_t end) {
  const FaceView view = faces_view(c, b, pose, step);
  ChunkForces on;
  for (std::size_t first = begin; first < end; first += FaceSet::chunk) {
    const std::size_t last = std::min(end, first + FaceSet::chunk);
    FoundInChunk found = place_chunk(view, &on, first, last);
    if (found.asks) {
      for (std::size_t k = first; k < last; ++k) {
        const Face face = face_at(c, b, pose.x, pose.y, k);
        if (asks(view, face, k)) judge(c, b, pose, k);
      }
      found = place_chunk(view, &on, first, last);
    }
    if (c.bonds[first / FaceSet::chunk] != 0 && break_bonds(c, b, pose, laws, first, last)) {
      found = place_chunk(view, &on, first, last);
    }
    c.stirs[first / FaceSet::chunk] = found.stirs ? 1 : 0;
    c.deepest[first / FaceSet::chunk] = found.deepest;
    keep_forces(c, on, first, last);
  }
}

}  // namespace

void place_faces(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                 double step) {
  parallel_chunks(c.size(), FaceSet::run, [&](std::size_t, std::size_t begin, std::size_t end) {
    place_chunks(c, b, pose, laws, step, begin, end);
  });
}

void place_face(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws, double step,
                std::size_t k) {
  const FaceView view = faces_view(c, b, pose, step);
  ChunkForces on;
  FoundInChunk found = place_chunk(view, &on, k, k + 1);
  if (found.asks) {
    judge(c, b, pose, k);
    found = place_chunk(view, &on, k, k + 1);
  }
  if (break_bonds(c, b, pose, laws, k, k + 1)) found = place_chunk(view, &on, k, k + 1);
  if (found.stirs) c.stirs[k / FaceSet::chunk] = 1;
  keep_forces(c, on, k, k + 1);
}

void change_step_behind(FaceSet& c, const BlockSet& b, const Pose& pose,
                        const std::vector<double>& old_x1, const std::vector<double>& old_y1) {
  FaceMemory& m = c.before;
  parallel_for(c.size(), [&](std::size_t k) {
    const FaceEnds offset{c.offset_a[k], c.offset_b[k]};
    const Face now = face_at(c, b, pose.x, pose.y, k), then = face_at(c, b, pose.x1, pose.y1, k);
    const FaceEnds was = motion_of(now, offset, face_points(c, old_x1, old_y1, k)).slip;
    const FaceEnds is = motion_of(now, offset, face_points(c, pose.x1, pose.y1, k)).slip;
    m.slip_a[k] += was.a - is.a;
    m.slip_b[k] += was.b - is.b;
    m.closure_a[k] = then.closure.a;
    m.closure_b[k] = then.closure.b;
    m.energy[k] = then.energy;
    m.gate[k] = std::max(m.gate[k], then.gate);
  });
}

void next_step(FaceSet& c) {
  if (c.gluing) glue_pressed(c);
  parallel_for(c.size(), [&](std::size_t k) {
    (c.breaks[k] > 0.0 ? c.fracture_work : c.friction_work)[k] += c.now.friction_work[k];
    c.damping_work[k] += c.now.damping_work[k];
    const bool cut = c.now.slip_a[k] != c.now.trial_a[k] || c.now.slip_b[k] != c.now.trial_b[k];
    if (cut) c.slipped[k] = 1.0;
    if (c.before.energy[k] > 0.0 && c.now.energy[k] == 0.0) c.opened[k] = 1.0;
    c.transfer[k] += c.now.transfer[k];
  });
  for (double& breaks : c.breaks) {
    if (breaks == 0.0) continue;
    if (breaks == bond_breaks) ++c.broken;
    breaks = 0.0;
  }
  std::swap(c.now, c.before);
}

Face face_at(const FaceSet& c, const BlockSet& b, const std::vector<double>& x,
             const std::vector<double>& y, std::size_t k) {
  return face_between(face_points(c, x, y, k),
                      face_pair(c, b.turn_cosine.data(), b.turn_sine.data(), k));
}

CornerForces cut_again(FaceSet& c, const Face& face, const FacePoints& at, const FacePoints& then,
                       double alpha, std::size_t k) {
  FaceMemory& m = c.before;
  const FaceEnds here = motion_of(face, {c.offset_a[k], c.offset_b[k]}, then).slip;
  const double spring = m.spring[k], cohesion = 0.5 * c.cohesion[k] * face.length * face.gate;
  const auto again = [&](double normal, double trial, double slipped, double& force, double& slip) {
    const Shear next = cut(trial, spring, std::max(cohesion + c.friction[k] * alpha * normal, 0.0));
    // As lost(), of which all that T_{n-1} does stays as it was; kept u_{n-1} = u_tr - slipped.
    const auto taken = [&](const Shear& s) {
      const double all = -0.5 * s.force * (slipped - s.slip);
      const double slid = 0.5 * spring * (trial - s.slip) * (s.slip + trial - slipped);
      const double friction = std::max(slid, 0.0);
      return Lost{friction, all - friction};
    };
    const Lost was = taken({force, slip}), is = taken(next);
    c.friction_work[k] += is.friction - was.friction;
    c.transfer[k] += is.transfer - was.transfer;
    force = next.force;
    slip = next.slip;
  };
  again(alpha * face.normal.a + m.damping_a[k], m.trial_a[k], here.a, m.shear_a[k], m.slip_a[k]);
  again(alpha * face.normal.b + m.damping_b[k], m.trial_b[k], here.b, m.shear_b[k], m.slip_b[k]);
  CornerForces force = end_forces(at, face, {}, {m.shear_a[k], m.shear_b[k]});
  force.p1 += alpha * face.force.p1;
  force.p2 += alpha * face.force.p2;
  force.q1 += alpha * face.force.q1;
  force.q2 += alpha * face.force.q2;
  return force;
}

}  // namespace edda
