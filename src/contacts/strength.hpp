// Strength of a joint as a function of its law, the state of its bond, its slip, its normal stress
// and the factor that divides it (theory, sections 5.1 to 5.8).
//
// Notation: u accumulated slip, both directions added up (m); sigma = N/(L t) mean normal stress on
// the length L of the face.
//  Coulomb: the peak strength until the bond breaks, the residual one afterwards
//  slip weakening: peak + (residual - peak) min(u/slip_distance, 1)
//  Barton-Bandis (Barton and Choubey 1977; Barton, Bandis and Bakhtar 1985):
//    tan(phi_r + JRC(u) log10(JCS/sigma)),  psi = JRC(u) log10(JCS/sigma)/2 degrees,
//    JRC(u) its peak value until u = u_p = L/500 (JRC/L)^0.33 and less beyond it
//  fracture energy: cohesion and tensile strength times 1 - D (contacts/face_softening.hpp)
//  strength reduction: cohesion, the tangent of the friction angle and tensile strength are divided
//    by a factor, peak and residual alike (Zienkiewicz, Humpheson and Lewis 1975; Matsui and San
//    1992)
#pragma once

#include <vector>

#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// The laws of the model where they have come in time, with their strength divided by factors[row];
/// of glued rows it has no effect. factors: [rows], above zero.
LawTable divided_laws(const Model& model, const std::vector<double>& factors,
                      const LawProgress& progress = {});

/// What the strength of a face depends on beside its law and its bond.
struct StrengthInputs {
  double slip = 0.0;    ///< u, m
  double length = 0.0;  ///< L, m; 0: it carries nothing
  double normal = 0.0;  ///< N
  FaceEnds parted{};    ///< w, m, of laws that soften
};
struct StrengthInForce {
  double friction;           ///< tan(phi)
  double cohesion, tension;  ///< times the thickness, N per m of overlap
  double dilation;           ///< tan(psi)
};
StrengthInForce strength_of(const LawTable& laws, std::uint16_t law, BondState bond,
                            const StrengthInputs& inputs);

/// Puts it in force for face k.
void put_in_force(FaceSet& faces, const StrengthInForce& strength, std::size_t k);
/// Puts in force for all faces what follows from their states: that of n - 1, as in a step.
void put_in_force(FaceSet& faces, const FaceStates& states, const LawTable& laws);
/// Sets the bond of face k, and its strength at this slip without normal force. The face carries
/// tension if its law has residual tensile strength; of an intact bond bond_faces() decides.
void set_bond(FaceSet& faces, const LawTable& laws, BondState bond, double slip, std::size_t k);
/// Takes the bond of face k, which then has the residual strength of its law, in tension too.
void set_residual_strength(FaceSet& faces, const LawTable& laws, std::size_t k);

/// Initial value of a face's accumulated slip: 0, or for slip weakening infinite (residual
/// strength), which bond_faces() sets to 0 for faces that touch at the start; of laws that soften,
/// too.
double first_slip(const Law& law);

/// Fraction of JRC that remains after the slip u, with the peak strength at the slip `peak` (m).
double roughness_left(double slip, double peak);

/// Friction angle of Barton-Bandis, degrees, at the normal stress sigma (Pa); at most 70 or, if
/// that is larger, the residual angle.
double barton_angle(const Law& law, double roughness, double sigma);

}  // namespace edda
