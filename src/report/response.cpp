#include "report/response.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edda {
namespace {

double largest(const std::vector<double>& values) {
  double most = 0.0;
  for (const double v : values) most = std::max(most, std::abs(v));
  return most;
}

/// I = pi/(2 g) int a^2 dt up to each row (Arias 1970), in each piece h (a_0^2 + a_0 a_1 +
/// a_1^2)/3.
std::vector<double> arias_up_to(const std::vector<AccelerationPiece>& pieces) {
  constexpr double standard_gravity = 9.80665;  // m/s2
  std::vector<double> sum{0.0};
  for (const auto& [h, a, b] : pieces)
    sum.push_back(sum.back() +
                  std::numbers::pi / (2.0 * standard_gravity) * h * (a * a + a * b + b * b) / 3.0);
  return sum;
}

/// When a sum that does not fall reaches `value`, linear between rows.
double time_of(const std::vector<double>& time, const std::vector<double>& sum, double value) {
  const auto at = std::lower_bound(sum.begin(), sum.end(), value);
  const auto r = static_cast<std::size_t>(at - sum.begin());
  if (r == 0) return time.front();
  return time[r - 1] + (time[r] - time[r - 1]) * (value - sum[r - 1]) / (sum[r] - sum[r - 1]);
}

/// An oscillator u'' + 2 zeta w u' + w^2 u = -a on the ground.
struct Oscillator {
  double w, zeta;              ///< rad/s, part of critical
  double u = 0.0, rate = 0.0;  ///< m, m/s, relative to the ground
};

/// Moves it by h while a = a_0 + s t, exactly (Nigam and Jennings 1969): with the particular
/// solution p = -(a_0 + s t)/w^2 + 2 zeta s/w^3,
/// u = p + exp(-zeta w t) (c cos w_d t + (d + zeta w c)/w_d sin w_d t), c and d being what u and u'
/// lack at t = 0, w_d = w sqrt(1 - zeta^2).
struct ExactStep {
  double w, zeta, h, damped, sine, cosine;  ///< exp(-zeta w h) in sine and cosine

  ExactStep(const Oscillator& o, double step)
      : w(o.w), zeta(o.zeta), h(step), damped(o.w * std::sqrt(1.0 - o.zeta * o.zeta)) {
    const double decay = std::exp(-zeta * w * h);
    sine = decay * std::sin(damped * h);
    cosine = decay * std::cos(damped * h);
  }

  void move(Oscillator& o, double a, double slope) const {
    const double rate = -slope / (w * w), lag = 2.0 * zeta * slope / (w * w * w);
    const double c = o.u + a / (w * w) - lag, d = o.rate - rate;
    const double e = (d + zeta * w * c) / damped;
    o.u = -(a + slope * h) / (w * w) + lag + c * cosine + e * sine;
    o.rate = rate + d * cosine - (zeta * w * e + damped * c) * sine;
  }
};

/// Largest |x| in a step of h in which x goes from x_0 to x_1 and its rate from d_0 to d_1: where
/// the rate, taken as linear, is 0 that of Hermite's cubic.
double largest_between(double x0, double d0, double x1, double d1, double h) {
  if (!(d0 * d1 < 0.0)) return std::max(std::abs(x0), std::abs(x1));
  const double s = d0 / (d0 - d1), rest = 1.0 - s;
  const double peak = (1.0 + 2.0 * s) * rest * rest * x0 + (1.0 + 2.0 * rest) * s * s * x1 +
                      h * s * rest * (rest * d0 - s * d1);
  return std::max({std::abs(x0), std::abs(x1), std::abs(peak)});
}

/// The largest displacement and velocity of an oscillator, relative to the ground.
struct Largest {
  double displacement = 0.0, velocity = 0.0;

  /// Of one step of `h`, from an acceleration of the ground of a on.
  void look(const Oscillator& from, const Oscillator& to, double a, double slope, double h) {
    const auto second = [](const Oscillator& o, double of_ground) {
      return -of_ground - 2.0 * o.zeta * o.w * o.rate - o.w * o.w * o.u;
    };
    displacement = std::max(displacement, largest_between(from.u, from.rate, to.u, to.rate, h));
    velocity = std::max(velocity, largest_between(from.rate, second(from, a), to.rate,
                                                  second(to, a + slope * h), h));
  }
};

}  // namespace

/// With mean a and slope s, v_1 - v_0 = a h and u_1 - u_0 = (v_0 + v_1) h/2 - s h^3/12. The ground
/// under apply = "inertia" is what a has beyond the change of v; its slope is that from the
/// interval before to the one after.
std::vector<AccelerationPiece> pieces_of(const MotionRecord& m) {
  const std::vector<double>&t = m.time, &v = m.velocity, &u = m.displacement;
  std::vector<double> ground, middle;
  for (std::size_t r = 1; r < t.size(); ++r) {
    const double h = t[r] - t[r - 1];
    ground.push_back(h > 0.0 ? m.acceleration[r] - (v[r] - v[r - 1]) / h : 0.0);
    middle.push_back(0.5 * (t[r - 1] + t[r]));
  }
  std::vector<AccelerationPiece> pieces;
  for (std::size_t r = 1; r < t.size(); ++r) {
    const double h = t[r] - t[r - 1];
    const std::size_t low = std::max<std::size_t>(r, 2) - 2, high = std::min(r, ground.size() - 1);
    double rise = 0.0;  // half of s h
    if (h > 0.0) rise = 6.0 / h * (0.5 * (v[r - 1] + v[r]) - (u[r] - u[r - 1]) / h);
    if (middle[high] > middle[low])
      rise += 0.5 * h * (ground[high] - ground[low]) / (middle[high] - middle[low]);
    pieces.push_back({h, m.acceleration[r] - rise, m.acceleration[r] + rise});
  }
  return pieces;
}

MotionMeasures measures_of(const MotionRecord& m) {
  MotionMeasures found;
  found.peak_acceleration = largest(m.acceleration);
  found.peak_velocity = largest(m.velocity);
  found.peak_displacement = largest(m.displacement);
  if (m.time.empty()) return found;
  found.permanent_displacement = m.displacement.back();
  const std::vector<double> sum = arias_up_to(pieces_of(m));
  found.arias = sum.back();
  if (found.arias > 0.0)
    found.arias_duration =
        time_of(m.time, sum, 0.95 * found.arias) - time_of(m.time, sum, 0.05 * found.arias);
  return found;
}

ResponseSpectrum response_spectrum(const std::vector<AccelerationPiece>& pieces, double damping,
                                   const std::vector<double>& periods) {
  constexpr double looks = 20.0;  // in a period, at least
  ResponseSpectrum spectrum;
  for (const double period : periods) {
    Oscillator o{2.0 * std::numbers::pi / period, damping};
    Largest largest;
    for (const auto& [length, from, to] : pieces) {
      if (!(length > 0.0)) continue;
      const double parts = std::ceil(looks * length / period), slope = (to - from) / length;
      const ExactStep step(o, length / parts);
      for (double k = 0.0; k < parts; k += 1.0) {
        const double a = from + slope * step.h * k;
        const Oscillator before = o;
        step.move(o, a, slope);
        largest.look(before, o, a, slope, step.h);
      }
    }
    spectrum.pseudo_acceleration.push_back(o.w * o.w * largest.displacement);
    spectrum.relative_velocity.push_back(largest.velocity);
    spectrum.relative_displacement.push_back(largest.displacement);
  }
  return spectrum;
}

std::vector<double> in_equal_ratios(double low, double high, std::size_t count) {
  std::vector<double> values{low};
  for (std::size_t k = 1; k + 1 < count; ++k) {
    const double part = static_cast<double>(k) / static_cast<double>(count - 1);
    values.push_back(low * std::pow(high / low, part));
  }
  values.push_back(high);
  return values;
}

}  // namespace edda
