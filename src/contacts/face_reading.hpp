// Read access to the state of faces: forces, strength, position. The signs are those of the theory,
// "Sign conventions" (docs/theory.md).
#pragma once

#include <algorithm>
#include <utility>

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
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

/// Whether face k carries force, or is bonded and would carry it at any displacement.
inline bool is_closed(const FaceSet& f, std::size_t k) {
  return f.now.energy[k] > 0.0 || (f.bonded[k] > 0.0 && f.now.gate[k] > 0.0);
}

/// The larger drawn closure of the two ends of face k, m, where they are closed by so much.
inline double drawn_closure(const FaceSet& f, FaceEnds closure, std::size_t k) {
  return std::max(closure.a - f.locked_closure_a[k], closure.b - f.locked_closure_b[k]);
}
inline double closure_of(const FaceSet& f, std::size_t k) {
  return drawn_closure(f, {f.now.closure_a[k], f.now.closure_b[k]}, k);
}

/// Whether the face is closed, or its edges touch within this gap, m.
inline bool meets_within(const FaceSet& f, double gap, std::size_t k) {
  return is_closed(f, k) || (f.acts[k] > 0.0 && f.now.gate[k] > 0.0 && closure_of(f, k) >= -gap);
}
/// The same within rounding, corners that touch as drawn included (closed_by()).
inline bool meets(const FaceSet& f, std::size_t k) {
  return meets_within(f, f.noise + 2.0 * least_closed * f.passing[k], k);
}

/// Inscribed radius of the narrower of the two blocks of face k, m.
inline double narrower_radius(const BlockSet& b, const FaceSet& f, std::size_t k) {
  return std::min(b.inradius[block_of_edge(b, f, k)], b.inradius[block_of_facing(b, f, k)]);
}

/// Normal force, N, positive in compression; shear force, N, positive where it drives the block of
/// `facing` along the edge.
inline double normal_force(const FaceSet& f, std::size_t k) {
  const FaceMemory& m = f.now;
  return m.normal_a[k] + m.normal_b[k] + m.damping_a[k] + m.damping_b[k];
}
inline double shear_force(const FaceSet& f, std::size_t k) {
  const FaceMemory& m = f.now;
  return m.shear_a[k] + m.shear_b[k] + m.shear_damping_a[k] + m.shear_damping_b[k];
}

/// Shear strength c L + N tan(phi), N (theory, section 5.1), of bonds as they hold at present.
inline double shear_strength(const FaceSet& f, std::size_t k) {
  const double held = f.bonded[k] > 0.0 ? f.bond_strength : 1.0;
  return coulomb_limit(held * f.cohesion[k] * f.now.cohesive[k], f.friction[k], normal_force(f, k));
}

/// Whether Coulomb's limit has cut the shear force of one of its ends in the last step.
inline bool slides(const FaceSet& f, std::size_t k) {
  const FaceMemory& m = f.now;
  return is_closed(f, k) && f.bonded[k] == 0.0 &&
         (is_cut(m.trial_a[k], m.slip_a[k]) || is_cut(m.trial_b[k], m.slip_b[k]));
}

/// Forces of face k on its corners, N.
inline CornerForces corner_forces(const FaceSet& f, std::size_t k) {
  const double* const on = &f.force[8 * k];
  return {{on[0], on[1]}, {on[2], on[3]}, {on[4], on[5]}, {on[6], on[7]}};
}

/// Force on the block of `facing`, N; the force on the block of `edge` is opposite.
inline Vec2 force_on_facing(const FaceSet& f, std::size_t k) {
  const CornerForces on = corner_forces(f, k);
  return on.q1 + on.q2;
}

/// Ends of the overlap on `edge`; along t they are L apart. Where the edges have passed each other
/// there is no overlap, and both ends are midway between the corners.
struct FaceSpan {
  Vec2 a, b;
};
inline FaceSpan span_of(const FaceSet& f, const Pose& pose, std::size_t k) {
  const Vec2 p1{pose.x[f.edge[k]], pose.y[f.edge[k]]},
      p2{pose.x[f.edge_end[k]], pose.y[f.edge_end[k]]};
  const auto at = [&](double xi) { return (1.0 - xi) * p1 + xi * p2; };
  const double xi_a = f.now.xi_a[k], xi_b = f.now.xi_b[k];
  if (f.now.length[k] > 0.0) return {at(xi_a), at(xi_b)};
  const Vec2 middle = at(0.5 * (xi_a + xi_b));
  return {middle, middle};
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
inline Vec2 deeper_end(const FaceSet& f, const Pose& pose, std::size_t k) {
  const FaceMemory& m = f.now;
  return deeper_end(face_points(f, pose.x, pose.y, k), {m.closure_a[k], m.closure_b[k]},
                    {m.xi_a[k], m.xi_b[k]}, {m.eta_a[k], m.eta_b[k]});
}
inline Vec2 middle_of(const FaceSet& f, const Pose& pose, std::size_t k) {
  const FaceSpan span = span_of(f, pose, k);
  return 0.5 * (span.a + span.b);
}

}  // namespace edda
