#include "base/random.hpp"

#include <cmath>

namespace edda {
namespace {

constexpr double ln2 = 0.69314718055994530942;

std::uint64_t scrambled(std::uint64_t z) {
  z = (z ^ (z >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27U)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31U);
}

}  // namespace

std::uint64_t Random::next() {
  state_ += 0x9e3779b97f4a7c15ULL;
  return scrambled(state_);
}

double Random::uniform() {
  return static_cast<double>(next() >> 11U) * 0x1p-53;
}

double Random::normal() {
  for (;;) {
    const double u = 2.0 * uniform() - 1.0, v = 2.0 * uniform() - 1.0;
    const double s = u * u + v * v;
    if (s >= 1.0 || s == 0.0) continue;
    return u * std::sqrt(-2.0 * portable_log(s) / s);
  }
}

std::uint64_t mixed(std::uint64_t key, std::uint64_t value) {
  return scrambled(scrambled(key + 0x9e3779b97f4a7c15ULL) ^ value);
}

std::uint64_t mixed(std::uint64_t key, std::string_view text) {
  key = mixed(key, static_cast<std::uint64_t>(text.size()));
  for (const char c : text) {
    key = mixed(key, static_cast<std::uint64_t>(static_cast<unsigned char>(c)));
  }
  return key;
}

/// x = m 2^e with m near 1; log m = 2 (s + s^3/3 + s^5/5 + ...), s = (m - 1)/(m + 1).
double portable_log(double x) {
  int e = 0;
  double m = std::frexp(x, &e);  // exact
  if (m < 0.70710678118654752440) {
    m *= 2.0;
    --e;
  }
  const double s = (m - 1.0) / (m + 1.0), s2 = s * s;
  double sum = 0.0;
  for (int k = 23; k >= 1; k -= 2) sum = sum * s2 + 1.0 / k;
  return 2.0 * s * sum + e * ln2;
}

/// x = n ln 2 + r, |r| <= ln(2)/2; e^r by its series.
double portable_exp(double x) {
  const double n = std::floor(x / ln2 + 0.5);
  const double r = x - n * ln2;
  double sum = 1.0;
  for (int k = 20; k >= 1; --k) sum = 1.0 + sum * r / k;
  return std::ldexp(sum, static_cast<int>(n));
}

}  // namespace edda
