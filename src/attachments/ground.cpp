#include "attachments/ground.hpp"

#include <algorithm>

#include "model/files/accelerogram.hpp"

namespace edda {

Ground find_ground(const Model& model, const BlockSet& b) {
  Ground ground;
  ground.moves =
      std::any_of(model.shakings.begin(), model.shakings.end(),
                  [](const Shaking& s) { return s.apply == ShakingKind::base; }) ||
      std::any_of(model.boundaries.begin(), model.boundaries.end(), [](const Boundary& q) {
        return q.type == BoundaryType::velocity || q.type == BoundaryType::displacement;
      });
  for (Id i = 0; i < b.size(); ++i) {
    if (b.fixed[i]) ground.fixed_blocks.push_back(i);
  }
  return ground;
}

Vec2 ground_acceleration(const Model& model, const ActiveIntervals& intervals, double time) {
  Vec2 a;
  for (std::size_t q = 0; q < model.shakings.size(); ++q) {
    const Shaking& shaking = model.shakings[q];
    const ActiveInterval& interval = intervals.shakings[q];
    const double part = interval.part(time);
    if (shaking.apply != ShakingKind::base || part == 0.0) continue;
    a += part * acceleration_at(shaking, time - interval.since);
  }
  return a;
}

GroundStep next_ground(const Model& model, const Loads& loads, const Ground& ground,
                       const BoundarySprings& springs, double time, double h_old, double h_new) {
  const ActiveIntervals& intervals = loads.intervals;
  GroundStep next;
  next.velocity =
      ground.velocity + (0.5 * (h_old + h_new)) * ground_acceleration(model, intervals, time);
  next.shift = ground.shift + h_new * next.velocity;
  next.shifts = springs.shift;
  for (std::size_t q = 0; q < next.shifts.size(); ++q) {
    const Boundary& boundary = model.boundaries[q];
    Vec2 velocity = next.velocity;
    const ActiveInterval& interval = intervals.boundaries[q];
    if (boundary.type == BoundaryType::velocity && interval.acts()) {
      const double middle = time + 0.5 * h_new - interval.since;
      velocity += boundary.factor.at(middle, 1.0) * *boundary.velocity;
    }
    next.shifts[q] += h_new * velocity;
    if (boundary.type == BoundaryType::displacement) {
      next.shifts[q] =
          next.shift + displacement_factor(model, loads, q, time + h_new) * *boundary.displacement;
    }
  }
  return next;
}

void place_fixed(const BlockSet& b, const Ground& ground, Vec2 shift, BodyVectors& position) {
  for (const Id i : ground.fixed_blocks) {
    store(vectors_of(b.node_x, b.node_y, i) + at_every_node(shift), position, i);
  }
}

}  // namespace edda
