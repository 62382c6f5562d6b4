#include "attachments/loads.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include "model/files/accelerogram.hpp"
#include "model/stage_names.hpp"

namespace edda {
namespace {

/// Integrals of d and of d s over a part of an edge, with d linear and zero where negative.
struct Head {
  double all = 0.0, second = 0.0;
};

Head head(double s0, double s1, double d0, double d1) {
  if (d0 <= 0.0 && d1 <= 0.0) return {};
  if (d0 < 0.0) {
    s0 += (s1 - s0) * d0 / (d0 - d1);
    d0 = 0.0;
  } else if (d1 < 0.0) {
    s1 = s0 + (s1 - s0) * d0 / (d0 - d1);
    d1 = 0.0;
  }
  const double w = s1 - s0;
  return {0.5 * w * (d0 + d1), w * (d0 * (2.0 * s0 + s1) + d1 * (s0 + 2.0 * s1)) / 6.0};
}

/// Forces of one wet piece between `from` and `to` of its edge, at the two ends of the edge.
EndForces water_of(const BlockSet& b, const LoadsNow& now, const WetEdge& e,
                   const std::vector<double>& x, const std::vector<double>& y, double from,
                   double to) {
  const double s0 = std::max(from, e.from), s1 = std::min(to, e.to);
  if (!(s1 > s0)) return {};
  const auto row = static_cast<std::size_t>(e.water);
  const Id end = b.next[e.edge];
  const Vec2 u{x[end] - x[e.edge], y[end] - y[e.edge]};
  const double slope = (e.level_to - e.level_from) / (e.to - e.from);
  const auto depth = [&](double s) {
    const double level = s == e.to ? e.level_to : e.level_from + slope * (s - e.from);
    return level + now.rise[row] - (y[e.edge] + s * u.y);
  };
  const Head h = head(s0, s1, depth(s0), depth(s1));
  if (h.all == 0.0) return {};
  const Vec2 inward = -now.weight[row] * outward_normal(u);
  return {(h.all - h.second) * inward, h.second * inward};
}

/// Unit weight times thickness, N/m2.
double weight_of(const Model& model, const Water& water) {
  return water.unit_weight * model.thickness;
}

/// The factor on a load: what its history says since it was activated, times its multiplier.
double factor_of(const TimeHistory& history, const ActiveInterval& interval,
                 const SteppedValue& slow, double time, const GradualChange& gradual) {
  const double part = interval.part(time, gradual);
  if (!(part > 0.0)) return 0.0;
  return part * slow.at(time, gradual) * history.at(time - interval.since, 1.0);
}

/// m: by the time since the water was activated, or where flow takes its time by that.
double rise_of(const Model& model, const Loads& loads, std::size_t water, double time) {
  const double since = loads.intervals.waters[water].since;
  return model.waters[water].rise.at(
      flow_takes_time(model) ? loads.slow.flow.at(time, loads.gradual) : time - since, 0.0);
}

}  // namespace

LoadsNow waters_at(const Model& model, const Loads& loads, double time) {
  LoadsNow now;
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    const Water& water = model.waters[q];
    const ActiveInterval& interval = loads.intervals.waters[q];
    const bool acts = interval.acts() && time >= interval.since;
    now.rise.push_back(acts ? rise_of(model, loads, q, time) : 0.0);
    now.weight.push_back(acts ? loads.slow.waters[q].value * weight_of(model, water) : 0.0);
  }
  return now;
}

Vec2 gravity_at(Vec2 g, const SlowLoading& slow, double time, const GradualChange& gradual) {
  const auto both = [&](const SteppedValue& there, const SteppedValue& back) {
    return there.at(time, gradual) - back.at(time, gradual);
  };
  const double angle = both(slow.tilt, slow.tilt_back) * std::numbers::pi / 180.0;
  const double kh = both(slow.kh, slow.kh_back), kv = both(slow.kv, slow.kv_back);
  const Vec2 tilted = std::cos(angle) * g + std::sin(angle) * perp(g);
  return slow.gravity.at(time, gradual) * ((1.0 - kv) * tilted + kh * perp(tilted));
}

SteppedValue* slow_value(SlowLoading& slow, Varied varied, Index target) {
  const auto row = static_cast<std::size_t>(target);
  switch (varied) {
    case Varied::tilt:
      return target == backwards ? &slow.tilt_back : &slow.tilt;
    case Varied::kh:
      return target == backwards ? &slow.kh_back : &slow.kh;
    case Varied::kv:
      return target == backwards ? &slow.kv_back : &slow.kv;
    case Varied::gravity:
      return &slow.gravity;
    case Varied::flow:
      return &slow.flow;
    case Varied::change:
      return &slow.change;
    case Varied::time:
      return &slow.time;
    case Varied::load:
      return &slow.loads[row];
    case Varied::water:
      return &slow.waters[row];
    case Varied::boundary:
      return &slow.boundaries[row];
    case Varied::strength:
    case Varied::shaking:
      break;
  }
  return nullptr;
}

ActiveInterval* interval_of(ActiveIntervals& intervals, Varied varied, Index target) {
  const auto row = static_cast<std::size_t>(target);
  if (varied == Varied::load) return &intervals.loads[row];
  if (varied == Varied::water) return &intervals.waters[row];
  if (varied == Varied::boundary) return &intervals.boundaries[row];
  return nullptr;
}

double displacement_factor(const Model& model, const Loads& loads, std::size_t row, double time) {
  const ActiveInterval& interval = loads.intervals.boundaries[row];
  if (time < interval.since || time > interval.until) return 0.0;
  return loads.slow.boundaries[row].at(time, loads.gradual.of_supports()) *
         model.boundaries[row].factor.at(time - interval.since, 1.0);
}

Vec2 frame_velocity(const Model& model, const ActiveIntervals& intervals, double time) {
  Vec2 v;
  for (std::size_t q = 0; q < model.shakings.size(); ++q) {
    if (model.shakings[q].apply != ShakingKind::inertia) continue;
    const ActiveInterval& interval = intervals.shakings[q];
    v += velocity_at(model.shakings[q], std::min(time, interval.until) - interval.since);
  }
  return v;
}

LoadsNow loads_at(const Model& model, const Loads& loads, double time) {
  LoadsNow now;
  const GradualChange& gradual = loads.gradual;
  now.to_come =
      model.gravity - gradual.of_weight() * gravity_at(model.gravity, loads.slow, time, gradual);
  for (std::size_t q = 0; q < model.shakings.size(); ++q) {
    const Shaking& shaking = model.shakings[q];
    const ActiveInterval& interval = loads.intervals.shakings[q];
    const double part = interval.part(time);
    if (shaking.apply != ShakingKind::inertia || part == 0.0) continue;
    now.frame += part * acceleration_at(shaking, time - interval.since);
  }
  for (std::size_t q = 0; q < model.waters.size(); ++q) {
    const Water& water = model.waters[q];
    const ActiveInterval& interval = loads.intervals.waters[q];
    const double part = interval.part(time, gradual);
    now.rise.push_back(part > 0.0 ? rise_of(model, loads, q, time) : 0.0);
    now.weight.push_back(part * loads.slow.waters[q].at(time, gradual) * weight_of(model, water));
  }
  if (loads.in_joints > 0.0) {
    const double part = gradual.at && loads.flow == JointFlow::steady ? gradual.part : 1.0;
    now.rise.insert(now.rise.end(), {0.0, 0.0});
    now.weight.insert(now.weight.end(), {part * loads.in_joints, (1.0 - part) * loads.in_joints});
  }
  if (loads.blocks.empty()) return now;
  now.loads = &loads;
  const auto add_factors = [&](const auto& items, const std::vector<ActiveInterval>& intervals,
                               const std::vector<SteppedValue>& slow) {
    for (std::size_t q = 0; q < items.size(); ++q)
      now.factor.push_back(factor_of(items[q].factor, intervals[q], slow[q], time, gradual));
  };
  add_factors(model.loads, loads.intervals.loads, loads.slow.loads);
  add_factors(model.boundaries, loads.intervals.boundaries, loads.slow.boundaries);
  for (const SteppedValue& fraction : loads.remaining)
    now.factor.push_back(fraction.at(time, gradual));
  return now;
}

void add_loads(BlockForces& on, const LoadsNow& now, const std::vector<double>& x,
               const std::vector<double>& y) {
  const BlockSet& b = on.blocks;
  const Loads& l = *now.loads;
  if (l.place[on.block] == no_id) return;
  const Loads::Range& r = l.range[l.place[on.block]];
  for (Id q = r.point_begin; q < r.point_end; ++q) {
    const PointLoad& p = l.points[q];
    const double factor = now.factor[static_cast<std::size_t>(p.load)];
    push(on, p.at, p.force, factor);
  }
  for (Id q = r.edge_begin; q < r.edge_end; ++q) {
    const EdgeLoad& e = l.edges[q];
    const Id end = b.next[e.edge];
    const Vec2 u{x[end] - x[e.edge], y[end] - y[e.edge]};
    const double part = now.factor[static_cast<std::size_t>(e.load)] * (e.to - e.from);
    const double middle = 0.5 * (e.from + e.to);
    const Vec2 whole = part * (b.edge_length[e.edge] * e.traction - e.pressure * outward_normal(u));
    const double factor = now.factor[static_cast<std::size_t>(e.load)];
    const EndForces ends = on_vertices(e.from, e.to, e.ends);
    on.at_corner(e.edge, (1.0 - middle) * whole + factor * ends.at_from);
    on.at_corner(end, middle * whole + factor * ends.at_to);
  }
  for (Id q = r.wet_begin; q < r.wet_end; ++q) {
    const EndForces of = water_of(b, now, l.wet[q], x, y, 0.0, 1.0);
    if (of.at_from == Vec2{} && of.at_to == Vec2{}) continue;
    on.at_corner(l.wet[q].edge, of.at_from);
    on.at_corner(b.next[l.wet[q].edge], of.at_to);
  }
}

EndForces water_on(const BlockSet& b, const LoadsNow& now, const std::vector<double>& x,
                   const std::vector<double>& y, Id edge, double from, double to) {
  EndForces whole;
  const Id i = b.vertex_block[edge];
  if (now.loads == nullptr || now.loads->place[i] == no_id || !(to > from)) return whole;
  const Loads::Range& r = now.loads->range[now.loads->place[i]];
  for (Id q = r.wet_begin; q < r.wet_end; ++q) {
    if (now.loads->wet[q].edge != edge) continue;
    const EndForces on = water_of(b, now, now.loads->wet[q], x, y, from, to);
    whole.at_from += on.at_from;
    whole.at_to += on.at_to;
  }
  const Vec2 sum = whole.at_from + whole.at_to;
  const Vec2 at_to = (1.0 / (to - from)) * (whole.at_to - from * sum);
  return {sum - at_to, at_to};
}

Vec2 load_on(const BlockSet& b, const LoadsNow& now, const Pose& pose, std::size_t i) {
  if (now.loads == nullptr) return {};
  BlockForces f{b, i};
  add_loads(f, now, pose.x, pose.y);
  constexpr double rounding = 1e-12;
  double sum = 0.0;
  for (const Vec2 of_node : f.sum.nodes) sum += norm(of_node);
  const Vec2 all = resultant(f.sum.nodes);
  return norm(all) > rounding * sum ? all : Vec2{};  // loads that balance leave their rounding
}

}  // namespace edda
