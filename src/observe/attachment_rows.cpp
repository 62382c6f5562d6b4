#include "observe/attachment_rows.hpp"

#include <algorithm>
#include <cmath>

#include "blocks/build_blocks.hpp"
#include "observe/bolt_nodes.hpp"
#include "results/csv.hpp"

namespace edda {

std::vector<Vec2> reactions(const Simulation& sim, const Instant& at) {
  std::vector<Vec2> sum(sim.scene->model.boundaries.size());
  const BoundarySprings& s = sim.attached.springs;
  for (std::size_t q = 0; q < s.size(); ++q) {
    if (!is_free(sim.scene->blocks, sim.motion.state, sim.scene->blocks.vertex_block[s.vertex[q]]))
      continue;
    sum[static_cast<std::size_t>(s.boundary[q])] +=
        spring_force(s, q, sim.motion.pose.x, sim.motion.pose.y);
  }
  for (std::size_t p = 0; p < at.on_dashpots.size(); ++p) {
    sum[static_cast<std::size_t>(sim.attached.dashpots.points[p].boundary)] += at.on_dashpots[p];
  }
  const LoadsNow now = acting(sim);
  for (const EdgeLoad& e : sim.attached.loads.edges) {
    const auto row = static_cast<std::size_t>(e.load), loads = sim.scene->model.loads.size();
    if (row < loads ||
        !is_free(sim.scene->blocks, sim.motion.state, sim.scene->blocks.vertex_block[e.edge]))
      continue;
    sum[row - loads] +=
        now.factor[row] * ((e.to - e.from) * sim.scene->blocks.edge_length[e.edge] * e.traction +
                           e.ends.at_from + e.ends.at_to);
  }
  // The forces that a boundary has taken over from another are part of its reaction.
  const Owners owners(sim.scene->model);
  for (const WallForce& f : sim.attached.wall_forces) {
    if (f.owner < owners.of_boundary(0) || f.owner >= owners.of_fill(0) ||
        !is_free(sim.scene->blocks, sim.motion.state, sim.scene->blocks.vertex_block[f.vertex])) {
      continue;
    }
    const auto row = static_cast<std::size_t>(f.owner);
    sum[row - static_cast<std::size_t>(owners.of_boundary(0))] +=
        sim.attached.loads.remaining[row].at(sim.motion.state.time, sim.attached.loads.gradual) *
        f.force;
  }
  return sum;
}

std::vector<std::string> boundary_names(const Model& model) {
  std::vector<std::string> names;
  for (const Boundary& boundary : model.boundaries)
    names.push_back(boundary.name.empty() ? std::to_string(names.size()) : boundary.name);
  return names;
}

std::string reactions_row(const Simulation& sim, const Instant& at) {
  Csv csv;
  csv.add(sim.motion.state.time);
  for (const Vec2 f : reactions(sim, at)) csv.add(f.x).add(f.y);
  return csv.end().text();
}

std::string bolts_rows(const Simulation& sim) {
  const Bolts& b = sim.attached.bolts;
  Csv csv;
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    for (std::size_t k = b.begin[r]; k < b.begin[r + 1]; ++k) {
      const BoltNode node = bolt_node(sim, r, k);
      csv.add(sim.motion.state.time).add(b.rows[r].name).add(b.distance[k]);
      csv.add(node.place.x).add(node.place.y);
      csv.add(node.axial).add(node.bond).add(node.dowel).add(node.utilisation);
      csv.add(int{node.yielded}).add(int{node.ruptured});
      csv.add(node.dowel_utilisation).add(node.angle).end();
    }
  }
  return csv.text();
}

namespace {

/// Moment of a section at the end of piece p of block i: the mean of the pieces on both sides. The
/// shear at the wall acts at half the thickness from the middle, and its couples at the sections
/// let the moment jump there.
double moment_at(const Simulation& sim, std::size_t i, std::uint32_t p, std::size_t end) {
  const ZoneModel& model = sim.scene->zones;
  const auto of = [&](std::uint32_t pair, std::size_t at) {
    return sim.motion.zones.piece[model.piece_of_pair[pair]].forces.moment[at];
  };
  const std::uint32_t first = model.pair_begin[i], last = model.pair_begin[i + 1] - 1;
  const bool at_edge = p == (end == 0 ? first : last);
  if (at_edge && !sections_of(sim.scene->blocks, i).closed) return of(p, end);
  const std::uint32_t beside = at_edge ? (end == 0 ? last : first) : end == 0 ? p - 1 : p + 1;
  return 0.5 * (of(p, end) + of(beside, 1 - end));
}

}  // namespace

std::string linings_rows(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const ZoneModel& model = sim.scene->zones;
  const Zones& zones = sim.motion.zones;
  Csv csv;
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!b.is_lining(i) || sim.motion.state.alive[i] == 0) continue;
    const std::string_view name = b.name(i);
    const std::string lining = name.empty() ? std::to_string(b.lining[i]) : std::string(name);
    const auto of = static_cast<std::size_t>(b.material[i]);
    const std::string& material = sim.scene->model.materials[of].name;
    double distance = 0.0;
    for (std::uint32_t p = model.pair_begin[i]; p < model.pair_begin[i + 1]; ++p) {
      const std::uint32_t q = model.piece_of_pair[p];
      const LiningPiece& piece = model.piece[q];
      const BeamState& state = zones.piece[q];
      const BeamCorners x = corners_of_piece(b, model, sim.motion.state, p);
      for (const std::size_t end : {0u, 1u}) {
        const Vec2 at = b.origin + 0.5 * (end == 0 ? x[0] + x[3] : x[1] + x[2]);
        if (end == 1) distance += state.length;
        csv.add(sim.motion.state.time).add(lining).add(int(p - model.pair_begin[i]));
        csv.add(distance).add(at.x).add(at.y);
        const double moment = moment_at(sim, i, p, end);
        csv.add(0.0 - state.forces.axial).add(moment);
        csv.add(state.forces.shear(state.length));
        csv.add(utilisation(
            strength_at(state, end, model.strength[piece.strength], model.residual[piece.strength]),
            state.forces.axial, moment));
        csv.add(state.hinge[end]).add(material).add(state.yielded[end]).end();
      }
    }
  }
  return csv.text();
}

std::string flow_rows(const Simulation& sim) {
  const std::vector<Water>& waters = sim.scene->model.waters;
  const std::vector<double>& inflow = sim.attached.joint_water.inflow;
  Csv csv;
  for (std::size_t q = 0; q < inflow.size(); ++q) {
    const std::string name = q == waters.size()       ? "open"
                             : waters[q].name.empty() ? std::to_string(q)
                                                      : waters[q].name;
    csv.add(sim.motion.state.time).add(name).add(inflow[q]).end();
  }
  return csv.text();
}

}  // namespace edda
