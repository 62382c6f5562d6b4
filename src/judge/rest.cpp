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
  for (std::size_t i = 0; i < nb; ++i) {
    if (is_free(sim.scene->blocks, sim.motion.state, i) && force_on(sim, i, sums.rounding[i]) > 0.0)
      return false;
  }
  return true;
}

void SlowingDown::begin(const Simulation& sim) {
  const std::size_t nb = sim.scene->blocks.size();
  *this = {};
  for (auto* values : {&from_x_, &from_y_, &moved_x_, &moved_y_}) values->assign(nb, 0.0);
  to_come_.assign(nb, std::numeric_limits<double>::infinity());
  begin_window(sim);
}

bool SlowingDown::fits(std::size_t blocks) const {
  const auto of_blocks = [blocks](const std::vector<double>* v) { return v->size() == blocks; };
  const auto all = {&from_x_, &from_y_, &moved_x_, &moved_y_, &to_come_};
  return std::all_of(all.begin(), all.end(), of_blocks);
}

void SlowingDown::begin_window(const Simulation& sim) {
  const double frequency = sim.relaxation.estimate.frequency;
  began_ = sim.motion.state.steps;
  length_ = window_of(sim);
  const double time = static_cast<double>(length_) * sim.motion.state.step;
  pull_before_ = pull_;
  pull_ = (frequency > 0.0 ? frequency : 1.0 / time) / time;
  for (std::size_t i = 0; i < from_x_.size(); ++i) {
    const Vec2 at = centroid(sim.motion.state.x, sim.motion.state.y, i);
    from_x_[i] = at.x;
    from_y_[i] = at.y;
  }
}

/// A motion that decays towards equilibrium decreases by the same ratio q from window to
/// window: q/(1 - q) of the last one is still to come.
void SlowingDown::look(const Simulation& sim) {
  if (sim.motion.state.steps < began_ + length_) return;
  const double like_before = pull_before_ > 0.0 ? pull_ / pull_before_ : 1.0;
  for (std::size_t i = 0; i < from_x_.size(); ++i) {
    const Vec2 now = centroid(sim.motion.state.x, sim.motion.state.y, i) -
                     Vec2{from_x_[i], from_y_[i]},
               was{moved_x_[i], moved_y_[i]};
    const double ratio = dot(was, was) > 0.0 ? like_before * dot(now, was) / dot(was, was) : 1.0;
    to_come_[i] = ratio <= 0.0  ? 0.0
                  : ratio < 1.0 ? norm(now) * ratio / (1.0 - ratio)
                                : std::numeric_limits<double>::infinity();
    moved_x_[i] = now.x;
    moved_y_[i] = now.y;
  }
  begin_window(sim);
}

namespace {

/// Speed of the corners of block i beside that of its nodes, m/s: the root of its mean square by
/// their masses, since the shapes of the modes are orthonormal.
double bending_speed(const BlockSet& b, const State& s, std::size_t i) {
  const BlockModes modes = b.modes(i);
  if (modes.count == 0) return 0.0;
  return std::sqrt(mode_product(modes, s.bend_rate, s.bend_rate) /
                   static_cast<double>(modes.corners));
}

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
  if (stiff &&
      (slowing->is_still(i) || (slowing->to_come(i) <= most && force <= balanced_part * weight)))
    return true;
  const double speed = (norm(centroid(s.vx, s.vy, i)) + bending_speed(b, s, i)) *
                       std::sqrt(inertia_of(sim.motion.masses, i) / b.mass[i]);
  const double time = rest_time(size_of(sim, i), own);
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
