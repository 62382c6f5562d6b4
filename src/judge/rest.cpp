#include "judge/rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/gravity.hpp"
#include "contacts/face_reading.hpp"
#include "observe/balance.hpp"
#include "step/faces_now.hpp"

namespace edda {
namespace {

/// About half a period of the motion, in steps: a block that reaches equilibrium has slowed down
/// markedly by then.
std::uint64_t window_of(const Simulation& sim) {
  constexpr double least = 128.0, most = 512.0;
  const double turn = sim.relaxation.estimate.frequency * sim.motion.state.step;
  return static_cast<std::uint64_t>(turn > 0.0 ? std::clamp(std::numbers::pi / turn, least, most)
                                               : least);
}

/// A mesh is at rest where no node will move further than rest_part/zone_parts of its zones: an
/// opening has some ten of them along its radius. A node is taken to move on for so many windows
/// at most.
constexpr double zone_parts = 0.1, most_windows = 100.0;

double size_of(const Simulation& sim, std::size_t i) {
  return std::sqrt(sim.scene->blocks.area[i]);
}

/// Resultant of the forces on block i in the last step, less their rounding, N.
double force_on(const Simulation& sim, std::size_t i, double rounding) {
  return std::max(resultant_on(sim, i) - rounding, 0.0);
}

/// Sums over the faces and supports of each block, [nb] N.
struct NormalSums {
  std::vector<double> rounding;  ///< forces that follow from the rounding of coordinates: a small
                                 ///< block wedged between large ones does not balance any better
  std::vector<double> pressed;   ///< half of the normal forces
};

/// Of the blocks of which this is 1, [nb].
NormalSums normal_sums(const Simulation& sim, const std::vector<std::uint8_t>& of) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  NormalSums sums{std::vector<double>(b.size(), 0.0), std::vector<double>(b.size(), 0.0)};
  const std::vector<NormalNow> normals = normals_now(sim, of);
  for (std::size_t k = 0; k < f.size(); ++k) {
    for (const Id i : {block_of_edge(b, f, k), block_of_facing(b, f, k)}) {
      sums.rounding[i] += 0.5 * f.noise * normals[k].spring;
      sums.pressed[i] += 0.5 * std::max(normals[k].force, 0.0);
    }
  }
  const BoundarySprings& s = sim.attached.springs;
  for (std::size_t q = 0; q < s.size(); ++q)
    sums.rounding[b.vertex_block[s.vertex[q]]] += f.noise * std::max(s.kxx[q], s.kyy[q]);
  return sums;
}

/// What the sum of unbalanced forces on mesh nodes may be by rounding, N.
double rounding_of_zones(const Simulation& sim) {
  constexpr double part = 1e-12;
  double sum = 0.0;
  for (const std::array<Vec2, 3>& on_corners : sim.motion.zones.force) {
    for (const Vec2 force : on_corners) sum += norm(force);
  }
  return part * sum;
}

}  // namespace

double rest_time(double size, double acceleration) {
  return rest_times * std::sqrt(size / (acceleration > 0.0 ? acceleration : usual_acceleration));
}

double longest_rest_time(const Simulation& sim) {
  const LoadsNow acting = loads_at(sim.scene->model, sim.attached.loads, sim.motion.state.time);
  double longest = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    longest = std::max(longest, rest_time(size_of(sim, i), acceleration_on(sim, acting, i)));
  }
  return longest;
}

double acceleration_on(const Simulation& sim, const LoadsNow& acting, std::size_t i) {
  const double g = norm(sim.scene->model.gravity);
  if (g > 0.0) return g;
  const BlockSet& b = sim.scene->blocks;
  return norm(load_on(b, acting, sim.motion.pose, i)) / b.mass[i];
}

bool forces_are_rounding(const Simulation& sim) {
  const std::size_t nb = sim.scene->blocks.size();
  const NormalSums sums = normal_sums(sim, std::vector<std::uint8_t>(nb, 1));
  const double of_zones = rounding_of_zones(sim);
  for (std::size_t i = 0; i < nb; ++i) {
    const BlockSet& b = sim.scene->blocks;
    if (!is_free(b, sim.motion.state, i)) continue;
    if (force_on(sim, i, sums.rounding[i]) > 0.0) return false;
    if (b.is_meshed(i) &&
        unbalanced_forces(sim.motion.masses, b, sim.motion.forces, i).sum > of_zones)
      return false;
  }
  return true;
}

void SlowingDown::begin(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  *this = {};
  for (auto* values : {&from_x_, &from_y_, &moved_x_, &moved_y_})
    values->assign(b.size() + b.meshes.nodes(), 0.0);
  to_come_.assign(b.size(), std::numeric_limits<double>::infinity());
  begin_window(sim);
}

bool SlowingDown::fits(const BlockSet& b) const {
  const std::size_t bodies = b.size() + b.meshes.nodes();
  const auto of_bodies = [bodies](const std::vector<double>* v) { return v->size() == bodies; };
  const auto all = {&from_x_, &from_y_, &moved_x_, &moved_y_};
  return std::all_of(all.begin(), all.end(), of_bodies) && to_come_.size() == b.size();
}

namespace {

/// Calls body(q, i, size, at) for each centroid and mesh node: its number, its block, its size (m;
/// of a mesh node the length of a zone) and its place.
template <class Body>
void for_each_body(const Simulation& sim, Body body) {
  const BlockSet& b = sim.scene->blocks;
  const BodyVectors& x = sim.motion.state.position;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.is_meshed(i)) {
      body(i, i, size_of(sim, i), centroid(x, i));
      continue;
    }
    for (std::size_t j = b.meshes.begin[i]; j < b.meshes.begin[i + 1]; ++j)
      body(b.size() + j, i, std::sqrt(b.meshes.share[j] * b.area[i]), mesh_node_at(b, x, i, j));
  }
}

}  // namespace

void SlowingDown::begin_window(const Simulation& sim) {
  const double frequency = sim.relaxation.estimate.frequency;
  began_ = sim.motion.state.steps;
  length_ = window_of(sim);
  const double time = static_cast<double>(length_) * sim.motion.state.step;
  pull_before_ = pull_;
  pull_ = (frequency > 0.0 ? frequency : 1.0 / time) / time;
  for_each_body(sim, [&](std::size_t q, std::size_t, double, Vec2 at) {
    from_x_[q] = at.x;
    from_y_[q] = at.y;
  });
}

/// A motion that decays towards equilibrium decreases by the same ratio q from window to
/// window: q/(1 - q) of the last one is still to come.
void SlowingDown::look(const Simulation& sim) {
  if (sim.motion.state.steps < began_ + length_) return;
  const double like_before = pull_before_ > 0.0 ? pull_ / pull_before_ : 1.0;
  constexpr double unknown = std::numeric_limits<double>::infinity();
  std::fill(to_come_.begin(), to_come_.end(), 0.0);
  for_each_body(sim, [&](std::size_t q, std::size_t i, double size, Vec2 at) {
    const Vec2 now = at - Vec2{from_x_[q], from_y_[q]}, was{moved_x_[q], moved_y_[q]};
    const double ratio = dot(was, was) > 0.0 ? like_before * dot(now, was) / dot(was, was) : 1.0;
    const double more = ratio <= 0.0 ? 0.0 : ratio < 1.0 ? ratio / (1.0 - ratio) : unknown;
    if (q < to_come_.size()) {
      to_come_[q] = more > 0.0 && more < unknown ? norm(now) * more : more;
    } else {
      // Of many nodes some move by rounding alone, without a trend.
      const double parts = std::min(more, most_windows) * size_of(sim, i) / (zone_parts * size);
      to_come_[i] = std::max(to_come_[i], parts * norm(now));
    }
    moved_x_[q] = now.x;
    moved_y_[q] = now.y;
  });
  begin_window(sim);
}

namespace {

/// As blocks_at_rest(), under the resultant `force` (N) and pressed by `pressed` (N).
bool is_at_rest(const Simulation& sim, const LoadsNow& acting, const SlowingDown* slowing,
                std::size_t i, double force, double pressed) {
  const BlockSet& b = sim.scene->blocks;
  const State& s = sim.motion.state;
  const double most = rest_part * size_of(sim, i);
  const double own = acceleration_on(sim, acting, i);
  const double weight = std::max(pressed, b.mass[i] * (own > 0.0 ? own : usual_acceleration));
  const bool stiff = sim.stepper->remaining_travel(sim, i, force) <= most;
  if (slowing == nullptr) return stiff;
  if (stiff && ((slowing->is_still(i) && !b.is_meshed(i)) ||
                (slowing->to_come(i) <= most && force <= balanced_part * weight)))
    return true;
  const double speed = (norm(centroid(s.velocity, i)) + mean_deviation(b, s.velocity, i)) *
                       std::sqrt(inertia_of(sim.motion.masses, i) / b.mass[i]);
  const double time = rest_time(size_of(sim, i), own);
  if (b.is_meshed(i)) return false;
  return speed * time + 0.5 * force / b.mass[i] * time * time <= most;
}

}  // namespace

std::vector<std::uint8_t> blocks_at_rest(const Simulation& sim, const SlowingDown* slowing) {
  const BlockSet& b = sim.scene->blocks;
  const LoadsNow acting = loads_at(sim.scene->model, sim.attached.loads, sim.motion.state.time);
  // What would move too far without any force on it does so under all, which then need not be
  // known.
  std::vector<std::uint8_t> slow(b.size(), 0), rest(b.size(), 1);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) continue;
    slow[i] = rest[i] = is_at_rest(sim, acting, slowing, i, 0.0, 0.0) ? 1 : 0;
  }
  const NormalSums sums = normal_sums(sim, slow);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (slow[i] == 0) continue;
    const double force = force_on(sim, i, sums.rounding[i]);
    rest[i] = is_at_rest(sim, acting, slowing, i, force, sums.pressed[i]) ? 1 : 0;
  }
  return rest;
}

}  // namespace edda
