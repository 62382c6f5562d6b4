#include "base/spectrum.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

namespace edda {
namespace {

struct Curve {
  std::vector<double> time;
  std::vector<Vec2> value;
};

template <class F>
Curve curve(double duration, std::size_t points, F at) {
  Curve c;
  for (std::size_t k = 0; k < points; ++k) {
    const double t = duration * static_cast<double>(k) / static_cast<double>(points - 1);
    c.time.push_back(t);
    c.value.push_back(at(t));
  }
  return c;
}

double wave(double frequency, double t) {
  return std::sin(2.0 * std::numbers::pi * frequency * t);
}

TEST(Spectrum, ASineHasItsFrequency) {
  for (const double frequency : {0.7, 2.0, 13.3}) {
    const Curve c = curve(10.0, 2001, [&](double t) { return Vec2{3.0, wave(frequency, t)}; });
    EXPECT_NEAR(dominant_frequency(c.time, c.value), frequency, 0.03);
  }
}

TEST(Spectrum, TheStrongerOfTwoCountsWhateverItsDirection) {
  const Curve c = curve(8.0, 1500, [](double t) {
    return Vec2{wave(2.0, t), 2.0 * wave(5.0, t) + 0.5 * wave(11.0, t)};
  });
  EXPECT_NEAR(dominant_frequency(c.time, c.value), 5.0, 0.03);
}

TEST(Spectrum, PointsNeedNotBeEven) {
  Curve c;
  double t = 0.0;
  for (int k = 0; k < 3000; ++k, t += k % 3 == 0 ? 0.001 : 0.003) {
    c.time.push_back(t);
    c.value.push_back({wave(4.0, t), 0.0});
  }
  EXPECT_NEAR(dominant_frequency(c.time, c.value), 4.0, 0.05);
}

TEST(Spectrum, WhatDoesNotChangeHasNone) {
  const Curve c = curve(1.0, 50, [](double) { return Vec2{1.0, -2.0}; });
  EXPECT_EQ(dominant_frequency(c.time, c.value), 0.0);
  EXPECT_EQ(dominant_frequency({0.0, 1.0}, {{0.0, 0.0}, {1.0, 0.0}}), 0.0);
}

}  // namespace
}  // namespace edda
