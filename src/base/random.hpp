// Random numbers that are the same on every compiler and processor: whole-number arithmetic, and
// the four operations and square roots, which are exactly rounded. The library's distributions, and
// its log and exp, are not used: they may differ between systems.
#pragma once

#include <cstdint>
#include <string_view>

namespace edda {

/// One stream of random numbers: SplitMix64 (Steele, Lea, Flood 2014), whose state is a counter, so
/// that any number of independent streams can be started from keys.
class Random {
 public:
  /// The stream of a key: a seed mixed with whatever distinguishes one use from another.
  explicit Random(std::uint64_t key) : state_(key) {}

  std::uint64_t next();
  /// Uniform in [0, 1), of 53 bits.
  double uniform();
  /// Mean 0 and standard deviation 1 (Marsaglia's polar method).
  double normal();

 private:
  std::uint64_t state_;
};

/// A key that depends on all bits of both.
std::uint64_t mixed(std::uint64_t key, std::uint64_t value);
/// As above, with the bytes of a text.
std::uint64_t mixed(std::uint64_t key, std::string_view text);

/// Natural logarithm of x > 0, with a relative and an absolute error of 2e-16.
double portable_log(double x);
/// e to the x, with a relative error of 1e-15; x within +-700.
double portable_exp(double x);

}  // namespace edda
