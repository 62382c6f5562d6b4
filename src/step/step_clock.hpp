// Wall time of the parts of a step. Only one step in 16 is timed, so that small models do not pay
// for the clock; the report scales the times to the whole run.
#pragma once

#include <chrono>
#include <cstdint>

namespace edda {

/// Sampled seconds by part of the step.
struct StepSeconds {
  double search = 0.0;     ///< contact list, bound of the step
  double forces = 0.0;     ///< loads, evaluation of faces, contact activation
  double integrate = 0.0;  ///< nodal forces, motion, energy accounts
  double sum() const { return search + forces + integrate; }
};

class StepClock {
 public:
  explicit StepClock(std::uint64_t step) : on_(is_sampled(step)) {
    if (on_) last_ = Clock::now();
  }
  /// Adds the time since the last lap to this part.
  void lap(double& part) {
    if (!on_) return;
    const Clock::time_point now = Clock::now();
    part += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  /// Irregular, so that what happens every so many steps is sampled in proportion (a Weyl
  /// sequence).
  static bool is_sampled(std::uint64_t step) { return step * 0x9e3779b97f4a7c15ull >> 60 == 0; }
  bool on_;
  Clock::time_point last_;
};

}  // namespace edda
