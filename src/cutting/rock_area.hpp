// The area that the blocks of a cut must have together.
#pragma once

#include <optional>
#include <vector>

#include "base/polygon.hpp"

namespace edda {

/// Area of `outline` without the union of `openings`, m2, by GEOS's overlay, which shares nothing
/// with the cut itself. Nothing where a ring is not simple.
std::optional<double> rock_area(const Ring& outline, const std::vector<Ring>& openings);

/// Area enclosed by both rings, m2, or by the first alone where the second is empty. Nothing where
/// it cannot be computed.
std::optional<double> common_area(const Ring& a, const Ring& b);

}  // namespace edda
