// Whether an [initial_stress] is in equilibrium with the weight of the rock and within the strength
// of the joints, checked before the first step.
#pragma once

#include <vector>

#include "contacts/face_preload.hpp"

namespace edda {

struct InitialBalance {
  double gradient = 0.0;  ///< difference of d(sxy)/dy and d(syy)/dy from -rho g, over rho |g|,
                          ///< largest of the materials; over the stress where there is no gravity;
                          ///< 0 with k0
  Index material = none;  ///< the material of that value
  double unbalanced = 0.0;  ///< mean resultant of the free blocks, over the mean contact force
  double largest = 0.0;     ///< resultant of the block with the largest one, over the mean contact
                            ///< force
  Id block = no_id;         ///< that block
  double within = 0.0;  ///< mean resultant of the blocks that others enclose, beyond that of the
                        ///< field of k0, over the mean contact force
  double top = 0.0;     ///< normal stress of the ground that free faces at the top of the model
                        ///< lack, over the mean stress
  std::vector<JointStress> joints;  ///< demand on each joint law, by row of the laws
};

}  // namespace edda
