#include "contacts/switching.hpp"

#include <gtest/gtest.h>

#include <random>

namespace edda::switching_test {
namespace {

/// What alpha is for: the discrete work of alpha p d over the step equals the change of p d d'/2.
TEST(SwitchingAlpha, WorkEqualsChangeOfStoredEnergy) {
  std::mt19937 rng(1);
  std::uniform_real_distribution<double> u(0.0, 1.0);
  int opened = 0, closed = 0, stayed = 0, left = 0;
  for (int trial = 0; trial < 100000; ++trial) {
    const double d = u(rng);                    // now, p = 1
    const double before = 3.0 * u(rng) - 1.5;   // a step ago
    const double without = 4.0 * u(rng) - 2.0;  // the next one without this force
    const double push = 3.9 * d * u(rng);       // q = (w h)^2 d, (w h)^2 < 4
    const double alpha = switching_alpha(before, without, push);
    ASSERT_GE(alpha, 0.0);
    ASSERT_LE(alpha, 1.0);
    const double after = without - alpha * push;
    const double change = 0.5 * d * (std::max(before, 0.0) - std::max(after, 0.0));
    const double work = 0.5 * alpha * d * (before - after);
    if (before > 0.0 && without - push > 0.0) {
      ++stayed;
      EXPECT_EQ(alpha, 1.0);
      EXPECT_NEAR(work, change, 1e-14);
    } else if (before > 0.0) {
      // Opens: exact unless the whole force does not do (alpha cut at 1: it then keeps some energy
      // back).
      ++opened;
      if (alpha < 1.0) {
        EXPECT_NEAR(work, change, 1e-12);
      }
    } else if (without <= 0.0) {
      ++left;
      EXPECT_EQ(alpha, 0.0);
    } else {
      ++closed;
      if (alpha < 1.0) {
        EXPECT_NEAR(work, 0.5 * d * (0.0 - after), 1e-12);
      }
    }
  }
  EXPECT_GT(std::min({opened, closed, stayed, left}), 1000);
}

/// A mass on a spring, dropped again and again on a penalty contact: energy after 1,000 bounces.
TEST(SwitchingAlpha, OneMassKeepsItsEnergy) {
  for (const double wh : {0.1, 0.5, 1.0, 1.5, 1.9}) {
    const double k = 1.0, m = 1.0, h = wh * std::sqrt(m / k), g = 1e-3;
    double x = 0.5, v = 0.5 * g * h,
           x_before = x - h * v;  // height; v_{-1/2} = v_0 - a h/2 with a = -g
    auto energy = [&] {
      const double d = -x, d_before = -x_before;
      return 0.5 * m * v * v + m * g * 0.5 * (x + x_before) +
             (d > 0.0 && d_before > 0.0 ? 0.5 * k * d * d_before : 0.0);
    };
    const double start = energy();
    int bounces = 0;
    for (int step = 0; bounces < 1000 && step < 10000000; ++step) {
      const double d = -x, d_before = -x_before;
      double force = d > 0.0 ? k * d : 0.0;
      if (d > 0.0) {
        const double free_v = v - h * g, without = -(x + h * free_v);
        const double alpha = switching_alpha(d_before, without, h * h * force / m);
        if (d_before <= 0.0) ++bounces;
        force *= alpha;
      }
      v += h * (force / m - g);
      x_before = x;
      x += h * v;
    }
    EXPECT_NEAR(energy() / start, 1.0, 1e-10) << wh;
    EXPECT_EQ(bounces, 1000);
  }
}

TEST(CutShear, IsTheLimit) {
  EXPECT_EQ(cut_shear(3.0, 2.0), 2.0);
  EXPECT_EQ(cut_shear(-3.0, 2.0), -2.0);
  EXPECT_EQ(cut_shear(1.0, 2.0), 1.0);
}

}  // namespace
}  // namespace edda::switching_test
