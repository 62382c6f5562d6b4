// Whether single blocks are at rest, each by its own size and time (theory, section 11.3).
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// At rest a block would move no further than this part of its size, and the forces on it balance
/// to this part of its weight, or of the mean force that presses it where that is larger.
inline constexpr double rest_part = 1e-4, balanced_part = 2e-5;
/// The time in which a block at rest is judged, over sqrt(L/a): rest_time().
inline constexpr double rest_times = 5.0;

/// Time within which a block at rest would move no further, s: T = rest_times sqrt(L/a), in which
/// it would fall by twelve times its size L (m) under the acceleration a (m/s2) that acts on it.
double rest_time(double size, double acceleration);

/// That of the free block that has the longest, s.
double longest_rest_time(const Simulation& sim);

/// Acceleration of gravity, or that of the loads on block i where there is none, m/s2.
double acceleration_on(const Simulation& sim, const LoadsNow& acting, std::size_t i);

/// Whether no block has a resultant beyond the rounding of the forces on it, as where nothing acts
/// on the model.
bool forces_are_rounding(const Simulation& sim);

/// Extrapolates the motion of blocks, and of the nodes of their meshes, from one time window to the
/// next, each about half a period of the motion long.
class SlowingDown {
 public:
  /// Begins anew, without a trend.
  void begin(const Simulation& sim);
  /// Call every few steps.
  void look(const Simulation& sim);
  /// Distance that block i will still move if it slows down as from the last but one window to the
  /// last, m; infinite where it does not, or where that is not known yet. Of a mesh: of the node
  /// that has furthest to go compared with its zones, by this part of the block's size.
  double to_come(std::size_t i) const { return to_come_[i]; }
  /// Whether the coordinates of block i have not changed at all in the last window: what moves it
  /// is less than they can tell, as where a sliver has a mass many times its own.
  bool is_still(std::size_t i) const {
    return pull_before_ > 0.0 && moved_x_[i] == 0.0 && moved_y_[i] == 0.0;
  }
  bool fits(const BlockSet& blocks) const;
  template <class Archive>
  void list(Archive& a, const std::string& of);

 private:
  void begin_window(const Simulation& sim);
  std::uint64_t began_ = 0, length_ = 0;   ///< steps, of the present window
  double pull_ = 0.0, pull_before_ = 0.0;  ///< 1/s2: the displacement in a window times this
                                           ///< measures the acceleration that drives a block which
                                           ///< only mass-proportional damping resists
  /// Of the centroids, then of the mesh nodes, [nb + mesh nodes] m: places when the window began,
  /// displacements in the last window.
  std::vector<double> from_x_, from_y_, moved_x_, moved_y_;
  std::vector<double> to_come_;  ///< [nb] m
};

template <class Archive>
void SlowingDown::list(Archive& a, const std::string& of) {
  a(of + "slowing.began", began_);
  a(of + "slowing.length", length_);
  a(of + "slowing.pull", pull_);
  a(of + "slowing.pull_before", pull_before_);
  a(of + "slowing.from_x", from_x_);
  a(of + "slowing.from_y", from_y_);
  a(of + "slowing.moved_x", moved_x_);
  a(of + "slowing.moved_y", moved_y_);
  a(of + "slowing.to_come", to_come_);
}

/// [nb] 1: the block is at rest, or not free. With the velocity v and the resultant R of the forces
/// on it, less their rounding, it would move by no more than rest_part of its size L if nothing
/// held it, v T + R/m T^2/2 with T = rest_time(L, a), m its true mass, and v that of the same
/// kinetic energy with this mass; or against the stiffness of its motion
/// (Stepper::remaining_travel), if it is also seen to slow down before that and R is at most
/// balanced_part of its weight, or to be still. `slowing`: null where only the stiffness counts.
std::vector<std::uint8_t> blocks_at_rest(const Simulation& sim, const SlowingDown* slowing);

}  // namespace edda
