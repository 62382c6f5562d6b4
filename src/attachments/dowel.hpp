// A bar that crosses a joint, bedded in grout and rock on either side of it (theory, section 14.2).
//
// Each half is a beam on a foundation (Winkler) that the bar crushes at a pressure. Sheared far
// enough the bar has a plastic hinge in either wall, and turns between them: what is between the
// hinges, the link, has the length R and makes the angle theta with the bolt where the bolt has
// the elongation e there and the walls the offset delta across it,
//
//  (R cos theta, R sin theta) = (H + e, delta),       H the distance of the hinges.
//
// The link carries the axial force N on its elongation R - H and the shear force V on H theta. The
// forces on the walls are the gradients of its energy, so they turn with it. It is elastic within
// (N/N_p)^2 + (V/V_p)^2 = 1, and flows at right angles to that.
#pragma once

#include "base/vec2.hpp"

namespace edda {

/// A round bar.
struct DowelBar {
  double diameter = 0.0;      ///< m
  double young = 0.0;         ///< Pa
  double yield_stress = 0.0;  ///< Pa
};

/// What it is bedded in on one side of a joint.
struct Foundation {
  double modulus = 0.0;   ///< Pa: N per metre of bar and metre of deflection
  double strength = 0.0;  ///< Pa, of the pressure on the bar's diameter
};

/// Of a link without axial force.
struct DowelAction {
  double stiffness = 0.0;  ///< N/m, of two beams that are joined in the middle of the joint
  double strength = 0.0;   ///< N, V_p: of the mechanism with two hinges, or of the sheared section
  double hinges = 0.0;     ///< m, H
};
/// `gap`: distance of the walls along the bar, m.
DowelAction dowel_action(const DowelBar& bar, const Foundation& before, const Foundation& after,
                         double gap);

/// N and V, or their stiffness and strength.
struct LinkPair {
  double axial = 0.0, shear = 0.0;
};

/// A link at an elongation and an offset.
struct BarLink {
  double cosine = 1.0, sine = 0.0;  ///< of theta
  double longer = 0.0;              ///< R - H, m
  double shear = 0.0;               ///< H theta, m
  double length = 0.0;              ///< R, m
  double part = 1.0;                ///< H/R

  /// Gradient by (e, delta) of the energy of a link with the forces N and V.
  Vec2 pull(const LinkPair& f) const {
    return {f.axial * cosine - f.shear * part * sine, f.axial * sine + f.shear * part * cosine};
  }
};
BarLink link_at(double hinges, double elongation, double offset);

/// Forces of a link, and their derivatives by its elongation and its shear.
struct LinkForces {
  LinkPair force;
  double axial_slope = 0.0, mixed_slope = 0.0, shear_slope = 0.0;  ///< N/m
  double energy = 0.0;  ///< J, stored and dissipated since the plastic parts were as given
  bool flows = false;
};
/// At the elastic trial forces `trial`: those on the strength surface that are closest to them in
/// energy. Beyond it remains the part `hardening` of the stiffness.
LinkForces link_forces(const LinkPair& trial, const LinkPair& stiffness, const LinkPair& strength,
                       double hardening);

}  // namespace edda
