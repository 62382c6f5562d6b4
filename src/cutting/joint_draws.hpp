// What the traces of a [[joint_set]] are drawn from: its directions, its joints and their random
// numbers.
//
// Notation: joint k of a set runs along `direction` at offset[k] from the set's origin, in the
// sense of `normal`; t is the distance along it from the projection of the origin. Its traces
// follow each other: trace, gap, trace, ..., so that the gap between them is as given.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "base/random.hpp"
#include "base/rings.hpp"
#include "cutting/line_work.hpp"

namespace edda {

/// Random draws start at a multiple of this number of steps (spacings or traces) from the origin,
/// the one nearest to the domain.
inline constexpr double far_away = 1000.0;

/// Whether each trace is where the means put it.
inline bool is_regular(const Deviation& d) {
  return d.angle == 0.0 && d.spacing == 0.0 && d.trace_length == 0.0 && d.gap == 0.0;
}

/// A set on its section, relative to the local origin.
struct DrawnSet {
  const JointSet& set;
  Vec2 point, direction, normal;
  Ring region;
  double spacing_deviation;
  double largest_turn;  ///< radians, largest deviation of a trace from the mean direction
  std::uint64_t key;

  double least_spacing() const { return 1e-3 * set.spacing; }
  bool regular() const { return is_regular(set.deviation); }
};

DrawnSet drawn_set(const JointSet& set, Vec2 origin);

struct SetJoint {
  double number = 0.0;
  double offset = 0.0;  ///< m
};

/// The joints between two offsets, if no more than `limit`.
bool joints_between(const DrawnSet& d, Stretch offsets, double limit,
                    std::vector<SetJoint>& joints);

/// A length from its distribution, drawn again where it falls below `least`.
double drawn_length(Random& random, double mean, double deviation, JointSpread spread,
                    double least);

std::uint64_t with_number(std::uint64_t key, double number);

/// The deviation of one trace from the direction of its set, radians.
double turn_of(const DrawnSet& d, Random& random);

/// Adds the part inside the domain of one trace, or of a joint that goes right through.
void add_part(LineWork& work, const DrawnSet& d, Index source, Vec2 middle, Stretch limits,
              double turn, double snap);

/// Extent of the domain, and of the region in it, along an axis.
Stretch extent_of(const LineWork& work, const Ring& region, Vec2 axis);

}  // namespace edda
