#include "flow/joint_water.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>

namespace edda {
namespace {

using Kind = NodeCondition::Kind;

class Flow {
 public:
  Flow(JointWater& joints, const FlowScene& scene, const LoadsNow& now)
      : joints_(joints), s_(scene), now_(now), thickness_(scene.model.thickness) {
    gamma_ = scene.model.waters.front().unit_weight;
    std::vector<std::uint8_t> acts;
    for (std::size_t q = 0; q < scene.model.waters.size(); ++q)
      acts.push_back(now.weight[q] > 0.0 ? 1 : 0);
    net_ = flow_network(scene, joints.ground, acts);
  }

  void solve() {
    for (const FlowNode& node : net_.nodes) given_.push_back(condition_of(node));
    water_.assign(net_.nodes.size(), {});
    for (Id v = 0; v < net_.node_of.size(); ++v) {
      const Id n = net_.node_of[v];
      if (n == no_id) continue;
      water_[n].pressure = std::max(water_[n].pressure, joints_.pressure[v]);
      water_[n].filled = std::max(water_[n].filled, joints_.filled[v]);
    }
    joints_.found = solve_seepage(net_, given_, gamma_, nullptr, water_);
    for (Id v = 0; v < net_.node_of.size(); ++v) {
      const Id n = net_.node_of[v];
      joints_.pressure[v] = n == no_id ? 0.0 : water_[n].pressure;
      joints_.filled[v] = n == no_id ? 0.0 : water_[n].filled;
    }
  }

  void report() {
    joints_.rows.clear();
    joints_.inflow.assign(s_.model.waters.size() + 1, 0.0);
    for (const FlowPipe& pipe : net_.pipes) {
      const double q = discharge_of(net_, pipe, gamma_, water_);
      note_inflow(pipe.from, q);
      note_inflow(pipe.to, -q);
      const double through = q * (pipe.part_to - pipe.part_from);
      const PipeLevels levels = levels_of(net_, pipe, gamma_, water_);
      const auto pressure = [&](Id node, double level) {
        return std::max(0.0, gamma_ * (level - net_.nodes[node].place.y));
      };
      const double aperture =
          std::cbrt(12.0 * s_.model.flow->viscosity * pipe.length * pipe.conductance);
      const FlowRow row{
          s_.faces.edge[pipe.face],         s_.faces.facing[pipe.face],  aperture, through,
          pressure(pipe.from, levels.from), pressure(pipe.to, levels.to)};
      const bool more = !joints_.rows.empty() && joints_.rows.back().edge == row.edge &&
                        joints_.rows.back().facing == row.facing;
      if (!more) {
        joints_.rows.push_back(row);
        continue;
      }
      joints_.rows.back().discharge += through;
      joints_.rows.back().pressure_b = row.pressure_b;
    }
  }

  /// Water on the walls of the joints, and outside them.
  std::vector<WetEdge> wet_edges() const {
    std::vector<WetEdge> wet = joints_.before;
    const auto flow_row = static_cast<Index>(s_.model.waters.size());
    for (const CoveredPart& part : net_.covered) {
      if (part.pipe == no_id || !is_free(s_.blocks, s_.state, s_.blocks.vertex_block[part.edge]))
        continue;
      const FlowPipe& pipe = net_.pipes[part.pipe];
      PipeLevels levels = levels_of(net_, pipe, gamma_, water_);
      if (part.from_node != pipe.from) std::swap(levels.from, levels.to);
      wet.push_back({part.edge, part.from, part.to, levels.from, levels.to, flow_row});
    }
    auto first = joints_.ground.outside.begin();
    for (const OpenPart& open : net_.open) {
      while (first != joints_.ground.outside.end() && first->edge < open.edge) ++first;
      for (auto e = first; e != joints_.ground.outside.end() && e->edge == open.edge; ++e) {
        const double from = std::max(e->from, open.from), to = std::min(e->to, open.to);
        if (!(to > from)) continue;
        const double slope = (e->level_to - e->level_from) / (e->to - e->from);
        wet.push_back({e->edge, from, to, e->level_from + slope * (from - e->from),
                       e->level_from + slope * (to - e->from), e->water});
      }
    }
    return wet;
  }

 private:
  NodeCondition condition_of(const FlowNode& node) const {
    double pressure = 0.0;
    Index water = node.water;
    if (water != none) {
      const auto row = static_cast<std::size_t>(water);
      const double level = level_of(s_.model.waters[row], s_.blocks.origin, node.place.x);
      pressure = now_.weight[row] * (level + now_.rise[row] - node.place.y) / thickness_;
    } else if (node.edge != no_id) {
      std::tie(pressure, water) = pressure_outside(node);
    } else {
      return {};
    }
    if (pressure > 0.0) return {Kind::pressure, pressure, water};
    return {Kind::air, 0.0, none};
  }

  /// Of the open water beside a node, and the row of it that presses most.
  std::pair<double, Index> pressure_outside(const FlowNode& node) const {
    const std::vector<WetEdge>& outside = joints_.ground.outside;
    double sum = 0.0, most = 0.0;
    Index water = none;
    constexpr double rounding = 1e-9;
    auto e = std::lower_bound(outside.begin(), outside.end(), node.edge,
                              [](const WetEdge& x, Id edge) { return x.edge < edge; });
    std::vector<Index> counted;
    for (; e != outside.end() && e->edge == node.edge; ++e) {
      if (node.at < e->from - rounding || node.at > e->to + rounding) continue;
      if (std::find(counted.begin(), counted.end(), e->water) != counted.end()) continue;
      counted.push_back(e->water);
      const auto row = static_cast<std::size_t>(e->water);
      const double slope = (e->level_to - e->level_from) / (e->to - e->from);
      const double level = e->level_from + slope * (node.at - e->from) + now_.rise[row];
      const double p = std::max(0.0, now_.weight[row] * (level - node.place.y) / thickness_);
      sum += p;
      if (p > most) {
        most = p;
        water = e->water;
      }
    }
    return {sum, water};
  }

  void note_inflow(Id node, double out_of_it) {
    const NodeCondition& given = given_[node];
    if (given.kind == Kind::inside) return;
    const std::size_t row =
        given.water == none ? joints_.inflow.size() - 1 : static_cast<std::size_t>(given.water);
    joints_.inflow[row] += out_of_it;
  }

  JointWater& joints_;
  const FlowScene& s_;
  const LoadsNow& now_;
  double thickness_, gamma_ = 0.0;
  FlowNetwork net_;
  std::vector<NodeCondition> given_;
  std::vector<NodeWater> water_;
};

auto key_of(const FlowRow& row) {
  return std::pair(row.edge, row.facing);
}

}  // namespace

void flow_through(JointWater& joints, const FlowScene& scene, const LoadsNow& now, Loads& loads) {
  const std::size_t corners = scene.blocks.vertex_count();
  joints.pressure.resize(corners, 0.0);
  joints.filled.resize(corners, 0.0);
  Flow flow(joints, scene, now);
  flow.solve();
  flow.report();
  put_water(scene.blocks, flow.wet_edges(), loads);
}

void keep_water(JointWater& joints, const Loads& loads, Index waters) {
  joints.before.clear();
  for (WetEdge e : loads.wet) {
    if (e.water != waters) continue;
    e.water = waters + 1;
    joints.before.push_back(e);
  }
}

const FlowRow* row_of(const JointWater& joints, Id edge, Id facing) {
  const auto row =
      std::lower_bound(joints.rows.begin(), joints.rows.end(), std::pair(edge, facing),
                       [](const FlowRow& r, std::pair<Id, Id> key) { return key_of(r) < key; });
  if (row == joints.rows.end() || key_of(*row) != std::pair(edge, facing)) return nullptr;
  return &*row;
}

}  // namespace edda
