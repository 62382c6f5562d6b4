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

MemoryView faces_view(FaceMemory& m) {
  return {m.closure_a.data(), m.closure_b.data(),     m.energy.data(),       m.normal_a.data(),
          m.normal_b.data(),  m.shear_a.data(),       m.shear_b.data(),      m.damping_a.data(),
          m.damping_b.data(), m.drag_a.data(),        m.drag_b.data(),       m.slip_a.data(),
          m.slip_b.data(),    m.trial_a.data(),       m.trial_b.data(),      m.spring.data(),
          m.length.data(),    m.overlap.data(),       m.cohesive.data(),     m.gate.data(),
          m.xi_a.data(),      m.xi_b.data(),          m.eta_a.data(),        m.eta_b.data(),
          m.switched.data(),  m.friction_work.data(), m.damping_work.data(), m.damping_due.data(),
          m.transfer.data()};
}

FaceView faces_view(FaceSet& c, const BlockSet& b, const Pose& pose, double step,
                    const ShearLimits* limits = nullptr) {
  return {c.edge.data(),
          c.edge_end.data(),
          c.facing.data(),
          c.facing_end.data(),
          c.stiffness.data(),
          c.shear_stiffness.data(),
          c.inverse_e.data(),
          c.inverse_f.data(),
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
          limits == nullptr ? nullptr : limits->a.data(),
          limits == nullptr ? nullptr : limits->b.data(),
          faces_view(c.now),
          faces_view(c.before)};
}

/// Forces of a chunk, by corner.
struct ChunkForces {
  double p1x[FaceSet::chunk], p1y[FaceSet::chunk], p2x[FaceSet::chunk], p2y[FaceSet::chunk],
      q1x[FaceSet::chunk], q1y[FaceSet::chunk], q2x[FaceSet::chunk], q2y[FaceSet::chunk];
};

struct FoundInChunk {
  bool asks, stirs, works;
  double deepest;
};

template <bool dashpots, bool held = false>
EDDA_INLINE void place_into(const FaceView& c, ChunkForces& on, std::size_t k, std::size_t q,
                            double& asking, double& stirring, double& working, double& deepest) {
  const Placed placed = place<dashpots, held>(c, k);
  on.p1x[q] = placed.force.p1.x;
  on.p1y[q] = placed.force.p1.y;
  on.p2x[q] = placed.force.p2.x;
  on.p2y[q] = placed.force.p2.y;
  on.q1x[q] = placed.force.q1.x;
  on.q1y[q] = placed.force.q1.y;
  on.q2x[q] = placed.force.q2.x;
  on.q2y[q] = placed.force.q2.y;
  asking = larger(asking, placed.asks);
  stirring = larger(stirring, placed.stirs);
  working = larger(working, placed.works);
  deepest = larger(deepest, placed.depth);
}

EDDA_VECTOR FoundInChunk place_undamped(FaceView c, ChunkForces* on, std::size_t first,
                                        std::size_t last) {
  double asking = 0.0, stirring = 0.0, working = 0.0, deepest = 0.0;
#pragma omp simd reduction(max : asking, stirring, working, deepest)
  for (std::size_t k = first; k < last; ++k) {
    place_into<false>(c, *on, k, k - first, asking, stirring, working, deepest);
  }
  return {asking > 0.0, stirring > 0.0, working > 0.0, deepest};
}

EDDA_VECTOR FoundInChunk place_damped(FaceView c, ChunkForces* on, std::size_t first,
                                      std::size_t last) {
  double asking = 0.0, stirring = 0.0, working = 0.0, deepest = 0.0;
#pragma omp simd reduction(max : asking, stirring, working, deepest)
  for (std::size_t k = first; k < last; ++k) {
    place_into<true>(c, *on, k, k - first, asking, stirring, working, deepest);
  }
  return {asking > 0.0, stirring > 0.0, working > 0.0, deepest};
}

template <bool dashpots>
FoundInChunk place_held(const FaceView& c, ChunkForces* on, std::size_t first, std::size_t last) {
  double asking = 0.0, stirring = 0.0, working = 0.0, deepest = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    place_into<dashpots, true>(c, *on, k, k - first, asking, stirring, working, deepest);
  }
  return {asking > 0.0, stirring > 0.0, working > 0.0, deepest};
}

/// Whether one of the faces [first, last), which have carried nothing for two steps, needs more
/// than a look.
EDDA_VECTOR bool wakes_chunk(FaceView c, std::size_t first, std::size_t last) {
  double waking = 0.0;
#pragma omp simd reduction(max : waking)
  for (std::size_t k = first; k < last; ++k) waking = larger(waking, wakes(c, k) ? 1.0 : 0.0);
  return waking > 0.0;
}

FoundInChunk place_chunk(const FaceView& c, ChunkForces* on, std::size_t first, std::size_t last) {
  if (c.limit_a != nullptr) {
    return c.damped ? place_held<true>(c, on, first, last) : place_held<false>(c, on, first, last);
  }
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

/// Where the columns lie that a step reads or writes. There are more of them than a processor
/// foresees by itself: models beyond its caches would wait for each.
std::vector<const double*> columns_of_step(const FaceSet& c) {
  std::vector<const double*> at;
  for (const FaceColumn& column : face_columns) {
    at.push_back((c.now.*column.values).data());
    at.push_back((c.before.*column.values).data());
  }
  for (const auto* values :
       {&c.stiffness, &c.shear_stiffness, &c.inverse_e, &c.inverse_f, &c.gate_from, &c.gate_scale,
        &c.passing, &c.at_ends, &c.acts, &c.leans, &c.friction, &c.cohesion, &c.offset_a,
        &c.offset_b, &c.pulls, &c.bonded}) {
    at.push_back(values->data());
  }
  return at;
}

/// Asks for the faces [first, last) from memory.
void fetch(const FaceSet& c, const std::vector<const double*>& columns, std::size_t first,
           std::size_t last) {
  constexpr std::size_t line = 8;  // numbers
  for (const double* at : columns) {
    for (std::size_t k = first; k < last; k += line) __builtin_prefetch(at + k);
  }
  for (std::size_t k = first; k < last; ++k) {
    __builtin_prefetch(c.force.data() + 4 * std::size_t{c.slot[k]}, 1);
    __builtin_prefetch(c.force.data() + 4 * std::size_t{c.facing_slot[k]}, 1);
  }
}

void place_chunks(FaceSet& c, const FaceView& view, const std::vector<const double*>& columns,
                  const BlockSet& b, const Pose& pose, const LawTable* laws, std::size_t begin,
                  std::size_t end) {
  ChunkForces on;
  for (std::size_t first = begin; first < end; first += FaceSet::chunk) {
    fetch(c, columns, std::min(first + FaceSet::chunk, end),
          std::min(first + 2 * FaceSet::chunk, end));
    const std::size_t last = std::min(end, first + FaceSet::chunk), q = first / FaceSet::chunk;
    const bool idle = c.now.idle[q] && c.before.idle[q] && !c.bonds[q] && view.limit_a == nullptr;
    if (idle && !wakes_chunk(view, first, last)) {
      c.stirs[q] = 0;
      c.deepest[q] = 0.0;
      continue;
    }
    FoundInChunk found = place_chunk(view, &on, first, last);
    if (found.asks) {
      for (std::size_t k = first; k < last; ++k) {
        const Face face = face_at(c, b, pose.x, pose.y, k);
        if (asks(view, face, k)) judge_face(c, b, pose, k);
      }
      found = place_chunk(view, &on, first, last);
    }
    if (laws != nullptr && c.bonds[q] != 0 && break_bonds(c, b, pose, *laws, first, last)) {
      found = place_chunk(view, &on, first, last);
    }
    c.now.idle[q] = found.works ? 0 : 1;
    c.stirs[q] = found.stirs ? 1 : 0;
    c.deepest[q] = found.deepest;
    keep_forces(c, on, first, last);
  }
}

/// laws: of the bonds that may break, if any.
void place_all(FaceSet& c, const FaceView& view, const BlockSet& b, const Pose& pose,
               const LawTable* laws) {
  const std::vector<const double*> columns = columns_of_step(c);
  parallel_chunks(c.size(), FaceSet::run, [&](std::size_t, std::size_t begin, std::size_t end) {
    place_chunks(c, view, columns, b, pose, laws, begin, end);
  });
}

/// What has been worked out is final; dashpots: of the faces, or of the method.
void end_step(FaceSet& c, bool dashpots) {
  if (c.gluing) glue_pressed(c);
  parallel_for(c.size(), [&](std::size_t k) {
    if (c.now.idle[k / FaceSet::chunk] != 0) return;
    (c.breaks[k] > 0.0 ? c.fracture_work : c.friction_work)[k] += c.now.friction_work[k];
    if (dashpots) c.damping_work[k] += c.now.damping_work[k] + c.now.damping_due[k];
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

}  // namespace

void place_faces(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws,
                 double step) {
  place_all(c, faces_view(c, b, pose, step), b, pose, &laws);
}

void try_faces(FaceSet& c, const BlockSet& b, const Pose& pose, double step,
               const ShearLimits& limits) {
  place_all(c, faces_view(c, b, pose, step, &limits), b, pose, nullptr);
}

void place_face(FaceSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws, double step,
                std::size_t k) {
  const FaceView view = faces_view(c, b, pose, step);
  const FaceMemory &m = c.now, &old = c.before;
  const bool idle = m.energy[k] == 0.0 && old.energy[k] == 0.0 && old.spring[k] == 0.0 &&
                    m.friction_work[k] == 0.0 && m.transfer[k] == 0.0 && m.damping_due[k] == 0.0 &&
                    c.bonded[k] == 0.0 && c.pulls[k] == 0.0;
  if (idle && !wakes_chunk(view, k, k + 1)) return;
  ChunkForces on;
  FoundInChunk found = place_chunk(view, &on, k, k + 1);
  if (found.asks) {
    judge_face(c, b, pose, k);
    found = place_chunk(view, &on, k, k + 1);
  }
  if (break_bonds(c, b, pose, laws, k, k + 1)) found = place_chunk(view, &on, k, k + 1);
  if (found.stirs) c.stirs[k / FaceSet::chunk] = 1;
  if (found.works) c.now.idle[k / FaceSet::chunk] = 0;
  keep_forces(c, on, k, k + 1);
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
  end_step(c, !c.zeta.empty());
}

void stand_still(FaceSet& c) {
  end_step(c, true);
  c.now = c.before;
  for (auto* work :
       {&c.now.friction_work, &c.now.damping_work, &c.now.damping_due, &c.now.transfer}) {
    std::fill(work->begin(), work->end(), 0.0);
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
