// Rock after Hoek and Brown (Hoek, Carranza-Torres and Corkum 2002), in principal stresses
// (positive in tension): s1 - s3 <= sigma_ci (s - m s1/sigma_ci)^a for s1 >= s2 >= s3.
//
// A factor of safety divides the shear strength: its envelope tau(sigma_n) in Mohr's plane becomes
// tau/F (Hammah, Yacoub, Corkum and Curran 2005). Lines that touch it go over into lines that touch
// the reduced one, at the same sigma_n: with t the first stress of the circle they touch,
//   sin phi = k/(2 + k),  k = a m (s - m t/sigma_ci)^(a-1),  tan phi' = tan phi/F.
#pragma once

#include "zones/koiter.hpp"

namespace edda {

struct HoekBrown {
  double strength = 0.0;             ///< sigma_ci of the intact rock, Pa
  double m = 0.0, s = 0.0, a = 0.5;  ///< of the rock mass
  double dilation = 0.0;             ///< psi, rad
  double tension = 0.0;              ///< cut-off, Pa; s sigma_ci/m at most
  double factor = 1.0;               ///< F by which the shear strength is divided
};

/// m, s and a of a rock mass by its geological strength index, mi of the intact rock, and the
/// disturbance D (Hoek, Carranza-Torres and Corkum 2002, equations 3 to 5).
struct HoekBrownConstants {
  double m, s, a;
};
HoekBrownConstants hoek_brown_constants(double index, double intact, double disturbance);

/// Distance of s1 and s3 from the surface along s1, Pa; positive outside.
double distance_from_yield(const HoekBrown& rock, double s1, double s3);

/// Radius of the circle about a centre (s1 + s3)/2 that touches the surface or ends at the cut-off,
/// Pa; negative where the centre lies beyond it.
double largest_radius(const HoekBrown& rock, double centre);

/// Whether stresses in any order lie within the surface and the cut-off.
bool within(const HoekBrown& rock, const Principal& s);

/// Return of stresses in any order, by planes that touch the surface where the last return has
/// ended: the domain is convex, so that each of them leaves it whole.
ReturnedStress return_to(const HoekBrown& rock, const IsotropicElasticity& elastic,
                         const Principal& trial);

}  // namespace edda
