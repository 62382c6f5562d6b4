#pragma once

#include "contacts/tile_rows.hpp"
#include "forces/nodal_forces.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Resultant of the forces of the faces on block i, N.
inline Vec2 contact_resultant(const Simulation& sim, std::size_t i) {
  const Motion& motion = sim.motion;
  const BlockSet& b = sim.scene->blocks;
  BodyVectors on;
  sum_faces(on, b, motion.contacts,
            corner_forces(motion.contacts, motion.tiled.tiles, b, motion.pose));
  return resultant(vectors_of(on, i));
}

}  // namespace edda
