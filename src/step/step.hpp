// The step: what the loop of a run calls.
#pragma once

#include <optional>

#include "attachments/loads.hpp"
#include "step/divergence.hpp"

namespace edda {

struct Simulation;

/// Chooses the step so that a whole number of steps ends at `first_event` (s), and sets the
/// velocities to the instant at which the method has them. Call once, before the first step().
void start(Simulation& sim, double first_event);

/// One step of the method: forces, motion, contacts, contact activation, contact search. A block
/// whose trouble is its own is set aside (step/changes.hpp).
std::optional<Failure> step(Simulation& sim);

// Used by the methods of stepping:
/// Updates time and counts after a step.
void finish_step(Simulation& sim);
/// Checks for a state from which no run should continue.
std::optional<Failure> inspect(const Simulation& sim);
/// The step, and what the method's stability allows.
StepInUse step_in_use(const Simulation& sim);
/// The failure where values are not finite: its place and likely cause.
Failure lost(const Simulation& sim);

}  // namespace edda
