#include "observe/overstress.hpp"

#include <algorithm>
#include <cmath>

namespace edda {

double utilisation(const RockStrength& strength, const BlockStress& stress) {
  const double mean = 0.5 * (stress.xx + stress.yy);
  const double round = std::hypot(0.5 * (stress.xx - stress.yy), stress.xy);
  const double least = -std::max(mean + round, stress.zz);    // sigma_3
  const double largest = -std::min(mean - round, stress.zz);  // sigma_1
  const double m = strength.ucs / strength.tension - strength.tension / strength.ucs;
  const double u = std::hypot(m * least, 2.0 * (largest - least)) - m * least;
  return 0.5 * u / strength.ucs;
}

double overstress(const Simulation& sim, const State& state, std::size_t i) {
  const Index m = sim.scene->blocks.material[i];
  if (m == none) return 0.0;
  const auto& strength = sim.scene->model.materials[static_cast<std::size_t>(m)].strength;
  return strength ? utilisation(*strength, block_stress(sim, state, i)) : 0.0;
}

}  // namespace edda
