#include "cutting/joint_sets.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "cutting/joint_draws.hpp"

namespace edda {
namespace {

constexpr double infinite = std::numeric_limits<double>::infinity();

/// The traces of one joint: from a start near the origin to either side. Without deviations a trace
/// begins at the origin, and on joint k at k times the stagger; with any, at random.
class Traces {
 public:
  Traces(LineWork& work, const DrawnSet& d, Index source, double snap, double limit)
      : work_(work), d_(d), source_(source), snap_(snap), limit_(limit) {}

  bool add(SetJoint joint, Stretch along) {
    const double period = mean_length() + d_.set.gap;
    base_ = d_.point + joint.offset * d_.normal;
    const bool placed = d_.regular() || d_.set.stagger;
    const double first = placed ? d_.set.stagger.value_or(0.0) * joint.number : 0.0;
    const double anchor =
        far_away * period * std::round((along.first - first) / (far_away * period));
    const std::uint64_t key = with_number(with_number(d_.key, joint.number), anchor / period);
    Random random(key);
    const double start = placed ? first + anchor : anchor - random.uniform() * period;
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
  const DrawnSet& d_;
  Index source_;
  double snap_, limit_;
  Vec2 base_;
};

/// Middle of the part of a joint inside the outline, about which the joint is rotated.
Vec2 middle_of(const LineWork& work, const DrawnSet& d, SetJoint joint, double snap) {
  const Vec2 base = d.point + joint.offset * d.normal;
  const std::vector<Stretch> inside = clip_line(work.outline, base, d.direction, snap);
  if (inside.empty()) return base;
  return base + 0.5 * (inside.front().first + inside.back().second) * d.direction;
}

}  // namespace

bool add_joint_set(LineWork& work, const JointSet& set, Index source, Vec2 origin, double snap,
                   double limit) {
  const DrawnSet d = drawn_set(set, origin);
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
  const Stretch across = extent_of(work, d.region, d.normal);
  std::vector<SetJoint> joints;
  if (!joints_between(d, {across.first - reach - zero, across.second + reach - zero}, limit,
                      joints)) {
    return false;
  }
  if (!set.trace_length) {
    for (const SetJoint joint : joints) {
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
  const Stretch along = extent_of(work, d.region, d.direction);
  Traces traces(work, d, source, snap, before + limit);
  return std::all_of(joints.begin(), joints.end(), [&](SetJoint joint) {
    return traces.add(joint, {along.first - at_point - snap, along.second - at_point + snap});
  });
}

}  // namespace edda
