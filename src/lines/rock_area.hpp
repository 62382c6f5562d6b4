// The area that a cut must give back.
#pragma once

#include <optional>
#include <vector>

#include "base/polygon.hpp"

namespace edda {

/// Area of `outline` without the union of `openings`, m2, by GEOS's overlay, which shares nothing
/// with the cut itself. Nothing where a ring is not simple.
std::optional<double> rock_area(const Ring& outline, const std::vector<Ring>& openings);

/// Area of what both rings enclose, m2; of the first alone where the second is empty. Nothing where
/// it cannot be measured.
std::optional<double> common_area(const Ring& a, const Ring& b);

}  // namespace edda
