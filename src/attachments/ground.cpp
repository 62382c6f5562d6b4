#include "attachments/ground.hpp"

#include <algorithm>

#include "model/accelerogram.hpp"

namespace edda {

Ground find_ground(const Model& model, const BlockSet& b) {
  Ground ground;
  ground.moves = std::any_of(model.shakings.begin(), model.shakings.end(),
                             [](const Shaking& s) { return s.apply == ShakingKind::base; }) ||
                 std::any_of(model.boundaries.begin(), model.boundaries.end(),
                             [](const Boundary& q) { return q.type == BoundaryType::velocity; });
  for (Id i = 0; i < b.size(); ++i) {
    if (b.fixed[i]) ground.held.push_back(i);
  }
  return ground;
}

Vec2 ground_acceleration(const Model& model, const Spells& spells, double time) {
  Vec2 a;
  for (std::size_t q = 0; q < model.shakings.size(); ++q) {
    const Shaking& shaking = model.shakings[q];
    const Spell& spell = spells.shakings[q];
    const double part = spell.part(time);
    if (shaking.apply != ShakingKind::base || part == 0.0) continue;
    a += part * acceleration_at(shaking, time - spell.since);
  }
  return a;
}

GroundStep next_ground(const Model& model, const Spells& spells, const Ground& ground,
                       const BoundarySprings& springs, double time, double h_old, double h_new) {
  GroundStep next;
  next.velocity =
      ground.velocity + (0.5 * (h_old + h_new)) * ground_acceleration(model, spells, time);
  next.shift = ground.shift + h_new * next.velocity;
  next.shifts = springs.shift;
  for (std::size_t q = 0; q < next.shifts.size(); ++q) {
    const Boundary& boundary = model.boundaries[q];
    Vec2 velocity = next.velocity;
    const Spell& spell = spells.boundaries[q];
    if (boundary.type == BoundaryType::velocity && spell.acts()) {
      const double middle = time + 0.5 * h_new - spell.since;
      velocity += boundary.factor.at(middle, 1.0) * *boundary.velocity;
    }
    next.shifts[q] += h_new * velocity;
  }
  return next;
}

void place_held(const BlockSet& b, const Ground& ground, Vec2 shift, Nodes& x, Nodes& y) {
  for (std::size_t k = 0; k < 3; ++k) {
    for (const Id i : ground.held) {
      x[k][i] = b.node_x[k][i] + shift.x;
      y[k][i] = b.node_y[k][i] + shift.y;
    }
  }
}

}  // namespace edda
