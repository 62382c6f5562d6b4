// Parts of the energy of a face (contacts/face.hpp), each with its derivatives: the gates (theory,
// section 4.4), the overlap where corners pass each other (4.5), the closure potentials (4.2), and
// the corner weight (docs/contacts.md).
#pragma once

#include <cmath>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"

namespace edda {

/// Which formulas of a face are computed: all of them; those of a face that is neither bonded nor
/// carries tension; and of these, those where is_plain() holds. What is left out would add nothing,
/// and the results are the same to the bit.
enum class Formulas { all, unbonded, plain };

/// A value at each end of the overlap.
struct FaceEnds {
  double a = 0.0, b = 0.0;
};

/// One of two vectors.
EDDA_INLINE Vec2 either(bool first, Vec2 a, Vec2 b) {
  return {first ? a.x : b.x, first ? a.y : b.y};
}

/// S(x) = x^2 (3 - 2 x) on [0, 1], 0 before and 1 beyond.
struct SmoothStep {
  double value, slope;
};
EDDA_INLINE SmoothStep smooth_step(double x) {
  const double u = at_most_one(positive_part(x));
  return {u * u * (3.0 - 2.0 * u), 6.0 * u * (1.0 - u)};
}

/// Aspect gate: w = 0 up to L/d* = aspect_from, and w = 1 from aspect_from + aspect_range on, with
/// the length L of the overlap and its largest closure d*.
inline constexpr double aspect_from = 0.5, aspect_range = 1.5;
/// Part of the locked closure of the initial stress that counts in the aspect gate.
inline constexpr double locked_part = 0.25;

/// Cosines of 8 and 4 degrees between the edges. Cohesion needs surfaces that lie along each other:
/// none acts beyond 8 degrees, all of it within 4, with a smooth transition. A corner that leans on
/// an edge has friction alone.
inline constexpr double lies_along = 0.99, lies_flush = 0.9976;
EDDA_INLINE double flush_part(double cosine) {
  return smooth_step((cosine - lies_along) * (1.0 / (lies_flush - lies_along))).value;
}

/// An end of the overlap where two corners are x apart along the face and pass each other within
/// the distance r (`reach`, m): the distance by which the end lies inward of the nearer corner,
/// (r - |x|)^2/(4 r), and the weight with which it follows the other corner. Without this the force
/// along the face would jump by k d^2/2.
struct CornersPassing {
  double inward, by_other;
  double by_reach;  ///< derivative of inward with respect to r
};
EDDA_INLINE CornersPassing corners_passing(double x, double reach, double per_reach) {
  const double near = positive_part(reach - std::abs(x));
  const double part = near * per_reach;
  return {0.25 * near * part, 0.5 * part, 0.25 * part * (2.0 - part)};
}

/// Weights with which the ends follow the corners of the first block.
EDDA_INLINE FaceEnds of_first(const CornersPassing& a, const CornersPassing& b, bool a_by_first,
                              bool b_by_first) {
  return {a_by_first ? 1.0 - a.by_other : a.by_other, b_by_first ? 1.0 - b.by_other : b.by_other};
}

/// The distance r within which corners pass each other, from the closures at both ends: (da^2 +
/// db^2)^(1/2)/3, limited smoothly to `furthest`, since edges may be shorter than the closure that
/// an initial stress locks in. Where two corners pass each other this closure is taken about midway
/// between them; otherwise its slope would jump as one takes over from the other.
inline constexpr double furthest_reach = 0.5;  ///< part of FacePair::passing
struct PassingReach {
  double reach, by_a, by_b;
};
EDDA_INLINE PassingReach passing_reach(double da, double db, double furthest, double per_furthest) {
  const double both = std::sqrt(da * da + db * db), part = 1.0 / 3.0;
  const double u = at_most_one(0.5 * part * both * per_furthest);
  const double slope = part * (1.0 - u) / (both > 0.0 ? both : 1.0);
  return {furthest * u * (2.0 - u), slope * da, slope * db};
}

/// phi and its derivatives with respect to da and db.
struct ClosurePotential {
  double value, by_a, by_b;
};

/// phi_exact, 1/(2 L) Int max(d, 0)^2 ds: (da^2 + da db + db^2)/6 where both ends are closed, or
/// where the face carries tension; d^3/(6 |da - db|) where only the end with closure d is closed.
EDDA_INLINE ClosurePotential exact_potential(double da, double db, bool carries_tension) {
  const double pa = positive_part(da), pb = positive_part(db);
  const bool whole = carries_tension | ((da >= 0.0) & (db >= 0.0));
  const double closed = pa + pb, difference = std::abs(da - db);
  const double part = closed / (difference > 0.0 ? difference : 1.0);
  constexpr double sixth = 1.0 / 6.0;
  const double far = sixth * closed * part * part;  // with respect to the open end
  const double near = 0.5 * closed * part - far;    // with respect to the closed end
  const bool a_closed = pa > 0.0, b_closed = pb > 0.0;
  const double by_a = a_closed ? near : far, by_b = b_closed ? near : far;
  return {sixth * (whole ? da * da + da * db + db * db : closed * closed * part),
          whole ? sixth * (2.0 * da + db) : by_a, whole ? sixth * (da + 2.0 * db) : by_b};
}

/// phi_ends, (max(da, 0)^2 + max(db, 0)^2)/4, or (da^2 + db^2)/4 where the face carries tension.
EDDA_INLINE ClosurePotential potential_at_ends(double da, double db, bool carries_tension) {
  const double pa = carries_tension ? da : positive_part(da),
               pb = carries_tension ? db : positive_part(db);
  return {(pa * pa + pb * pb) / 4.0, pa / 2.0, pb / 2.0};
}

/// Corner weight sin^2(eps - theta)/(sin^2 theta + sin^2(eps - theta)), with its derivatives; eps
/// is the exterior angle of the corner. The two edges of the corner make the angles theta and eps -
/// theta with the edge that it leans on, so their weights sum to one. turn: cosine and sine of eps.
/// c, s: cosine and sine of theta >= 0, both times the same length.
struct CornerWeight {
  double value, by_c, by_s;
};
EDDA_INLINE CornerWeight corner_weight(Vec2 turn, double c, double s) {
  const double x = positive_part(turn.y * c - turn.x * s);  // sine of eps - theta
  const double a = x * x, b = s * s, sum = a + b;
  const double inverse = 1.0 / (sum > 0.0 ? sum : 1.0), twice = 2.0 * inverse * inverse;
  return {a * inverse, twice * b * x * turn.y, -twice * (b * x * turn.x + a * s)};
}

}  // namespace edda
