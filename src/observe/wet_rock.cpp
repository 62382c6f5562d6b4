#include "observe/wet_rock.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "step/labels.hpp"

namespace edda {
namespace {

/// The largest pore pressure that a water ever makes in a zone, Pa.
double largest_pressure(const Simulation& sim, const WetZone& wet) {
  const BlockSet& b = sim.scene->blocks;
  const Water& water = sim.scene->model.waters[wet.water];
  const double y = b.centroid_y[wet.block] + centre_of_zone(b.meshes, wet.zone).y;
  double rise = 0.0;
  for (const double value : water.rise.value) rise = std::max(rise, value);
  return water.unit_weight * std::max(0.0, wet.level + rise - y);
}

/// A place, model coordinates, and the pore pressure there.
struct Wettest {
  double pressure = 0.0;
  Vec2 place;
  void see(double p, Vec2 at) {
    if (p > pressure) *this = {p, at};
  }
};

/// Dry outer edges of wet zones.
Wettest wettest_wall(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const Meshes& m = b.meshes;
  std::vector<std::uint8_t> has_water(b.vertex_count(), 0);
  for (const WetEdge& e : sim.attached.loads.wet) has_water[e.edge] = 1;
  Wettest wall;
  for (const WetZone& wet : sim.attached.loads.wet_zones) {
    const std::uint32_t first = m.begin[wet.block];
    const Id begin = b.vertex_begin[wet.block], end = b.vertex_begin[wet.block + 1];
    for (std::size_t k = 0; k < corners_of_zone; ++k) {
      const Id v = begin + m.zone[wet.zone][k] - first,
               next = begin + m.zone[wet.zone][(k + 1) % corners_of_zone] - first;
      if (v >= end || b.next[v] != next || has_water[v] != 0) continue;
      wall.see(largest_pressure(sim, wet), 0.5 * (b.vertex(v) + b.vertex(next)) + b.origin);
    }
  }
  return wall;
}

/// Nodes between zones under the table of a water and others beside its ends.
Wettest wettest_end(const Simulation& sim, std::size_t row) {
  const BlockSet& b = sim.scene->blocks;
  const Meshes& m = b.meshes;
  std::vector<double> pressure(m.nodes(), 0.0);
  std::vector<std::uint8_t> under(m.zone.size(), 0), of_block(b.size(), 0);
  for (const WetZone& wet : sim.attached.loads.wet_zones) {
    if (wet.water != row) continue;
    under[wet.zone] = of_block[wet.block] = 1;
    for (const std::uint32_t j : m.zone[wet.zone])
      pressure[j] = std::max(pressure[j], largest_pressure(sim, wet));
  }
  Wettest end;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (of_block[i] == 0) continue;
    const Vec2 centre = Vec2{b.centroid_x[i], b.centroid_y[i]} + b.origin;
    for (std::uint32_t z = m.zone_begin[i]; z < m.zone_begin[i + 1]; ++z) {
      if (under[z] != 0) continue;
      for (const std::uint32_t j : m.zone[z])
        end.see(pressure[j], centre + Vec2{m.arm_x[j], m.arm_y[j]});
    }
  }
  return end;
}

}  // namespace

void warn_of_wet_rock(const Simulation& sim, std::vector<std::string>& warnings) {
  if (sim.attached.loads.wet_zones.empty()) return;
  if (const Wettest wall = wettest_wall(sim); wall.pressure > 0.0) {
    warnings.push_back(fmt::format(
        "water: rock at the dry wall at {} keeps the pore pressure of the table, up to {:.3g} MPa, "
        "since no flow is computed: draw the table down to the opening, or name it as flooded, or "
        "give the material pore_pressure = false",
        place_label(wall.place), 1e-6 * wall.pressure));
  }
  for (std::size_t q = 0; q < sim.scene->model.waters.size(); ++q) {
    const Wettest end = wettest_end(sim, q);
    if (end.pressure == 0.0) continue;
    warnings.push_back(fmt::format(
        "{}: its table ends within a block of zones, so that pores have up to {:.3g} MPa on one "
        "side of {} and none on the other: continue the table through the block, or give the "
        "material pore_pressure = false",
        sim.scene->model.waters[q].where.key, 1e-6 * end.pressure, place_label(end.place)));
  }
}

}  // namespace edda
