// Progress of rigid limit analysis.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <mutex>
#include <string>

#include "base/pace.hpp"
#include "limit/linear_program.hpp"

namespace edda {

/// Reports every two seconds which limits are being computed, and passes on that it is to stop.
class LimitWatch {
 public:
  LimitWatch(const std::atomic<bool>* stop, std::function<void(const std::string&)> say);
  LimitWatch(const LimitWatch&) = delete;
  LimitWatch& operator=(const LimitWatch&) = delete;

  const ProgramWatch* programs() const { return &programs_; }
  bool stopped() const { return programs_.stopped(); }
  /// What is computed from now on, as in "limit: WHAT, after 3 s".
  void begin(const std::string& what);

 private:
  void after_round();

  std::function<void(const std::string&)> say_;
  ProgramWatch programs_;
  std::mutex mutex_;
  std::string what_;
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  Pace pace_;
};

}  // namespace edda
