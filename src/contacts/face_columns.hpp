// What a step reads of the columns of a FaceSet and writes to them, face by face.
#pragma once

#include "contacts/face_set.hpp"
#include "contacts/face_step.hpp"

namespace edda {

/// EndMotion::slip of face k from the corners `then` to `at`, at which it is this element, m.
inline FaceEnds slip_of(const FaceSet& c, const Face& face, const FacePoints& at,
                        const FacePoints& then, std::size_t k) {
  const auto corners = [&](const FacePoints& p) {
    return coordinates_of(p, c.inverse_e[k], c.inverse_f[k]);
  };
  return motion_of(face, corners(at), corners(then), length_ratio(c, k)).slip;
}

/// What a loop over the faces of a chunk reads and writes. x, y: positions at n; x1, y1: at n - 1.
struct FaceView : FaceProperties<const double*> {
  const Id *edge, *edge_end, *facing, *facing_end;
  const double *exterior_cosine, *exterior_sine;
  const double *x, *y, *x1, *y1;
  double noise;
  const double *point_inverse, *edge_inverse;  // inverse masses, 1/kg, for dashpots
  double per_step;                             ///< 1/s, of the step from n - 1 to n
  FaceFields<double*> now;
  FaceFields<const double*> before;
  double* force;
};

/// The state of face k at n - 1, from its columns and positions.
template <bool dashpots>
EDDA_INLINE FaceBefore face_before(const FaceView& c, std::size_t k) {
  const FaceFields<const double*>& m = c.before;
  return {m.slip_a[k],
          m.slip_b[k],
          m.overlap[k],
          m.spring[k],
          m.energy[k] > 0.0,
          m.gate[k] > 0.0,
          m.closure_a[k] > c.noise,
          m.closure_b[k] > c.noise,
          m.switched[k] > 0.0,
          coordinates_at(c, c.x1, c.y1, k),
          dashpots ? FaceEnds{m.damping_a[k], m.damping_b[k]} : FaceEnds{},
          dashpots ? FaceEnds{m.shear_damping_a[k], m.shear_damping_b[k]} : FaceEnds{},
          dashpots ? FaceEnds{m.strike_a[k], m.strike_b[k]} : FaceEnds{}};
}

template <bool dashpots>
EDDA_INLINE FaceInputs inputs_of(const FaceView& c, std::size_t k) {
  const auto inverse_mass = [&](const Id* from, const Id* to) {
    return dashpots ? inverse_mass_of_edge(c, from[k], to[k]) : EdgeInverseMass{};
  };
  return {face_pair(c, c.exterior_cosine, c.exterior_sine, k),
          {c.shear_stiffness[k], c.friction[k], c.cohesion[k], c.bonded[k] > 0.0, c.zeta[k],
           c.shear_zeta[k], c.rebound[k]},
          face_points(c, c.x, c.y, k),
          face_points(c, c.x1, c.y1, k),
          face_before<dashpots>(c, k),
          inverse_mass(c.edge, c.edge_end),
          inverse_mass(c.facing, c.facing_end),
          c.per_step,
          c.noise,
          {}};
}

/// Writes the state of face k at n.
template <bool dashpots>
EDDA_INLINE void write_face(const FaceView& c, const Face& face, const FaceStep& s, std::size_t k) {
  const FaceFields<double*>& m = c.now;
  m.closure_a[k] = face.closure.a;
  m.closure_b[k] = face.closure.b;
  m.energy[k] = face.energy;
  m.normal_a[k] = face.normal.a;
  m.normal_b[k] = face.normal.b;
  m.shear_a[k] = s.shear.a;
  m.shear_b[k] = s.shear.b;
  m.slip_a[k] = s.slip.a;
  m.slip_b[k] = s.slip.b;
  m.trial_a[k] = s.trial.a;
  m.trial_b[k] = s.trial.b;
  m.spring[k] = s.spring;
  m.length[k] = larger(face.length, 0.0);
  m.cohesive[k] = face.cohesive;
  m.overlap[k] = s.overlap;
  m.gate[k] = face.gate;
  m.xi_a[k] = face.xi.a;
  m.xi_b[k] = face.xi.b;
  m.eta_a[k] = face.eta.a;
  m.eta_b[k] = face.eta.b;
  m.switched[k] = s.switched ? 1.0 : 0.0;
  m.friction_work[k] = s.friction;
  m.transfer[k] = s.transfer;
  if constexpr (dashpots) {
    m.damping_a[k] = s.damping.a;
    m.damping_b[k] = s.damping.b;
    m.shear_damping_a[k] = s.shear_damping.a;
    m.shear_damping_b[k] = s.shear_damping.b;
    m.strike_a[k] = s.strike.a;
    m.strike_b[k] = s.strike.b;
    m.damping_work[k] = s.damping_work;
    m.damping_due[k] = s.damping_due;
  }
}

/// The same for a face that has carried nothing for two steps; its other columns are 0 already.
EDDA_INLINE void write_open_face(const FaceView& c, const OpenFace& s, std::size_t k) {
  const FaceFields<double*>& m = c.now;
  m.closure_a[k] = s.closure.a;
  m.closure_b[k] = s.closure.b;
  m.length[k] = m.overlap[k] = s.length;
  m.gate[k] = s.gate;
  m.cohesive[k] = s.cohesive;
  m.xi_a[k] = s.xi.a;
  m.xi_b[k] = s.xi.b;
  m.eta_a[k] = s.eta.a;
  m.eta_b[k] = s.eta.b;
}

}  // namespace edda
