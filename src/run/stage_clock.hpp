// Where the wall time of the steps goes. Timed in every 16th step only, so that small models do not
// pay for the clock, and scaled to all of them.
#pragma once

#include <chrono>
#include <cstdint>

namespace edda {

/// Sampled seconds by stage.
struct StageSeconds {
  double search = 0.0;     ///< gaps, corners, list, transitions
  double forces = 0.0;     ///< contact springs and their gathering on the nodes
  double integrate = 0.0;  ///< motion and open-close iteration
  double sum() const { return search + forces + integrate; }
};

class StageClock {
 public:
  explicit StageClock(std::uint64_t step) : on_(step % 16 == 0) {
    if (on_) last_ = Clock::now();
  }
  /// Adds the time since the last lap to `stage`.
  void lap(double& stage) {
    if (!on_) return;
    const Clock::time_point now = Clock::now();
    stage += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool on_;
  Clock::time_point last_;
};

}  // namespace edda
