// Return of a trial stress to an elastic domain that planes bound in the space of principal
// stresses (Koiter 1953; de Souza Neto, Peric and Owen 2008, section 8.2, for Mohr and Coulomb's
// planes).
//
// Elastic strains e and stresses s = C e, with the isotropic C = lambda 1 1^T + 2 mu I. Beyond the
// planes a (n_a . s <= d_a) plastic strains follow the flow m_a of those that act:
//   s = s* - sum_a l_a C m_a,   l_a >= 0,   n_a . s = d_a where l_a > 0,   n_a . s <= d_a
//   elsewhere.
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <span>

namespace edda {

using Principal = std::array<double, 3>;
inline double dot(const Principal& a, const Principal& b) {
  return a[0] * b[0] + a[1] * b[1] + a[2] * b[2];
}

struct YieldPlane {
  Principal normal;      ///< n
  double limit = 0.0;    ///< d, Pa
  Principal flow;        ///< m
  bool tensile = false;  ///< s_i <= limit
};

/// s_i <= limit, associated.
YieldPlane tensile_plane(std::size_t i, double limit);

/// Lame's constants, Pa.
struct IsotropicElasticity {
  double lambda, mu;
  Principal stress(const Principal& strain) const {
    const double pressure = lambda * (strain[0] + strain[1] + strain[2]);
    return {pressure + 2.0 * mu * strain[0], pressure + 2.0 * mu * strain[1],
            pressure + 2.0 * mu * strain[2]};
  }
};

struct ReturnedStress {
  Principal stress{};       ///< Pa
  Principal plastic{};      ///< strain that the return has made plastic
  std::size_t count = 0;    ///< planes that act; 0: elastic
  std::size_t tensile = 0;  ///< those of them that bound a tension
};

/// What `body` returns for these stresses in descending order, in their own order.
template <class Body>
ReturnedStress in_order(const Principal& trial, Body body) {
  std::array<std::size_t, 3> order{0, 1, 2};
  std::sort(order.begin(), order.end(),
            [&](std::size_t i, std::size_t j) { return trial[i] > trial[j]; });
  const ReturnedStress r = body(Principal{trial[order[0]], trial[order[1]], trial[order[2]]});
  ReturnedStress back = r;
  for (std::size_t k = 0; k < order.size(); ++k) {
    back.stress[order[k]] = r.stress[k];
    back.plastic[order[k]] = r.plastic[k];
  }
  return back;
}

/// The first combination of one, two, then three planes with l >= 0 whose return violates no other
/// plane by more than `rounding` (Pa).
ReturnedStress return_to_planes(const Principal& trial, const IsotropicElasticity& elastic,
                                std::span<const YieldPlane> planes, double rounding);

}  // namespace edda
