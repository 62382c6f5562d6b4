#include "run/event_times.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

double multiple(std::uint64_t k, double every) {
  // With every = m / 10^d, m a whole number, there is only one rounding.
  double power = 1.0;
  for (int d = 0; d <= 15; ++d, power *= 10.0) {
    const double m = std::round(every * power), product = static_cast<double>(k) * m;
    if (m > 0.0 && m / power == every && product < 9e15) return product / power;
  }
  return static_cast<double>(k) * every;
}

void EventTimes::go_on_after(double time) {
  const auto after = [&](double every) {
    auto k = static_cast<std::uint64_t>(std::floor(time / every));
    while (multiple(k, every) <= time * (1.0 + 1e-9)) ++k;
    return k;
  };
  row_ = after(row_every_);
  frame_ = after(frame_every_);
}

Event EventTimes::next() {
  const double row = multiple(row_, row_every_), frame = multiple(frame_, frame_every_);
  const double same = 1e-9 * std::min({row_every_, frame_every_, end_});
  Event e;
  e.time = std::min(row, frame);
  e.end = e.time >= end_ - same;
  if (e.end) e.time = end_;
  e.counted_row = row <= e.time + same;
  e.counted_frame = frame <= e.time + same;
  e.row = e.end || e.counted_row;
  e.frame = e.end || e.counted_frame;
  // Where both coincide, the time of the row, so that history.csv has exact multiples.
  if (e.row && !e.end) e.time = row;
  if (e.counted_row) ++row_;
  if (e.counted_frame) ++frame_;
  return e;
}

}  // namespace edda
