#include "observe/monitors.hpp"

#include <fmt/format.h>

#include <utility>

#include "blocks/locate.hpp"
#include "step/labels.hpp"

namespace edda {

namespace {

/// The material point at `point`, model coordinates; if no block is there, adds a fault at `where`
/// with `key` appended.
MonitorPoint place(const Simulation& sim, const std::string& name, Vec2 point, const Where& where,
                   const std::string& key, Faults& faults) {
  const Vec2 p = point - sim.scene->blocks.origin;
  const auto block = block_at(sim.scene->model, sim.scene->polygons, sim.scene->blocks, p);
  if (block) return point_of_block(name, sim.scene->blocks, *block, p);
  Fault fault{where, "lies in no block", "move it into one (edda cut draws them)"};
  fault.where.key += key;
  faults.push_back(fault);
  return {};
}

}  // namespace

MonitorPoint point_of_block(std::string name, const BlockSet& b, std::size_t block, Vec2 point) {
  return {block_point(b, block, point), std::move(name)};
}

Result<std::vector<MonitorPoint>> place_monitors(const Simulation& sim) {
  std::vector<MonitorPoint> points;
  Faults faults;
  for (const Monitor& m : sim.scene->model.monitors) {
    points.push_back(place(sim, m.name, m.point, m.where, ".point", faults));
  }
  if (!faults.empty()) return faults;
  return points;
}

Result<std::vector<ConvergenceLine>> place_convergences(const Simulation& sim) {
  std::vector<ConvergenceLine> lines;
  Faults faults;
  for (const Convergence& c : sim.scene->model.convergences) {
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

std::vector<std::string> border_points(const Simulation& sim) {
  std::vector<std::string> warnings;
  const BlockSet& b = sim.scene->blocks;
  const auto look = [&](const std::string& what, Vec2 point, Among among) {
    std::vector<Id> blocks =
        blocks_at(sim.scene->model, sim.scene->polygons, b, point - b.origin, among);
    // At the wall of rock that a stage excavates, or of fill, the choice is clear.
    const auto leaves = [&](Id i) {
      return b.is_fill(i) || (!b.opening.empty() && b.opening[i] != none);
    };
    if (!blocks.empty() && !leaves(blocks.front())) std::erase_if(blocks, leaves);
    if (blocks.size() < 2) return;
    std::string others;
    for (std::size_t k = 1; k < blocks.size(); ++k) {
      others += (k == 1 ? "" : k + 1 == blocks.size() ? " and " : ", ") + block_label(b, blocks[k]);
    }
    warnings.push_back(
        fmt::format("{} at {} lies on the boundary between blocks: it moves with {}, not with {}; "
                    "move it into the block that is meant",
                    what, place_label(point), block_label(b, blocks[0]), others));
  };
  for (const Monitor& m : sim.scene->model.monitors) {
    look("monitor " + m.name, m.point, Among::all_blocks);
  }
  for (const Convergence& c : sim.scene->model.convergences) {
    for (const Vec2 end : c.between) {
      look("an end of convergence " + c.name, end, Among::all_blocks);
    }
  }
  for (const Load& load : sim.scene->model.loads) {
    if (load.point) look(load.where.key, *load.point, Among::free_blocks);
  }
  return warnings;
}

double convergence(const BlockSet& blocks, const State& s, const ConvergenceLine& line) {
  const auto length = [&](const BodyVectors& u) {
    return norm(at_point(blocks, u, line.ends[1]) - at_point(blocks, u, line.ends[0]));
  };
  return length(s.reference) - length(s.position);
}

Vec2 displacement_of(const BlockSet& b, const State& s, const MonitorPoint& m) {
  return at_point(vector_of(b, s.position, m.block) - vector_of(b, s.reference, m.block), m);
}

Vec2 absolute_velocity(const Simulation& sim, const Instant& at, const MonitorPoint& m) {
  return at_point(sim.scene->blocks, at.state.velocity, m) +
         frame_velocity(sim.scene->model, sim.attached.loads.intervals, at.state.time);
}

MonitorReading read_monitor(const Simulation& sim, const Instant& at, const MonitorPoint& m) {
  MonitorReading r;
  const BlockSet& b = sim.scene->blocks;
  r.displacement = displacement_of(b, at.state, m);
  r.velocity = at_point(b, at.state.velocity, m);
  r.stress = block_stress(sim, at.state, m.block);
  return r;
}

}  // namespace edda
