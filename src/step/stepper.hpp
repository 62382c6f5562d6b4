// The interface of the methods of stepping: the explicit one (leapfrog, with a step bounded by
// stability), the same with the contacts of the paper, and the implicit one (Newmark with a global
// solve).
#pragma once

#include <cstddef>
#include <optional>

#include "step/divergence.hpp"

namespace edda {

struct Simulation;
struct Instant;
struct Reach;

/// A method of stepping. All other parts of a simulation use it only through these members.
struct Stepper {
  /// Before the first step, whose length is known: sets the velocities to the instant at which the
  /// method has them.
  void (*start)(Simulation&);
  /// Computes the bound of the step again.
  void (*set_limit)(Simulation&);
  /// One step.
  std::optional<Failure> (*step)(Simulation&);
  /// The complete state at the end of the last step.
  void (*complete_instant)(const Simulation&, Instant&);
  /// Distance that block i, of which the forces have this resultant (N), would still move against
  /// the stiffness of the motion, m; infinite: unknown.
  double (*remaining_travel)(const Simulation&, std::size_t i, double force);

  /// Makes the list of all possible contacts within this reach.
  void (*search)(Simulation&, const Reach&);
  /// The contacts at the start, once they are listed.
  void (*begin_contacts)(Simulation&);
  /// Sums the forces of the contacts on each block (Motion::on_contacts).
  void (*sum_contacts)(Simulation&);
  /// Where two blocks overlap by more than the half-width of one of them.
  std::optional<Failure> (*deep_overlap)(const Simulation&);

  /// Distance that any vertex may move in the next step, m.
  double (*ahead)(const Simulation&);
  /// The contact list is renewed when its reach is less than what two edges have approached each
  /// other since (largest_approach()) plus twice this multiple of ahead().
  double margin;
  /// Least reach of the contact list, in units of the displacement limit of a step.
  double least_reach;
  /// Steps by which velocities are behind positions: 1/2 for the leapfrog, 0 where both belong to
  /// one instant.
  double velocity_lag;
  /// Whether stability bounds the step (StepBound), so that mass scaling makes sense.
  bool conditionally_stable;
};

extern const Stepper leapfrog_stepper;
extern const Stepper paper_stepper;
extern const Stepper newmark_stepper;

}  // namespace edda
