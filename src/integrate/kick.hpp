// The change of a node's velocity in one step of the leapfrog, for loops over several blocks.
#pragma once

#include <cmath>
#include <cstddef>
#include <vector>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"

namespace edda {

EDDA_INLINE double sign(double v) {
  return (v > 0.0 ? 1.0 : 0.0) - (v < 0.0 ? 1.0 : 0.0);
}

/// Cundall's local damping: beta |f| against the velocity, by component.
EDDA_INLINE Vec2 local_damping(Vec2 f, Vec2 v, double beta) {
  return {-beta * std::abs(f.x) * sign(v.x), -beta * std::abs(f.y) * sign(v.y)};
}

/// Change of a velocity in one step, v+ = ((1 - a h/2) v- + h f/m)/(1 + a h/2) with the
/// mass-proportional damping a, and the step h_new of the position that follows.
struct Kick {
  double keeps;  ///< (1 - a h/2)/(1 + a h/2)
  double h;      ///< h/(1 + a h/2), s
  double h_new, local;
};

/// The same for blocks of which each has a mass-proportional damping of its own.
struct BlockKicks {
  std::vector<double> mass;   ///< [nb] a, 1/s
  std::vector<double> keeps;  ///< [nb] (1 - a h/2)/(1 + a h/2)
  std::vector<double> h;      ///< [nb] h/(1 + a h/2), s
};
/// h: mean of the last and the next step, s.
inline void set_kicks(BlockKicks& kicks, double h) {
  kicks.keeps.resize(kicks.mass.size());
  kicks.h.resize(kicks.mass.size());
  for (std::size_t i = 0; i < kicks.mass.size(); ++i) {
    const double half = 0.5 * kicks.mass[i] * h;
    kicks.keeps[i] = (1.0 - half) / (1.0 + half);
    kicks.h[i] = h / (1.0 + half);
  }
}

/// The kick of each block: all alike, or each its own.
struct OneKick {
  Kick kick;
  EDDA_INLINE Kick of(std::size_t) const { return kick; }
};
struct OwnKicks {
  const double *keeps, *h;
  double h_new, local;
  EDDA_INLINE Kick of(std::size_t i) const { return {keeps[i], h[i], h_new, local}; }
};

EDDA_INLINE Vec2 kicked(Vec2 before, Vec2 acceleration, const Kick& kick) {
  return kick.keeps * before + kick.h * acceleration;
}

/// The same of a node with a lumped mass, under the force `push` and local damping.
EDDA_INLINE Vec2 kicked_node(Vec2 before, Vec2 push, double inverse_mass, const Kick& kick) {
  const Vec2 force = push + local_damping(push, before, kick.local);
  return kicked(before, inverse_mass * force, kick);
}

}  // namespace edda
