#include "observe/wave_loss.hpp"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "base/spectrum.hpp"

namespace edda {
namespace {

using Complex = std::complex<double>;
constexpr Complex i_unit{0.0, 1.0};
constexpr double most_cycles = 8.0;  // blocks ring at their own frequencies where a signal begins

/// Motion at the end per unit of the signal: of a motion the same quantity, of a traction the
/// velocity.
Complex transfer(const WavePath& path, WaveSource source, Complex omega, bool damped) {
  const WaveLayer& last = path.layers.back();
  const Complex outside = i_unit * omega * last.density * last.speed();  // traction of a dashpot
  const bool held = path.end == PathEnd::held;
  Complex u = held ? 0.0 : 1.0, traction = held                             ? outside
                                           : path.end == PathEnd::absorbing ? -outside
                                                                            : Complex{};
  for (auto layer = path.layers.rbegin(); layer != path.layers.rend(); ++layer) {
    const Complex modulus =
        layer->modulus * (1.0 + (damped ? i_unit * omega * layer->viscosity : Complex{}));
    const Complex k = omega * std::sqrt(layer->density / modulus), turn = k * layer->length;
    const Complex c = std::cos(turn), s = std::sin(turn), u_end = u;
    u = u * c - traction * s / (k * modulus);
    traction = traction * c + u_end * k * modulus * s;
  }
  const WaveLayer& first = path.layers.front();
  const Complex wave = i_unit * omega * first.density * first.speed();
  switch (source) {
    case WaveSource::motion:
      return 1.0 / u;
    case WaveSource::incoming:
      return 2.0 / (u - traction / wave);
    case WaveSource::force:
      break;
  }
  return -i_unit * omega / traction;
}

}  // namespace

double lost_to_damping(const WavePath& path, WaveSource source, const WaveSignal& signal) {
  const std::size_t n = signal.value.size();
  if (n < 4 || path.layers.empty()) return 0.0;
  // With exp(-sigma t) on everything what the periods of the transform add is exp(-6) of it.
  const double window = static_cast<double>(n) * signal.interval, sigma = 6.0 / window;
  std::vector<Complex> given(n);
  for (std::size_t q = 0; q < n; ++q) {
    given[q] = signal.value[q] * std::exp(-sigma * signal.interval * static_cast<double>(q));
  }
  fourier(given);
  double largest[2] = {0.0, 0.0};
  for (const bool damped : {false, true}) {
    std::vector<Complex> out(n);
    for (std::size_t f = 0; f < n / 2; ++f) {
      if (static_cast<double>(f) > most_cycles * signal.frequency * window) break;
      const Complex omega{2.0 * std::numbers::pi * static_cast<double>(f) / window, -sigma};
      const Complex value = transfer(path, source, omega, damped) * given[f];
      if (!std::isfinite(std::abs(value))) continue;
      // Of a real signal; the transform back is that of the conjugates.
      out[f] = std::conj(value);
      if (f > 0) out[n - f] = value;
    }
    fourier(out);
    for (std::size_t q = 0; q < n; ++q) {
      if (signal.interval * static_cast<double>(q) > signal.until) break;
      const double v = out[q].real() * std::exp(sigma * signal.interval * static_cast<double>(q));
      largest[damped ? 1 : 0] = std::max(largest[damped ? 1 : 0], std::abs(v));
    }
  }
  return largest[0] > 0.0 ? std::clamp(1.0 - largest[1] / largest[0], 0.0, 1.0) : 0.0;
}

}  // namespace edda
