// The parts of a simulation that no step changes: the model as read, its polygons, the geometry and
// the rock of its blocks.
#pragma once

#include "blocks/block_set.hpp"
#include "cutting/polygon_set.hpp"
#include "model/model.hpp"
#include "zones/zone_set.hpp"

namespace edda {

/// Filled by Simulation::create().
struct Scene {
  Model model;
  PolygonSet polygons;
  BlockSet blocks;
  ZoneModel zones;
  double base_reach = 0.0;           ///< m: least reach of the contact search
  double displacement_limit = 0.0;   ///< m: largest displacement of a vertex in one step
  double smallest_half_width = 0.0;  ///< m, of all blocks
};

}  // namespace edda
