// Strength of a joint: Coulomb's limit, and when a bond fails (theory, sections 4.3 and 5.1
// to 5.3).
#pragma once

#include <cmath>

#include "base/vector_loop.hpp"
#include "contacts/face.hpp"

namespace edda {

/// The largest shear force under this normal force, N: cohesion, N, and friction, tan(phi).
EDDA_INLINE double coulomb_limit(double cohesion, double friction, double normal) {
  return positive_part(cohesion + friction * normal);
}

/// Whether an end slides: Coulomb's limit has cut its elastic slip (m, before and after).
EDDA_INLINE bool is_cut(double trial, double slip) {
  return trial != slip;
}
/// Whether one of both ends does.
EDDA_INLINE bool is_cut(FaceEnds trial, FaceEnds slip) {
  return (trial.a != slip.a) | (trial.b != slip.b);
}

/// Strength of a bonded face. Members as in FaceSet.
struct BondStrength {
  bool bonded, carries_tension, glued;
  double friction, cohesion, tension;
  double hold;  ///< cohesion and tensile strength are multiplied by this (FaceSet::bond_strength)
  double parts_at;  ///< m: without tensile strength it fails at a larger gap
};
/// What it carries.
struct BondLoad {
  FaceEnds closure, normal;  ///< m, N
  double shear;              ///< of both ends, N
  double spring;             ///< of each end, N/m
  double length, cohesive;   ///< m, as in FaceFields
};
/// How it fails: its outer fibre is in more tension than its tensile strength; it gapes all along;
/// the shear of both ends exceeds its strength, by more than rounding of the coordinates (`noise`,
/// m).
struct BondFailure {
  bool torn, apart, sheared;
  bool any() const { return bool(torn | apart | sheared); }
};
EDDA_INLINE BondFailure failure_of(const BondStrength& s, const BondLoad& f, double noise) {
  const bool torn = s.carries_tension & (outer_tension(f.normal) > s.hold * s.tension * f.length);
  const bool apart =
      s.bonded & !s.carries_tension & (larger(f.closure.a, f.closure.b) < -s.parts_at);
  const double rounding = 2.0 * f.spring * noise;
  const bool sheared = s.bonded & (std::abs(f.shear) > rounding + s.hold * s.cohesion * f.cohesive +
                                                           s.friction * (f.normal.a + f.normal.b));
  const bool fails = !s.glued;
  return {bool(torn & fails), bool(apart & fails), bool(sheared & fails)};
}

}  // namespace edda
