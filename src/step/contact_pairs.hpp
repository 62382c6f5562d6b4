// Blocks in contact, of either contact model.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

#include "blocks/block_set.hpp"

namespace edda {

struct Simulation;

enum class Nearness {
  closed,    ///< the contact carries force, or is bonded
  touching,  ///< or there is no gap between the blocks, within rounding
  near       ///< or a gap of a thousandth of the smaller block at most
};

/// Both blocks of each contact that is so near, one pair for each contact.
std::vector<std::pair<Id, Id>> blocks_in_contact(const Simulation& sim, Nearness nearness);

/// Normal forces of the contacts, N.
struct NormalForces {
  double pressed = 0.0;  ///< the sum of those that press
  std::size_t ends = 0;  ///< on how many ends of faces, or points, they act
  double size = 0.0;     ///< the sum of all sizes
};
/// of_faces: normal_forces_now().
NormalForces normal_forces(const Simulation& sim, const std::vector<double>& of_faces);

}  // namespace edda
