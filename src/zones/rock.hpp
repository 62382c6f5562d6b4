// Rock of zones: its elasticity, where it yields, how its strength falls, and its foliation.
//
// Strength falls from the peak to the residual one as a band of rock shears. What a zone remembers
// is its plastic shear strain g, the accumulated difference e1 - e3; a band through it is as wide
// as two zones (w), so that it has slipped by w g: the strength falls linearly with w g over a
// given slip, and what a band dissipates hardly hangs on the size of the zones.
#pragma once

#include <array>
#include <optional>
#include <variant>

#include "model/model.hpp"
#include "zones/foliation.hpp"
#include "zones/hoek_brown.hpp"
#include "zones/mohr_coulomb.hpp"

namespace edda {

/// The first: rock that stays elastic.
using YieldSurface = std::variant<std::monostate, MohrCoulombSurface, HoekBrown>;
inline bool yields(const YieldSurface& surface) {
  return surface.index() > 0;
}

struct ZoneMaterial {
  IsotropicElasticity elastic{};
  YieldSurface peak{}, residual{};  ///< residual: empty where the strength does not fall
  double slip = 0.0;  ///< m, from the peak to the residual strength; 0: at the first slip
  std::optional<Foliation> foliation{};
};
/// Whether it yields anywhere.
inline bool has_strength(const ZoneMaterial& rock) {
  return yields(rock.peak) || (rock.foliation && rock.foliation->strength);
}
ZoneMaterial zone_material(const Material& material);
/// Stresses xx, yy, xy of elastic rock per strains xx, yy and 2 xy in the plane, Pa.
using PlaneStiffness = std::array<std::array<double, 3>, 3>;
PlaneStiffness plane_stiffness(const ZoneMaterial& rock);
inline ZoneMaterial rock_that_yields(const IsotropicElasticity& elastic,
                                     const MohrCoulomb& strength) {
  return {elastic, surface_of(strength)};
}

/// With the shear and tensile strength divided by a factor, dilation with the friction.
ZoneMaterial divided(const ZoneMaterial& rock, double factor);

/// Whether stresses in any order are within the strength after a slip (m).
bool stays_elastic(const ZoneMaterial& rock, double slip, const Principal& stress);

/// Return of stresses in any order to the strength of the rock after a slip (m); it yields.
ReturnedStress return_to(const ZoneMaterial& rock, double slip, const Principal& trial);

/// By how much Mohr's circle of the largest and smallest principal stress may grow about its centre
/// until the rock yields after a slip (m) in shear or tension, and that in the plane until its
/// foliation slips or opens; the smaller. It is 1 where the rock yields, and infinite without a
/// limit. Stress: of a zone, as seen from it: xx, yy, zz, xy, Pa.
double strength_factor(const ZoneMaterial& rock, double slip, const std::array<double, 4>& stress);

}  // namespace edda
