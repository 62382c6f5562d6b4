// When rows and frames are due: multiples counted, never summed, so that no rounding piles up.
#pragma once

#include <cstdint>

namespace edda {

struct Event {
  double time = 0.0;  ///< s
  bool row = false, frame = false, end = false;
};

/// t = 0, every multiple of both intervals, and the end, in order; times that rounding keeps apart
/// are one.
class EventTimes {
 public:
  /// Seconds, all > 0.
  EventTimes(double duration, double row_every, double frame_every);
  /// The event after the last one given; the first is t = 0. Precondition: the end has not been
  /// given.
  Event next();
  /// Multiples of both intervals that come next, and to go on from there.
  std::uint64_t next_row() const { return row_; }
  std::uint64_t next_frame() const { return frame_; }
  void go_on_from(std::uint64_t row, std::uint64_t frame) {
    row_ = row;
    frame_ = frame;
  }

 private:
  double duration_, row_every_, frame_every_;
  std::uint64_t row_ = 0, frame_ = 0;  ///< multiples that come next
};

/// k times `every`, as a decimal would be read: 3 x 0.1 is 0.3.
double multiple(std::uint64_t k, double every);

}  // namespace edda
