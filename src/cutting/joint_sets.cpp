// Notation: joint k of a set runs along `direction` at offset[k] from the set's origin, in the
// sense of `normal`; t is the distance along it from the projection of the origin. Its traces
// follow each other: trace, gap, trace, ..., so that the gap between them is as given.
#include "cutting/joint_sets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include "base/random.hpp"
#include "base/rings.hpp"

namespace edda {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// Random draws start at a multiple of this number of steps (spacings or traces) from the origin,
/// the one nearest to the domain.
constexpr double far_away = 1000.0;

double drawn_value(Random& random, double mean, double deviation, JointSpread spread) {
  if (deviation == 0.0) return mean;
  if (spread == JointSpread::uniform) return mean + deviation * (2.0 * random.uniform() - 1.0);
  constexpr double cut_off = 3.0;
  for (;;) {
    const double z = random.normal();
    if (std::abs(z) <= cut_off) return mean + deviation * z;
  }
}

/// As above, for values that must not fall below `least`: drawn again where they do.
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

/// A set on its section, relative to the local origin.
struct Drawn {
  const JointSet& set;
  Vec2 point, direction, normal;
  Ring region;
  double spacing_deviation;
  double largest_turn;  ///< radians, largest deviation of a trace from the mean direction
  std::uint64_t key;

  double least_spacing() const { return 1e-3 * set.spacing; }
};

Drawn drawn_set(const JointSet& set, Vec2 origin) {
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

struct Joint {
  double number = 0.0;
  double offset = 0.0;  ///< m
};

/// The joints between two offsets, if no more than `limit`.
bool joints_between(const Drawn& d, Stretch offsets, double limit, std::vector<Joint>& joints) {
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

/// Adds the part inside the domain of one trace or of a persistent joint.
void add_part(LineWork& work, const Drawn& d, Index source, Vec2 middle, Stretch limits,
              double turn, double snap) {
  const Vec2 direction = turn == 0.0 ? d.direction : rotated(d.direction, turn);
  const double margin = margin_of(work.outline, snap);
  for (Stretch part : drawn(work.outline, d.region, middle, direction, snap, margin, limits)) {
    work.lines.push_back(
        {{middle + part.first * direction, middle + part.second * direction}, source});
  }
}

double turn_of(const Drawn& d, Random& random) {
  return drawn_value(random, 0.0, d.set.deviation.angle, d.set.deviation.distribution) *
         std::numbers::pi / 180.0;
}

/// The traces of one joint: from a start near the origin to either side.
class Traces {
 public:
  Traces(LineWork& work, const Drawn& d, Index source, double snap, double limit)
      : work_(work), d_(d), source_(source), snap_(snap), limit_(limit) {}

  bool add(Joint joint, Stretch along) {
    const double period = mean_length() + d_.set.gap;
    base_ = d_.point + joint.offset * d_.normal;
    const double anchor = far_away * period * std::round(along.first / (far_away * period));
    const std::uint64_t key = with_number(with_number(d_.key, joint.number), anchor / period);
    Random random(key);
    const double start = anchor - random.uniform() * period;
    return walk(mixed(key, "ahead"), start, 1.0, along) &&
           walk(mixed(key, "behind"), start - gap(random), -1.0, along);
  }

 private:
  double mean_length() const { return *d_.set.trace_length; }
  double length(Random& random) const {
    return drawn_length(random, mean_length(), d_.set.deviation.trace_length,
                        d_.set.deviation.distribution, 1e-3 * mean_length());
  }
  double gap(Random& random) const {
    return drawn_length(random, d_.set.gap, d_.set.deviation.gap, d_.set.deviation.distribution,
                        0.0);
  }

  bool walk(std::uint64_t key, double t, double sense, Stretch along) {
    Random random(key);
    while (sense > 0.0 ? t <= along.second : t >= along.first) {
      const double l = length(random), turn = turn_of(d_, random);
      const double middle = t + 0.5 * sense * l;
      if (middle + l >= along.first && middle - l <= along.second) {
        add_part(work_, d_, source_, base_ + middle * d_.direction, {-0.5 * l, 0.5 * l}, turn,
                 snap_);
        if (static_cast<double>(work_.lines.size()) > limit_) return false;
      }
      t += sense * (l + gap(random));
    }
    return true;
  }

  LineWork& work_;
  const Drawn& d_;
  Index source_;
  double snap_, limit_;
  Vec2 base_;
};

/// Middle of the part of a joint inside the outline, about which the joint is rotated.
Vec2 middle_of(const LineWork& work, const Drawn& d, Joint joint, double snap) {
  const Vec2 base = d.point + joint.offset * d.normal;
  const std::vector<Stretch> inside = clip_line(work.outline, base, d.direction, snap);
  if (inside.empty()) return base;
  return base + 0.5 * (inside.front().first + inside.back().second) * d.direction;
}

Stretch extent(const LineWork& work, const Ring& region, Vec2 axis) {
  Stretch extent = extent_along(work.outline, axis);
  if (region.empty()) return extent;
  const Stretch limits = extent_along(region, axis);
  return {std::max(extent.first, limits.first), std::min(extent.second, limits.second)};
}

}  // namespace

bool add_joint_set(LineWork& work, const JointSet& set, Index source, Vec2 origin, double snap,
                   double limit) {
  const Drawn d = drawn_set(set, origin);
  const double before = static_cast<double>(work.lines.size());
  // For an exponential length: -log of the smallest number drawn.
  const double widest = set.deviation.distribution == JointSpread::exponential ? 37.0 : 3.0;
  const double longest =
      set.trace_length ? *set.trace_length + widest * set.deviation.trace_length : infinite;
  const double reach =
      d.largest_turn == 0.0
          ? snap
          : std::min(longest, 2.0 * size_of(work.outline)) * std::sin(d.largest_turn) + snap;
  const double zero = dot(d.point, d.normal);
  const Stretch across = extent(work, d.region, d.normal);
  std::vector<Joint> joints;
  if (!joints_between(d, {across.first - reach - zero, across.second + reach - zero}, limit,
                      joints)) {
    return false;
  }
  if (!set.trace_length) {
    for (const Joint joint : joints) {
      const bool turned = set.deviation.angle != 0.0;
      Random random(mixed(with_number(d.key, joint.number), "angle"));
      const Vec2 middle =
          turned ? middle_of(work, d, joint, snap) : d.point + joint.offset * d.normal;
      add_part(work, d, source, middle, {-infinite, infinite}, turned ? turn_of(d, random) : 0.0,
               snap);
    }
    return true;
  }
  const double at_point = dot(d.point, d.direction);
  const Stretch along = extent(work, d.region, d.direction);
  Traces traces(work, d, source, snap, before + limit);
  return std::all_of(joints.begin(), joints.end(), [&](Joint joint) {
    return traces.add(joint, {along.first - at_point - snap, along.second - at_point + snap});
  });
}

}  // namespace edda
