// Motion of the supports of the model: fixed blocks, and the far ends of boundary springs.
#pragma once

#include <vector>

#include "attachments/boundary_springs.hpp"
#include "attachments/loads.hpp"
#include "blocks/kinematics.hpp"
#include "model/model.hpp"

namespace edda {

/// The ground, moved by ground motions of kind "base" with the same leapfrog as the blocks:
/// v_{n+1/2} = v_{n-1/2} + h a_n, u_{n+1} = u_n + h v_{n+1/2}. Blocks on it then move relative to
/// it as they would on a ground at rest with -a_n added to gravity, to rounding.
struct Ground {
  bool moves = false;            ///< whether the model has a base motion or a boundary that moves
  std::vector<Id> fixed_blocks;  ///< the fixed blocks, which move with it
  Vec2 velocity;                 ///< at n - 1/2, m/s
  Vec2 shift, shift_1;           ///< u_n, u_{n-1}, m
};

/// The ground at the end of a step.
struct GroundStep {
  Vec2 velocity;             ///< at n + 1/2
  Vec2 shift;                ///< u_{n+1}
  std::vector<Vec2> shifts;  ///< [rows of Model::boundaries] at n + 1
};

Ground find_ground(const Model& model, const BlockSet& blocks);

/// Acceleration of the ground by ground motions of kind "base", m/s2.
Vec2 ground_acceleration(const Model& model, const ActiveIntervals& intervals, double time);

/// The ground one step after `time`, with h_old and h_new the last and the next step (s). A
/// boundary of type velocity also moves with its velocity at the middle of the step, one of type
/// displacement is displaced from the ground by what its factor then is.
GroundStep next_ground(const Model& model, const Loads& loads, const Ground& ground,
                       const BoundarySprings& springs, double time, double h_old, double h_new);

/// Moves the nodes of the fixed blocks with the ground.
void place_fixed(const BlockSet& blocks, const Ground& ground, Vec2 shift, BodyVectors& position);

}  // namespace edda
