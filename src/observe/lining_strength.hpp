// What the sections of a lining can carry, for pictures.
#pragma once

#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "model/model.hpp"

namespace edda {

/// Corners of the strength of a section of this lining (its name, or its number) while it is of
/// this material: thrust (N, positive in compression) in x and moment (N m) in y, of the thickness
/// of the model, once round from the largest thrust; empty where it stays elastic; residual: once
/// it has yielded, empty where the strength does not fall.
std::vector<Vec2> strength_outline(const Model& model, const std::string& lining,
                                   const std::string& material, bool residual = false);

}  // namespace edda
