#include "base/spectrum.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <cstddef>
#include <numbers>
#include <utility>

namespace edda {
namespace {

using Complex = std::complex<double>;

/// The curve at equal intervals as x + iy about its mean, padded with zeros to four times the
/// number.
std::vector<Complex> samples(const std::vector<double>& time, const std::vector<Vec2>& value,
                             std::size_t count) {
  const double span = time.back() - time.front();
  std::vector<Complex> at(count);
  Complex mean = 0.0;
  std::size_t k = 1;
  for (std::size_t q = 0; q < count; ++q) {
    const double t = time.front() + span * static_cast<double>(q) / static_cast<double>(count);
    while (k + 1 < time.size() && time[k] < t) ++k;
    const double part = (t - time[k - 1]) / (time[k] - time[k - 1]);
    const Vec2 v = value[k - 1] + part * (value[k] - value[k - 1]);
    at[q] = {v.x, v.y};
    mean += at[q];
  }
  mean /= static_cast<double>(count);
  for (Complex& a : at) a -= mean;
  constexpr std::size_t finer = 4;
  at.resize(finer * count, 0.0);
  return at;
}

}  // namespace

void fourier(std::vector<Complex>& a) {
  const std::size_t n = a.size();
  for (std::size_t i = 1, j = 0; i < n; ++i) {
    std::size_t bit = n >> 1U;
    for (; (j & bit) != 0; bit >>= 1U) j ^= bit;
    j ^= bit;
    if (i < j) std::swap(a[i], a[j]);
  }
  for (std::size_t length = 2; length <= n; length *= 2) {
    const double turn = -2.0 * std::numbers::pi / static_cast<double>(length);
    for (std::size_t k = 0; k < length / 2; ++k) {
      const Complex w = std::polar(1.0, turn * static_cast<double>(k));
      for (std::size_t i = k; i < n; i += length) {
        const Complex u = a[i], v = w * a[i + length / 2];
        a[i] = u + v;
        a[i + length / 2] = u - v;
      }
    }
  }
}

double dominant_frequency(const std::vector<double>& time, const std::vector<Vec2>& value) {
  if (time.size() < 3 || !(time.back() > time.front())) return 0.0;
  constexpr std::size_t fewest = 256, most = 1U << 17U;
  std::size_t count = fewest;
  while (count < most && count < 2 * time.size()) count *= 2;
  std::vector<Complex> a = samples(time, value, count);
  const double span =
      (time.back() - time.front()) * static_cast<double>(a.size()) / static_cast<double>(count);
  fourier(a);
  std::size_t best = 0;
  double largest = 0.0;
  for (std::size_t f = 1; f < a.size() / 2; ++f) {
    const double power = std::norm(a[f]) + std::norm(a[a.size() - f]);
    if (power > largest * (1.0 + 1e-9)) {
      largest = power;
      best = f;
    }
  }
  return static_cast<double>(best) / span;
}

}  // namespace edda
