// Corotated constant-strain elasticity (method.md section 3).
#pragma once

#include <array>

#include "blocks/kinematics.hpp"

namespace edda {

/// First Piola-Kirchhoff stress, Pa.
struct PiolaStress {
  double xx, xy, yx, yy;
};

/// P = 2 mu (F - R) + lambda tr(R^T F - I) R. The gradient of
/// W = mu |F - R|^2 + lambda/2 tr(R^T F - I)^2 per volume; no stress under a rotation.
EDDA_INLINE PiolaStress piola(const Deformation& f, const Rotation& r, double lambda, double mu) {
  const double trace = r.c * (f.xx + f.yy) + r.s * (f.yx - f.xy) - 2.0;
  const double lt = lambda * trace;
  return {2.0 * mu * (f.xx - r.c) + lt * r.c, 2.0 * mu * (f.xy + r.s) - lt * r.s,
          2.0 * mu * (f.yx - r.s) + lt * r.s, 2.0 * mu * (f.yy - r.c) + lt * r.c};
}

/// Nodal force f_k = -V P G_k, N.
EDDA_INLINE Vec2 elastic_force(const PiolaStress& p, double volume, double gx, double gy) {
  return {-volume * (p.xx * gx + p.xy * gy), -volume * (p.yx * gx + p.yy * gy)};
}

/// Cauchy stress P F^T / det F, Pa.
inline Tensor cauchy(const PiolaStress& p, const Deformation& f) {
  const double det = f.xx * f.yy - f.xy * f.yx;
  return {(p.xx * f.xx + p.xy * f.xy) / det, (p.yx * f.yx + p.yy * f.yy) / det,
          (p.xx * f.yx + p.xy * f.yy) / det};
}

/// Energy of two strains in the ledger's terms, V (2 mu a:b + lambda tr a tr b)/2, J.
inline double strain_energy(const Tensor& a, const Tensor& b, double volume, double lambda,
                            double mu) {
  return 0.5 * volume *
         (2.0 * mu * (a.xx * b.xx + a.yy * b.yy + 2.0 * a.xy * b.xy) +
          lambda * (a.xx + a.yy) * (b.xx + b.yy));
}

}  // namespace edda
