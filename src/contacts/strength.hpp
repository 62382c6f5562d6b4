// Strength reduction: laws and contacts whose cohesion, tangent of the friction angle and tensile
// strength are divided by a factor, peak and residual alike (Zienkiewicz, Humpheson and Lewis 1975;
// Matsui and San 1992).
#pragma once

#include <vector>

#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// The same laws with the strength as the model gives it divided by factors[row]; glued rows stay.
/// factors: [rows], above zero.
LawTable divided_laws(const Model& model, const std::vector<double>& factors);

/// Brings contacts that have their strength from `before` to that of `now`.
void take_strength(FaceSet& contacts, const LawTable& before, const LawTable& now);

}  // namespace edda
