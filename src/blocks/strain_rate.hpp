// The rate of a block's corotated strain, and the forces that do work on it alone.
//
// Notation: F = R U (kinematics.hpp), L = sum v_k G_k^T the rate of F, A = R^T L. As U stays
// symmetric,
//  dU/dt = A - w J U,  w = (A21 - A12)/(U11 + U22), J the rotation by a right angle,
// so that dU/dt is 0, to the last digit, in any rigid motion of the strained block.
#pragma once

#include "blocks/kinematics.hpp"

namespace edda {

/// U11, U22 and 2 U12, or their rates; for stresses 11, 22 and 12, so that the sum of products is
/// work.
struct StrainTerms {
  double xx, yy, xy;
};

/// F = R U of a block, R = [c -s; s c]; `trace` of U, and its inverse.
struct StrainFrame {
  double c, s, u11, u22, u12, trace, per_trace;
};

EDDA_INLINE StrainFrame strain_frame(const Deformation& f) {
  const Rotation r = rotation(f);
  return {r.c,
          r.s,
          r.c * f.xx + r.s * f.yx,
          r.c * f.yy - r.s * f.xy,
          r.c * f.xy + r.s * f.yy,
          r.strength,
          r.inverse};
}

/// A = R^T L.
EDDA_INLINE Deformation rotated_back(const StrainFrame& q, const Deformation& l) {
  return {q.c * l.xx + q.s * l.yx, q.c * l.xy + q.s * l.yy, q.c * l.yx - q.s * l.xx,
          q.c * l.yy - q.s * l.xy};
}

/// dU/dt for the rate L of F.
EDDA_INLINE StrainTerms strain_rate(const StrainFrame& q, const Deformation& l) {
  const Deformation a = rotated_back(q, l);
  const double spin = (a.yx - a.xy) * q.per_trace;
  return {a.xx + spin * q.u12, a.yy - spin * q.u12, a.xy + a.yx + spin * (q.u22 - q.u11)};
}

/// Change of U over h, in a step h in which F changes by h L: 0 for a block that rotates as a
/// whole, of which L is the chord. With the rotation of the step, tan(theta) = h (A21 - A12)/(tr U
/// + h tr A), it is (R_theta^T (U + h A) - U)/h, written so that nothing cancels.
EDDA_INLINE StrainTerms strain_rate_over(const StrainFrame& q, const Deformation& l, double h) {
  const Deformation a = rotated_back(q, l);
  const double turn = a.yx - a.xy, along = q.trace + h * (a.xx + a.yy);
  const double r = std::sqrt(along * along + h * h * turn * turn);
  const double both = r + along, inverse = 1.0 / (r * both), per_r = both * inverse;
  const double cosine = along * per_r, spin = turn * per_r;  // sin(theta) = h spin
  const double shrink = -h * turn * turn * inverse;          // (cos(theta) - 1)/h
  return {
      cosine * a.xx + shrink * q.u11 + spin * (q.u12 + h * a.yx),
      cosine * a.yy + shrink * q.u22 - spin * (q.u12 + h * a.xy),
      cosine * (a.xy + a.yx) + 2.0 * shrink * q.u12 + spin * (q.u22 - q.u11 + h * (a.yy - a.xx))};
}

/// P for nodal forces -V P G_k whose power is -V s : dU/dt in every motion. It is R s only where s
/// and U have the same principal axes; otherwise R s would make a torque.
EDDA_INLINE Deformation stress_on_rate(const StrainFrame& q, const StrainTerms& s) {
  const double turn = ((s.xx - s.yy) * q.u12 + s.xy * (q.u22 - q.u11)) * q.per_trace;
  const double s12 = s.xy - turn, s21 = s.xy + turn;
  return {q.c * s.xx - q.s * s21, q.c * s12 - q.s * s.yy, q.s * s.xx + q.c * s21,
          q.s * s12 + q.c * s.yy};
}

}  // namespace edda
