// Numbers that a test compares with their exact value, recorded for docs/verification.md: each
// expect_* asserts a bound and records the same numbers. Without the environment variable
// EDDA_VERIFICATION_OUT, the folder to write to, nothing is recorded.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <initializer_list>
#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// What a number is, and the row of docs/validation.md that it belongs to.
struct Quantity {
  int row = 0;
  std::string which;  ///< of the row's cases; may be empty
  std::string what;
  std::string unit;  ///< empty: a ratio
};

/// computed/exact - 1 lies within -bound and bound, or within low and high.
void expect_relative(const Quantity& q, double computed, double exact, double bound);
void expect_relative(const Quantity& q, double computed, double exact, double low, double high);
/// One-sided bounds.
void expect_at_most(const Quantity& q, double computed, double limit);
void expect_at_least(const Quantity& q, double computed, double limit);

/// Of many pairs the one with the largest relative error.
class FurthestOff {
 public:
  void see(double computed, double exact) {
    const double off = std::abs(computed / exact - 1.0);
    if (std::isnan(off_) || off <= off_) return;
    off_ = off;
    computed_ = computed;
    exact_ = exact;
  }
  void expect(const Quantity& q, double bound) const {
    expect_relative(q, computed_, exact_, bound);
  }

 private:
  double off_ = -1.0, computed_ = 0.0, exact_ = 0.0;
};

/// Whether records are written.
bool recording();

/// Records the model of a row: key numbers, outlines of the blocks at the start and now.
void record_model(int row, const std::string& which, const Simulation& sim);

/// A table of numbers for the figure of a row: curves over time, values over depth. Written when it
/// ends.
class Series {
 public:
  Series(int row, std::string which, std::vector<std::string> columns);
  Series(const Series&) = delete;
  Series& operator=(const Series&) = delete;
  ~Series();

  void add(std::initializer_list<double> line);

 private:
  int row_;
  std::string which_;
  std::vector<std::string> columns_;
  std::vector<std::vector<double>> lines_;
};

}  // namespace edda
