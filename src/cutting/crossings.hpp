// Number of crossings of lines before they are cut, to refuse a cut that would not end in time.
#pragma once

#include <vector>

#include "cutting/line_work.hpp"

namespace edda {

/// About how many pairs of segments cross; counted where there are few segments, otherwise
/// estimated from pairs drawn in a fixed order. 0 where too few of those cross for an estimate.
double estimated_crossings(const std::vector<LineString>& lines);

}  // namespace edda
