// Strain damping of the blocks at the frequencies of the loads and ground motions.
#pragma once

#include <string>
#include <vector>

#include "results/json.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Strain damping at the frequency of one ground motion, load or boundary.
struct StrainDampingAt {
  std::string of;          ///< "shaking quake"
  double frequency = 0.0;  ///< Hz; of a record, its dominant frequency
  double fraction = 0.0;   ///< fraction of critical damping of a vibration of block `block` at this
                           ///< frequency
  Id block = no_id;        ///< the block that is damped most
  std::string key{};  ///< of the damping that it has: "materials.rock.damping", or a "rayleigh"
  bool rayleigh = false;
  double lost = 0.0;    ///< part of the largest motion that it takes off waves (wave_loss.hpp), on
  double length = 0.0;  ///< a path of this length, m; 0: nothing is taken
  /// "strain damping", or what of Rayleigh damping is one.
  std::string what() const;
};

/// For ground motions, and for loads and boundaries whose histories rise and fall, each with the
/// damping of the stage in which it acts. A viscosity eta damps with the fraction pi eta f of
/// critical at the frequency f.
std::vector<StrainDampingAt> strain_damping_at(const Simulation& sim);

std::vector<std::string> strain_damping_report(const Simulation& sim);
void add_strain_damping(Json& json, const Simulation& sim);

}  // namespace edda
