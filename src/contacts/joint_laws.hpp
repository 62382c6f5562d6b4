// Slip-dependent joint laws (theory, sections 5.4 to 5.7): slip weakening, dilation, Barton-Bandis.
// Such faces are few, and the loops over all faces do not evaluate the laws: they read the friction
// and cohesion in force, which are updated here between two steps.
//
// Notation: u accumulated slip, both directions added up (m); sigma = N/(L t) mean normal stress on
// the length L of the face; psi dilation angle.
//  slip weakening: strength = peak + (residual - peak) min(u/slip_distance, 1)
//  Barton-Bandis (Barton and Choubey 1977; Barton, Bandis and Bakhtar 1985):
//    tan(phi_r + JRC(u) log10(JCS/sigma)),  psi = JRC(u) log10(JCS/sigma)/2 degrees,
//    JRC(u) its peak value until u = u_p = L/500 (JRC/L)^0.33 and less beyond it
//  dilation: a slip du opens the joint by tan(psi) |du|: the locked closure increases by that much,
//    and the energy that the normal spring gains is taken from what friction dissipates, which
//    becomes T |du| - N tan(psi) |du|. The opening r between n and n + 1 is that of the slip in the
//    same step: dilation is integrated implicitly, since with the slip of the step before N would
//    lag by a step, which is negative damping, and blocks hop. In the leapfrog's terms it takes r
//    (N_n + N_{n+1})/2 from friction, with N_{n+1} in the new position of the blocks: they give way
//    as the joint opens, and r may be many times their closure under the load.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Initial value of a face's accumulated slip: 0, or for slip weakening infinite (residual
/// strength), which bond_faces() sets to 0 for faces that touch at the start.
double first_slip(const Law& law);

/// Fraction of JRC that remains after the slip u, with the peak strength at the slip `peak` (m).
double roughness_left(double slip, double peak);

/// Friction angle of Barton-Bandis, degrees, at the normal stress sigma (Pa); at most 70 or, if
/// that is larger, the residual angle.
double barton_angle(const Law& law, double roughness, double sigma);

/// A face at n: where `complete` is false only what it remembers, and what follows from its corners
/// (closures, normal forces, lengths) is found where a law asks for it.
struct FaceAtN {
  FaceFields state;
  bool complete;
};
/// Adds the slip of face k up to n, puts the resulting strength in force, and opens the joint, if
/// it dilates, by what the slip between n and n + 1 asks for. Requires pose.x1 at n and pose.x at
/// n + 1.
void update_joint_law(FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                      const LawTable& laws, FaceAtN& at_n, std::size_t k);
/// Updates the strength alone, from the accumulated slip and the present normal force.
void put_strengths_in_force(FaceSet& faces, const FaceStates& states, const LawTable& laws);

}  // namespace edda
