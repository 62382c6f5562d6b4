#include "step/touching.hpp"

#include "step/contact_pairs.hpp"
#include "step/simulation.hpp"

namespace edda {

std::vector<std::uint8_t> touching(const Simulation& sim) {
  std::vector<std::uint8_t> touches(sim.scene->blocks.size(), 0);
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    for (Id q = sim.attached.springs.block_begin[i]; q < sim.attached.springs.block_begin[i + 1];
         ++q) {
      if (sim.attached.springs.kxx[q] + sim.attached.springs.kyy[q] > 0.0) touches[i] = 1;
    }
  }
  const Bolts& bolts = sim.attached.bolts;
  for (std::size_t r = 0; r < bolts.rows.size(); ++r) {
    if (!bolts.rows[r].grouted && bolts.bars.broken[bolts.begin[r]] != 0) continue;
    for (Id k = bolts.begin[r]; k < bolts.begin[r + 1]; ++k) touches[bolts.host[k]] = 1;
  }
  for (const auto& [i, j] : blocks_in_contact(sim, Nearness::closed)) touches[i] = touches[j] = 1;
  return touches;
}

}  // namespace edda
