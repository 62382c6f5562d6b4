// Monitors: material points recorded in history.csv.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "blocks/block_point.hpp"
#include "observe/observe.hpp"

namespace edda {

struct MonitorPoint : BlockPoint {
  std::string name;
};

/// The point of a block that was at `point` (local coordinates) at the start.
MonitorPoint point_of_block(std::string name, const BlockSet& blocks, std::size_t block,
                            Vec2 point);

/// The block of every monitor (block_at()). A fault for each that lies in no block.
Result<std::vector<MonitorPoint>> place_monitors(const Simulation& sim);

/// A [[convergence]]: two material points.
struct ConvergenceLine {
  std::string name;
  std::array<MonitorPoint, 2> ends;
};

/// The blocks of both ends, found as those of monitors.
Result<std::vector<ConvergenceLine>> place_convergences(const Simulation& sim);

/// A warning for each monitor, end of a convergence and point load that lies on the border of
/// several blocks: to which block it is assigned.
std::vector<std::string> border_points(const Simulation& sim);

/// Shortening of the line since the start or the last reset of displacements, m.
double convergence(const BlockSet& blocks, const State& state, const ConvergenceLine& line);

/// Displacement of the point, m.
Vec2 displacement_of(const BlockSet& blocks, const State& state, const MonitorPoint& point);

/// Velocity of the point in a frame at rest, m/s: with that of the ground under apply = "inertia".
Vec2 absolute_velocity(const Simulation& sim, const Instant& at, const MonitorPoint& point);

/// Displacement and velocity of the point, and the stress of its block.
struct MonitorReading {
  Vec2 displacement, velocity;
  BlockStress stress;
};
MonitorReading read_monitor(const Simulation& sim, const Instant& at, const MonitorPoint& point);

}  // namespace edda
