// Joint laws whose strength or opening goes with slip: slip weakening, dilation, Barton and Bandis.
// Such faces are few; the loops over all faces know nothing of them. They see the friction and
// cohesion in force, which are brought up to date here between two steps.
//
// Notation: u slip made so far, both ways added up (m); sigma = N/(L t) mean normal stress on the
// length L of the face; psi dilation angle.
//   slip weakening: strength = peak + (residual - peak) min(u/slip_distance, 1)
//   Barton and Bandis (Barton and Choubey 1977; Barton, Bandis and Bakhtar 1985):
//     tan(phi_r + JRC(u) log10(JCS/sigma)),  psi = JRC(u) log10(JCS/sigma)/2 degrees,
//     JRC(u) its peak value until u = u_p = L/500 (JRC/L)^0.33 and less beyond it
//   dilation: the joint opens by tan(psi) |du|: the closure of its surfaces as drawn goes up by
//     that much, and what the normal pressure stores more is taken from what friction dissipates,
//     T |du| - N tan(psi) |du|.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Slip that a face of this law begins with: none, or for one that never was whole, no end of
/// it.
double first_slip(const Law& law);

/// Part of JRC that is left after the slip u where the peak is at `peak` (m).
double roughness_left(double slip, double peak);

/// Barton and Bandis' angle of friction, degrees, at the normal stress sigma (Pa); at most 70.
double barton_angle(const Law& law, double roughness, double sigma);

/// Adds the slip of the step before, opens what dilates, and puts in force the strength that
/// follows. With pose.x1 at n, of which FaceSet::before is the memory, and pose.x at n + 1 or, with
/// the implicit method, at n.
void update_joint_laws(FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                       const LawTable& laws);
/// The strength alone, by the slip so far and the normal force as it is.
void put_strengths_in_force(FaceSet& faces, const LawTable& laws);

}  // namespace edda
