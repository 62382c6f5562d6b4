// What the energy of a face is made of (contacts/face.hpp): its gates, where corners pass each
// other, the potentials of its closure, and the share of a leaning corner; each with its
// derivatives.
#pragma once

#include <cmath>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"

namespace edda {

/// A value at each end of the overlap.
struct FaceEnds {
  double a = 0.0, b = 0.0;
};

/// S(x) = x^2 (3 - 2 x) on [0, 1], 0 before and 1 beyond.
struct SmoothStep {
  double value, slope;
};
EDDA_INLINE SmoothStep smooth_step(double x) {
  const double u = smaller(larger(x, 0.0), 1.0);
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u)};
}

/// Closures deeper than this part of the overlap begin to fade, and are gone at four times that.
inline constexpr double aspect_from = 0.5, aspect_range = 1.5;
/// Part of the initial stress's closure that counts there.
inline constexpr double locked_part = 0.25;

/// Cosine of the angle between edges that lie along each other: 8 degrees. Cohesion needs surfaces
/// that do; a corner that leans on an edge has friction alone. It goes over up to 4
/// degrees.
inline constexpr double lies_along = 0.99, lies_flush = 0.9976;
EDDA_INLINE double flush_part(double cosine) {
  return smooth_step((cosine - lies_along) * (1.0 / (lies_flush - lies_along))).value;
}

/// What bounds an end of the overlap where two corners are x apart along the face and pass each
/// other within `reach` (m): how far it is drawn in, and by which part it follows the corner that
/// would not bound it alone. Without it the force along the face would jump by k d^2/2.
struct CornersPassing {
  double drawn_in, by_other;
  double by_reach;  ///< derivative of drawn_in
};
EDDA_INLINE CornersPassing corners_passing(double x, double reach, double per_reach) {
  const double near = larger(reach - std::abs(x), 0.0);
  const double part = near * per_reach;
  return {0.25 * near * part, 0.5 * part, 0.25 * part * (2.0 - part)};
}

/// Part by which each end follows the first block's corner.
EDDA_INLINE FaceEnds of_first(const CornersPassing& a, const CornersPassing& b, bool a_by_first,
                              bool b_by_first) {
  return {a_by_first ? 1.0 - a.by_other : a.by_other, b_by_first ? 1.0 - b.by_other : b.by_other};
}

/// That reach, of the closures at both ends, (da^2 + db^2)^(1/2)/3, towards a furthest one: edges
/// may be shorter than what an initial stress locks in. The closure of corners that pass each other
/// is taken halfway between the two, or it would go on at another rate where one takes over.
inline constexpr double furthest_reach = 0.5;  ///< of FacePair::passing
struct PassingReach {
  double reach, by_a, by_b;
};
EDDA_INLINE PassingReach passing_reach(double da, double db, double furthest, double per_furthest) {
  const double both = std::sqrt(da * da + db * db), part = 1.0 / 3.0;
  const double u = smaller(0.5 * part * both * per_furthest, 1.0);
  const double slope = part * (1.0 - u) / (both > 0.0 ? both : 1.0);
  return {furthest * u * (2.0 - u), slope * da, slope * db};
}

/// phi and its derivatives by da and db.
struct ClosurePotential {
  double value, by_a, by_b;
};

/// 1/(2 L) Int max(d, 0)^2 ds: (da^2 + da db + db^2)/6 where both ends are closed; else, of the
/// closed end d, d^3/(6 |da - db|).
EDDA_INLINE ClosurePotential exact_potential(double da, double db, bool pulls) {
  const double pa = larger(da, 0.0), pb = larger(db, 0.0);
  const bool whole = pulls | ((da >= 0.0) & (db >= 0.0));
  const double closed = pa + pb, difference = std::abs(da - db);
  const double part = closed / (difference > 0.0 ? difference : 1.0);
  constexpr double sixth = 1.0 / 6.0;
  const double far = sixth * closed * part * part;  // by the open end
  const double near = 0.5 * closed * part - far;    // by the closed end
  return {sixth * (whole ? da * da + da * db + db * db : closed * closed * part),
          whole ? sixth * (2.0 * da + db) : (pa > 0.0 ? near : far),
          whole ? sixth * (da + 2.0 * db) : (pb > 0.0 ? near : far)};
}

EDDA_INLINE ClosurePotential potential_at_ends(double da, double db, bool pulls) {
  const double pa = pulls ? da : larger(da, 0.0), pb = pulls ? db : larger(db, 0.0);
  return {(pa * pa + pb * pb) / 4.0, pa / 2.0, pb / 2.0};
}

/// Part of a leaning corner, sin^2(eps - theta)/(sin^2 theta + sin^2(eps - theta)): its two edges
/// make theta and eps - theta with the edge that it leans on, so that their parts sum to one.
/// c and s: cosine and sine of theta >= 0, both times the same length. With its derivatives.
struct CornerShare {
  double value, by_c, by_s;
};
EDDA_INLINE CornerShare corner_share(Vec2 turn, double c, double s) {
  const double x = larger(turn.y * c - turn.x * s, 0.0);  // sine of eps - theta
  const double a = x * x, b = s * s, sum = a + b;
  const double inverse = 1.0 / (sum > 0.0 ? sum : 1.0), twice = 2.0 * inverse * inverse;
  return {a * inverse, twice * b * x * turn.y, -twice * (b * x * turn.x + a * s)};
}

}  // namespace edda
