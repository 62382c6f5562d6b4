#include "run/monitors.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

#include "lines/cut_domain.hpp"

namespace edda {
namespace {

double extent(const BlockSet& b) {
  double largest = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    largest = std::max({largest, std::abs(b.vertex_x[v]), std::abs(b.vertex_y[v])});
  }
  return 2.0 * largest;
}

double distance_to_rings(const std::vector<Ring>& rings, Vec2 p) {
  double least = std::numeric_limits<double>::infinity();
  for (const Ring& ring : rings) {
    for (std::size_t k = 0; k < ring.size(); ++k) {
      least = std::min(least, distance_to_segment(p, ring[k], ring[(k + 1) % ring.size()]));
    }
  }
  return least;
}

/// `edge`: what counts as on an edge, for rounding only.
std::optional<std::size_t> block_at(const Simulation& sim, Vec2 p, double edge, double snap) {
  std::optional<std::size_t> nearest;
  double least = snap;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    const Vec2 arm = p - Vec2{sim.blocks.centroid_x[i], sim.blocks.centroid_y[i]};
    if (norm(arm) > sim.blocks.radius[i] + snap + edge) continue;
    const std::vector<Ring>& rings = sim.polygons.blocks[i].rings;
    if (side_of(rings, p, edge) >= 0) return i;
    const double d = distance_to_rings(rings, p);
    if (d > least || (nearest && d == least)) continue;
    least = d;
    nearest = i;
  }
  return nearest;
}

}  // namespace

Result<std::vector<MonitorPoint>> place_monitors(const Simulation& sim) {
  const double size = extent(sim.blocks);
  const double snap = sim.model.domain ? snap_of(sim.model) : 1e-9 * size;
  std::vector<MonitorPoint> points;
  Faults faults;
  for (const Monitor& m : sim.model.monitors) {
    const Vec2 p = m.point - sim.blocks.origin;
    const auto block = block_at(sim, p, std::min(snap, 1e-13 * (size + norm(m.point))), snap);
    if (!block) {
      Fault fault{m.where, "lies in no block", "move it into one (edda cut draws them)"};
      fault.where.key += ".point";
      faults.push_back(fault);
      continue;
    }
    points.push_back({m.name, *block, weights_at(sim.blocks, *block, p)});
  }
  if (!faults.empty()) return faults;
  return points;
}

MonitorReading read_monitor(const Simulation& sim, const Instant& at, const MonitorPoint& m) {
  MonitorReading r;
  r.displacement = displacement_of(sim.blocks, at.state, m.block, m.weight);
  r.velocity = weighted(m.weight, at.state.vx, at.state.vy, m.block);
  r.stress = block_stress(sim, at.state, m.block);
  return r;
}

}  // namespace edda
