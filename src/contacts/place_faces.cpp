#include "contacts/place_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/face_step.hpp"
#include "contacts/judge_face.hpp"

namespace edda {
namespace {

/// What all chunks read.
struct AllFaces {
  const double *turn_cosine, *turn_sine;
  const double *x, *y, *x1, *y1;
  double noise;
  const double *point_inverse, *edge_inverse;
  double step;
  const double *limit_a, *limit_b;
};
AllFaces all_faces(const FaceSet& c, const BlockSet& b, const Pose& pose, double step,
                   const ShearLimits* limits = nullptr) {
  return {b.turn_cosine.data(),
          b.turn_sine.data(),
          pose.x.data(),
          pose.y.data(),
          pose.x1.data(),
          pose.y1.data(),
          c.noise,
          b.point_inverse.data(),
          b.edge_inverse.data(),
          step,
          limits == nullptr ? nullptr : limits->a.data(),
          limits == nullptr ? nullptr : limits->b.data()};
}

/// Where a chunk lies.
struct ChunkPlace {
  const Id* corners;
  const double* properties;
  double* now;
  const double* before;
  double* force;
};
ChunkPlace chunk_place(FaceSet& c, std::size_t q) {
  return {c.corners.data() + q * 4 * FaceSet::chunk, c.begin_of_chunk(q), c.now.begin_of_chunk(q),
          c.before.begin_of_chunk(q), c.force.data() + q * 8 * FaceSet::chunk};
}

EDDA_INLINE FaceView view_of(const AllFaces& all, const ChunkPlace& at) {
  FaceView v;
  static_cast<FaceProperties<const double*>&>(v) =
      columns_of_chunk<FaceProperties<const double*>, face_property_list<const double*>>(
          at.properties);
  v.edge = at.corners;
  v.edge_end = at.corners + FaceSet::chunk;
  v.facing = at.corners + 2 * FaceSet::chunk;
  v.facing_end = at.corners + 3 * FaceSet::chunk;
  v.turn_cosine = all.turn_cosine;
  v.turn_sine = all.turn_sine;
  v.x = all.x;
  v.y = all.y;
  v.x1 = all.x1;
  v.y1 = all.y1;
  v.noise = all.noise;
  v.point_inverse = all.point_inverse;
  v.edge_inverse = all.edge_inverse;
  v.step = all.step;
  v.limit_a = all.limit_a;
  v.limit_b = all.limit_b;
  v.now = columns_of_chunk<FaceFields<double*>, face_fields<double*>>(at.now);
  v.before = columns_of_chunk<FaceFields<const double*>, face_fields<const double*>>(at.before);
  v.force = at.force;
  return v;
}

struct FoundInChunk {
  bool asks, stirs, works, rare;
  double deepest;
};

template <bool dashpots, bool held, bool plain>
EDDA_INLINE void place_into(const FaceView& c, std::size_t k, double& asking, double& stirring,
                            double& working, double& rare, double& deepest) {
  const Placed placed = place<dashpots, held, plain>(c, k);
  c.force[8 * k + 0] = placed.force.p1.x;
  c.force[8 * k + 1] = placed.force.p1.y;
  c.force[8 * k + 2] = placed.force.p2.x;
  c.force[8 * k + 3] = placed.force.p2.y;
  c.force[8 * k + 4] = placed.force.q1.x;
  c.force[8 * k + 5] = placed.force.q1.y;
  c.force[8 * k + 6] = placed.force.q2.x;
  c.force[8 * k + 7] = placed.force.q2.y;
  asking = larger(asking, placed.asks);
  stirring = larger(stirring, placed.stirs);
  working = larger(working, placed.works);
  rare = larger(rare, placed.rare);
  deepest = larger(deepest, placed.depth);
}

/// All rows of a chunk.
template <bool dashpots, bool plain>
EDDA_INLINE FoundInChunk place_rows(const AllFaces& all, const ChunkPlace& at) {
  const FaceView c = view_of(all, at);
  double asking = 0.0, stirring = 0.0, working = 0.0, rare = 0.0, deepest = 0.0;
#pragma omp simd reduction(max : asking, stirring, working, rare, deepest)
  for (std::size_t k = 0; k < FaceSet::chunk; ++k) {
    place_into<dashpots, false, plain>(c, k, asking, stirring, working, rare, deepest);
  }
  return {asking > 0.0, stirring > 0.0, working > 0.0, rare > 0.0, deepest};
}
EDDA_VECTOR FoundInChunk place_undamped(const AllFaces& all, const ChunkPlace& at) {
  return place_rows<false, false>(all, at);
}
EDDA_VECTOR FoundInChunk place_plain_undamped(const AllFaces& all, const ChunkPlace& at) {
  return place_rows<false, true>(all, at);
}
EDDA_VECTOR FoundInChunk place_damped(const AllFaces& all, const ChunkPlace& at) {
  return place_rows<true, false>(all, at);
}
EDDA_VECTOR FoundInChunk place_plain_damped(const AllFaces& all, const ChunkPlace& at) {
  return place_rows<true, true>(all, at);
}

/// Rows [first, last) alone, one by one.
template <bool dashpots, bool held>
FoundInChunk place_rows(const AllFaces& all, const ChunkPlace& at, std::size_t first,
                        std::size_t last) {
  const FaceView c = view_of(all, at);
  double asking = 0.0, stirring = 0.0, working = 0.0, rare = 0.0, deepest = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    place_into<dashpots, held, false>(c, k, asking, stirring, working, rare, deepest);
  }
  return {asking > 0.0, stirring > 0.0, working > 0.0, rare > 0.0, deepest};
}

/// Whether one of the faces of a chunk, which have carried nothing for two steps, needs more than a
/// look.
EDDA_VECTOR bool wakes_chunk(const AllFaces& all, const ChunkPlace& at) {
  const FaceView c = view_of(all, at);
  double waking = 0.0;
#pragma omp simd reduction(max : waking)
  for (std::size_t k = 0; k < FaceSet::chunk; ++k) waking = larger(waking, wakes(c, k) ? 1.0 : 0.0);
  return waking > 0.0;
}

/// Breaks what gives way of the faces [first, last). Whether anything does.
bool break_bonds(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                 std::size_t first, std::size_t last) {
  bool any = false;
  for (std::size_t k = first; k < last; ++k) {
    if ((c.bonded[k] == 0.0 && c.pulls[k] == 0.0) || !gives_way(c, b, k)) continue;
    const double stored = normal_energy(c, b, pose, k);
    break_bond(c, laws, k);
    take_lost_energy(c, stored - normal_energy(c, b, pose, k), k);
    any = true;
  }
  return any;
}

/// All faces of a chunk as they stand: plainly where they all are plain, as they mostly were at the
/// step before.
FoundInChunk place_chunk(FaceSet& c, const AllFaces& all, std::size_t q) {
  const ChunkPlace at = chunk_place(c, q);
  if (c.plain[q] != 0) {
    const FoundInChunk found =
        c.dashpots ? place_plain_damped(all, at) : place_plain_undamped(all, at);
    if (!found.rare) return found;
  }
  const FoundInChunk found = c.dashpots ? place_damped(all, at) : place_undamped(all, at);
  c.plain[q] = found.rare ? 0 : 1;
  return found;
}

/// The faces [first, last), of one chunk, as they stand.
FoundInChunk place_part(FaceSet& c, const AllFaces& all, std::size_t first, std::size_t last) {
  const std::size_t q = first / FaceSet::chunk, from = first % FaceSet::chunk;
  const std::size_t to = from + (last - first);
  const bool held = all.limit_a != nullptr;
  if (!held && from == 0 && last == std::min(first + FaceSet::chunk, c.size())) {
    return place_chunk(c, all, q);
  }
  const ChunkPlace at = chunk_place(c, q);
  AllFaces here = all;
  if (held) {
    here.limit_a += first - from;
    here.limit_b += first - from;
    return c.dashpots ? place_rows<true, true>(here, at, from, to)
                      : place_rows<false, true>(here, at, from, to);
  }
  return c.dashpots ? place_rows<true, false>(here, at, from, to)
                    : place_rows<false, false>(here, at, from, to);
}

/// The same, with what has to be decided and, given the laws, bonds that may break.
FoundInChunk place_and_judge(FaceSet& c, const AllFaces& all, const BlockSet& b, const Pose& pose,
                             const LawTable* laws, std::size_t first, std::size_t last) {
  FoundInChunk found = place_part(c, all, first, last);
  if (found.asks) {
    const FaceView view = view_of(all, chunk_place(c, first / FaceSet::chunk));
    bool changes = false;
    for (std::size_t k = first; k < last; ++k) {
      if (asks(view, k % FaceSet::chunk) && judge_face(c, b, pose, k)) changes = true;
    }
    if (changes) found = place_part(c, all, first, last);
  }
  const bool bonds = laws != nullptr && c.bonds[first / FaceSet::chunk] != 0;
  if (bonds && break_bonds(c, b, pose, *laws, first, last)) {
    found = place_part(c, all, first, last);
  }
  return found;
}

void place_chunks(FaceSet& c, const AllFaces& all, const BlockSet& b, const Pose& pose,
                  const LawTable* laws, std::size_t begin, std::size_t end) {
  for (std::size_t first = begin; first < end; first += FaceSet::chunk) {
    const std::size_t last = std::min(end, first + FaceSet::chunk), q = first / FaceSet::chunk;
    const bool idle = c.now.idle[q] && c.before.idle[q] && !c.bonds[q] && all.limit_a == nullptr;
    if (idle && !wakes_chunk(all, chunk_place(c, q))) {
      c.stirs[q] = 0;
      c.deepest[q] = 0.0;
      continue;
    }
    const FoundInChunk found = place_and_judge(c, all, b, pose, laws, first, last);
    c.now.idle[q] = found.works ? 0 : 1;
    c.stirs[q] = found.stirs ? 1 : 0;
    c.deepest[q] = found.deepest;
  }
}

/// laws: of the bonds that may break, if any.
void place_all(FaceSet& c, const AllFaces& all, const BlockSet& b, const Pose& pose,
               const LawTable* laws) {
  parallel_chunks(c.size(), FaceSet::run, [&](std::size_t, std::size_t begin, std::size_t end) {
    place_chunks(c, all, b, pose, laws, begin, end);
  });
}

/// Adds what a step has taken to what was taken before, of the faces of a chunk.
struct ChunkBooks {
  FaceProperties<double*> of;
  FaceFields<const double*> now, before;
};
EDDA_INLINE void end_step(const ChunkBooks& c, bool dashpots, std::size_t k) {
  const FaceFields<const double*>& m = c.now;
  const bool tears = c.of.breaks[k] > 0.0;
  const double taken = m.friction_work[k];
  c.of.fracture_work[k] += tears ? taken : 0.0;
  c.of.friction_work[k] += tears ? 0.0 : taken;
  if (dashpots) c.of.damping_work[k] += m.damping_work[k] + m.damping_due[k];
  const bool cut = (m.slip_a[k] != m.trial_a[k]) | (m.slip_b[k] != m.trial_b[k]);
  const bool opens = (c.before.energy[k] > 0.0) & (m.energy[k] == 0.0);
  c.of.slipped[k] = cut ? 1.0 : c.of.slipped[k];
  c.of.opened[k] = opens ? 1.0 : c.of.opened[k];
  c.of.transfer[k] += m.transfer[k];
}
EDDA_VECTOR void end_step_of_chunk(double* properties, const double* now, const double* before,
                                   bool dashpots) {
  const ChunkBooks c{
      columns_of_chunk<FaceProperties<double*>, face_property_list<double*>>(properties),
      columns_of_chunk<FaceFields<const double*>, face_fields<const double*>>(now),
      columns_of_chunk<FaceFields<const double*>, face_fields<const double*>>(before)};
#pragma omp simd
  for (std::size_t k = 0; k < FaceSet::chunk; ++k) end_step(c, dashpots, k);
}

/// What has been worked out is final; dashpots: of the faces, or of the method.
void end_step(FaceSet& c, bool dashpots) {
  if (c.gluing) glue_pressed(c);
  parallel_chunks(c.size(), FaceSet::run, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t q = begin / FaceSet::chunk; q * FaceSet::chunk < end; ++q) {
      if (c.now.idle[q] != 0) continue;
      end_step_of_chunk(c.begin_of_chunk(q), c.now.begin_of_chunk(q), c.before.begin_of_chunk(q),
                        dashpots);
    }
  });
  for (std::size_t q = 0; q < c.chunks(); ++q) {
    if (c.tears[q] == 0) continue;
    c.tears[q] = 0;
    for (std::size_t k = q * FaceSet::chunk; k < std::min((q + 1) * FaceSet::chunk, c.size());
         ++k) {
      if (c.breaks[k] == bond_breaks) ++c.broken;
      c.breaks[k] = 0.0;
    }
  }
  std::swap(c.now, c.before);
}

}  // namespace

void place_faces(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                 double step) {
  place_all(c, all_faces(c, b, pose, step), b, pose, &laws);
}

void try_faces(FaceSet& c, const BlockSet& b, const Pose& pose, double step,
               const ShearLimits& limits) {
  place_all(c, all_faces(c, b, pose, step, &limits), b, pose, nullptr);
}

void place_face(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws, double step,
                std::size_t k) {
  const AllFaces all = all_faces(c, b, pose, step);
  const std::size_t q = k / FaceSet::chunk;
  const FaceMemory &m = c.now, &old = c.before;
  const bool idle = m.energy[k] == 0.0 && old.energy[k] == 0.0 && old.spring[k] == 0.0 &&
                    m.friction_work[k] == 0.0 && m.transfer[k] == 0.0 && m.damping_due[k] == 0.0 &&
                    c.bonded[k] == 0.0 && c.pulls[k] == 0.0;
  if (idle && !wakes(view_of(all, chunk_place(c, q)), k % FaceSet::chunk)) return;
  const FoundInChunk found = place_and_judge(c, all, b, pose, &laws, k, k + 1);
  c.deepest[q] = std::max(c.deepest[q], found.deepest);
  if (found.stirs) c.stirs[q] = 1;
  if (found.works) c.now.idle[q] = 0;
}

void change_step_behind(FaceSet& c, const BlockSet& b, const Pose& pose,
                        const std::vector<double>& old_x1, const std::vector<double>& old_y1) {
  FaceMemory& m = c.before;
  std::fill(m.idle.begin(), m.idle.end(), std::uint8_t{0});
  parallel_for(c.size(), [&](std::size_t k) {
    const FaceEnds offset{c.offset_a[k], c.offset_b[k]};
    const Face now = face_at(c, b, pose.x, pose.y, k), then = face_at(c, b, pose.x1, pose.y1, k);
    const FaceEnds was = motion_of(now, offset, face_points(c, old_x1, old_y1, k)).slip;
    const FaceEnds is = motion_of(now, offset, face_points(c, pose.x1, pose.y1, k)).slip;
    // What holds keeps its force; what slides slips at the new velocity.
    if (c.now.slip_a[k] == c.now.trial_a[k]) m.slip_a[k] += was.a - is.a;
    if (c.now.slip_b[k] == c.now.trial_b[k]) m.slip_b[k] += was.b - is.b;
    m.closure_a[k] = then.closure.a;
    m.closure_b[k] = then.closure.b;
    m.energy[k] = then.energy;
    m.gate[k] = std::max(m.gate[k], then.gate);
  });
}

void next_step(FaceSet& c) {
  end_step(c, c.dashpots);
}

void stand_still(FaceSet& c) {
  end_step(c, true);
  c.now = c.before;
  for (auto* work :
       {&c.now.friction_work, &c.now.damping_work, &c.now.damping_due, &c.now.transfer}) {
    work->fill(0.0);
  }
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
  const double spring = m.spring[k], cohesion = 0.5 * c.cohesion[k] * face.cohesive;
  const auto again = [&](double normal, double trial, double slipped, double& force, double& slip) {
    const double limit = std::max(cohesion + c.friction[k] * normal, 0.0);
    const Shear next =
        cut(trial, spring, inverse_of(spring), c.bonded[k] > 0.0 ? unlimited_shear : limit);
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
