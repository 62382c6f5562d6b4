// What mass a force on a point of a block feels.
#pragma once

#include "blocks/block_set.hpp"

namespace edda {

/// Fills point_inverse and edge_inverse from the masses of the nodes. Again whenever these, or what
/// is held, change.
void fill_point_masses(BlockSet& blocks);

/// Inverse of the mass that a force feels on edge e-f at the part xi of its length, 1/kg: the
/// quadratic form of its weights (1 - xi) w_e + xi w_f.
template <class Blocks>
[[gnu::always_inline]] inline double inverse_mass_on_edge(const Blocks& b, std::size_t e,
                                                          std::size_t f, double xi) {
  const double rest = 1.0 - xi;
  return rest * rest * b.point_inverse[e] + 2.0 * xi * rest * b.edge_inverse[e] +
         xi * xi * b.point_inverse[f];
}

}  // namespace edda
