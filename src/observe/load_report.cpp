#include "observe/load_report.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "base/text.hpp"
#include "model/files/accelerogram.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

std::string range_of(const TimeHistory& h, const char* what, const char* unit) {
  if (h.value.empty()) return {};
  const auto [low, high] = std::minmax_element(h.value.begin(), h.value.end());
  return fmt::format(", {} {:.4g} to {:.4g}{} over {:.4g} s", what, *low, *high, unit,
                     h.time.back() - std::min(h.time.front(), 0.0));
}

/// Resultant of one load or water at its full value, N.
Vec2 alone(const Simulation& sim, std::size_t load, std::size_t water) {
  LoadsNow now = loads_at(sim.scene->model, sim.attached.loads, 0.0);
  for (std::size_t q = 0; q < now.factor.size(); ++q) now.factor[q] = q == load ? 1.0 : 0.0;
  for (std::size_t q = 0; q < now.weight.size(); ++q) {
    if (q != water) now.weight[q] = 0.0;
  }
  Vec2 sum;
  for (const Id i : sim.attached.loads.blocks)
    sum += load_on(sim.scene->blocks, now, sim.motion.pose, i);
  return sum;
}

/// Length of the faces under one water at the start, m.
double wet_length(const Simulation& sim, std::size_t water) {
  const BlockSet& b = sim.scene->blocks;
  const double rise = loads_at(sim.scene->model, sim.attached.loads, 0.0).rise[water];
  double sum = 0.0;
  for (const WetEdge& e : sim.attached.loads.wet) {
    if (static_cast<std::size_t>(e.water) != water) continue;
    const double y = sim.motion.pose.y[e.edge], up = sim.motion.pose.y[b.next[e.edge]] - y;
    const double first = e.level_from + rise - (y + e.from * up),
                 last = e.level_to + rise - (y + e.to * up);
    const double high = std::max(first, last), low = std::min(first, last);
    const double rounding = 1e-9 * b.edge_length[e.edge];
    const double part = high <= rounding ? 0.0 : low >= 0.0 ? 1.0 : high / (high - low);
    sum += part * (e.to - e.from) * b.edge_length[e.edge];
  }
  return sum;
}

/// Peak and duration of a ground motion, and its final velocity: after a record without baseline
/// correction the motion continues for ever.
std::string shaking_line(const Shaking& s, std::size_t row) {
  const std::string name = row_label("shaking", s.name, row);
  if (s.acceleration.file.empty()) {
    return fmt::format("{}: sine of {:.4g} m/s2 and {:.4g} Hz", name,
                       s.scale * *s.acceleration.amplitude, *s.acceleration.frequency);
  }
  double peak = 0.0;
  for (const Vec2 a : s.record.acceleration) peak = std::max(peak, std::abs(s.scale) * norm(a));
  const Vec2 end = velocity_at(s, s.record.time.back());
  return fmt::format(
      "{}: {}, {} to {:.4g} s, peak {:.4g} m/s2; its velocity ends at ({:.4g}, {:.4g}) m/s", name,
      s.record.read_as, counted(s.record.time.size(), "row"), s.record.time.back(), peak, end.x,
      end.y);
}

/// What flows through the joints as they are, and where it comes from.
std::string flow_line(const Simulation& sim) {
  const JointWater& water = sim.attached.joint_water;
  double comes = 0.0;
  for (const double inflow : water.inflow) comes += std::max(inflow, 0.0);
  std::string text = fmt::format("flow through {}: {:.4g} m2/s at the start",
                                 counted(water.rows.size(), "joint"), comes);
  for (std::size_t q = 0; q + 1 < water.inflow.size(); ++q)
    text += fmt::format(", from {} {:.4g}", row_label("water", sim.scene->model.waters[q].name, q),
                        water.inflow[q]);
  return text;
}

std::string injection_line(const Simulation& sim, std::size_t q) {
  const Water& water = sim.scene->model.waters[q];
  const BlockSet& b = sim.scene->blocks;
  std::string where = ", none of which conducts water inside the rock at the start";
  if (const Id corner = sim.attached.joint_water.injected[q]; corner != no_id)
    where = " at " + place_label(b.vertex(corner) + b.origin);
  return fmt::format("{}: injects {:.4g} m2/s into the joints{}{}",
                     row_label("water", water.name, q), *water.injection, where,
                     range_of(water.rise, "times", ""));
}

std::string bolts_line(const Bolts& bolts) {
  std::size_t joints = 0;
  for (std::size_t k = 0; k < bolts.size(); ++k) joints += bolts.crossing[k];
  for (std::size_t q = 0; q < bolts.rows.size(); ++q) {
    const Id head = bolts.begin[q];  // of an end-anchored bolt one joint is counted
    if (!bolts.rows[q].grouted && bolts.host[head] != bolts.host[head + 1]) ++joints;
  }
  return fmt::format("{} of {} {} {}", counted(bolts.rows.size(), "bolt"),
                     counted(bolts.size(), "node"), bolts.rows.size() == 1 ? "crosses" : "cross",
                     counted(joints, "joint"));
}

}  // namespace

std::vector<std::string> load_report(const Simulation& sim) {
  constexpr std::size_t no_row = static_cast<std::size_t>(-1);
  std::vector<std::string> lines;
  const BlockSet& b = sim.scene->blocks;
  for (std::size_t q = 0; q < sim.scene->model.loads.size(); ++q) {
    const Load& load = sim.scene->model.loads[q];
    std::string on;
    double length = 0.0;
    std::size_t faces = 0, points = 0;
    for (const PointLoad& p : sim.attached.loads.points) {
      if (static_cast<std::size_t>(p.load) != q) continue;
      on = block_label(b, p.at.block);
      ++points;
    }
    for (const EdgeLoad& e : sim.attached.loads.edges) {
      if (static_cast<std::size_t>(e.load) != q) continue;
      ++faces;
      length += (e.to - e.from) * b.edge_length[e.edge];
    }
    if (!load.along.empty()) on = fmt::format("{:.4g} m of {}", length, counted(faces, "face"));
    if (load.body_force) on = counted(points, "block");
    const Vec2 f = alone(sim, q, no_row);
    lines.push_back(fmt::format("{} on {}: ({:.4g}, {:.4g}) N{}", row_label("load", load.name, q),
                                on, f.x, f.y, range_of(load.factor, "times", "")));
  }
  for (std::size_t q = 0; q < sim.scene->model.waters.size(); ++q) {
    const Water& water = sim.scene->model.waters[q];
    if (water.rain) {
      lines.push_back(fmt::format("{} of {:.4g} mm/h on the ground under the open sky{}",
                                  row_label("water", water.name, q), 3.6e6 * *water.rain,
                                  range_of(water.rise, "times", "")));
      continue;
    }
    if (water.injection) {
      lines.push_back(injection_line(sim, q));
      continue;
    }
    if (water.level) {
      lines.push_back(fmt::format("{} at the level {:.4g} m in the rock, where its line meets {}{}",
                                  row_label("water", water.name, q), *water.level,
                                  counted(sim.attached.joint_water.heads[q], "joint"),
                                  range_of(water.rise, "rising", " m")));
      continue;
    }
    const double length = wet_length(sim, q);
    const Vec2 f = alone(sim, no_row, q);
    lines.push_back(
        fmt::format("{} over {:.4g} m of faces, {} of {} full: ({:.4g}, {:.4g}) N at the start{}",
                    row_label("water", water.name, q), length, water.flooded.size(),
                    counted(sim.scene->model.openings.size(), "opening"), f.x, f.y,
                    range_of(water.rise, "rising", " m")));
  }
  if (sim.scene->model.flow) lines.push_back(flow_line(sim));
  for (std::size_t q = 0; q < sim.scene->model.shakings.size(); ++q) {
    lines.push_back(shaking_line(sim.scene->model.shakings[q], q));
  }
  if (!sim.attached.bolts.rows.empty()) lines.push_back(bolts_line(sim.attached.bolts));
  return lines;
}

}  // namespace edda
