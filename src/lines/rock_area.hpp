// The area that a cut must give back.
#pragma once

#include <optional>
#include <vector>

#include "base/polygon.hpp"

namespace edda {

/// Area of `outline` without the union of `openings`, m2, by GEOS's overlay, which shares nothing
/// with the cut itself. Nothing where a ring is not simple.
std::optional<double> rock_area(const Ring& outline, const std::vector<Ring>& openings);

}  // namespace edda
