// Weights of the corners of a polygon, as for the masses of a block that bends.
#pragma once

#include <vector>

#include "base/vec2.hpp"

namespace edda {

/// Each edge has a weight by its length, half of it at either end, times a factor that is linear
/// over the polygon, so that the centre of these weights is the origin; their sum is 1. Of a
/// polygon so odd that the factor would vanish somewhere it is reduced. tributary: half of the
/// lengths of both edges at each corner.
std::vector<double> corner_weights(const std::vector<Vec2>& corner,
                                   const std::vector<double>& tributary);

}  // namespace edda
