// Open-close iteration, made exact: what part of a contact's force the step in which it opens or
// closes may keep (method.md section 4). Pure functions.
//
// Notation: a penalty spring under leapfrog does the discrete work -F (d_{n+1} - d_{n-1})/2 in the
// step made with the force F = alpha p d_n. Its stored energy is p d_{n-1} d_n / 2 before and
// p d_n d_{n+1} / 2 after (0 where it is open), and alpha makes the two agree. d_{n+1} = D - alpha
// q.
#pragma once

#include <algorithm>
#include <cmath>

#include "base/vector_loop.hpp"

namespace edda {

/// alpha in [0, 1]. before: penetration a step ago (<= 0: open); without: the next one without this
/// force; push: q = h^2 p d / m_c > 0, what the whole force takes from it. All in metres.
inline double switching_alpha(double before, double without, double push) {
  if (before > 0.0) {                      // was closed
    if (without - push > 0.0) return 1.0;  // stays closed
    const double b = before - without;
    const double r = std::sqrt(std::max(0.0, b * b + 4.0 * push * before));
    return b > 0.0 ? std::min(1.0, 2.0 * before / (b + r))
                   : std::min(1.0, (r - b) / (2.0 * push));  // opens
  }
  if (without <= 0.0) return 0.0;  // leaves by itself
  const double b = without - before + push;
  return std::min(
      1.0, 2.0 * without / (b + std::sqrt(std::max(0.0, b * b - 4.0 * push * without))));  // closes
}

/// Coulomb's limit by a return map: the shear force cut to +-limit.
EDDA_INLINE double cut_shear(double trial, double limit) {
  return smaller(larger(trial, -limit), limit);
}

}  // namespace edda
