// Motion of what holds the model: held blocks, and where the springs of boundaries pull to.
#pragma once

#include <vector>

#include "attachments/boundary_springs.hpp"
#include "attachments/loads.hpp"
#include "blocks/kinematics.hpp"
#include "model/model.hpp"

namespace edda {

/// The ground that shakings of kind "base" move, by the same leapfrog as the blocks: v_{n+1/2} =
/// v_{n-1/2} + h a_n, u_{n+1} = u_n + h v_{n+1/2}. Blocks on it then move as they would on a ground
/// at rest with -a_n added to gravity, to rounding.
struct Ground {
  bool moves = false;    ///< whether the model has anything that moves it, or a boundary
  std::vector<Id> held;  ///< blocks on it
  Vec2 velocity;         ///< at n - 1/2, m/s
  Vec2 shift, shift_1;   ///< u_n, u_{n-1}, m
};

/// Where a step takes it.
struct GroundStep {
  Vec2 velocity;             ///< at n + 1/2
  Vec2 shift;                ///< u_{n+1}
  std::vector<Vec2> shifts;  ///< [rows of Model::boundaries] at n + 1
};

Ground find_ground(const Model& model, const BlockSet& blocks);

/// Acceleration that shakings of kind "base" give the ground, m/s2.
Vec2 ground_acceleration(const Model& model, const Spells& spells, double time);

/// From `time` on, h_old and h_new the steps behind and ahead (s). A boundary of type velocity
/// moves at its velocity at the middle of the step, too.
GroundStep next_ground(const Model& model, const Spells& spells, const Ground& ground,
                       const BoundarySprings& springs, double time, double h_old, double h_new);

/// Puts the nodes of the held blocks where the ground takes them.
void place_held(const BlockSet& blocks, const Ground& ground, Vec2 shift, Nodes& x, Nodes& y);

}  // namespace edda
