// The range of values that a picture shows, chosen such that a few outliers do not make all others
// look alike.
#pragma once

#include <vector>

namespace edda {

/// A value and how much it counts: the area of its block, m2.
struct Weighed {
  double value = 0.0, weight = 1.0;
};

struct Ends {
  double low = 0.0, high = 0.0;
};

/// The range beyond either end of which lies at most 1 % of the weight. Reorders the values, which
/// are finite.
Ends inner_ends(std::vector<Weighed>& values);

/// The ends of the drawn range: those of `all`; but an end that lies beyond that of `inner` by more
/// than the larger magnitude of `inner` is moved to half of that beyond it.
Ends drawn_ends(Ends all, Ends inner);

/// Values that differ by less than this fraction of the largest differ by rounding.
inline constexpr double one_value = 1e-7;

/// Arrows beyond the drawn range are drawn at most this many times as long as its ends.
inline constexpr double longest_beyond = 1.5;

}  // namespace edda
