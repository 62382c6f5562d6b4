// To how many digits numbers were rounded before they were written down.
#pragma once

#include <array>

namespace edda {

/// Counts the decimals of numbers, the coordinates of a file. Those of 0.25 are two, however it was
/// written; what follows the 14th significant digit is rounding of a program and left out.
class Digits {
 public:
  void add(double number);

  /// One unit of the last decimal, 10^-d: d is the largest number of decimals that a tenth of the
  /// numbers with decimals have (of numbers to four decimals a tenth end in 0, and a few may have
  /// been moved by a program). 1 for whole numbers; 0 without any numbers.
  double unit() const;

 private:
  static constexpr int most = 30;
  std::array<long long, most + 1> with_{};  ///< by number of decimals
};

}  // namespace edda
