// Response spectra and measures of motions against known answers.
#include "report/response.hpp"

#include <gtest/gtest.h>

#include <algorithm>
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

/// Of an acceleration that is linear between the times.
ResponseSpectrum spectrum(const std::vector<double>& time, const std::vector<double>& a,
                          double damping, const std::vector<double>& periods) {
  std::vector<AccelerationPiece> pieces;
  for (std::size_t r = 1; r < time.size(); ++r)
    pieces.push_back({time[r] - time[r - 1], a[r - 1], a[r]});
  return response_spectrum(pieces, damping, periods);
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
    const ResponseSpectrum s = spectrum(time, a, damping, periods);
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
    const ResponseSpectrum s = spectrum(time, a, damping, {r * period});
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
    const ResponseSpectrum s = spectrum(time, a, damping, {1.0});
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
  const ResponseSpectrum s = spectrum(time, a, 0.5, {1e-4});
  EXPECT_NEAR(s.pseudo_acceleration[0], most, 1e-3 * most);
  const ResponseSpectrum soft = spectrum(time, a, 0.05, {1e4});
  EXPECT_NEAR(soft.relative_displacement[0], peak, 3e-3 * peak);
}

/// A motion from its displacement, velocity and acceleration, and the displacement of the ground
/// from which they are seen.
struct Motion {
  std::function<double(double)> u, v, a;
  std::function<double(double)> ground = [](double) { return 0.0; }, speed = ground;
  MotionRecord rows(const std::vector<double>& time) const {
    MotionRecord m;
    m.time = time;
    for (std::size_t r = 0; r < time.size(); ++r) {
      const double t = time[r];
      m.displacement.push_back(u(t) - ground(t));
      m.velocity.push_back(v(t) - speed(t));
      m.acceleration.push_back(r == 0 ? 0.0 : (v(t) - v(time[r - 1])) / (t - time[r - 1]));
    }
    return m;
  }
};

Motion swing(double amplitude, double period) {
  const double w = 2.0 * pi / period;
  return {[=](double t) { return amplitude / (w * w) * (w * t - std::sin(w * t)); },
          [=](double t) { return amplitude / w * (1.0 - std::cos(w * t)); },
          [=](double t) { return amplitude * std::sin(w * t); }};
}

/// The pieces are the acceleration itself where that is linear in each interval.
TEST(Pieces, AreALinearAcceleration) {
  const Motion m{[](double t) { return 0.2 * t * t - 0.1 * t * t * t + 0.3 * t; },
                 [](double t) { return 0.4 * t - 0.3 * t * t + 0.3; },
                 [](double t) { return 0.4 - 0.6 * t; }};
  double t = 0.0;
  for (const auto& [length, from, to] : pieces_of(m.rows({0.0, 0.3, 0.35, 1.0, 1.2, 1.2 + 1e-3}))) {
    EXPECT_NEAR(from, m.a(t), 1e-8);
    t += length;
    EXPECT_NEAR(to, m.a(t), 1e-8);
  }
  MotionRecord twice = m.rows({0.0, 0.5, 1.0});  // a row that is there twice
  for (auto* column : {&twice.time, &twice.velocity, &twice.displacement})
    column->insert(column->begin() + 2, (*column)[1]);
  twice.acceleration.insert(twice.acceleration.begin() + 2, 0.0);
  const auto pieces = pieces_of(twice);
  EXPECT_EQ(pieces[1].length, 0.0);
  EXPECT_NEAR(pieces[2].to, m.a(1.0), 1e-8);
}

/// At five rows a period of the motion, seen from a frame at rest; oscillators of all periods.
TEST(Pieces, GiveTheSpectrumOfASmoothMotion) {
  const std::vector<double> periods{0.025, 0.04, 0.05, 0.06, 0.1, 0.2, 1.0};
  for (const double rows : {5.0, 10.0, 20.0}) {
    const double step = 0.05 / rows;
    const Motion m = swing(3.0, 0.05);
    const auto fine = times(0.6, 1e-4);
    const auto exact = spectrum(fine, at(fine, m.a), 0.05, periods),
               found = response_spectrum(pieces_of(m.rows(times(0.6, step))), 0.05, periods);
    for (std::size_t k = 0; k < periods.size(); ++k)
      EXPECT_NEAR(found.pseudo_acceleration[k] / exact.pseudo_acceleration[k], 1.0, 0.02)
          << rows << ' ' << periods[k];
  }
}

/// The same of a motion that is seen from a ground which shakes, as under apply = "inertia". Of the
/// ground the rows have no displacement, so that it needs ten rows a period.
TEST(Pieces, GiveTheSpectrumOfAMotionRelativeToTheGround) {
  const std::vector<double> periods{0.1, 0.15, 0.3, 1.0};
  Motion m = swing(3.0, 0.1);
  const Motion ground = swing(2.0, 0.1), slow = swing(2.0, 0.4);
  m.ground = [&](double t) { return ground.u(t) + slow.u(t); };
  m.speed = [&](double t) { return ground.v(t) + slow.v(t); };
  const auto fine = times(1.2, 1e-4);
  const auto exact = spectrum(fine, at(fine, m.a), 0.05, periods),
             found = response_spectrum(pieces_of(m.rows(times(1.2, 0.01))), 0.05, periods);
  for (std::size_t k = 0; k < periods.size(); ++k)
    EXPECT_NEAR(found.pseudo_acceleration[k] / exact.pseudo_acceleration[k], 1.0, 0.02)
        << periods[k];
}

/// A swing at 100 m/s2 between rows, most of them at another place of it, leaves spectra from five
/// rows on as they are; accelerations at the times of the rows have another spectrum there.
TEST(Pieces, AreNotAliased) {
  const std::vector<double> periods{0.1, 0.2, 0.5, 1.0, 3.0};
  const Motion slow = swing(3.0, 0.7), fast = swing(100.0, 0.0021);
  const auto both = [](const auto& f, const auto& g) {
    return [=](double t) { return f(t) + g(t); };
  };
  const double drift = fast.v(0.0021 / 2.0) / 2.0;  // of the fast one, which is to stay
  const Motion m{both(both(slow.u, fast.u), [=](double t) { return -drift * t; }),
                 both(both(slow.v, fast.v), [=](double) { return -drift; }), both(slow.a, fast.a)};
  const auto fine = times(4.0, 2e-5), rows = times(4.0, 0.02);
  const auto exact = spectrum(fine, at(fine, m.a), 0.05, periods),
             found = response_spectrum(pieces_of(m.rows(rows)), 0.05, periods),
             aliased = spectrum(rows, at(rows, m.a), 0.05, periods);
  for (std::size_t k = 0; k < periods.size(); ++k) {
    const double is = exact.pseudo_acceleration[k];
    EXPECT_NEAR(found.pseudo_acceleration[k], is, 0.05 * is) << periods[k];
    if (k < 2) {
      EXPECT_GT(aliased.pseudo_acceleration[k], 1.5 * is) << periods[k];
    }
  }
}

/// A sine burst of n periods: I = pi/(2 g) A^2 n T/2.
TEST(Measures, OfASineBurst) {
  constexpr double amplitude = 3.0, period = 0.5;
  const Motion sine = swing(amplitude, period);
  const auto within = [](double t) { return std::clamp(t - 1.0, 0.0, 4.0); };
  const Motion burst{[&](double t) { return sine.u(within(t)); },
                     [&](double t) { return sine.v(within(t)); }, sine.a};
  const MotionMeasures found = measures_of(burst.rows(times(6.0, 0.05)));  // ten a period
  const double exact = pi / (2.0 * 9.80665) * amplitude * amplitude * 2.0;
  EXPECT_NEAR(found.arias, exact, 2e-3 * exact);
  EXPECT_NEAR(found.arias_duration, 0.9 * 4.0, 0.08);
  const double w = 2.0 * pi / period;
  EXPECT_NEAR(found.peak_acceleration, amplitude, 0.05 * amplitude);
  EXPECT_NEAR(found.peak_velocity, 2.0 * amplitude / w, 1e-12);
  EXPECT_NEAR(found.peak_displacement, sine.u(4.0), 1e-12);
  EXPECT_NEAR(found.permanent_displacement, sine.u(4.0), 1e-12);
}

TEST(Measures, OfAConstantAccelerationLastNineTenths) {
  const Motion falls{[](double t) { return -t * t; }, [](double t) { return -2.0 * t; }, {}};
  const std::vector<double> time{0.0, 0.5, 3.0, 4.0};
  const MotionMeasures found = measures_of(falls.rows(time));
  EXPECT_NEAR(found.arias, pi / (2.0 * 9.80665) * 16.0, 1e-12);
  EXPECT_NEAR(found.arias_duration, 3.6, 1e-12);
  EXPECT_EQ(found.peak_acceleration, 2.0);
  EXPECT_EQ(found.peak_displacement, 16.0);
  const auto none = [](double) { return 0.0; };
  EXPECT_EQ(measures_of(Motion{none, none, none}.rows(time)).arias_duration, 0.0);
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
