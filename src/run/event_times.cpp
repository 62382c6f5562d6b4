#include "run/event_times.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

double multiple(std::uint64_t k, double every) {
  // As a fraction of whole numbers, every = m / 10^d, there is one rounding only.
  double power = 1.0;
  for (int d = 0; d <= 15; ++d, power *= 10.0) {
    const double m = std::round(every * power), product = static_cast<double>(k) * m;
    if (m > 0.0 && m / power == every && product < 9e15) return product / power;
  }
  return static_cast<double>(k) * every;
}

EventTimes::EventTimes(double duration, double row_every, double frame_every)
    : duration_(duration), row_every_(row_every), frame_every_(frame_every) {}

Event EventTimes::next() {
  const double row = multiple(row_, row_every_), frame = multiple(frame_, frame_every_);
  const double same = 1e-9 * std::min({row_every_, frame_every_, duration_});
  Event e;
  e.time = std::min(row, frame);
  e.end = e.time >= duration_ - same;
  if (e.end) e.time = duration_;
  e.row = e.end || row <= e.time + same;
  e.frame = e.end || frame <= e.time + same;
  // The row's own time where both fall together, so that history.csv shows its multiples.
  if (e.row && !e.end) e.time = row;
  if (e.row) ++row_;
  if (e.frame) ++frame_;
  return e;
}

}  // namespace edda
