#include "base/digits.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace edda::digits_test {
namespace {

double unit_of(std::initializer_list<double> numbers) {
  Digits digits;
  for (const double x : numbers) digits.add(x);
  return digits.unit();
}

TEST(Digits, OfAFewNumbers) {
  EXPECT_EQ(Digits{}.unit(), 0.0);
  EXPECT_EQ(unit_of({0.0, 10.0, -3.0, 1e7}), 1.0);
  EXPECT_EQ(unit_of({0.0, 4100.0, -300.0, 1e7}), 100.0);
  EXPECT_EQ(unit_of({0.0}), 1.0);
  EXPECT_EQ(unit_of({0.0, 3.333, 10.0, 6.667, 2.5}), 1e-3);
  EXPECT_EQ(unit_of({-0.25}), 1e-2);
  EXPECT_EQ(unit_of({6691234.123456}), 1e-6);
  EXPECT_EQ(unit_of({1.5e-7}), 1e-8);
  EXPECT_EQ(unit_of({NAN, INFINITY, 0.5}), 1e-1);
}

/// A program that divides millimetres by 1000 leaves 17 digits of which the last are noise.
TEST(Digits, ConversionsLeaveNoNoise) {
  Digits digits;
  for (int i = 1; i < 2000; i += 7) digits.add(i * 0.001);
  EXPECT_EQ(digits.unit(), 1e-3);
}

/// A tenth of rounded numbers end in 0, and a few may have been moved by a program.
TEST(Digits, AreThoseOfMostNumbers) {
  std::mt19937 random(3);
  std::uniform_real_distribution<double> any(-4000.0, 4000.0);
  Digits digits;
  for (int i = 0; i < 1000; ++i) digits.add(std::round(any(random) * 1e4) / 1e4);
  for (int i = 0; i < 30; ++i) digits.add(std::round(any(random) * 1e6) / 1e6);
  EXPECT_EQ(digits.unit(), 1e-4);
  for (int i = 0; i < 1000; ++i) digits.add(any(random));
  EXPECT_LT(digits.unit(), 1e-8);
}

}  // namespace
}  // namespace edda::digits_test
