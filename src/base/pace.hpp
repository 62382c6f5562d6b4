// Progress of what takes long, a line every two seconds.
#pragma once

#include <atomic>
#include <chrono>

namespace edda {

/// Says when a line of progress is due, from any thread.
class Pace {
 public:
  /// Whether two seconds have passed since the last line.
  bool due() {
    constexpr long every = 2000;  // ms
    const long now = static_cast<long>(
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - began_)
            .count());
    long last = said_.load(std::memory_order_relaxed);
    return now - last >= every && said_.compare_exchange_strong(last, now);
  }

 private:
  const std::chrono::steady_clock::time_point began_ = std::chrono::steady_clock::now();
  std::atomic<long> said_ = 0;  ///< ms after that
};

}  // namespace edda
