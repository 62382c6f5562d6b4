// Thinning of long histories such that every peak remains.
#pragma once

#include <cstddef>
#include <vector>

namespace edda {

/// The rows to draw where time is divided into this number of slivers: all rows where there are
/// few, else the first, the last, the lowest and the highest of each sliver. `time` ascends.
std::vector<std::size_t> rows_with_peaks(const std::vector<double>& time,
                                         const std::vector<double>& values, std::size_t slivers);

}  // namespace edda
