// To how many digits numbers were rounded before they were written down.
#pragma once

#include <array>

namespace edda {

/// Counts the decimals of numbers, the coordinates of a file. Those of 0.25 are two, those of 300
/// less two, however they were written; what follows the 14th significant digit is rounding of a
/// program and left out.
class Digits {
 public:
  void add(double number);

  /// One unit of the last decimal, 10^-d: d is the largest number of decimals that a tenth of the
  /// numbers with a fraction have, of whole numbers a tenth of all but 0 (of numbers to four
  /// decimals a tenth end in 0, and a few may have been moved by a program). 0 without any numbers.
  double unit() const;

 private:
  static constexpr int fewest = -12, most = 30;
  std::array<long long, most - fewest + 1> with_{};  ///< by number of decimals, from the fewest
  long long zeros_ = 0;
};

}  // namespace edda
