// Whether a model has reached equilibrium, judged block by block by how far each would still move,
// and not by a mean. Blocks that slide or fall away for good do not prevent it. Theory,
// sections 11.3 and 11.4.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/stages.hpp"

namespace edda {

/// In equilibrium, in stages and in trials, no block would move further than this part of its size,
/// in this many checks in sequence.
constexpr double equilibrium_travel_ratio = 1e-4;
constexpr int checks_in_sequence = 3;

/// Acceleration that replaces gravity where there is none, m/s2.
constexpr double usual_acceleration = 9.81;

/// Time for which a block would have to stay, s: T = 5 sqrt(size/g), in which an unsupported block
/// would fall by twelve times its size (m); g: acceleration that acts, m/s2, or 0.
double equilibrium_time(double size, double acceleration);

/// Data of the search in one stage until equilibrium.
struct EquilibriumSearch {
  int found_in_sequence = 0;              ///< checks in sequence that have found equilibrium
  bool is_far = false;                    ///< from equilibrium, by the mean unbalanced force
  std::uint64_t window_began = 0;         ///< step
  std::uint64_t window = 0;               ///< steps
  double pull = 0.0, pull_before = 0.0;   ///< 1/s2, of this window and the last one: the
                                          ///< displacement in a window times this measures the
                                          ///< acceleration that drives a block which only
                                          ///< mass-proportional damping resists
  std::vector<double> began_x, began_y;   ///< [nb] m, centroids when the stage began
  std::vector<std::uint8_t> began_apart;  ///< [nb] 1: was in the air then, alone or with others
  std::vector<double> from_x, from_y;     ///< [nb] m, centroids when the window began
  std::vector<double> moved_x, moved_y;   ///< [nb] m, displacements in the last window
  std::vector<double> to_come;  ///< [nb] m: distance that the block will still move if it slows
                                ///< down by the ratio of the last two windows; infinite: it does
                                ///< not slow down, or that is not known yet
  std::vector<std::uint8_t> windows_moving;  ///< [nb] windows in sequence in which the block has
                                             ///< continued to move
};

/// Begins the search of a stage: no block counts as loose. In a stage until equilibrium, adaptive
/// damping is updated from now on.
void begin_equilibrium_search(EquilibriumSearch& search, Simulation& sim, const Stage& stage);

enum class Equilibrium {
  not_yet,
  found,
  never,  ///< all free blocks are loose, and each has left its place
};

/// Call after every step. Equilibrium is found once all gradual changes are complete
/// (gradual_change_complete()), the mean unbalanced force is within the stage's ratio, and no block
/// would move further than a ten-thousandth of its size. This is checked with the stiffness of the
/// present motion (Stepper::remaining_travel), and without any stiffness: with its velocity v and
/// the resultant R a block would move v T + R/m T^2/2 in T = equilibrium_time(), m its true mass,
/// unless it is seen to slow down before that. Pebbles do not count. Marks blocks as loose that
/// keep moving where others reach equilibrium: in each of several windows, about half a period of
/// the motion long, they have moved in the same direction by at least half as much as in the window
/// before, corrected for the change of damping and window length.
Equilibrium look_for_equilibrium(EquilibriumSearch& search, Simulation& sim, const Stage& stage);

/// Forces at each block that follow from the rounding of coordinates, [nb] N. A small block wedged
/// between large ones does not balance any better.
std::vector<double> rounding_of_forces(const Simulation& sim);

/// Distance that block i would move within t (s) if nothing supported it, m: v t + R/m t^2/2, with
/// its velocity v (m/s), the resultant R of the forces on it less `rounding` (N), and its true mass
/// m.
double travel_if_free(const Simulation& sim, std::size_t i, double v, double t, double rounding);

/// Loose blocks of the present stage, pebbles excluded, ascending.
std::vector<Id> loose_block_ids(const Simulation& sim);
/// The same and those that fall freely.
std::vector<Id> lost_block_ids(const Simulation& sim);

/// "block 25 (3.1 mm so far), block 7 (...)", the fastest first; empty: none.
std::string loose_blocks(const EquilibriumSearch& search, const Simulation& sim);

}  // namespace edda
