// Choice of the step: the limits of stability and displacement, and the event at which a whole
// number of steps ends. Theory, sections 7.3 and 12.5.
#pragma once

#include <cstdint>
#include <limits>
#include <vector>

#include "blocks/block_set.hpp"
#include "contacts/find_faces.hpp"
#include "forces/step_bound.hpp"

namespace edda {

struct Simulation;

struct StepControl {
  StepBound bound;       ///< at the last search
  double limit = 0.0;    ///< s: largest step allowed at present
  double nominal = 0.0;  ///< s: of the implicit method, before any cut
  double cap = std::numeric_limits<double>::infinity();  ///< s: limit after halvings of the step
  double step_before = 0.0;  ///< s: step that ends at n, over which v_{n-1/2} acted; 0 before the
                             ///< first
  double target = 0.0;       ///< s: time of the next event
  std::uint64_t steps_left = 0;            ///< steps up to the next event
  std::uint64_t larger_allowed_since = 0;  ///< step since which a much larger one has been allowed
  double last_displacement = 0.0;          ///< m: largest of a vertex in the last step
  NeighbourGroups neighbours;              ///< of the list of possible contacts
  NearEdges near_edges;
  StepCache step_cache;
  // Mass scaling.
  double scaled_step = 0.0;  ///< s: uniform step of a stage, to which inertia is raised; 0: none
  double sliver_step = 0.0;  ///< s: step to which the inertia of slivers is raised; 0: no slivers
  std::vector<double> sliver_most;  ///< [nb] largest factor on the masses that this may take
};

/// Sets the step towards an event at `time` s: as few equal steps as the limit allows.
void fit_step_to(Simulation& sim, double time);

/// Computes the bound of the step again, after a search or a change of masses, damping or springs.
void set_limit(Simulation& sim);

/// Largest step allowed, s; for the implicit method, the one after its short first step.
double usual_step(const Simulation& sim);

/// The step of the block that allows the longest one, s: that of a mass scaling after which all
/// blocks allow the same.
double uniform_step(const Simulation& sim);

/// Sets the masses as given, or raises them so that all blocks allow one time step.
void scale_masses(Simulation& sim, StageMasses masses);

/// Plans the mass scaling of the slivers of the cut.
void plan_slivers(Simulation& sim);

/// Raises the masses of blocks that would hold the step below the requested one.
void raise_masses(Simulation& sim);

/// Everything that determines stiffness and damping of the blocks at present.
StiffnessInputs stiffness_inputs(const Simulation& sim);
/// The same for other block properties.
StiffnessInputs stiffness_inputs(const Simulation& sim, const BlockSet& blocks);

/// Updates the viscosity, after a change of masses or damping.
void set_viscosity(Simulation& sim);

}  // namespace edda
