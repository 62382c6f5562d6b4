#include "run/attachment_rows.hpp"

#include <algorithm>
#include <cmath>

#include "results/csv.hpp"

namespace edda {
namespace {

std::string label(const Model& model, std::size_t q) {
  const std::string& name = model.boundaries[q].name;
  return name.empty() ? std::to_string(q) : name;
}

/// Node k of a bolt of nodes [first, last): N there. It is that of the steel in a joint, none at a
/// free end, elsewhere between those of the two bars.
double axial_force(const Bolts& b, const BoltData& row, std::size_t k, std::size_t first,
                   std::size_t last) {
  if (!row.grouted) return b.bars.force[first];
  const double before = k > first ? b.bars.force[k - 1] : 0.0;
  const double after = k + 1 < last ? b.bars.force[k] : 0.0;
  if (k + 1 < last && b.crossing[k] != 0) return after;
  if (k > first && b.crossing[k - 1] != 0) return before;
  if (k == first || k + 1 == last) return 0.0;
  return 0.5 * (before + after);
}

double part(double force, double strength) {
  return force != 0.0 && strength > 0.0 ? std::abs(force) / strength : 0.0;
}

}  // namespace

std::vector<Vec2> reactions(const Simulation& sim, const Instant& at) {
  std::vector<Vec2> sum(sim.model.boundaries.size());
  const BoundarySprings& s = sim.springs;
  for (std::size_t q = 0; q < s.size(); ++q) {
    if (!is_free(sim.blocks, sim.state, sim.blocks.vertex_block[s.vertex[q]])) continue;
    sum[static_cast<std::size_t>(s.boundary[q])] += spring_force(s, q, sim.pose.x, sim.pose.y);
  }
  for (std::size_t p = 0; p < at.on_dashpots.size(); ++p) {
    sum[static_cast<std::size_t>(sim.dashpots.points[p].boundary)] += at.on_dashpots[p];
  }
  const LoadsNow now = sim.acting();
  for (const EdgeLoad& e : sim.loads.edges) {
    const auto row = static_cast<std::size_t>(e.load), loads = sim.model.loads.size();
    if (row < loads || !is_free(sim.blocks, sim.state, sim.blocks.vertex_block[e.edge])) continue;
    sum[row - loads] +=
        now.factor[row] * ((e.to - e.from) * sim.blocks.edge_length[e.edge] * e.traction +
                           e.ends.at_from + e.ends.at_to);
  }
  // What a boundary has taken over from another it bears as well.
  const auto openings = static_cast<Index>(sim.model.openings.size());
  for (const KeptForce& f : sim.kept) {
    if (f.keeper < openings || !is_free(sim.blocks, sim.state, sim.blocks.vertex_block[f.vertex])) {
      continue;
    }
    const auto row = static_cast<std::size_t>(f.keeper);
    sum[row - static_cast<std::size_t>(openings)] +=
        sim.loads.held[row].at(sim.state.time, sim.loads.gentle) * f.force;
  }
  return sum;
}

std::string reactions_header(const Model& model) {
  Csv csv;
  csv.add("time");
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    csv.add(label(model, q) + ".fx").add(label(model, q) + ".fy");
  }
  return csv.end().text();
}

std::string reactions_row(const Simulation& sim, const Instant& at) {
  Csv csv;
  csv.add(sim.state.time);
  for (const Vec2 f : reactions(sim, at)) csv.add(f.x).add(f.y);
  return csv.end().text();
}

std::string bolts_header() {
  Csv csv;
  csv.header({"time", "bolt", "distance", "x", "y", "axial_force", "bond_force", "dowel_force",
              "utilisation", "yielded", "ruptured"});
  return csv.text();
}

std::string bolts_rows(const Simulation& sim) {
  const Bolts& b = sim.bolts;
  Csv csv;
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    const BoltData& row = b.rows[r];
    const std::size_t first = b.begin[r], last = b.begin[r + 1];
    for (std::size_t k = first; k < last; ++k) {
      const Vec2 place = node_place(b, sim.state, k) + sim.blocks.origin;
      const double axial = axial_force(b, row, k, first, last);
      const double bond = b.bonded[k] > 0.0 ? b.bonds.force[k] / b.bonded[k] : 0.0;
      const auto near = [&](const std::vector<std::uint8_t>& flags) {
        return (k + 1 < last && flags[k] != 0) || (k > first && flags[k - 1] != 0);
      };
      const double dowel = k + 1 < last && b.dowels.stiffness[k] > 0.0    ? b.dowels.force[k]
                           : k > first && b.dowels.stiffness[k - 1] > 0.0 ? b.dowels.force[k - 1]
                                                                          : 0.0;
      const double used = std::max(
          {part(axial, row.yield), part(bond, row.bond_strength), part(dowel, row.dowel_strength)});
      csv.add(sim.state.time).add(row.name).add(b.distance[k]).add(place.x).add(place.y);
      csv.add(axial / row.share).add(bond / row.share).add(dowel / row.share).add(used);
      csv.add(int{near(b.bars.yielded)}).add(int{near(b.bars.broken)}).end();
    }
  }
  return csv.text();
}

}  // namespace edda
