#include "report/peaks.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace edda {

std::vector<std::size_t> rows_with_peaks(const std::vector<double>& time,
                                         const std::vector<double>& values, std::size_t slivers) {
  std::vector<std::size_t> rows;
  if (time.size() <= 4 * slivers) {
    rows.resize(time.size());
    std::iota(rows.begin(), rows.end(), std::size_t{0});
    return rows;
  }
  const double span = std::max(time.back() - time.front(), 1e-300);
  const auto sliver_of = [&](std::size_t r) {
    return static_cast<std::size_t>((time[r] - time.front()) / span * static_cast<double>(slivers));
  };
  for (std::size_t first = 0; first < time.size();) {
    std::size_t end = first + 1, low = first, high = first;
    for (; end < time.size() && sliver_of(end) == sliver_of(first); ++end) {
      // A value that is not a number is neither the lowest nor the highest.
      if (std::isnan(values[low]) || values[end] < values[low]) low = end;
      if (std::isnan(values[high]) || values[end] > values[high]) high = end;
    }
    const std::array some{first, std::min(low, high), std::max(low, high), end - 1};
    for (const std::size_t r : some) {
      if (rows.empty() || rows.back() != r) rows.push_back(r);
    }
    first = end;
  }
  return rows;
}

}  // namespace edda
