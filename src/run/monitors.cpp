#include "run/monitors.hpp"

#include "blocks/locate.hpp"

namespace edda {

Result<std::vector<MonitorPoint>> place_monitors(const Simulation& sim) {
  std::vector<MonitorPoint> points;
  Faults faults;
  for (const Monitor& m : sim.model.monitors) {
    const Vec2 p = m.point - sim.blocks.origin;
    const auto block = block_at(sim.model, sim.polygons, sim.blocks, p);
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
  r.displacement = displacement_of(at.state, m.block, m.weight);
  r.velocity = weighted(m.weight, at.state.vx, at.state.vy, m.block);
  r.stress = block_stress(sim, at.state, m.block);
  return r;
}

}  // namespace edda
