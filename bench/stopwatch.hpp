// Time that a measurement takes.
#pragma once

#include <chrono>
#include <ctime>

/// With one thread the time of the processor, so that what else runs on the machine counts only by
/// what it does to the caches; with more of them that of the clock on the wall.
class Stopwatch {
 public:
  explicit Stopwatch(int threads) : alone_(threads == 1), start_(now()) {}
  double seconds() const { return now() - start_; }

 private:
  double now() const {
    if (alone_) return static_cast<double>(std::clock()) / static_cast<double>(CLOCKS_PER_SEC);
    return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch())
        .count();
  }
  bool alone_;
  double start_;
};
