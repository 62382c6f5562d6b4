// What the springs of bolts store.
#pragma once

#include "attachments/bolts.hpp"

namespace edda::testing {

/// sum of F^2/2k, J.
inline double stored(const Bolts& b) {
  double sum = 0.0;
  for (const BoltSprings* s : {&b.bonds, &b.bars, &b.dowels}) {
    for (std::size_t k = 0; k < b.size(); ++k) {
      if (s->stiffness[k] > 0.0) sum += 0.5 * s->force[k] * s->force[k] / s->stiffness[k];
    }
  }
  return sum;
}

}  // namespace edda::testing
