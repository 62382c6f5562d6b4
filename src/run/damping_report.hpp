// How much the damping of the blocks' strain takes from what shakes a model.
#pragma once

#include <string>
#include <vector>

#include "results/json.hpp"
#include "run/simulation.hpp"

namespace edda {

/// One motion or load of the model that has a frequency.
struct StrainDampingAt {
  std::string of;          ///< "shaking quake"
  double frequency = 0.0;  ///< Hz, of a record the one that it shakes with most
  double fraction = 0.0;   ///< of critical, of a vibration of block `block` with this frequency
  Id block = no_id;        ///< the one that is damped most: the largest and softest
};

/// Of shakings, and of loads and boundaries whose histories go up and down. A viscosity eta takes
/// pi eta f of critical at the frequency f.
std::vector<StrainDampingAt> strain_damping_at(const Simulation& sim);

std::vector<std::string> strain_damping_report(const Simulation& sim);
void add_strain_damping(Json& json, const Simulation& sim);

}  // namespace edda
