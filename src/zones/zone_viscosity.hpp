// Viscous forces of zones and pieces of linings (theory, sections 9.2 and 9.3).
#pragma once

#include "zones/pairs.hpp"
#include "zones/zone_set.hpp"

namespace edda {

/// Those of the nodes of a zone.
inline std::array<Vec2, corners_of_zone> at_corners(const Meshes& m, const std::vector<Vec2>& of,
                                                    std::uint32_t z) {
  const auto& [a, b, c] = m.zone[z];
  return {of[a], of[b], of[c]};
}

/// What the viscous forces of pair p do with the velocities of its nodes, W.
double viscous_power(const ZoneModel& model, const BlockSet& blocks, const Zones& zones,
                     std::size_t p);

/// The viscous forces of the velocities that have moved the nodes, and what those before have
/// dissipated by the displacements of both steps around them, each by half.
void evaluate_viscosity(const ZoneModel& model, const BlockSet& blocks, const State& state,
                        const std::vector<double>& viscosity, double h, Zones& zones);

/// Of pair p, which begins.
void begin_viscosity(const ZoneModel& model, std::size_t p, Zones& zones);

}  // namespace edda
