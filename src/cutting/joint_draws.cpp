#include "cutting/joint_draws.hpp"

#include <cmath>
#include <numbers>

namespace edda {
namespace {

double drawn_value(Random& random, double mean, double deviation, JointSpread spread) {
  if (deviation == 0.0) return mean;
  if (spread == JointSpread::uniform) return mean + deviation * (2.0 * random.uniform() - 1.0);
  constexpr double cut_off = 3.0;
  for (;;) {
    const double z = random.normal();
    if (std::abs(z) <= cut_off) return mean + deviation * z;
  }
}

}  // namespace

double drawn_length(Random& random, double mean, double deviation, JointSpread spread,
                    double least) {
  for (;;) {
    const double value = spread == JointSpread::exponential && deviation > 0.0
                             ? mean - deviation - deviation * portable_log(1.0 - random.uniform())
                             : drawn_value(random, mean, deviation, spread);
    if (value >= least) return value;
  }
}

std::uint64_t with_number(std::uint64_t key, double number) {
  return mixed(key, static_cast<std::uint64_t>(static_cast<std::int64_t>(number)));
}

DrawnSet drawn_set(const JointSet& set, Vec2 origin) {
  const Vec2 direction = direction_of(set.angle);
  const double widest = set.deviation.distribution == JointSpread::uniform ? 1.0 : 3.0;
  return {set,
          set.origin - origin,
          direction,
          perp(direction),
          local_ring(set.region, origin),
          set.deviation.spacing * set.apparent,
          std::min(widest * set.deviation.angle, 90.0) * std::numbers::pi / 180.0,
          mixed(mixed(mixed(0, "joint_set"), static_cast<std::uint64_t>(set.seed)), set.name)};
}

bool joints_between(const DrawnSet& d, Stretch offsets, double limit,
                    std::vector<SetJoint>& joints) {
  const double spacing = d.set.spacing;
  const double first = std::ceil(offsets.first / spacing),
               last = std::floor(offsets.second / spacing);
  if (!(last - first < limit)) return false;
  if (d.spacing_deviation == 0.0) {
    for (double k = first; k <= last; k += 1.0) joints.push_back({k, k * spacing});
    return true;
  }
  const double start = far_away * std::round(first / far_away);
  const auto walk = [&](double step, const char* side, double number, double offset) {
    Random random(mixed(with_number(d.key, start), side));
    while (step > 0.0 ? offset <= offsets.second : offset >= offsets.first) {
      if (offset >= offsets.first && offset <= offsets.second) joints.push_back({number, offset});
      if (static_cast<double>(joints.size()) > limit) return false;
      number += step;
      offset += step * drawn_length(random, spacing, d.spacing_deviation,
                                    d.set.deviation.distribution, d.least_spacing());
    }
    return true;
  };
  if (!walk(1.0, "above", start, start * spacing)) return false;
  Random below(mixed(with_number(d.key, start), "first below"));
  const double gap = drawn_length(below, spacing, d.spacing_deviation, d.set.deviation.distribution,
                                  d.least_spacing());
  return walk(-1.0, "below", start - 1.0, start * spacing - gap);
}

void add_part(LineWork& work, const DrawnSet& d, Index source, Vec2 middle, Stretch limits,
              double turn, double snap) {
  const Vec2 direction = turn == 0.0 ? d.direction : rotated(d.direction, turn);
  const double margin = margin_of(work.outline, snap);
  for (Stretch part : drawn(work.outline, d.region, middle, direction, snap, margin, limits)) {
    work.lines.push_back(
        {{middle + part.first * direction, middle + part.second * direction}, source});
  }
}

double turn_of(const DrawnSet& d, Random& random) {
  return drawn_value(random, 0.0, d.set.deviation.angle, d.set.deviation.distribution) *
         std::numbers::pi / 180.0;
}

Stretch extent_of(const LineWork& work, const Ring& region, Vec2 axis) {
  Stretch extent = extent_along(work.outline, axis);
  if (region.empty()) return extent;
  const Stretch limits = extent_along(region, axis);
  return {std::max(extent.first, limits.first), std::min(extent.second, limits.second)};
}

}  // namespace edda
