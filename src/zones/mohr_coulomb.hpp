// Rock after Mohr and Coulomb, with a tension cut-off, in principal stresses (positive in tension).
#pragma once

#include <algorithm>

#include "zones/koiter.hpp"

namespace edda {

struct MohrCoulomb {
  double friction = 0.0, dilation = 0.0;  ///< angles phi and psi, rad
  double cohesion = 0.0;                  ///< c, Pa
  double tension = 0.0;                   ///< cut-off, Pa; c cot(phi) at most
};

/// The planes that can act on stresses s1 >= s2 >= s3 and what the return makes of them:
/// s_i (1 + sin phi) - s_j (1 - sin phi) <= 2 c cos phi for the pairs 13, 12 and 23, with the flow
/// of psi, and s_i <= T.
using MohrCoulombPlanes = std::array<YieldPlane, 6>;
MohrCoulombPlanes yield_planes(const MohrCoulomb& rock);

/// Whether stresses in any order lie within the planes.
inline bool within(const MohrCoulombPlanes& planes, const Principal& s, double rounding) {
  const double most = std::max({s[0], s[1], s[2]}), least = std::min({s[0], s[1], s[2]});
  const YieldPlane &shear = planes[0], &tension = planes[1];
  return shear.normal[0] * most + shear.normal[2] * least <= shear.limit + rounding &&
         most <= tension.limit + rounding;
}

/// A rock with its planes.
struct MohrCoulombSurface {
  MohrCoulomb rock;
  MohrCoulombPlanes planes;
};
inline MohrCoulombSurface surface_of(const MohrCoulomb& rock) {
  return {rock, yield_planes(rock)};
}

/// Return of stresses in any order.
ReturnedStress return_to(const MohrCoulombSurface& surface, const IsotropicElasticity& elastic,
                         const Principal& trial);
inline ReturnedStress return_to(const MohrCoulomb& rock, const IsotropicElasticity& elastic,
                                const Principal& trial) {
  return return_to(surface_of(rock), elastic, trial);
}

}  // namespace edda
