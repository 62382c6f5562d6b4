// Cohesive cracks: joints whose tensile strength and cohesion fall linearly as they open and slip
// (theory, section 5.9; Hillerborg, Modeer and Petersson 1976). Faces that are elastic cost nothing
// more than other bonds: the loops find those that exceed their strength, and these are decided one
// by one from then on.
//
// Each end of a face stands for half of it. Notation, for an end:
//   w  largest opening of its crack so far (FaceSet::parted_a, parted_b), g <= w the present one
//      (FaceSet::gap_a, gap_b), m; s plastic slip of the face (FaceSet::slip_so_far), m
//   D = min(w/w_c + s/s_c, 1),  w_c = 2 G_I/T,  s_c = 2 G_II/c
// The opening of the crack adds to that of the normal spring: it is part of the locked closure.
// With the normal force N of the end (compression positive) and the length L of the face
//   g = 0: N >= 0, or 0 <= -N <= (1 - D) T L/2 where w = 0      0 < g < w: N = 0
//   g = w: 0 <= -N <= (1 - D) T L/2, and w grows where the strength is exceeded
// so that the crack closes and opens again without force, the spring is elastic, and what the end
// dissipates is the integral of (1 - D) T L/2 over w: G_I L/2 in tension alone. Cohesion in force
// is (1 - D) c with the mean D of both ends; friction stays. Where D = 1 at both ends the face is
// broken, and is one of the residual strength.
#pragma once

#include "contacts/evaluate_face.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// D of both ends at these openings w (m) and at the slip s (m).
FaceEnds damage_of(const Law& law, FaceEnds parted, double slip);
/// Those of face k.
FaceEnds damage_of(const FaceSet& faces, const LawTable& laws, std::size_t k);

/// Whether decide_face() leaves face k to soften_face(): its law softens, and it carries tension.
bool may_soften(const FaceSet& faces, const LawTable& laws, std::size_t k);

/// Opens the crack of face k until it carries what it can at the positions of the scene, and puts
/// the strength that is left in force; a face that had its bond begins to soften. Accounts for the
/// energy that its springs lose as fracture energy.
void soften_face(FaceSet& faces, const FaceScene& scene, std::size_t k);

/// Adds the plastic slip of face k in the step to n, where its state is m, to its slip so far. What
/// cohesion has dissipated on it becomes fracture energy. Requires pose.x1 at n.
void soften_by_slip(FaceSet& faces, const BlockSet& blocks, const Pose& pose, const LawTable& laws,
                    const FaceFields& m, std::size_t k);

}  // namespace edda
