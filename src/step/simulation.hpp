// A simulation: its parts, and the method by which it makes a step.
#pragma once

#include "base/copy_on_write.hpp"
#include "base/fault.hpp"
#include "implicit/newmark.hpp"
#include "paper/points.hpp"
#include "step/accounts.hpp"
#include "step/attached.hpp"
#include "step/leapfrog_step.hpp"
#include "step/motion.hpp"
#include "step/relaxation.hpp"
#include "step/scene.hpp"
#include "step/step_control.hpp"
#include "step/stepper.hpp"

namespace edda {

/// Numbering of the blocks: as the cut gives them, or reversed (for verification: only rounding may
/// depend on it).
enum class BlockOrder { as_cut, reversed };

struct Simulation {
  CopyOnWrite<Scene> scene;  ///< shared by copies of the simulation
  Attached attached;
  Motion motion;
  Accounts accounts;
  StepControl control;
  Relaxation relaxation;
  const Stepper* stepper = nullptr;  ///< by solver.method
  LeapfrogStep leapfrog;             ///< working data of the leapfrog
  ImplicitSolver implicit;           ///< working data of Newmark's method
  PointSet point_contacts;           ///< of the paper's model, in place of faces

  /// Cuts the domain, builds the blocks, finds contacts and bounds the step. Returns faults of the
  /// geometry as values.
  static Result<Simulation> create(Model model, BlockOrder order = BlockOrder::as_cut);
};

/// The rock of its blocks, evaluated at the end of the last step.
inline RockInside rock_of(const Simulation& sim) {
  const bool meshed = sim.scene->blocks.meshes.any();
  return {&sim.motion.locked, meshed ? &sim.scene->zones : nullptr,
          meshed ? &sim.motion.zones : nullptr};
}

/// Whether its method is the explicit one (solver.method = "edda").
inline bool is_explicit(const Simulation& sim) {
  return sim.stepper->conditionally_stable;
}

}  // namespace edda
