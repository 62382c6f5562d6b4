#include "run/monitors.hpp"

#include "blocks/locate.hpp"

namespace edda {

namespace {

/// The material point at `point`, model coordinates; a fault at `where` with `key` added if there
/// is none.
MonitorPoint place(const Simulation& sim, const std::string& name, Vec2 point, const Where& where,
                   const std::string& key, Faults& faults) {
  const Vec2 p = point - sim.blocks.origin;
  const auto block = block_at(sim.model, sim.polygons, sim.blocks, p);
  if (block) return {name, *block, weights_at(sim.blocks, *block, p)};
  Fault fault{where, "lies in no block", "move it into one (edda cut draws them)"};
  fault.where.key += key;
  faults.push_back(fault);
  return {};
}

}  // namespace

Result<std::vector<MonitorPoint>> place_monitors(const Simulation& sim) {
  std::vector<MonitorPoint> points;
  Faults faults;
  for (const Monitor& m : sim.model.monitors) {
    points.push_back(place(sim, m.name, m.point, m.where, ".point", faults));
  }
  if (!faults.empty()) return faults;
  return points;
}

Result<std::vector<ConvergenceLine>> place_convergences(const Simulation& sim) {
  std::vector<ConvergenceLine> lines;
  Faults faults;
  for (const Convergence& c : sim.model.convergences) {
    const auto end = [&](std::size_t k) {
      return place(sim, c.name, c.between[k], c.where, k == 0 ? ".between[0]" : ".between[1]",
                   faults);
    };
    const MonitorPoint first = end(0), second = end(1);
    lines.push_back({c.name, {first, second}});
  }
  if (!faults.empty()) return faults;
  return lines;
}

double convergence(const State& s, const ConvergenceLine& line) {
  const auto length = [&](const Nodes& x, const Nodes& y) {
    const auto& [a, b] = line.ends;
    return norm(weighted(b.weight, x, y, b.block) - weighted(a.weight, x, y, a.block));
  };
  return length(s.from_x, s.from_y) - length(s.x, s.y);
}

MonitorReading read_monitor(const Simulation& sim, const Instant& at, const MonitorPoint& m) {
  MonitorReading r;
  r.displacement = displacement_of(at.state, m.block, m.weight);
  r.velocity = weighted(m.weight, at.state.vx, at.state.vy, m.block);
  r.stress = block_stress(sim, at.state, m.block);
  return r;
}

}  // namespace edda
