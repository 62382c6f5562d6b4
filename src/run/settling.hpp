// Whether a model has come to rest: judged by what would still move, block by block, and not by a
// mean. Blocks that slide or fall away for good hold up nobody.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "run/stages.hpp"

namespace edda {

/// At rest, in stages and in trials, is what would not go on by more than this part of a block's
/// size, so many looks in sequence.
constexpr double left_over = 1e-4;
constexpr int looks_at_rest = 3;

/// What counts for gravity where nothing acts, m/s2.
constexpr double usual_acceleration = 9.81;

/// For how long it would have to stay, s: T = 5 sqrt(size/g), in which a block that nothing held
/// would fall by twelve of its size (m); g: acceleration of what acts, m/s2, or 0.
double time_to_stay(double size, double acceleration);

/// What is remembered from look to look, of one stage until equilibrium.
struct Settling {
  int calm = 0;                          ///< looks in sequence that have found rest
  std::uint64_t window_began = 0;        ///< step
  std::uint64_t window = 0;              ///< steps
  double pull = 0.0, pull_before = 0.0;  ///< 1/s2, of this window and the one before: its
                                         ///< displacements times this are what drives a block on
                                         ///< which nothing but drag acts, m/s2
  std::vector<double> from_x, from_y;    ///< [nb] m, centroids when the window began
  std::vector<double> moved_x, moved_y;  ///< [nb] m, in the window before
  std::vector<double> to_come;      ///< [nb] m: how far it still goes if it slows down from window
                                    ///< to window by the ratio of the last two; infinite: it does
                                    ///< not, or that is not known yet
  std::vector<std::uint8_t> going;  ///< [nb] windows in sequence in which it has gone on as before
};

/// Begins anew: no block is known to go its own way. A stage until equilibrium is to come to rest
/// from now on.
void begin_settling(Settling& settling, Simulation& sim, const Stage& stage);

/// How far block i would still go, m: |v|/w + |R|/(m w^2) with its velocity v, the resultant R of
/// the forces on it, and w the frequency with which the model moves (Pace). Of a static implicit
/// step, what that has moved it by.
double prospect(const Simulation& sim, std::size_t i);

enum class Rest {
  not_yet,
  found,
  never,  ///< whatever is free has come loose, and each such block has gone further than its size
};

/// To be called after every step. Rest is found once all that is to come has come
/// (Simulation::all_on), the mean unbalanced force is within the stage's ratio, and no block would
/// go further than a ten-thousandth of its size: neither with the stiffness that the model moves
/// with (prospect), nor without any, where it keeps its velocity and the resultant R on it for
/// T (time_to_stay), v T + R/m T^2/2 with its true mass, unless it is seen to slow down before
/// that. Pebbles do not count. Marks blocks that keep going where others come to rest as aloof: in
/// each of several windows, about half a period of the motion long, they have gone on in the same
/// direction by at least half as much as in the one before, as drag and window then were.
Rest look_for_rest(Settling& settling, Simulation& sim, const Stage& stage);

/// What the springs at each block make of the rounding of coordinates, [nb] N. Nothing small that
/// is wedged tight between large blocks is in balance to less.
std::vector<double> rounding_of_forces(const Simulation& sim);

/// How far block i would go within t (s) if nothing held it, m: v t + R/m t^2/2, with its velocity
/// v (m/s), the resultant R of the forces on it less what `rounding` (N) makes, and its true mass
/// m.
double way_unheld(const Simulation& sim, std::size_t i, double v, double t, double rounding);

/// Blocks that have come loose in the stage in hand, but for pebbles, ascending.
std::vector<Id> loose_ones(const Simulation& sim);

/// "block 25 (3.1 mm so far), block 7 (...)", the fastest first; empty: none.
std::string loose_blocks(const Settling& settling, const Simulation& sim);

}  // namespace edda
