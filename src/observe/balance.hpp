// Measures of how far a simulation is from equilibrium.
#pragma once

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

#include "blocks/block_set.hpp"

namespace edda {

struct Simulation;

/// How far the forces of the last step are from equilibrium. Blocks without contact do not count,
/// since they fall whatever the others do, unless nothing moves them; nor do loose blocks
/// (Relaxation::loose).
struct Balance {
  double mean = 0.0;  ///< mean resultant of the blocks and mesh nodes, over the mean contact normal
                      ///< force (the mean weight where no contact carries load)
  double mean_95 = 0.0;      ///< the same mean without the 5 % of blocks furthest from equilibrium
  double largest = 0.0;      ///< the same for the block furthest from equilibrium, the mean of its
                             ///< mesh
  Id block = no_id;          ///< that block
  std::size_t resting = 0;   ///< blocks that count
  std::size_t detached = 0;  ///< free blocks that fall: without contact, and not at rest
  std::size_t loose = 0;     ///< blocks that slide or fall away for good (Relaxation::loose)
};

Balance balance_of(const Simulation& sim);

/// Resultant of the forces on block i in the last step, N.
double resultant_on(const Simulation& sim, std::size_t i);

/// [nb] 1: a free block that touches nothing, or carries no load where it touches, and moves or is
/// about to move. Where nothing acts on a model its blocks rest without carrying any load.
std::vector<std::uint8_t> falling_blocks(const Simulation& sim);

/// Loose blocks (Relaxation::loose), ascending.
std::vector<Id> loose_blocks(const Simulation& sim);

/// The fastest blocks and the unbalanced forces, for a stage that did not reach equilibrium.
std::string still_moving(const Simulation& sim, const Balance& balance);

}  // namespace edda
