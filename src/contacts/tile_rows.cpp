#include "contacts/tile_rows.hpp"

#include <algorithm>
#include <iterator>

#include "base/parallel.hpp"
#include "contacts/evaluate_face.hpp"
#include "contacts/face_step.hpp"
#include "contacts/tile_columns.hpp"

namespace edda {

FaceFields remembered(const FaceTiles& t, int which, std::size_t k) {
  const Id place = t.place[k][0];
  const auto memory = get<FaceMemoryColumns<double>>(t, which, place);
  const LaneBits bits = t.bits[which][place / lanes];
  const auto was = [&](unsigned of) {
    return lane_bits::test(bits, of, place % lanes) ? 1.0 : 0.0;
  };
  FaceFields m{};
  m.energy = was(lane_bits::stored);
  m.gate = was(lane_bits::on);
  m.closure_a = was(lane_bits::closed_a);
  m.closure_b = was(lane_bits::closed_b);
  m.switched = was(lane_bits::switched);
  for_memory(t, [&]<class Fields>() { take_columns(m, get<Fields>(t, which, place)); });
  const bool kept = t.fresh[which][place / lanes] != 0;
  take_columns(m, kept ? get<FaceWorkColumns<double>>(t, which, place) : no_work(memory));
  if (!(m.spring > 0.0)) m.overlap = 0.0;
  return m;
}

FaceFields remembered(const FaceTiles& t, std::size_t k) {
  return remembered(t, 1 - t.now, k);
}

FaceRow face_row(const FaceSet& c, const FaceTiles& t, const BlockSet& b, const Pose& pose,
                 std::size_t k) {
  FaceRow row{c, k, {}, {}, false, false};
  const Id place = t.place[k][0];
  if (place == no_id) return row;
  row.opened = t.has_ever(lane_bits::opens, k);
  row.slipped = t.has_ever(lane_bits::slides, k);
  const FacePair pair = face_pair(c, b, k);
  const FacePoints at = face_points(c, pose.x, pose.y, k);
  const EdgeGeometry stands = geometry_of_edges(at, pair);
  const Face face = face_between(stands, pair);
  // A face that is new in the list has no state until its first step.
  if (face.gate > 0.0 && !t.remembers(lane_bits::on, k)) return row;
  FaceFields& m = row.state;
  m = remembered(t, t.now, k);
  take_element(m, face);
  const FaceEnds shear{m.shear_a, m.shear_b}, bounds = locked_closure_forces(face, pair);
  // The formula of the step: with and without dashpots the sums round differently.
  row.force = t.dashpots ? force_of<true, true>(face, stands, shear, {m.damping_a, m.damping_b},
                                                {m.shear_damping_a, m.shear_damping_b}, bounds)
                         : force_of<false, true>(face, stands, shear, {}, {}, bounds);
  return row;
}

void recall_work(FaceSet& c, const FaceTiles& t, std::size_t k) {
  const Id place = t.place[k][0];
  const auto sums = get<FaceSumColumns<double>>(t.sums, place);
  c.friction_work[k] = sums.friction_work;
  c.transfer[k] = sums.transfer;
  c.damping_work[k] = sums.damping_work;
  c.set(FaceFlag::opened, k, t.has_ever(lane_bits::opens, k));
  c.set(FaceFlag::slipped, k, t.has_ever(lane_bits::slides, k));
}

void recall_work(FaceSet& c, const FaceTiles& t) {
  const auto recall = [&](std::size_t k) {
    if (t.place[k][0] != no_id) recall_work(c, t, k);
  };
  parallel_for(c.size(), recall, 5);
}

bool stays_open(const FaceTiles& t, const FaceSet& c, const BlockSet& b, const Pose& pose,
                std::size_t k) {
  FaceInputs in{};
  in.pair = face_pair(c, b, k);
  in.at = face_points(c, pose.x, pose.y, k);
  in.noise = c.noise;
  const std::size_t place = t.place[k][0];
  in.before.on = lane_bits::test(t.bits[1 - t.now][place / lanes], lane_bits::on, place % lanes);
  const OpenFace s = test_open_face(in);
  return !s.may_close && (s.gate > 0.0) == in.before.on;
}

FaceStates states_of(const FaceSet& c, const FaceTiles& t, const BlockSet& b, const Pose& pose) {
  FaceStates states(c.size());
  const auto unload = [&](std::size_t k) {
    if (t.place[k][0] == no_id) return;
    states.now[k] = face_row(c, t, b, pose, k).state;
    states.before[k] = remembered(t, k);
  };
  parallel_for(c.size(), unload, 150);
  return states;
}

std::vector<double> corner_forces(const FaceSet& c, const FaceTiles& t, const BlockSet& b,
                                  const Pose& pose) {
  std::vector<double> forces(8 * c.size(), 0.0);
  const auto unload = [&](std::size_t k) { put(&forces[8 * k], face_row(c, t, b, pose, k).force); };
  parallel_for(c.size(), unload, 150);
  return forces;
}

namespace {

/// What a face that loses its strength takes by friction in that step counts as fracture.
void move_friction_to_fracture(FaceSet& c, FaceTiles& t, std::size_t k) {
  for (const Id place : t.place[k]) {
    if (place == no_id || t.fresh[t.now][place / lanes] == 0) continue;
    double& friction = number_at(t, t.now, place, &FaceWorkColumns<double>::friction_work);
    if (place == t.place[k][0]) c.fracture_work[k] += friction;
    friction = 0.0;
  }
}

/// Adds the work of the step of a chunk to the accumulated work.
EDDA_VECTOR void add_work(const double* work, double* sums) {
  const auto w = columns_from<FaceWorkColumns<const double*>>(work);
  const auto of = columns_from<FaceSumColumns<double*>>(sums);
#pragma omp simd
  for (std::size_t k = 0; k < lanes; ++k) {
    of.friction_work[k] += w.friction_work[k];
    of.transfer[k] += w.transfer[k];
    of.damping_work[k] += w.damping_work[k] + w.damping_due[k];
  }
}

}  // namespace

void next_step(FaceSet& c, FaceTiles& t) {
  c.for_failures([&](std::size_t k) { move_friction_to_fracture(c, t, k); });
  count_failures(c);
  constexpr LaneBits lasting =
      lane_bits::field(lane_bits::opens) | lane_bits::field(lane_bits::slides);
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), t.face.size(), no_scratch, [&](std::size_t tile, char&) {
    for (Id q = t.tiles[tile].first_chunk; q < t.tiles[tile].awake_end; ++q) {
      if (t.fresh[t.now][q] == 0) continue;
      add_work(chunk_of<FaceWorkColumns<double>>(t.numbers[tile], t.now, q),
               &t.sums[q * sum_columns * lanes]);
      t.ever[q] |= t.found[t.now][q] & lasting;
    }
  });
  t.now = 1 - t.now;
}

}  // namespace edda
