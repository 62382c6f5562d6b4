#include "run/event_times.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

double multiple(std::uint64_t k, double every) {
  const double per_second = 1.0 / every, whole = std::round(per_second);
  const bool decimal = whole < 1e15 && whole >= 1.0 && 1.0 / whole == every;
  return decimal ? static_cast<double>(k) / whole : static_cast<double>(k) * every;
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
