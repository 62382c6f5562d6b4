#include "contacts/evaluate_faces.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "base/parallel.hpp"
#include "contacts/activity.hpp"
#include "contacts/face_bonds.hpp"
#include "contacts/face_columns.hpp"
#include "contacts/face_energy.hpp"

namespace edda {
namespace {

/// Data that all chunks read; members as in FaceView.
struct AllFaces {
  const double *exterior_cosine, *exterior_sine;
  const double *x, *y, *x1, *y1;
  double noise;
  const double *point_inverse, *edge_inverse;
  double step;
};
AllFaces all_faces(const FaceSet& c, const FaceScene& scene, double step) {
  const Pose& pose = scene.pose;
  return {scene.blocks.exterior_cosine.data(),
          scene.blocks.exterior_sine.data(),
          pose.x.data(),
          pose.y.data(),
          pose.x1.data(),
          pose.y1.data(),
          c.noise,
          scene.masses.point_inverse.data(),
          scene.masses.edge_inverse.data(),
          step};
}

/// Addresses of the data of a chunk.
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
  v.exterior_cosine = all.exterior_cosine;
  v.exterior_sine = all.exterior_sine;
  v.x = all.x;
  v.y = all.y;
  v.x1 = all.x1;
  v.y1 = all.y1;
  v.noise = all.noise;
  v.point_inverse = all.point_inverse;
  v.edge_inverse = all.edge_inverse;
  v.per_step = 1.0 / all.step;
  v.now = columns_of_chunk<FaceFields<double*>, face_fields<double*>>(at.now);
  v.before = columns_of_chunk<FaceFields<const double*>, face_fields<const double*>>(at.before);
  v.force = at.force;
  return v;
}

/// What evaluating a chunk has found: whether any of its faces has the flag (see FaceStep), and the
/// largest depth.
struct ChunkResult {
  bool decides, switching, works;
  double deepest;
};

template <bool dashpots>
EDDA_INLINE void evaluate_into(const FaceView& c, std::size_t k, double& deciding,
                               double& switching, double& working, double& deepest) {
  const FaceInputs in = inputs_of<dashpots>(c, k);
  const EdgeGeometry stands = geometry_of_edges(in.at, in.pair);
  const Face face = face_between(stands, in.pair);
  const FaceStep s = step_of_face<dashpots, false, Formulas::all>(in, stands, face);
  write_face<dashpots>(c, face, s, k);
  put(c.force + 8 * k, s.force);
  deciding = larger(deciding, s.decides ? 1.0 : 0.0);
  switching = larger(switching, s.switching ? 1.0 : 0.0);
  working = larger(working, s.works ? 1.0 : 0.0);
  deepest = larger(deepest, s.depth);
}

/// Evaluates all rows of a chunk.
template <bool dashpots>
EDDA_INLINE ChunkResult evaluate_rows(const AllFaces& all, const ChunkPlace& at) {
  const FaceView c = view_of(all, at);
  double deciding = 0.0, switching = 0.0, working = 0.0, deepest = 0.0;
#pragma omp simd reduction(max : deciding, switching, working, deepest)
  for (std::size_t k = 0; k < FaceSet::chunk; ++k) {
    evaluate_into<dashpots>(c, k, deciding, switching, working, deepest);
  }
  return {deciding > 0.0, switching > 0.0, working > 0.0, deepest};
}
EDDA_VECTOR ChunkResult evaluate_undamped(const AllFaces& all, const ChunkPlace& at) {
  return evaluate_rows<false>(all, at);
}
EDDA_VECTOR ChunkResult evaluate_damped(const AllFaces& all, const ChunkPlace& at) {
  return evaluate_rows<true>(all, at);
}

/// Evaluates the rows [first, last) alone, one by one.
template <bool dashpots>
ChunkResult evaluate_rows(const AllFaces& all, const ChunkPlace& at, std::size_t first,
                          std::size_t last) {
  const FaceView c = view_of(all, at);
  double deciding = 0.0, switching = 0.0, working = 0.0, deepest = 0.0;
  for (std::size_t k = first; k < last; ++k) {
    evaluate_into<dashpots>(c, k, deciding, switching, working, deepest);
  }
  return {deciding > 0.0, switching > 0.0, working > 0.0, deepest};
}

/// Updates the geometry of a face that has carried no load for two steps. Returns whether it needs
/// more than that.
EDDA_INLINE bool may_close(const FaceView& c, std::size_t k) {
  const OpenFace s = look_at_open_face(inputs_of<false>(c, k));
  write_open_face(c, s, k);
  return s.may_close;
}
/// The same for a chunk.
EDDA_VECTOR bool chunk_may_close(const AllFaces& all, const ChunkPlace& at) {
  const FaceView c = view_of(all, at);
  double switching = 0.0;
#pragma omp simd reduction(max : switching)
  for (std::size_t k = 0; k < FaceSet::chunk; ++k)
    switching = larger(switching, may_close(c, k) ? 1.0 : 0.0);
  return switching > 0.0;
}

/// A row of a chunk of states.
FaceFields<double> row_in(const FaceFields<double*>& chunk, std::size_t row) {
  FaceFields<double> fields;
  for (std::size_t i = 0; i < std::size(face_fields<double>); ++i)
    fields.*face_fields<double>[i].values = (chunk.*face_fields<double*>[i].values)[row];
  return fields;
}

/// Breaks the bonds of those faces of [first, last), of this chunk, that fail. Returns whether any
/// does.
bool break_bonds(FaceSet& c, const FaceScene& scene, const FaceFields<double*>& chunk,
                 std::size_t first, std::size_t last) {
  const BlockSet& b = scene.blocks;
  const Pose& pose = scene.pose;
  bool any = false;
  for (std::size_t k = first; k < last; ++k) {
    if (c.bonded[k] == 0.0 && c.carries_tension[k] == 0.0) continue;
    const FaceFields<double> now = row_in(chunk, k % FaceSet::chunk);
    if (!bond_fails(c, b, now, k)) continue;
    const double stored = normal_energy(c, b, pose, k);
    break_bond(c, b, scene.laws, now, k);
    account_failure_energy(c, stored - normal_energy(c, b, pose, k), k);
    any = true;
  }
  return any;
}

/// Evaluates the faces [first, last), all of the chunk `at`.
ChunkResult evaluate_part(const FaceSet& c, const AllFaces& all, const ChunkPlace& at,
                          std::size_t first, std::size_t last) {
  const std::size_t from = first % FaceSet::chunk, to = from + (last - first);
  if (from == 0 && last == std::min(first + FaceSet::chunk, c.size()))
    return c.dashpots ? evaluate_damped(all, at) : evaluate_undamped(all, at);
  return c.dashpots ? evaluate_rows<true>(all, at, from, to)
                    : evaluate_rows<false>(all, at, from, to);
}

/// The same, with pending decisions (decide_activity()) and failure of bonds.
ChunkResult evaluate_with_laws(FaceSet& c, const AllFaces& all, const FaceScene& scene,
                               const ChunkPlace& at, std::size_t first, std::size_t last) {
  ChunkResult found = evaluate_part(c, all, at, first, last);
  const FaceView view = view_of(all, at);
  if (found.decides) {
    bool changes = false;
    for (std::size_t k = first; k < last; ++k) {
      const std::size_t row = k % FaceSet::chunk;
      const FaceEnds drawn{view.now.closure_a[row] - view.locked_closure_a[row],
                           view.now.closure_b[row] - view.locked_closure_b[row]};
      if (needs_decision(inputs_of<false>(view, row), view.now.gate[row] > 0.0, drawn,
                         view.now.energy[row] > 0.0) &&
          decide_activity(c, scene.blocks, scene.pose,
                          {view.before.energy[row] > 0.0, view.before.gate[row] > 0.0}, k))
        changes = true;
    }
    if (changes) found = evaluate_part(c, all, at, first, last);
  }
  const bool bonds = c.bonds[first / FaceSet::chunk] != 0;
  if (bonds && break_bonds(c, scene, view.now, first, last)) {
    found = evaluate_part(c, all, at, first, last);
  }
  return found;
}

void evaluate_chunks(FaceSet& c, const AllFaces& all, const FaceScene& scene, std::size_t begin,
                     std::size_t end) {
  for (std::size_t first = begin; first < end; first += FaceSet::chunk) {
    const std::size_t last = std::min(end, first + FaceSet::chunk), q = first / FaceSet::chunk;
    const bool inactive = c.now.inactive[q] && c.before.inactive[q] && !c.bonds[q];
    const ChunkPlace at = chunk_place(c, q);
    if (inactive && !chunk_may_close(all, at)) {
      c.switching[q] = 0;
      c.deepest[q] = 0.0;
      continue;
    }
    const ChunkResult found = evaluate_with_laws(c, all, scene, at, first, last);
    c.now.inactive[q] = found.works ? 0 : 1;
    c.switching[q] = found.switching ? 1 : 0;
    c.deepest[q] = found.deepest;
  }
}

void evaluate_all(FaceSet& c, const AllFaces& all, const FaceScene& scene) {
  parallel_chunks(c.size(), FaceSet::run, 40, [&](std::size_t, std::size_t begin, std::size_t end) {
    evaluate_chunks(c, all, scene, begin, end);
  });
}

/// Adds the work of a step to the accumulated work, for the faces of a chunk.
struct ChunkAccounts {
  FaceProperties<double*> of;
  FaceFields<const double*> now, before;
};
EDDA_INLINE void end_step(const ChunkAccounts& c, bool dashpots, std::size_t k) {
  const FaceFields<const double*>& m = c.now;
  const bool fails = c.of.failure[k] > 0.0;
  const double taken = m.friction_work[k];
  c.of.fracture_work[k] += fails ? taken : 0.0;
  c.of.friction_work[k] += fails ? 0.0 : taken;
  if (dashpots) c.of.damping_work[k] += m.damping_work[k] + m.damping_due[k];
  const bool cut = is_cut({m.trial_a[k], m.trial_b[k]}, {m.slip_a[k], m.slip_b[k]});
  const bool opens = (c.before.energy[k] > 0.0) & (m.energy[k] == 0.0);
  c.of.slipped[k] = cut ? 1.0 : c.of.slipped[k];
  c.of.opened[k] = opens ? 1.0 : c.of.opened[k];
  c.of.transfer[k] += m.transfer[k];
}
EDDA_VECTOR void end_step_of_chunk(double* properties, const double* now, const double* before,
                                   bool dashpots) {
  const ChunkAccounts c{
      columns_of_chunk<FaceProperties<double*>, face_property_list<double*>>(properties),
      columns_of_chunk<FaceFields<const double*>, face_fields<const double*>>(now),
      columns_of_chunk<FaceFields<const double*>, face_fields<const double*>>(before)};
#pragma omp simd
  for (std::size_t k = 0; k < FaceSet::chunk; ++k) end_step(c, dashpots, k);
}

/// Makes the step final; dashpots: whether dashpots, or the damping of the implicit scheme, have
/// done work.
void end_step(FaceSet& c, bool dashpots) {
  if (c.gluing) glue_pressed(c);
  parallel_chunks(c.size(), FaceSet::run, 5, [&](std::size_t, std::size_t begin, std::size_t end) {
    for (std::size_t q = begin / FaceSet::chunk; q * FaceSet::chunk < end; ++q) {
      if (c.now.inactive[q] != 0) continue;
      end_step_of_chunk(c.begin_of_chunk(q), c.now.begin_of_chunk(q), c.before.begin_of_chunk(q),
                        dashpots);
    }
  });
  count_failures(c);
  std::swap(c.now, c.before);
}

}  // namespace

void count_failures(FaceSet& c) {
  c.for_failures([&](std::size_t k) {
    if (c.failure[k] == bond_breaks) ++c.broken;
    c.failure[k] = 0.0;
  });
  std::fill(c.chunk_fails.begin(), c.chunk_fails.end(), std::uint8_t{0});
}

void evaluate_faces(FaceSet& c, const FaceScene& scene, double step) {
  evaluate_all(c, all_faces(c, scene, step), scene);
}

void evaluate_face(FaceSet& c, const FaceScene& scene, double step, std::size_t k) {
  const AllFaces all = all_faces(c, scene, step);
  const std::size_t q = k / FaceSet::chunk;
  const FaceMemory &m = c.now, &old = c.before;
  const bool inactive = m.energy[k] == 0.0 && old.energy[k] == 0.0 && old.spring[k] == 0.0 &&
                        m.friction_work[k] == 0.0 && m.transfer[k] == 0.0 &&
                        m.damping_due[k] == 0.0 && c.bonded[k] == 0.0 &&
                        c.carries_tension[k] == 0.0;
  const ChunkPlace at = chunk_place(c, q);
  if (inactive && !may_close(view_of(all, at), k % FaceSet::chunk)) return;
  const ChunkResult found = evaluate_with_laws(c, all, scene, at, k, k + 1);
  c.deepest[q] = std::max(c.deepest[q], found.deepest);
  if (found.switching) c.switching[q] = 1;
  if (found.works) c.now.inactive[q] = 0;
}

void decide_face(FaceSet& c, const FaceScene& scene, double step, const FaceFields<double>& before,
                 std::size_t k) {
  FaceMemory was, is;
  for (FaceMemory* m : {&was, &is}) m->clear_rows(FaceSet::chunk);
  set_row(was, k % FaceSet::chunk, before);
  double force[8 * FaceSet::chunk];
  const std::size_t q = k / FaceSet::chunk;
  const ChunkPlace at{c.corners.data() + q * 4 * FaceSet::chunk, c.begin_of_chunk(q),
                      is.begin_of_chunk(0), was.begin_of_chunk(0), &force[0]};
  evaluate_with_laws(c, all_faces(c, scene, step), scene, at, k, k + 1);
}

void next_step(FaceSet& c) {
  end_step(c, c.dashpots);
}

void begin_from_step_end(FaceSet& c) {
  end_step(c, true);
  c.now = c.before;
  for (auto* work :
       {&c.now.friction_work, &c.now.damping_work, &c.now.damping_due, &c.now.transfer}) {
    work->fill(0.0);
  }
}

Face face_at(const FaceSet& c, const BlockSet& b, const std::vector<double>& x,
             const std::vector<double>& y, std::size_t k, double risen) {
  FacePair pair = face_pair(c, b.exterior_cosine.data(), b.exterior_sine.data(), k);
  pair.offset = {pair.offset.a - risen, pair.offset.b - risen};
  return face_between(face_points(c, x, y, k), pair);
}

}  // namespace edda
