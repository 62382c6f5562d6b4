// Blocks too coarse for an opening, or of one strain between stiff joints: how much of a closure or
// of a bending deflection is lost (theory, section 4.9).
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// An opening in ground with an initial stress whose elastic closure is too small.
struct LockedOpening {
  std::size_t opening;     ///< row of Model::openings
  double stiffness = 0.0;  ///< of the joints around it over that of their blocks, the mean
  double size = 0.0;       ///< m, of the blocks there: root of the mean area
  double radius = 0.0;     ///< m: root of the area of the opening over pi
  double lost = 0.0;       ///< part of the closure
  bool bends = false;      ///< most of these blocks bend, and are too large for the opening
};
std::vector<LockedOpening> locked_openings(const Simulation& sim);

/// Part of its elastic closure that an opening loses among blocks that do not bend, with x = (2 -
/// k) (0.13 kn + 0.15 ks) (block/radius)^2: ratio k of the principal stresses of the ground, 0 to
/// 1, and stiffnesses of the joints over those of their blocks, kn as the joint bends; none for
/// triangles.
double lost_closure(double x);

/// The same among blocks that bend, by the ratio of their size to the radius.
double lost_by_size(double size);

/// Blocks glued in a row, which loads bend: each touches two others alone, which do so too, end the
/// row or are fixed.
struct LockedRow {
  std::vector<Id> blocks;  ///< ascending
  double stiffness = 0.0;  ///< of their joints over that of the blocks, in bending, the mean
  double lost = 0.0;       ///< part of the deflection
  double kn = 0.0;         ///< Pa/m: joints that bend as the blocks would
  bool triangles = false;  ///< among them, which have no corner to spare for bending
};
LockedRow locked_row(const Simulation& sim);

void warn_of_locking(const Simulation& sim, std::vector<std::string>& warnings);

}  // namespace edda
