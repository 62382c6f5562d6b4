// Motion and damping at the boundaries of the model, in the explicit method: ground motion,
// velocity boundaries, outgoing and incoming waves. Theory, section 13.8.
#pragma once

#include <vector>

#include "attachments/free_field.hpp"
#include "attachments/loads.hpp"

namespace edda {

struct Simulation;

/// Velocities that the dashpots at the boundaries refer to at n, and additional forces, [points].
struct DashpotDrive {
  std::vector<Vec2> reference;  ///< m/s
  std::vector<Vec2> push;       ///< N; empty: none
};

/// Loads and bolts as they act at n.
LoadsNow acting(const Simulation& sim);
/// The water in the pores of zones now.
PoreWater water_in_pores(const Simulation& sim);

/// Velocity of the ground at n, m/s.
Vec2 ground_velocity(const Simulation& sim);

/// Velocity of the ground (`of_ground`, m/s) plus twice that of an incoming wave; beside free-field
/// columns, the mean of their velocities now and in `next`, and their stress as forces.
DashpotDrive dashpot_drive(const Simulation& sim, Vec2 of_ground,
                           const std::vector<FreeFieldColumn>& next);

/// The free-field columns one step further.
std::vector<FreeFieldColumn> next_free_field(const Simulation& sim, Vec2 of_ground, double h_old,
                                             double h_new);

/// Starts the ground half a step back, as the blocks are: v_{-1/2} = -a_0 h/2. Sets its earlier
/// position accordingly.
void start_ground(Simulation& sim, double h);
/// Computes the motion of ground and columns and the drive of the dashpots for the step from n to n
/// + 1; account_boundaries() makes it the present state.
void drive_ground(Simulation& sim, double h_old, double h_new);
/// Moves the blocks that move with the ground back to where they were at n.
void stop_ground(Simulation& sim);
/// Force of faces and bolts at n on the blocks that move with the ground, N.
Vec2 force_on_fixed(const Simulation& sim);
/// Power of the bolts' forces at n on the blocks at the velocities of n - 1/2, W.
double bolt_power(const Simulation& sim);
/// Accounts for the work of the step at the boundaries, and advances the ground and the columns to
/// n + 1.
void account_boundaries(Simulation& sim, double h_old, double h_new);

}  // namespace edda
