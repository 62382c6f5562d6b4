// Corotated constant-strain elasticity (theory, section 3).
#pragma once

#include "blocks/initial_stress.hpp"
#include "blocks/kinematics.hpp"
#include "blocks/strain_rate.hpp"

namespace edda {

/// First Piola-Kirchhoff stress, Pa.
struct PiolaStress {
  double xx, xy, yx, yy;
};

/// P = 2 mu (F - R) + lambda tr(R^T F - I) R (theory, section 3.2), the gradient of W = mu |F -
/// R|^2 + lambda/2 tr(R^T F
/// - I)^2 per volume; zero under a rotation.
EDDA_INLINE PiolaStress piola(const Deformation& f, const Rotation& r, double lambda, double mu) {
  const double trace = r.c * (f.xx + f.yy) + r.s * (f.yx - f.xy) - 2.0;
  const double lt = lambda * trace;
  return {2.0 * mu * (f.xx - r.c) + lt * r.c, 2.0 * mu * (f.xy + r.s) - lt * r.s,
          2.0 * mu * (f.yx - r.s) + lt * r.s, 2.0 * mu * (f.yy - r.c) + lt * r.c};
}

/// F sigma0, the contribution of an initial stress to P: the gradient of sigma0 : (F^T F - I)/2. (R
/// sigma0 would not be the gradient of an energy and would make a torque.)
EDDA_INLINE PiolaStress initial_stress_term(const Deformation& f, double xx, double yy, double xy) {
  return {f.xx * xx + f.xy * xy, f.xx * xy + f.xy * yy, f.yx * xx + f.yy * xy,
          f.yx * xy + f.yy * yy};
}

/// P of block i, with its initial stress.
inline PiolaStress stress_in(const BlockSet& b, std::size_t i, const Deformation& f) {
  const PiolaStress p = piola(f, rotation(f), b.lame_lambda[i], b.lame_mu[i]);
  const Tensor s = initial_stress(b, i);
  const PiolaStress q = initial_stress_term(f, s.xx, s.yy, s.xy);
  return {p.xx + q.xx, p.xy + q.xy, p.yx + q.yx, p.yy + q.yy};
}

/// Nodal forces f_k = -V P G_k of block i, N. Blocks: BlockSet or a view with volume and gradients.
template <class Blocks>
EDDA_INLINE NodeVectors elastic_forces(const Blocks& b, const PiolaStress& p, std::size_t i) {
  return nodal_forces_of(b, p, -b.volume[i], i);
}

/// P of the viscous stress eta C : dU/dt of block i, F = R U in `frame` (blocks/strain_rate.hpp).
/// eta: viscosity time of the block, s.
inline PiolaStress viscous_stress(const BlockSet& b, double eta, std::size_t i,
                                  const StrainFrame& frame, const StrainTerms& rate) {
  const double mu = eta * b.lame_mu[i], pressure = eta * b.lame_lambda[i] * (rate.xx + rate.yy);
  const Deformation p = stress_on_rate(
      frame, {pressure + 2.0 * mu * rate.xx, pressure + 2.0 * mu * rate.yy, mu * rate.xy});
  return {p.xx, p.xy, p.yx, p.yy};
}

/// Cauchy stress P F^T / det F, Pa.
inline Tensor cauchy(const PiolaStress& p, const Deformation& f) {
  const double det = f.xx * f.yy - f.xy * f.yx;
  return {(p.xx * f.xx + p.xy * f.xy) / det, (p.yx * f.yx + p.yy * f.yy) / det,
          (p.xx * f.yx + p.xy * f.yy) / det};
}

/// Energy of two strains in the terms of the energy balance, V (2 mu a:b + lambda tr a tr b)/2, J.
inline double strain_energy(const Tensor& a, const Tensor& b, double volume, double lambda,
                            double mu) {
  return 0.5 * volume *
         (2.0 * mu * (a.xx * b.xx + a.yy * b.yy + 2.0 * a.xy * b.xy) +
          lambda * (a.xx + a.yy) * (b.xx + b.yy));
}

/// As strain_energy(), for an initial stress s: V [s : C^-1 : s / 2 + (A s B^T - s : I)/2], J, with
/// the deformations A and B. The sum of both is the energy of the total stress.
inline double initial_energy(const Deformation& a, const Deformation& b, const Tensor& s,
                             double volume, double lambda, double mu) {
  const double axx = a.xx - 1.0, ayy = a.yy - 1.0, bxx = b.xx - 1.0, byy = b.yy - 1.0;
  const double first = s.xx * (axx + bxx) + s.yy * (ayy + byy) + s.xy * (a.xy + a.yx + b.xy + b.yx);
  const double second = s.xx * (axx * bxx + a.yx * b.yx) + s.yy * (a.xy * b.xy + ayy * byy) +
                        s.xy * (axx * b.xy + a.xy * bxx + a.yx * byy + ayy * b.yx);
  const double trace = s.xx + s.yy;
  const double start = (s.xx * s.xx + s.yy * s.yy + 2.0 * s.xy * s.xy -
                        lambda / (2.0 * (lambda + mu)) * trace * trace) /
                       (2.0 * mu);
  return 0.5 * volume * (start + first + second);
}

}  // namespace edda
