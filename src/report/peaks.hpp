// Long histories, thinned so that every peak stays.
#pragma once

#include <cstddef>
#include <vector>

namespace edda {

/// The rows that show where time is cut into so many slivers: all of them where there are few, or
/// of each sliver the first, the last, the lowest and the highest. `time` ascends.
std::vector<std::size_t> rows_with_peaks(const std::vector<double>& time,
                                         const std::vector<double>& values, std::size_t slivers);

}  // namespace edda
