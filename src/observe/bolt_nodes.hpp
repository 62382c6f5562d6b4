// Forces of a bolt at one of its nodes.
#pragma once

#include "step/simulation.hpp"

namespace edda {

/// Of one bolt, not per metre of thickness.
struct BoltNode {
  Vec2 place;                                   ///< now, m
  double axial = 0.0, bond = 0.0, dowel = 0.0;  ///< N, N/m, N
  double utilisation = 0.0;                     ///< the largest of the three
  double dowel_utilisation = 0.0;
  double angle = 0.0;                      ///< by which a link has turned, rad
  bool yielded = false, ruptured = false;  ///< the steel beside it, where it has not been cut
};

/// Node k of the bolt in row r of Bolts::rows.
BoltNode bolt_node(const Simulation& sim, std::size_t r, std::size_t k);

}  // namespace edda
