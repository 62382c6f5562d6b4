#include "observe/bolt_summary.hpp"

#include <algorithm>
#include <cmath>

#include "observe/bolt_nodes.hpp"
#include "results/csv.hpp"

namespace edda {
namespace {

void keep_larger(double& most, double value) {
  if (std::abs(value) > std::abs(most)) most = value;
}

}  // namespace

void raise_peaks(const Simulation& sim, std::vector<BoltPeak>& peaks) {
  const Bolts& b = sim.attached.bolts;
  peaks.resize(b.rows.size());
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    for (std::size_t k = b.begin[r]; k < b.begin[r + 1]; ++k) {
      const BoltNode node = bolt_node(sim, r, k);
      if (std::abs(node.axial) > std::abs(peaks[r].force))
        peaks[r] = {node.axial, sim.motion.state.time, b.distance[k], node.place, peaks[r].dowel};
      keep_larger(peaks[r].dowel, node.dowel);
    }
  }
}

std::string bolt_summary_rows(const Simulation& sim, const std::vector<BoltPeak>& peaks) {
  const Bolts& b = sim.attached.bolts;
  Csv csv;
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    const BoltPeak peak = r < peaks.size() ? peaks[r] : BoltPeak{};
    double axial = 0.0, bond = 0.0, dowel = 0.0, used = 0.0, dowel_used = 0.0;
    bool slipped = false, yielded = false, ruptured = false;
    for (std::size_t k = b.begin[r]; k < b.begin[r + 1]; ++k) {
      const BoltNode node = bolt_node(sim, r, k);
      keep_larger(axial, node.axial);
      keep_larger(bond, node.bond);
      keep_larger(dowel, node.dowel);
      used = std::max(used, node.utilisation);
      dowel_used = std::max(dowel_used, node.dowel_utilisation);
      slipped = slipped || b.bonds.yielded[k] != 0;
      yielded = yielded || node.yielded;
      ruptured = ruptured || node.ruptured;
    }
    csv.add(b.rows[r].name).add(peak.force).add(peak.time).add(peak.distance);
    csv.add(peak.place.x).add(peak.place.y).add(axial).add(bond).add(dowel).add(used);
    csv.add(int{slipped}).add(int{yielded}).add(int{ruptured});
    csv.add(peak.dowel).add(dowel_used).end();
  }
  return csv.text();
}

}  // namespace edda
