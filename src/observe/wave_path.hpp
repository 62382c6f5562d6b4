// The rock that a plane wave crosses on a straight line through the model, as layers.
#pragma once

#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// Rock of one material on the path, with its joints.
struct WaveLayer {
  double length = 0.0;     ///< m
  double density = 0.0;    ///< kg/m3
  double modulus = 0.0;    ///< Pa, of rock and joints in series
  double viscosity = 0.0;  ///< s: complex modulus M (1 + i omega eta)
  double speed() const;    ///< m/s
};

/// How an end of the path is supported in the direction of the motion.
enum class PathEnd { open, held, absorbing };

struct WavePath {
  std::vector<WaveLayer> layers;  ///< from the source on
  PathEnd end = PathEnd::open;    ///< at the far end
  double length() const;
  double travel_time() const;  ///< s
};

/// The path of a wave from `from` (local) in the direction `along` through the free blocks, up to
/// where they end or a void or a fixed block lies; particles move in the
/// direction `motion`, both of length 1. Empty where there is no free block. masses: those whose
/// viscosity damps the wave.
WavePath wave_path(const Simulation& sim, const Masses& masses, Vec2 from, Vec2 along, Vec2 motion);

}  // namespace edda
