// The list of possible contacts, and when it is renewed (theory, section 7.5).
#pragma once

#include "contacts/evaluate_face.hpp"
#include "contacts/near_edges.hpp"
#include "step/divergence.hpp"

namespace edda {

struct Simulation;

/// The blocks and laws that the faces of a simulation refer to.
FaceScene face_scene(const Simulation& sim);

/// Computes all vertices from the nodes.
void place_all(Simulation& sim);
/// Sums the forces of the contacts on each block; to be called where they have been evaluated.
void sum_contact_forces(Simulation& sim);
/// Evaluates the faces at n again, after a change of their strength.
void reevaluate_faces(Simulation& sim);
/// Makes the list of all possible contacts within this reach.
void search(Simulation& sim, const Reach& reach);

// Of faces, for the methods of stepping (step/stepper.hpp):
void begin_faces(Simulation& sim);
void sum_face_forces(Simulation& sim);
std::optional<Failure> deep_overlap_of_faces(const Simulation& sim);

/// The reach of the next list.
Reach next_reach(const Simulation& sim);
/// After each step: renews the list and the bound of the step where that is due.
void search_if_due(Simulation& sim);

}  // namespace edda
