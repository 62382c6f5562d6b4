// What sends waves through the model: ground motions, and loads and boundaries with a history.
#pragma once

#include <string>
#include <vector>

#include "observe/wave_loss.hpp"

namespace edda {

/// A place where waves begin, the direction in which they go and that in which particles move.
struct WaveRay {
  Vec2 from, along, motion;  ///< m, local; of length 1
};

/// A curve over time, straight between its points, or a sine of this frequency.
struct WaveCurve {
  double frequency = 0.0;           ///< Hz; of a curve the dominant one, 0: it does not swing
  std::vector<double> time, value;  ///< empty: a sine
};

struct WaveOrigin {
  std::string of;    ///< "shaking quake"
  std::string name;  ///< "quake"
  WaveSource source = WaveSource::motion;
  WaveCurve curve;
  std::vector<WaveRay> rays;  ///< some of them
};

std::vector<WaveOrigin> wave_origins(const Simulation& sim);

/// The curve from its beginning on, for as long as it lasts and its waves need to die away on a
/// path with this travel time, s.
WaveSignal signal_on(const WaveCurve& curve, double longest, double travel_time);

}  // namespace edda
