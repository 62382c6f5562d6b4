// Times of rows and frames: counted as multiples and never added up, so that rounding does not
// accumulate.
#pragma once

#include <cstdint>

namespace edda {

struct Event {
  double time = 0.0;  ///< s
  bool row = false, frame = false;
  bool end = false;                                 ///< end of the stage
  bool counted_row = false, counted_frame = false;  ///< a multiple of its interval is due
};

/// t = 0, every multiple of both intervals, and the end of each stage, in order; times that differ
/// by rounding are one event.
class EventTimes {
 public:
  /// Seconds, both > 0.
  EventTimes(double row_every, double frame_every)
      : row_every_(row_every), frame_every_(frame_every) {}
  /// Sets the end of the present stage, s.
  void end_at(double time) { end_ = time; }
  /// The event after the last one returned; the first is t = 0. Precondition: the end of the stage
  /// has not been returned.
  Event next();
  /// Puts back an event that was returned but not reached.
  void put_back(const Event& event) {
    if (event.counted_row) --row_;
    if (event.counted_frame) --frame_;
  }
  /// The next multiples of both intervals, and how to continue from them.
  std::uint64_t next_row() const { return row_; }
  std::uint64_t next_frame() const { return frame_; }
  void go_on_from(std::uint64_t row, std::uint64_t frame) {
    row_ = row;
    frame_ = frame;
  }
  /// Continues with the multiples after a time.
  void go_on_after(double time);

 private:
  double end_ = 0.0, row_every_, frame_every_;
  std::uint64_t row_ = 0, frame_ = 0;  ///< next multiples
};

/// k times `every`, rounded as a decimal number would be: 3 x 0.1 is 0.3.
double multiple(std::uint64_t k, double every);

}  // namespace edda
