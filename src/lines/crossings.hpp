// How often lines cross, before they are cut: whether the cut would end at all.
#pragma once

#include <vector>

#include "lines/line_work.hpp"

namespace edda {

/// About how many pairs of segments cross; counted where there are few segments, otherwise
/// estimated from pairs drawn in a fixed order. 0 where too few of those cross to say.
double estimated_crossings(const std::vector<LineString>& lines);

}  // namespace edda
