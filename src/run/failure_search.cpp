#include "run/failure_search.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "attachments/loads.hpp"
#include "run/equilibrium_search.hpp"

namespace edda {
namespace {

constexpr std::uint64_t look_at_every = 32;  // steps
// Parts of the failure displacement that a vertex must have moved for its trend to count: during a
// search, and at its end.
constexpr double visible = 0.3, barely = 0.01;
constexpr double periods_enough = 6.0;  // of the motion, before a trend counts
// Of the size of a block: the failure displacement, which is larger where supports carry blocks
// along; and how far no block moves that deforms, nor one whose support is displaced by a part of a
// change (parts_of_change()), unless it falls.
constexpr double by_forces = 0.01, by_supports = 0.03;
constexpr double far_by_forces = 1.0, far_by_supports = 0.25;
constexpr double slower = 10.0;

}  // namespace

bool is_displaced(const Model& model, Varied varied, Index target) {
  return varied == Varied::boundary &&
         model.boundaries[static_cast<std::size_t>(target)].type == BoundaryType::displacement;
}

CollapseCriterion collapse_criterion(const Simulation& sim, Varied varied, Index target) {
  CollapseCriterion c;
  double count = 0.0, mass = 0.0, force = 0.0;
  const Model& model = sim.scene->model;
  const BlockSet& b = sim.scene->blocks;
  const LoadsNow acting = loads_at(model, sim.attached.loads, sim.motion.state.time);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) continue;
    c.size += std::sqrt(b.area[i]);
    mass += b.mass[i];
    force += norm(load_on(b, acting, sim.motion.pose, i));
    count += 1.0;
  }
  c.size /= std::max(count, 1.0);
  c.acceleration = norm(model.gravity);
  if (c.acceleration == 0.0) c.acceleration = force > 0.0 ? force / mass : usual_acceleration;
  c.duration = equilibrium_time(c.size, c.acceleration);
  const bool displaced = is_displaced(model, varied, target);
  c.displacement = (displaced ? by_supports : by_forces) * c.size;
  c.velocity = by_forces * c.size / (slower * c.duration);
  c.far = displaced ? far_by_supports / by_supports : far_by_forces / by_forces;
  return c;
}

int parts_of_change(const Model& model, Varied varied, Index target, double from, double to,
                    const CollapseCriterion& criterion) {
  if (!is_displaced(model, varied, target)) return 1;
  // Blocks that the support carries along must not look as if they failed (`visible`).
  constexpr double at_a_time = 0.0025;  // of the size of a block
  const Vec2 whole = *model.boundaries[static_cast<std::size_t>(target)].displacement;
  const double way = norm(whole) * std::abs(to - from);
  return std::max(1, static_cast<int>(std::ceil(way / (at_a_time * criterion.size))));
}

Verdict FailureSearch::end(Verdict verdict, std::string reason, Id block) {
  verdict_ = verdict;
  block_ = block;
  reason_ = std::move(reason);
  return verdict;
}

/// A block that moves beyond the failure displacement by its trend, and has moved this part of it
/// already. During the search a block so slow that it would count as in equilibrium does not; of
/// one that has lost its contacts any motion counts.
Id FailureSearch::goes_beyond(const Simulation& sim, double part) const {
  const double most = criterion_.displacement;
  const double slow = equilibrium_travel_ratio * criterion_.size / criterion_.duration;
  return watch_.goes_beyond(sim, {part * most, part > barely ? slow : 0.0}, {barely * most, 0.0},
                            most, visible * most);
}

Verdict FailureSearch::fail_by_trend(const Simulation& sim, double part) {
  const Id block = goes_beyond(sim, part);
  if (block == no_id) return Verdict::not_yet;
  by_trend_ = true;
  return end(Verdict::fails, "keeps moving", block);
}

Verdict FailureSearch::look(Simulation& sim) {
  if (sim.motion.state.steps % look_at_every != 0) return Verdict::not_yet;
  velocity_ = watch_.velocity(sim).value;
  const double most = criterion_.displacement;
  const Furthest furthest = watch_.displacement(sim);
  const double gone = furthest.value;
  if (gone > criterion_.far * most) return end(Verdict::fails, "moved too far", furthest.block);
  if (!sim.relaxation.seeks_equilibrium) return Verdict::not_yet;
  if (!gradual_change_complete(sim)) {
    watch_.begin(sim);
    return Verdict::not_yet;
  }
  const bool anew = watch_.look_at_trend(sim);
  if (const Id block = gone > most ? goes_beyond(sim, 1.0) : no_id; block != no_id)
    return end(Verdict::fails, "moved too far", block);
  if (anew && watch_.periods() >= periods_enough && fail_by_trend(sim, visible) != Verdict::not_yet)
    return verdict_;
  const double least = equilibrium_travel_ratio * criterion_.size;
  bool in_equilibrium = velocity_ * criterion_.duration <= least;
  if (in_equilibrium) in_equilibrium = watch_.prospect(sim, criterion_.duration) <= least;
  found_in_sequence_ = in_equilibrium ? found_in_sequence_ + 1 : 0;
  if (found_in_sequence_ < checks_in_sequence) return Verdict::not_yet;
  return end(Verdict::holds, "in equilibrium");
}

Verdict FailureSearch::at_end(Simulation& sim) {
  update_face_rows(sim);
  if (fail_by_trend(sim, barely) != Verdict::not_yet) return verdict_;
  return velocity_ > criterion_.velocity
             ? end(Verdict::fails, "still moving", watch_.fastest())
             : end(Verdict::holds, "slower than the velocity of a failure");
}

}  // namespace edda
