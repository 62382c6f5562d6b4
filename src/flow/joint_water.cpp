#include "flow/joint_water.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <span>

namespace edda {
namespace {

using Kind = NodeCondition::Kind;

/// Level of the water on a part of an edge at its coordinate s, m.
double level_at(const WetEdge& e, double s) {
  return e.level_from + (e.level_to - e.level_from) / (e.to - e.from) * (s - e.from);
}

template <class OfFace>
auto key_of(const OfFace& row) {
  return std::pair(row.edge, row.facing);
}

class Flow {
 public:
  Flow(JointWater& joints, const FlowScene& scene, const LoadsNow& now)
      : joints_(joints), s_(scene), now_(now), thickness_(scene.model.thickness) {
    gamma_ = scene.model.waters.front().unit_weight;
    net_ = flow_network(scene, joints.ground);
    water_.assign(net_.nodes.size(), {});
    for (Id v = 0; v < net_.node_of.size(); ++v) {
      const Id n = net_.node_of[v];
      if (n == no_id) continue;
      water_[n].pressure = std::max(water_[n].pressure, joints.pressure[v]);
      water_[n].filled = std::max(water_[n].filled, joints.filled[v]);
    }
    give_conditions();
    for (std::size_t n = net_.with_corners; n < net_.nodes.size(); ++n) {
      if (given_[n].kind == Kind::pressure) water_[n] = {given_[n].pressure, 1.0};
    }
  }

  std::vector<WaterContent> contents() const {
    std::vector<WaterContent> found;
    for (const FlowPipe& pipe : net_.pipes) {
      found.push_back({s_.faces.edge[pipe.face], s_.faces.facing[pipe.face], pipe.part_from,
                       pipe.part_to, content_at(pipe, 0), content_at(pipe, 1),
                       pipe.aperture[0].value(), pipe.aperture[1].value()});
    }
    std::stable_sort(found.begin(), found.end(),
                     [](const auto& c, const auto& d) { return key_of(c) < key_of(d); });
    return found;
  }

  std::vector<CornerForce> solve_in_step(const WaterInStep& step) {
    const std::vector<NodeForce> forces = node_forces(net_, s_);
    Storage storage;
    storage.passed = step.passed;
    storage.bulk_modulus = s_.model.flow->bulk_modulus;
    storage.gives = gives_of(forces, end_openings(net_, s_), s_, step.masses, step.seconds_squared);
    for (const NodeWater& w : water_) storage.acting.push_back(w.pressure);
    take_beginning(storage);
    solve(&storage);
    std::vector<CornerForce> more;
    for (const NodeForce& f : forces) {
      const double rise = water_[f.node].pressure - storage.acting[f.node];
      more.push_back({f.block, f.corner, rise * f.force});
    }
    return more;
  }

  void solve(const Storage* storage = nullptr) {
    timed_ = storage != nullptr;
    if (!solve_seepage(net_, given_, gamma_, water_, storage)) ++joints_.not_found;
    joints_.heads.assign(s_.model.waters.size(), 0);
    for (const HeadNode& head : net_.heads) ++joints_.heads[static_cast<std::size_t>(head.water)];
    for (Id v = 0; v < net_.node_of.size(); ++v) {
      const Id n = net_.node_of[v];
      joints_.pressure[v] = n == no_id ? 0.0 : water_[n].pressure;
      joints_.filled[v] = n == no_id ? 0.0 : water_[n].filled;
    }
  }

  void report() {
    joints_.rows.clear();
    joints_.inflow.assign(s_.model.waters.size() + 1, 0.0);
    std::vector<double> out_of(net_.nodes.size(), 0.0);  // into joints
    for (const FlowPipe& pipe : net_.pipes) {
      const double q = discharge_of(net_, pipe, gamma_, water_);
      out_of[pipe.from] += q;
      out_of[pipe.to] -= q;
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
    note_inflow(out_of);
  }

  /// Water on the walls of the joints, and outside them.
  std::vector<WetEdge> wet_edges() const {
    std::vector<WetEdge> wet = joints_.before;
    const auto flow_row = static_cast<Index>(s_.model.waters.size());
    for (const CoveredPart& part : net_.covered) {
      if (!is_free(s_.blocks, s_.state, s_.blocks.vertex_block[part.edge])) continue;
      const FlowPipe& pipe = net_.pipes[part.pipe];
      PipeLevels levels = linear(levels_of(net_, pipe, gamma_, water_), pipe);
      if (part.from_node != pipe.from) std::swap(levels.from, levels.to);
      wet.push_back({part.edge, part.from, part.to, levels.from, levels.to, flow_row});
    }
    for (const OpenPart& open : net_.open) {
      if (open.void_node != no_id) {
        const double level =
            net_.nodes[open.void_node].place.y + water_[open.void_node].pressure / gamma_;
        wet.push_back({open.edge, open.from, open.to, level, level, flow_row});
      }
      if (!open.wet) continue;
      for (const WetEdge& e : outside(open.edge)) {
        const double from = std::max(e.from, open.from), to = std::min(e.to, open.to);
        if (!(to > from)) continue;
        wet.push_back({e.edge, from, to, level_at(e, from), level_at(e, to), e.water});
      }
    }
    return wet;
  }

 private:
  /// Linear levels with the same force and moment as the water along the pipe.
  static PipeLevels linear(PipeLevels levels, const FlowPipe& pipe) {
    const double drop = levels.to - levels.from;
    return {levels.from + drop * (4.0 * pipe.of_to.a - 2.0 * pipe.of_to.b),
            levels.from + drop * (4.0 * pipe.of_to.b - 2.0 * pipe.of_to.a)};
  }
  /// What the nodes contained when the time began, and the apertures. A joint that was none then
  /// has what it has.
  void take_beginning(Storage& storage) const {
    std::vector<double>& content = storage.content;
    content.assign(net_.nodes.size(), 0.0);
    for (const FlowPipe& pipe : net_.pipes) {
      double from = pipe.aperture[0].value(), to = pipe.aperture[1].value();
      const std::pair key(s_.faces.edge[pipe.face], s_.faces.facing[pipe.face]);
      const auto before = [](const WaterContent& c, const auto& k) { return key_of(c) < k; };
      auto at = std::lower_bound(joints_.contents.begin(), joints_.contents.end(), key, before);
      const bool known = at != joints_.contents.end() && key_of(*at) == key;
      for (; at != joints_.contents.end() && key_of(*at) == key; ++at) {
        const double middle = 0.5 * (pipe.part_from + pipe.part_to);
        content[pipe.from] += share_of(*at, pipe.part_from, middle);
        content[pipe.to] += share_of(*at, middle, pipe.part_to);
        from = aperture_at(*at, pipe.part_from).value_or(from);
        to = aperture_at(*at, pipe.part_to).value_or(to);
      }
      storage.before.insert(storage.before.end(), {from, to});
      if (known) continue;
      content[pipe.from] += content_at(pipe, 0);
      content[pipe.to] += content_at(pipe, 1);
    }
  }
  static std::optional<double> aperture_at(const WaterContent& c, double part) {
    if (part < c.part_from || part > c.part_to) return {};
    const double t = (part - c.part_from) / (c.part_to - c.part_from);
    return (1.0 - t) * c.aperture_from + t * c.aperture_to;
  }
  /// Of the node at this end, what it has in the pipe.
  double content_at(const FlowPipe& pipe, std::size_t end) const {
    return volume_at(pipe, pipe.aperture[end].value(), pipe.aperture[1 - end].value()) *
           water_[end == 0 ? pipe.from : pipe.to].content(s_.model.flow->bulk_modulus);
  }
  /// Of what a pipe contained, the share of its first node in its first half and that of the other
  /// one in the second, what is in the half from `from` to `to` of a pipe of the same face.
  static double share_of(const WaterContent& c, double from, double to) {
    const double middle = 0.5 * (c.part_from + c.part_to);
    const auto common = [&](double begin, double end) {
      return std::max(0.0, std::min(to, end) - std::max(from, begin)) / (end - begin);
    };
    return c.from * common(c.part_from, middle) + c.to * common(middle, c.part_to);
  }

  /// The highest head of lines in the rock and of what lies open beside a node.
  void give_conditions() {
    given_.assign(net_.nodes.size(), {});
    for (const Outcrop& outcrop : net_.outcrops) {
      NodeCondition& given = given_[outcrop.node];
      if (given.kind == Kind::inside) given.kind = Kind::air;
      if (!outcrop.wet) continue;
      for (const WetEdge& e : outside(outcrop.edge)) {
        constexpr double rounding = 1e-9;
        if (outcrop.at < e.from - rounding || outcrop.at > e.to + rounding) continue;
        take(given, e.water, level_at(e, outcrop.at), net_.nodes[outcrop.node]);
      }
    }
    for (const HeadNode& head : net_.heads) {
      NodeCondition& given = given_[head.node];
      if (given.kind == Kind::inside) given.kind = Kind::air;
      const FlowNode& node = net_.nodes[head.node];
      const Water& water = s_.model.waters[static_cast<std::size_t>(head.water)];
      take(given, head.water, level_of(water, s_.blocks.origin, node.place.x), node);
    }
    find_injections();
    for_injections([&](Id n, Index, double rate) {
      if (n != no_id) given_[n].source += rate;
    });
    for (std::size_t q = 0; q < s_.model.waters.size(); ++q) {
      if (s_.model.waters[q].rain) let_rain(static_cast<Index>(q));
    }
  }

  /// The crossings inside the rock that are nearest, as drawn, to where waters are injected.
  void find_injections() {
    const BlockSet& b = s_.blocks;
    joints_.injected.assign(s_.model.waters.size(), no_id);
    for (std::size_t q = 0; q < joints_.injected.size(); ++q) {
      const Water& water = s_.model.waters[q];
      if (!water.injection) continue;
      double nearest = std::numeric_limits<double>::infinity();
      for (Id v = 0; v < net_.node_of.size(); ++v) {
        const Id n = net_.node_of[v];
        const double far = norm(b.vertex(v) + b.origin - *water.at);
        if (n == no_id || !(net_.nodes[n].conductance > 0.0) || given_[n].kind != Kind::inside ||
            !(far < nearest))
          continue;
        nearest = far;
        joints_.injected[q] = v;
      }
    }
  }

  /// Calls f(node or no_id, water, m2/s) for the injections that act.
  template <class F>
  void for_injections(const F& f) {
    for (std::size_t q = 0; q < joints_.injected.size(); ++q) {
      const Water& water = s_.model.waters[q];
      if (!water.injection) continue;
      const Id corner = joints_.injected[q];
      const double rate = rate_of(*water.injection, static_cast<Index>(q));
      if (rate > 0.0)
        f(corner == no_id ? no_id : net_.node_of[corner], static_cast<Index>(q), rate);
    }
  }

  /// By the history and the multiplier of the water.
  double rate_of(double given, Index water) const {
    const auto row = static_cast<std::size_t>(water);
    const Water& of = s_.model.waters[row];
    const double factor = of.history.empty() ? 1.0 : now_.rise[row];
    return given * factor * now_.weight[row] / (of.unit_weight * thickness_);
  }

  /// What falls on ground between two joints goes to both.
  void let_rain(Index water) {
    const double rate = rate_of(*s_.model.waters[static_cast<std::size_t>(water)].rain, water);
    for (const OpenPart& open : net_.open) {
      const std::array ends{open.from_node, open.to_node};
      const double parts = static_cast<double>(
          std::count_if(ends.begin(), ends.end(), [](Id n) { return n != no_id; }));
      for (const Id n : ends) {
        if (n == no_id || !(rate * open.sky > 0.0)) continue;
        NodeCondition& given = given_[n];
        if (given.kind != Kind::air && given.kind != Kind::rain) continue;
        given = {Kind::rain, 0.0, water, given.source + rate * open.sky / parts};
      }
    }
  }

  /// The node has the pressure of this water, of this level before it rises, where that is higher.
  void take(NodeCondition& given, Index water, double level, const FlowNode& node) const {
    const auto row = static_cast<std::size_t>(water);
    const double pressure = now_.weight[row] * (level + now_.rise[row] - node.place.y) / thickness_;
    if (pressure > given.pressure) given = {Kind::pressure, pressure, water};
  }

  std::span<const WetEdge> outside(Id edge) const {
    const std::vector<WetEdge>& all = joints_.ground.outside;
    const auto before = [](const WetEdge& x, Id e) { return x.edge < e; };
    const auto first = std::lower_bound(all.begin(), all.end(), edge, before);
    return {first, std::lower_bound(first, all.end(), edge + 1, before)};
  }

  /// Where rain falls on an outcrop from which water leaves, it leaves to the open air.
  void note_inflow(const std::vector<double>& out_of) {
    for (std::size_t n = 0; n < out_of.size(); ++n) {
      const NodeCondition& given = given_[n];
      if (given.kind == Kind::inside) continue;
      const bool open = given.water == none || (given.kind == Kind::rain && out_of[n] < 0.0);
      joints_.inflow[open ? joints_.inflow.size() - 1 : static_cast<std::size_t>(given.water)] +=
          out_of[n];
    }
    for_injections([&](Id n, Index water, double rate) {
      // Of steady flow none goes in where none can leave.
      const double part = n == no_id ? 0.0 : timed_ ? 1.0 : out_of[n] / given_[n].source;
      joints_.inflow[static_cast<std::size_t>(water)] += part * rate;
      if (!(part > 0.0)) ++joints_.not_taken;
    });
  }

  JointWater& joints_;
  const FlowScene& s_;
  const LoadsNow& now_;
  double thickness_, gamma_ = 0.0;
  bool timed_ = false;
  FlowNetwork net_;
  std::vector<NodeCondition> given_;
  std::vector<NodeWater> water_;
};

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

void take_contents(JointWater& joints, const FlowScene& scene, const LoadsNow& now) {
  joints.contents = Flow(joints, scene, now).contents();
}

void put_flow(JointWater& joints, const FlowScene& scene, const LoadsNow& now, Loads& loads) {
  put_water(scene.blocks, Flow(joints, scene, now).wet_edges(), loads);
}

std::vector<CornerForce> flow_in_step(JointWater& joints, const FlowScene& scene,
                                      const LoadsNow& now, const WaterInStep& step, Loads& loads) {
  Flow flow(joints, scene, now);
  std::vector<CornerForce> forces = flow.solve_in_step(step);
  flow.report();
  put_water(scene.blocks, flow.wet_edges(), loads);
  return forces;
}

void keep_water(JointWater& joints, const BlockSet& blocks, Index waters, Loads& loads) {
  joints.before.clear();
  std::vector<WetEdge> wet = std::move(loads.wet);
  std::erase_if(wet, [&](const WetEdge& e) { return e.water > waters; });
  for (WetEdge e : wet) {
    if (e.water != waters) continue;
    e.water = waters + 1;
    joints.before.push_back(e);
  }
  wet.insert(wet.begin(), joints.before.begin(), joints.before.end());
  put_water(blocks, std::move(wet), loads);
}

const FlowRow* row_of(const JointWater& joints, Id edge, Id facing) {
  const auto row =
      std::lower_bound(joints.rows.begin(), joints.rows.end(), std::pair(edge, facing),
                       [](const FlowRow& r, std::pair<Id, Id> key) { return key_of(r) < key; });
  if (row == joints.rows.end() || key_of(*row) != std::pair(edge, facing)) return nullptr;
  return &*row;
}

}  // namespace edda
