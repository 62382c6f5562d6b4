// Response spectra and measures of motions against known answers.
#include "report/response.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <numbers>

namespace edda::response_test {
namespace {

constexpr double pi = std::numbers::pi;

std::vector<double> times(double end, double step) {
  std::vector<double> time;
  const auto rows = static_cast<std::size_t>(std::llround(end / step)) + 1;
  for (std::size_t r = 0; r < rows; ++r) time.push_back(static_cast<double>(r) * step);
  return time;
}

std::vector<double> at(const std::vector<double>& time, const std::function<double(double)>& of) {
  std::vector<double> values;
  for (const double t : time) values.push_back(of(t));
  return values;
}

/// Largest u and u' of an oscillator by small steps of the classical Runge-Kutta method.
struct Peaks {
  double displacement = 0.0, velocity = 0.0;
};
Peaks peaks_by_small_steps(const std::vector<double>& time, const std::vector<double>& a,
                           double damping, double period) {
  const double w = 2.0 * pi / period;
  double u = 0.0, v = 0.0;
  Peaks most;
  for (std::size_t r = 1; r < time.size(); ++r) {
    constexpr int parts = 400;
    const double h = (time[r] - time[r - 1]) / parts;
    for (int k = 0; k < parts; ++k) {
      const auto rate = [&](double part, double uu, double vv) {
        const double s = (k + part) / parts;
        return -(a[r - 1] + s * (a[r] - a[r - 1])) - 2.0 * damping * w * vv - w * w * uu;
      };
      const double k1 = rate(0.0, u, v), k2 = rate(0.5, u + 0.5 * h * v, v + 0.5 * h * k1);
      const double k3 = rate(0.5, u + 0.5 * h * (v + 0.5 * h * k1), v + 0.5 * h * k2);
      const double k4 = rate(1.0, u + h * (v + 0.5 * h * k2), v + h * k3);
      u += h * v + h * h / 6.0 * (k1 + k2 + k3);
      v += h / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
      most = {std::max(most.displacement, std::abs(u)), std::max(most.velocity, std::abs(v))};
    }
  }
  return most;
}

/// Any steps, also uneven ones.
TEST(Response, IsExactForAccelerationsThatAreLinearBetweenRows) {
  const std::vector<double> time{0.0, 0.1, 0.15, 0.4, 0.41, 0.9, 1.0, 1.7},
      a{0.0, 3.0, -2.0, 5.0, 1.0, -4.0, 0.5, 0.5};
  for (const double damping : {0.0, 0.05, 0.4}) {
    const std::vector<double> periods{0.1, 0.33, 1.0, 4.0};
    const ResponseSpectrum s = response_spectrum(time, a, damping, periods);
    for (std::size_t k = 0; k < periods.size(); ++k) {
      const Peaks exact = peaks_by_small_steps(time, a, damping, periods[k]);
      EXPECT_NEAR(s.relative_displacement[k] / exact.displacement, 1.0, 1e-3)
          << damping << ' ' << periods[k];
      EXPECT_NEAR(s.relative_velocity[k] / exact.velocity, 1.0, 1e-3)
          << damping << ' ' << periods[k];
      const double w = 2.0 * pi / periods[k];
      EXPECT_DOUBLE_EQ(s.pseudo_acceleration[k], w * w * s.relative_displacement[k]);
    }
  }
}

/// A harmonic base: u_max = A/w^2 / sqrt((1 - r^2)^2 + (2 zeta r)^2), r the ratio of the periods of
/// oscillator and base.
TEST(Response, AmplifiesAHarmonicMotionAsAnOscillatorDoes) {
  constexpr double damping = 0.1, period = 0.5;
  const std::vector<double> time = times(40.0, 0.005),
                            a = at(time, [](double t) {
                              // Grows slowly, so that the oscillators' own swinging stays small.
                              const double grown =
                                  t < 20.0 ? 0.5 - 0.5 * std::cos(pi * t / 20.0) : 1.0;
                              return grown * std::sin(2.0 * pi * t / period);
                            });
  for (const double r : {0.3, 0.8, 1.0, 1.5, 3.0}) {
    const double exact = 1.0 / std::hypot(1.0 - r * r, 2.0 * damping * r);
    const ResponseSpectrum s = response_spectrum(time, a, damping, {r * period});
    EXPECT_NEAR(s.pseudo_acceleration[0], exact, 5e-3 * exact) << r;
    const double v = s.relative_displacement[0] * 2.0 * pi / period;
    EXPECT_NEAR(s.relative_velocity[0], v, 5e-3 * v) << r;
  }
}

/// An impulse of the velocity v: u_max = v/w exp(-zeta/sqrt(1 - zeta^2) acos zeta).
TEST(Response, ToAnImpulseIsAFreeSwing) {
  constexpr double v = 0.3, width = 1e-4;
  std::vector<double> time{0.0, width, 2.0 * width}, a{0.0, v / width, 0.0};
  for (double t = 0.01; t < 2.0; t += 0.01) {
    time.push_back(t);
    a.push_back(0.0);
  }
  for (const double damping : {0.0, 0.05, 0.3}) {
    const double w = 2.0 * pi;
    const double exact =
        v / w * std::exp(-damping / std::sqrt(1.0 - damping * damping) * std::acos(damping));
    const ResponseSpectrum s = response_spectrum(time, a, damping, {1.0});
    EXPECT_NEAR(s.relative_displacement[0], exact, 3e-3 * exact) << damping;
    EXPECT_NEAR(s.relative_velocity[0], v, 3e-3 * v) << damping;
  }
}

/// A stiff oscillator has the ground's acceleration, a soft one stays where it was.
TEST(Response, HasTheGroundsPeaksAtBothEnds) {
  const double w = 2.0 * pi;
  const std::vector<double> time = times(3.0, 0.01), a = at(time, [&](double t) {
                                                       return 2.0 * w * w * std::cos(w * t) -
                                                              0.5 * w * w * std::cos(0.5 * w * t);
                                                     });
  std::vector<double> u{0.0};
  double v = 0.0, peak = 0.0, most = 0.0;
  for (std::size_t r = 1; r < time.size(); ++r) {
    const double h = time[r] - time[r - 1];
    u.push_back(u.back() + h * v + h * h * (2.0 * a[r - 1] + a[r]) / 6.0);
    v += 0.5 * h * (a[r - 1] + a[r]);
    peak = std::max(peak, std::abs(u.back()));
  }
  for (const double x : a) most = std::max(most, std::abs(x));
  const ResponseSpectrum s = response_spectrum(time, a, 0.5, {1e-4});
  EXPECT_NEAR(s.pseudo_acceleration[0], most, 1e-3 * most);
  const ResponseSpectrum soft = response_spectrum(time, a, 0.05, {1e4});
  EXPECT_NEAR(soft.relative_displacement[0], peak, 3e-3 * peak);
}

/// A sin burst of n periods: I = pi/(2 g) A^2 n T/2.
TEST(Measures, OfASineBurst) {
  constexpr double amplitude = 3.0, period = 0.5;
  MotionRecord m;
  m.time = times(6.0, 0.001);
  m.acceleration = at(m.time, [&](double t) {
    return t < 1.0 || t > 5.0 ? 0.0 : amplitude * std::sin(2.0 * pi * (t - 1.0) / period);
  });
  m.velocity = at(m.time, [](double t) { return 0.1 * t; });
  m.displacement = at(m.time, [](double t) { return 0.02 * t * (t - 5.0); });
  const MotionMeasures found = measures_of(m);
  const double exact = pi / (2.0 * 9.80665) * amplitude * amplitude * 2.0;
  EXPECT_NEAR(found.arias, exact, 1e-4 * exact);
  EXPECT_NEAR(found.arias_duration, 0.9 * 4.0, 0.08);
  EXPECT_NEAR(found.peak_acceleration, amplitude, 1e-4);
  EXPECT_NEAR(found.peak_velocity, 0.6, 1e-12);
  EXPECT_NEAR(found.peak_displacement, 0.125, 1e-12);
  EXPECT_NEAR(found.permanent_displacement, 0.12, 1e-12);
}

TEST(Measures, OfAConstantAccelerationLastNineTenths) {
  MotionRecord m;
  m.time = {0.0, 0.5, 3.0, 4.0};
  m.acceleration.assign(4, -2.0);
  m.velocity.assign(4, 0.0);
  m.displacement.assign(4, 0.0);
  EXPECT_DOUBLE_EQ(measures_of(m).arias, pi / (2.0 * 9.80665) * 16.0);
  EXPECT_NEAR(measures_of(m).arias_duration, 3.6, 1e-12);
  m.acceleration.assign(4, 0.0);
  EXPECT_EQ(measures_of(m).arias_duration, 0.0);
}

/// Rows that follow each other too slowly for what swings between them are found out.
TEST(Measures, CompareTheAccelerationWithTheVelocity) {
  const auto error = [](double step) {
    MotionRecord m;
    m.time = times(2.0, step);
    m.velocity =
        at(m.time, [](double t) { return std::sin(pi * t) + 0.01 * std::sin(200.0 * pi * t); });
    m.acceleration = at(m.time, [](double t) {
      return pi * std::cos(pi * t) + 2.0 * pi * std::cos(200.0 * pi * t);
    });
    return error_of_integral(m);
  };
  EXPECT_LT(error(5e-4), 1e-2);
  EXPECT_GT(error(0.02), 1.0);  // rows at equal places of the fast swing
}

TEST(Periods, AreInEqualRatios) {
  const std::vector<double> periods = in_equal_ratios(0.02, 5.0, 100);
  ASSERT_EQ(periods.size(), 100u);
  EXPECT_EQ(periods.front(), 0.02);
  EXPECT_EQ(periods.back(), 5.0);
  for (std::size_t k = 1; k < periods.size(); ++k)
    EXPECT_NEAR(periods[k] / periods[k - 1], std::pow(250.0, 1.0 / 99.0), 1e-12);
  EXPECT_EQ(in_equal_ratios(1.0, 4.0, 2), (std::vector<double>{1.0, 4.0}));
}

}  // namespace
}  // namespace edda::response_test
