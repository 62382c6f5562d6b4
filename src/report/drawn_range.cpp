#include "report/drawn_range.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace edda {
namespace {

constexpr double beyond = 0.01;  // part of the weight

/// The least value after which, in the order of `before`, at most `rest` of the weight follows.
template <class Before>
double without_the_last(std::vector<Weighed>& values, double rest, Before before) {
  std::size_t first = 0, end = values.size();
  while (end - first > 1) {
    const std::size_t middle = first + (end - first) / 2;
    const auto at = [&](std::size_t k) { return values.begin() + static_cast<std::ptrdiff_t>(k); };
    std::nth_element(at(first), at(middle), at(end), before);
    double after = 0.0;
    for (std::size_t k = middle; k < end; ++k) after += values[k].weight;
    if (after > rest) {
      first = middle;
    } else {
      rest -= after;
      end = middle;
    }
  }
  return values[first].value;
}

}  // namespace

Ends inner_ends(std::vector<Weighed>& values) {
  if (values.empty()) return {};
  double rest = 0.0;
  for (const Weighed& v : values) rest += beyond * v.weight;
  // A value without weight is not left out because of that.
  if (!(rest > 0.0)) rest = -1.0;
  const auto rising = [](const Weighed& a, const Weighed& b) { return a.value < b.value; };
  const auto falling = [](const Weighed& a, const Weighed& b) { return a.value > b.value; };
  const double high = without_the_last(values, rest, rising);
  return {without_the_last(values, rest, falling), high};
}

Ends drawn_ends(Ends all, Ends inner) {
  const double size = std::max(std::abs(inner.low), std::abs(inner.high));
  // Where all but a few blocks are at rest, the picture is to show those few.
  if (size <= 1e-6 * std::max(std::abs(all.low), std::abs(all.high))) return all;
  const double far = size, kept = 0.5 * size;
  return {all.low < inner.low - far ? inner.low - kept : all.low,
          all.high > inner.high + far ? inner.high + kept : all.high};
}

}  // namespace edda
