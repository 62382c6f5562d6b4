#include "step/faces_now.hpp"

#include <algorithm>
#include <vector>

#include "base/parallel.hpp"
#include "contacts/activity.hpp"
#include "contacts/evaluate_face.hpp"
#include "contacts/face_reading.hpp"
#include "contacts/tile_columns.hpp"
#include "contacts/tile_rows.hpp"
#include "contacts/tile_sweep.hpp"
#include "step/simulation.hpp"

namespace edda {
namespace {

Face face_now(const Simulation& sim, std::size_t k) {
  const Pose& pose = sim.motion.pose;
  return face_at(sim.motion.contacts, sim.scene->blocks, pose.x, pose.y, k);
}

/// Forces of the dashpots across the ends of face k, N.
FaceEnds dashpots_across(const Simulation& sim, std::size_t k) {
  const FaceTiles& t = sim.motion.tiled.tiles;
  const Id place = t.place[k][0];
  if (!t.dashpots || place == no_id) return {};
  const auto memory = get<DashpotMemoryColumns<double>>(t, t.now, place);
  return {memory.damping_a, memory.damping_b};
}

/// Faces, ascending, whose ratio may be larger than `above`: of a chunk the tiles know an
/// upper bound of the closures.
std::vector<Id> faces_that_may_exceed(const Simulation& sim, double above) {
  constexpr double rounding = 1e-9;  // in which the tiles may be off
  const FaceTiles& t = sim.motion.tiled.tiles;
  const FaceSet& c = sim.motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  const double least = (1.0 - rounding) * above;
  std::vector<Id> found;
  for (std::size_t q = 0; q < t.chunks(); ++q) {
    if (t.deepest[q] <= least * sim.scene->smallest_half_width) continue;
    for (std::size_t lane = 0; lane < lanes; ++lane) {
      const Id k = t.face[q * lanes + lane];
      if (k != no_id && t.deepest[q] > least * narrower_radius(b, c, k)) found.push_back(k);
    }
  }
  std::sort(found.begin(), found.end());
  found.erase(std::unique(found.begin(), found.end()), found.end());  // faces between two tiles
  return found;
}

}  // namespace

FaceRow face_row(const Simulation& sim, std::size_t k) {
  return face_row(sim.motion.contacts, sim.motion.tiled.tiles, sim.scene->blocks, sim.motion.pose,
                  k);
}

bool has_opened(const Simulation& sim, std::size_t k) {
  return sim.motion.tiled.tiles.has_ever(lane_bits::opens, k);
}

bool is_closed_now(const Simulation& sim, std::size_t k) {
  const FaceSet& c = sim.motion.contacts;
  const FaceTiles& t = sim.motion.tiled.tiles;
  return t.remembers(lane_bits::stored, k) || (c.bonded(k) && t.remembers(lane_bits::on, k));
}

namespace {

constexpr std::size_t cost_of_a_face = 100 / seldom;  // ns, of closed faces and open ones

FaceWork work_now(const Simulation& sim, std::size_t k) {
  const FaceSet& c = sim.motion.contacts;
  const FaceTiles& t = sim.motion.tiled.tiles;
  const Id place = t.place[k][0];
  if (place == no_id) return {0.0, 0.0, c.fracture_work[k], 0.0, 0.0};
  const auto sums = get<FaceSumColumns<double>>(t.sums, place);
  const bool fresh = t.fresh[t.now][place / lanes] != 0;
  return {sums.friction_work, sums.damping_work, c.fracture_work[k], sums.transfer,
          fresh ? get<FaceWorkColumns<double>>(t, t.now, place).damping_due : 0.0};
}

/// Normal force of face k, which is this element now, N.
double normal_of(const Simulation& sim, const Face& face, std::size_t k) {
  const FaceEnds dashpots = dashpots_across(sim, k);
  return face.normal.a + face.normal.b + dashpots.a + dashpots.b;
}

NormalNow normal_now(const Simulation& sim, std::size_t k) {
  if (!is_closed_now(sim, k)) return {};
  const FaceSet& c = sim.motion.contacts;
  const Face face = face_now(sim, k);
  return {normal_of(sim, face, k), c.stiffness[k] * std::max(face.length, 0.0) * face.gate};
}

template <class Value, class Of>
std::vector<Value> of_all_faces(const Simulation& sim, Of of) {
  std::vector<Value> values(sim.motion.contacts.size());
  parallel_for(
      values.size(), [&](std::size_t k) { values[k] = of(k); }, cost_of_a_face);
  return values;
}

}  // namespace

double normal_force_now(const Simulation& sim, std::size_t k) {
  return normal_now(sim, k).force;
}

std::vector<double> normal_forces_now(const Simulation& sim) {
  return of_all_faces<double>(sim, [&](std::size_t k) { return normal_force_now(sim, k); });
}

FaceMeasures measure_faces(const Simulation& sim) {
  const FaceSet& c = sim.motion.contacts;
  const FaceTiles& t = sim.motion.tiled.tiles;
  FaceMeasures all{std::vector<double>(c.size(), 0.0), std::vector<double>(c.size(), 0.0),
                   std::vector<FaceWork>(c.size())};
  std::vector<char> no_scratch;
  parallel_tasks(t.tiles.size(), 20 * c.size(), no_scratch, [&](std::size_t tile, char&) {
    measure_tile(t, c, sim.scene->blocks, sim.motion.pose, tile, all.energy, all.normal);
  });
  const auto add = [&](std::size_t k) {
    all.work[k] = work_now(sim, k);
    if (!t.dashpots || !is_closed_now(sim, k)) return;
    const FaceEnds dashpots = dashpots_across(sim, k);
    all.normal[k] = all.normal[k] + dashpots.a + dashpots.b;
  };
  parallel_for(c.size(), add, 5);
  return all;
}

std::vector<NormalNow> normals_now(const Simulation& sim, const std::vector<std::uint8_t>& of) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& c = sim.motion.contacts;
  return of_all_faces<NormalNow>(sim, [&](std::size_t k) {
    const bool wanted = of[block_of_edge(b, c, k)] != 0 || of[block_of_facing(b, c, k)] != 0;
    return wanted ? normal_now(sim, k) : NormalNow{};
  });
}

DeepestNow deepest_now(const Simulation& sim, double above) {
  const FaceSet& c = sim.motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  const Pose& pose = sim.motion.pose;
  DeepestNow deepest;
  for (const Id k : faces_that_may_exceed(sim, above)) {
    const Face face = face_now(sim, k);
    const double depth = drawn_closure(c, face.closure, k), radius = narrower_radius(b, c, k);
    if (!(face.energy > 0.0) || !(depth > std::max(above, deepest.ratio) * radius)) continue;
    if (!overlap_where_pressed(c, b, pose, face, k)) continue;
    const FacePoints at = face_points(c, pose.x, pose.y, k);
    deepest = {k, depth / radius, depth, deeper_end(at, face.closure, face.xi, face.eta)};
  }
  return deepest;
}

}  // namespace edda
