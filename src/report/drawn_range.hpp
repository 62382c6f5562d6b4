// From where to where a picture shows values, so that a few giants do not make all others look
// alike.
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

/// Such that 1 % of the weight lie beyond either at most. Reorders the values, which are finite.
Ends inner_ends(std::vector<Weighed>& values);

/// The ends to draw by: `all`; but one that lies further out than `inner` by more than the larger
/// of `inner` is put where it lies further out by half of that.
Ends drawn_ends(Ends all, Ends inner);

/// Values that differ by less than so much of the largest are one value and rounding.
inline constexpr double one_value = 1e-7;

/// An arrow that is longer than the ends that arrows are drawn by is drawn so many times as long as
/// those at most.
inline constexpr double longest_beyond = 1.5;

}  // namespace edda
