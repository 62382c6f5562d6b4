// When rows and frames are due: multiples counted, never summed, so that no rounding piles up.
#pragma once

#include <cstdint>

namespace edda {

struct Event {
  double time = 0.0;  ///< s
  bool row = false, frame = false;
  bool end = false;                                 ///< of the stage
  bool counted_row = false, counted_frame = false;  ///< a multiple of its interval falls here
};

/// t = 0, every multiple of both intervals, and the end of each stage, in order; times that
/// rounding keeps apart are one.
class EventTimes {
 public:
  /// Seconds, both > 0.
  EventTimes(double row_every, double frame_every)
      : row_every_(row_every), frame_every_(frame_every) {}
  /// The stage in hand ends at this time, s.
  void end_at(double time) { end_ = time; }
  /// The event after the last one given; the first is t = 0. Precondition: the end of the stage has
  /// not been given.
  Event next();
  /// An event that was given but not waited for comes again.
  void put_back(const Event& event) {
    if (event.counted_row) --row_;
    if (event.counted_frame) --frame_;
  }
  /// Multiples of both intervals that come next, and to go on from there.
  std::uint64_t next_row() const { return row_; }
  std::uint64_t next_frame() const { return frame_; }
  void go_on_from(std::uint64_t row, std::uint64_t frame) {
    row_ = row;
    frame_ = frame;
  }
  /// To go on with the multiples behind a time.
  void go_on_after(double time);

 private:
  double end_ = 0.0, row_every_, frame_every_;
  std::uint64_t row_ = 0, frame_ = 0;  ///< multiples that come next
};

/// k times `every`, as a decimal would be read: 3 x 0.1 is 0.3.
double multiple(std::uint64_t k, double every);

}  // namespace edda
