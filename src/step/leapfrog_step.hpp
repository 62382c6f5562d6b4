// Working data of the leapfrog (theory, section 7.1), kept from step to step. A checkpoint needs
// none of it.
#pragma once

#include <optional>
#include <vector>

#include "attachments/free_field.hpp"
#include "attachments/ground.hpp"
#include "blocks/kinematics.hpp"
#include "forces/step_bound.hpp"
#include "integrate/leapfrog.hpp"
#include "integrate/strain_damping.hpp"
#include "step/divergence.hpp"
#include "step/face_switching.hpp"
#include "step/ground_motion.hpp"

namespace edda {

/// What a step of the leapfrog does with the contacts.
struct LeapContacts {
  void (*begin)(Simulation&);  ///< before the blocks move
  /// State and forces at n + 1; h_old: the step before, s.
  void (*evaluate)(Simulation&, double h_old);
};
std::optional<Failure> leap(Simulation& sim, const LeapContacts& contacts);

/// Raises the masses, where mass scaling is asked for or slivers need it.
void scale_masses(Simulation& sim);
/// Limits the step by this bound, and by what the model gives.
void limit_leap(Simulation& sim, const StepBound& bound);

struct LeapfrogStep {
  BodyVectors old_velocity;  ///< v_{n-1/2}, m/s; swapped with State::velocity as a step begins
  GroundStep next_ground;    ///< ground at the end of the step
  Vec2 on_fixed;             ///< N at n: force_on_fixed() before the contact activation
  DashpotDrive drive;        ///< motion of the ground behind the dashpots
  std::vector<FreeFieldColumn> next_columns;  ///< free field at the end of the step
  std::vector<double> largest;  ///< [chunks of blocks] squares of largest displacements, m2
  FaceSwitchingScratch switching;
  DampingOfStep damping;
};

}  // namespace edda
