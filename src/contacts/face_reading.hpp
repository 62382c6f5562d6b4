// Read access to the state of faces: forces, strength, position. The signs are those of the theory,
// "Sign conventions" (docs/theory.md).
#pragma once

#include <algorithm>
#include <utility>

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/joint_strength.hpp"

namespace edda {

/// Block of `edge`, and block of `facing`.
inline Id block_of_edge(const BlockSet& b, const FaceSet& f, std::size_t k) {
  return b.vertex_block[f.edge[k]];
}
inline Id block_of_facing(const BlockSet& b, const FaceSet& f, std::size_t k) {
  return b.vertex_block[f.facing[k]];
}

/// Both blocks of face k, the lower number first.
inline std::pair<Id, Id> blocks_of_face(const BlockSet& b, const FaceSet& f, std::size_t k) {
  return std::minmax({block_of_edge(b, f, k), block_of_facing(b, f, k)});
}

/// Face k at step n, a value: its state and the forces on its corners (N), with what is decided of
/// it in `of`.
struct FaceRow {
  const FaceSet& of;
  std::size_t k;
  FaceFields state;
  CornerForces force;
  bool opened, slipped;  ///< it has opened after having been closed; an end has slipped
};

/// Whether it carries force, or is bonded and would carry it at any displacement.
inline bool is_closed(const FaceRow& r) {
  return r.state.energy > 0.0 || (r.of.bonded(r.k) && r.state.gate > 0.0);
}

/// The larger drawn closure of the two ends of face k, m. closure: those at its ends.
inline double drawn_closure(const FaceSet& f, FaceEnds closure, std::size_t k) {
  return std::max(closure.a - f.locked_closure_a[k], closure.b - f.locked_closure_b[k]);
}
inline double closure_of(const FaceRow& r) {
  return drawn_closure(r.of, {r.state.closure_a, r.state.closure_b}, r.k);
}

/// Whether the face is closed, or its edges touch within this gap, m.
inline bool meets_within(const FaceRow& r, double gap) {
  return is_closed(r) || (r.of.acts(r.k) && r.state.gate > 0.0 && closure_of(r) >= -gap);
}
/// The same within rounding, corners that touch as drawn included (closed_by()).
inline bool meets(const FaceRow& r) {
  return meets_within(r, r.of.noise + 2.0 * least_closed * r.of.passing[r.k]);
}

/// Inscribed radius of the narrower of the two blocks of face k, m.
inline double narrower_radius(const BlockSet& b, const FaceSet& f, std::size_t k) {
  return std::min(b.inradius[block_of_edge(b, f, k)], b.inradius[block_of_facing(b, f, k)]);
}

/// Normal force, N, positive in compression; shear force, N, positive where it drives the block of
/// `facing` along the edge.
inline double normal_force(const FaceRow& r) {
  const FaceFields& m = r.state;
  return m.normal_a + m.normal_b + m.damping_a + m.damping_b;
}
inline double shear_force(const FaceRow& r) {
  const FaceFields& m = r.state;
  return m.shear_a + m.shear_b + m.shear_damping_a + m.shear_damping_b;
}

/// Shear strength c L + N tan(phi), N (theory, section 5.1), of bonds as they hold at present.
inline double shear_strength(const FaceRow& r) {
  const FaceSet& f = r.of;
  const double held = f.bonded(r.k) ? f.bond_strength : 1.0;
  return coulomb_limit(held * f.cohesion[r.k] * r.state.cohesive, f.friction[r.k], normal_force(r));
}

/// Whether Coulomb's limit has cut the shear force of one of its ends in the last step.
inline bool slides(const FaceRow& r) {
  const FaceFields& m = r.state;
  return is_closed(r) && !r.of.bonded(r.k) &&
         is_cut(FaceEnds{m.trial_a, m.trial_b}, FaceEnds{m.slip_a, m.slip_b});
}

/// Force on the block of `facing`, N; the force on the block of `edge` is opposite.
inline Vec2 force_on_facing(const FaceRow& r) {
  return r.force.q1 + r.force.q2;
}

/// Ends of the overlap on `edge`; along t they are L apart. Where the edges have passed each other
/// there is no overlap, and both ends are midway between the corners.
struct FaceSpan {
  Vec2 a, b;
};
/// The whole `edge` of a face.
inline FaceSpan edge_of(const FaceRow& r, const Pose& pose) {
  const FaceSet& f = r.of;
  return {{pose.x[f.edge[r.k]], pose.y[f.edge[r.k]]},
          {pose.x[f.edge_end[r.k]], pose.y[f.edge_end[r.k]]}};
}
inline FaceSpan span_of(const FaceRow& r, const Pose& pose) {
  const FaceSpan edge = edge_of(r, pose);
  const auto at = [&](double xi) { return (1.0 - xi) * edge.a + xi * edge.b; };
  const double xi_a = r.state.xi_a, xi_b = r.state.xi_b;
  if (r.state.length > 0.0) return {at(xi_a), at(xi_b)};
  const Vec2 middle = at(0.5 * (xi_a + xi_b));
  return {middle, middle};
}
/// Between the middles of both edges of a face that have come apart, m.
inline double distance_apart(const FaceRow& r, const Pose& pose) {
  const FaceSet& f = r.of;
  const Vec2 q1{pose.x[f.facing[r.k]], pose.y[f.facing[r.k]]},
      q2{pose.x[f.facing_end[r.k]], pose.y[f.facing_end[r.k]]};
  const FaceSpan edge = edge_of(r, pose);
  return 0.5 * norm(q1 + q2 - edge.a - edge.b);
}
inline Vec2 middle_of(const FaceRow& r, const Pose& pose) {
  const FaceSpan span = span_of(r, pose);
  return 0.5 * (span.a + span.b);
}
/// The corner, of `edge` or of `facing`, that bounds the overlap at the end of larger closure; the
/// ends lie at the fractions xi and eta of the edges with these corners.
inline Vec2 deeper_end(const FacePoints& p, FaceEnds closure, FaceEnds of_edge,
                       FaceEnds of_facing) {
  const bool b_is = closure.b >= closure.a;
  const double xi = b_is ? of_edge.b : of_edge.a, eta = b_is ? of_facing.b : of_facing.a;
  const bool of_first = xi == 0.0 || xi == 1.0;
  return of_first ? (1.0 - xi) * p.p1 + xi * p.p2 : eta * p.q1 + (1.0 - eta) * p.q2;
}

}  // namespace edda
