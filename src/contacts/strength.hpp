// Strength reduction (theory, section 5.8): laws and contacts whose cohesion, tangent of the
// friction angle and tensile strength are divided by a factor, peak and residual alike
// (Zienkiewicz, Humpheson and Lewis 1975; Matsui and San 1992).
#pragma once

#include <vector>

#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// The laws of the model with their strength divided by factors[row]; glued rows do not change.
/// factors: [rows], above zero.
LawTable divided_laws(const Model& model, const std::vector<double>& factors);

/// Scales the strength of contacts from the factors of `before` to those of `now`.
void take_strength(FaceSet& contacts, const LawTable& before, const LawTable& now);

}  // namespace edda
