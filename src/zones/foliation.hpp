// Planes of weakness of one direction throughout a rock (foliation, bedding, ubiquitous joints):
// elasticity that is isotropic in the planes alone, and slip and opening on them after Coulomb.
//
// They are fixed in the zone, whose elastic deformation rotates them. With t along them in the
// plane of the model, n across, z out of it, and stresses positive in tension:
//   E_tt = S_tt/E - nu S_zz/E - nu' S_nn/E',  E_nn = S_nn/E' - nu' (S_tt + S_zz)/E',
//   E_tn = S_tn/(2 G')                        (Lekhnitskii 1963; Jaeger and Cook 1979, section 5.8)
//   |S_tn| + S_nn tan(phi) <= c,  S_nn <= T;  dilation dn = tan(psi) |dg| of a slip dg (strain).
#pragma once

#include <array>
#include <optional>

#include "base/vec2.hpp"

namespace edda {

/// Stresses per strains, Pa, in the axes of the planes.
struct TransverseElasticity {
  double tt = 0.0, nn = 0.0, zz = 0.0, tn = 0.0, tz = 0.0, nz = 0.0;
  double shear = 0.0;  ///< G'
};

/// Of Young's modulus and Poisson's ratio in the planes, and E' and nu' across them (nu': strain in
/// the planes over strain across, under a stress across); none if a state of strain would give
/// energy away.
std::optional<TransverseElasticity> transverse_elasticity(double young, double poisson,
                                                          double young_across,
                                                          double poisson_across, double shear);
/// Strains tt, nn and zz under these stresses, Pa.
std::array<double, 3> strains_of(const TransverseElasticity& elastic, double tt, double nn,
                                 double zz);
/// G' after Saint-Venant: 1/G' = 1/E + 1/E' + 2 nu'/E'.
double usual_shear_modulus(double young, double young_across, double poisson_across);

struct FoliationStrength {
  double friction = 0.0, dilation = 0.0;  ///< tangents of phi and psi
  double cohesion = 0.0;                  ///< Pa
  double tension = 0.0;                   ///< Pa; c/tan(phi) at most
};

struct Foliation {
  Vec2 along{1.0, 0.0};  ///< t, unit
  std::optional<TransverseElasticity> elastic{};
  std::optional<FoliationStrength> strength{};
};

/// Plastic strains of the planes.
struct FoliationSlip {
  double slip = 0.0;     ///< dg, engineering strain, with the sign of the shear stress
  double opening = 0.0;  ///< dn
  bool opens = false;    ///< the tensile strength is reached
  bool any() const { return slip != 0.0 || opening != 0.0; }
};
/// By which stresses (across and along the planes, Pa) return to the strength; stiffness across and
/// shear modulus in Pa.
FoliationSlip slip_to(const FoliationStrength& strength, double stiffness, double shear_modulus,
                      double across, double along);

}  // namespace edda
