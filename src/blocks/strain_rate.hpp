// The rate of a block's corotated strain, and the forces that do work on it alone.
//
// Notation: F = R U (kinematics.hpp), L = sum v_k G_k^T the rate of F, A = R^T L. As U stays symmetric,
//   dU/dt = A - w J U,  w = (A21 - A12)/(U11 + U22), J the turn by a right angle,
// so that dU/dt is 0, to the last digit, in any rigid motion of the strained block.
#pragma once

#include "blocks/kinematics.hpp"

namespace edda {

/// U11, U22 and 2 U12, or their rates; of stresses 11, 22 and 12, so that the products add up to work.
struct StrainTerms {
  double xx, yy, xy;
};

/// What of a block's deformation decides its rate of strain.
struct StrainFrame {
  double c, s;         ///< R = [c -s; s c]
  double shear, skew;  ///< U12 and U22 - U11, both over U11 + U22
};

EDDA_INLINE StrainFrame strain_frame(const Deformation& f) {
  const Rotation r = rotation(f);
  const double u11 = r.c * f.xx + r.s * f.yx, u22 = r.c * f.yy - r.s * f.xy,
               u12 = r.c * f.xy + r.s * f.yy;
  return {r.c, r.s, u12 / r.strength, (u22 - u11) / r.strength};
}

/// dU/dt for the rate L of F.
EDDA_INLINE StrainTerms strain_rate(const StrainFrame& q, const Deformation& l) {
  const double a11 = q.c * l.xx + q.s * l.yx, a12 = q.c * l.xy + q.s * l.yy,
               a21 = q.c * l.yx - q.s * l.xx, a22 = q.c * l.yy - q.s * l.xy;
  const double spin = a21 - a12;
  return {a11 + spin * q.shear, a22 - spin * q.shear, a12 + a21 + spin * q.skew};
}

/// P of node forces -V P G_k whose power is -V s : dU/dt in every motion. Where s and U have other
/// principal axes it is not R s: that would make a torque.
EDDA_INLINE Deformation stress_on_rate(const StrainFrame& q, const StrainTerms& s) {
  const double turn = (s.xx - s.yy) * q.shear + s.xy * q.skew;
  const double s12 = s.xy - turn, s21 = s.xy + turn;
  return {q.c * s.xx - q.s * s21, q.c * s12 - q.s * s.yy, q.s * s.xx + q.c * s21,
          q.s * s12 + q.c * s.yy};
}

}  // namespace edda
