#include "cutting/strata_bound.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cutting/joint_draws.hpp"

namespace edda {
namespace {

/// The rock between two beds.
struct Layer {
  double number = 0.0;
  Stretch offsets;  ///< of the beds below and above it, in the sense of their normal; m
};

/// All layers in which the domain has a part; the outermost have no end.
bool layers_of(const LineWork& work, const DrawnSet& beds, double limit,
               std::vector<Layer>& layers) {
  constexpr double infinite = std::numeric_limits<double>::infinity();
  const double zero = dot(beds.point, beds.normal);
  const Stretch across = extent_of(work, {}, beds.normal);
  std::vector<SetJoint> joints;
  const Stretch offsets{across.first - zero - beds.set.spacing,
                        across.second - zero + beds.set.spacing};
  if (!joints_between(beds, offsets, limit, joints)) return false;
  if (joints.empty()) return true;
  std::sort(joints.begin(), joints.end(),
            [](const SetJoint& a, const SetJoint& b) { return a.number < b.number; });
  layers.push_back({joints.front().number - 1.0, {-infinite, joints.front().offset}});
  for (std::size_t i = 0; i < joints.size(); ++i) {
    const double above = i + 1 < joints.size() ? joints[i + 1].offset : infinite;
    layers.push_back({joints[i].number, {joints[i].offset, above}});
  }
  return true;
}

/// The interval of the line through `base` along `direction` in a layer.
Stretch part_in(const Layer& layer, const DrawnSet& beds, Vec2 base, Vec2 direction) {
  const double at = dot(base - beds.point, beds.normal), rise = dot(direction, beds.normal);
  const double a = (layer.offsets.first - at) / rise, b = (layer.offsets.second - at) / rise;
  return {std::min(a, b), std::max(a, b)};
}

/// The set as it is in one layer: elsewhere along the beds, and with random numbers of its own.
DrawnSet in_layer(const DrawnSet& d, const DrawnSet& beds, const Layer& layer) {
  DrawnSet here = d;
  here.point += layer.number * d.set.stagger.value_or(0.0) * beds.direction;
  if (d.regular()) return here;
  here.key = with_number(mixed(d.key, "layer"), layer.number);
  Random random(mixed(here.key, "phase"));
  if (d.spacing_deviation > 0.0) here.point += random.uniform() * d.set.spacing * d.normal;
  return here;
}

bool add_layer(LineWork& work, const DrawnSet& d, const DrawnSet& beds, const Layer& layer,
               Index source, double snap, double limit) {
  const double zero = dot(d.point, d.normal);
  const Stretch across = extent_of(work, d.region, d.normal);
  const double reach = 2.0 * size_of(work.outline) * std::sin(d.largest_turn) + snap;
  std::vector<SetJoint> joints;
  if (!joints_between(d, {across.first - reach - zero, across.second + reach - zero}, limit,
                      joints)) {
    return false;
  }
  constexpr double parallel = 1e-3;
  for (const SetJoint joint : joints) {
    const Vec2 base = d.point + joint.offset * d.normal;
    const Stretch straight = part_in(layer, beds, base, d.direction);
    const double middle = 0.5 * (straight.first + straight.second);
    Random random(mixed(with_number(d.key, joint.number), "angle"));
    const double turn = d.set.deviation.angle == 0.0 ? 0.0 : turn_of(d, random);
    const Vec2 at = std::isfinite(middle) ? base + middle * d.direction : base;
    const Vec2 direction = turn == 0.0 ? d.direction : rotated(d.direction, turn);
    if (std::abs(dot(direction, beds.normal)) < parallel) continue;
    add_part(work, d, source, at, part_in(layer, beds, at, direction), turn, snap);
    if (static_cast<double>(work.lines.size()) > limit) return false;
  }
  return true;
}

}  // namespace

bool add_strata_bound(LineWork& work, const JointSet& set, const JointSet& beds, Index source,
                      Vec2 origin, double snap, double limit) {
  const DrawnSet d = drawn_set(set, origin), bedding = drawn_set(beds, origin);
  const double most = static_cast<double>(work.lines.size()) + limit;
  std::vector<Layer> layers;
  if (!layers_of(work, bedding, limit, layers)) return false;
  return std::all_of(layers.begin(), layers.end(), [&](const Layer& layer) {
    return add_layer(work, in_layer(d, bedding, layer), bedding, layer, source, snap, most);
  });
}

}  // namespace edda
