// Monitors: material points that history.csv follows.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "run/observe.hpp"

namespace edda {

struct MonitorPoint {
  std::string name;
  std::size_t block = 0;
  std::array<double, 3> weight{};  ///< area coordinates in the block
};

/// The block of every monitor (block_at()). A fault for each that lies in no block.
Result<std::vector<MonitorPoint>> place_monitors(const Simulation& sim);

/// A [[convergence]]: two material points.
struct ConvergenceLine {
  std::string name;
  std::array<MonitorPoint, 2> ends;
};

/// The blocks of both ends, found as those of monitors.
Result<std::vector<ConvergenceLine>> place_convergences(const Simulation& sim);

/// A warning per monitor, end of a convergence and load at a point that lies on the border of
/// several blocks: which of them it goes with.
std::vector<std::string> border_points(const Simulation& sim);

/// How much shorter the line has become since the start or the last reset of displacements, m.
double convergence(const State& state, const ConvergenceLine& line);

/// Displacement and velocity of the point, and its block's stress.
struct MonitorReading {
  Vec2 displacement, velocity;
  BlockStress stress;
};
MonitorReading read_monitor(const Simulation& sim, const Instant& at, const MonitorPoint& point);

}  // namespace edda
