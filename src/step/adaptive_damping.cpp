// Adaptive damping at present, of the whole model and of each block (theory, section 11.1).
#include <algorithm>
#include <limits>

#include "step/simulation.hpp"

namespace edda {
namespace {

/// The largest coefficient of adaptive damping, 1/s. Blocks follow supports by a small part of
/// their weight, which damping must not take from them: at the largest velocity of a support, 1.5
/// d/T, this is the force that accelerates them, 6 d/T^2.
double most_adaptive(const Simulation& sim) {
  const double time = sim.attached.loads.gradual.time_of_supports();
  return time > 0.0 ? 4.0 / time : std::numeric_limits<double>::infinity();
}

/// At more than 1/h velocities would change sign.
double with_adaptive(const Simulation& sim, double frequency, double most) {
  const Damping& damping = sim.motion.damping;
  const double adaptive = std::min(2.0 * damping.adaptive * frequency, most);
  return std::min(damping.mass_damping() + adaptive, 1.0 / sim.motion.state.step);
}

}  // namespace

double mass_damping(const Simulation& sim) {
  if (sim.motion.damping.adaptive == 0.0) return sim.motion.damping.mass_damping();
  return with_adaptive(sim, sim.relaxation.estimate.frequency, most_adaptive(sim));
}

void mass_damping_of_blocks(const Simulation& sim, std::vector<double>& damping) {
  if (sim.motion.damping.adaptive == 0.0) {
    damping = sim.motion.masses.decay;
    return;
  }
  const double most = most_adaptive(sim);
  damping.resize(sim.scene->blocks.size());
  for (std::size_t i = 0; i < damping.size(); ++i)
    damping[i] = with_adaptive(sim, sim.relaxation.estimate.frequency_of(i), most);
}

}  // namespace edda
