// Everything that is attached to the blocks or acts on them from outside, with its own state: what
// is active at present, anchor points of springs and bolts, displacement of the ground.
#pragma once

#include <vector>

#include "attachments/bolts.hpp"
#include "attachments/boundary_springs.hpp"
#include "attachments/dashpots.hpp"
#include "attachments/free_field.hpp"
#include "attachments/ground.hpp"
#include "attachments/loads.hpp"
#include "flow/joint_water.hpp"

namespace edda {

struct Attached {
  BoundarySprings springs;
  Loads loads;
  JointWater joint_water;
  Dashpots dashpots;
  FreeField free_field;
  Bolts bolts;
  Ground ground;
  std::vector<WallForce> wall_forces;  ///< of excavated rock and of replaced boundaries
};

}  // namespace edda
