// How an [initial_stress] goes with the weight of the rock and the strength of the joints, judged
// before the first step.
#pragma once

#include <vector>

#include "contacts/face_preload.hpp"

namespace edda {

struct InitialBalance {
  double gradient = 0.0;  ///< what d(sxy)/dy and d(syy)/dy miss of -rho g, over rho |g|: largest of
                          ///< the materials; over the stress where there is no gravity; 0 with k0
  Index material = none;  ///< that one
  double unbalanced = 0.0;  ///< mean resultant of the free blocks, over the mean contact force
  double largest = 0.0;     ///< that of the block furthest off
  Id block = no_id;         ///< that block
  std::vector<JointStress> joints;  ///< what is asked of each law, by row of the laws
};

}  // namespace edda
