// What strain damping takes off waves: the motion at the end of a path, with and without it.
#pragma once

#include <vector>

#include "observe/wave_path.hpp"

namespace edda {

/// What is given at the near end of the path.
enum class WaveSource {
  motion,   ///< its motion: fixed ground, a boundary that moves
  force,    ///< a traction
  incoming  ///< a wave that comes in through dashpots
};

/// A signal at equal intervals of time, s.
struct WaveSignal {
  std::vector<double> value;
  double interval = 0.0;
  double until = 0.0;      ///< s: motion after this does not count
  double frequency = 0.0;  ///< Hz: nor does what rings at more than eight times this
};

/// Part of the largest motion at the end of the path that strain damping takes, 0 to 1, exact for
/// plane waves in layers (theory, section 9.2): each frequency crosses the layers with their
/// complex modulus M (1 + i omega eta).
double lost_to_damping(const WavePath& path, WaveSource source, const WaveSignal& signal);

}  // namespace edda
