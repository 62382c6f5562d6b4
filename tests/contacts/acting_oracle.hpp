// Which faces act, from its definition in docs/contacts.md alone: edges are opposed and overlap, a
// face that comes into being acts if it is open, if the points where it would press lie inside both
// blocks, or if a corner that bounds the overlap lies in the other block by a twentieth of the
// closure, otherwise once it is open; its corner leans if no third block lies beside it. Only the
// corners are shared with the program.
#pragma once

#include <algorithm>
#include <limits>
#include <map>
#include <utility>
#include <vector>

#include "blocks/pose.hpp"
#include "contacts/face_states.hpp"
#include "contacts/oracle.hpp"

namespace edda {

/// Winding number of the outlines of a block about p: 1 inside, 0 outside and in its holes.
inline int windings(const BlockSet& b, const Pose& pose, Vec2 p, Id block) {
  double angle = 0.0;
  for (Id v = b.vertex_begin[block]; v < b.vertex_begin[block + 1]; ++v) {
    const Vec2 from = at(pose.x, pose.y, v) - p, to = at(pose.x, pose.y, b.next[v]) - p;
    angle += std::atan2(cross(from, to), dot(from, to));
  }
  return static_cast<int>(std::lround(angle / (2.0 * std::numbers::pi)));
}

/// Depth of p inside the block, m; negative outside.
inline double depth_of(const BlockSet& b, const Pose& pose, Vec2 p, Id block) {
  double nearest = std::numeric_limits<double>::infinity();
  for (Id v = b.vertex_begin[block]; v < b.vertex_begin[block + 1]; ++v) {
    nearest = std::min(
        nearest, distance_to_segment(p, at(pose.x, pose.y, v), at(pose.x, pose.y, b.next[v])));
  }
  return windings(b, pose, p, block) > 0 ? nearest : -nearest;
}

/// Two edges in their present position.
struct EdgesFacing {
  bool opposed = false;
  double angle_left =
      0.0;              ///< distance of the cosine from the limit beyond which they are not opposed
  double length = 0.0;  ///< of their overlap, m
  double a = 0.0, b = 0.0;  ///< closures at its ends, m
  Vec2 beside;  ///< point between both, a tenth of the overlap from the end of larger closure
  Vec2 on_edge, on_facing;  ///< points of each at the centre of pressure
  struct Bound {
    Vec2 corner;
    bool of_edge = true;  ///< it is a corner of `edge`, not of `facing`
  } at_a, at_b;           ///< the corners that bound the overlap
  double closure() const { return std::max(a, b); }
};

inline EdgesFacing edges_facing(const BlockSet& b, const Pose& pose, Id e, Id f) {
  const Vec2 p1 = at(pose.x, pose.y, e), p2 = at(pose.x, pose.y, b.next[e]);
  const Vec2 q1 = at(pose.x, pose.y, f), q2 = at(pose.x, pose.y, b.next[f]);
  EdgesFacing s;
  s.angle_left = -dot(unit(p2 - p1), unit(q2 - q1)) - least_opposed(b, e, f);
  s.opposed = s.angle_left > 0.0;
  if (!s.opposed) return s;
  const Vec2 t = unit(unit(p2 - p1) - unit(q2 - q1)), n{t.y, -t.x};
  const double end = dot(p2 - p1, t), from = dot(q2 - p1, t), to = dot(q1 - p1, t);
  const double sa = std::max(0.0, from), sb = std::min(end, to);
  s.at_a = from <= 0.0 ? EdgesFacing::Bound{p1, true} : EdgesFacing::Bound{q2, false};
  s.at_b = end <= to ? EdgesFacing::Bound{p2, true} : EdgesFacing::Bound{q1, false};
  s.length = sb - sa;
  if (end <= 0.0 || to <= from) s.opposed = false;
  const auto on_e = [&](double x) { return p1 + x / end * (p2 - p1); };
  const auto on_f = [&](double x) { return q2 + (x - from) / (to - from) * (q1 - q2); };
  const auto closure = [&](double x) { return dot(on_e(x) - on_f(x), n); };
  s.a = closure(sa);
  s.b = closure(sb);
  // Where both ends are closed the pressure is a trapezoid, else a triangle from the point where it
  // opens.
  double middle = 0.5;
  if (s.a > 0.0 && s.b > 0.0) middle = (s.a + 2.0 * s.b) / (3.0 * (s.a + s.b));
  if (s.a > 0.0 && s.b <= 0.0) middle = s.a / (s.a - s.b) / 3.0;
  if (s.b > 0.0 && s.a <= 0.0) middle = 1.0 - s.b / (s.b - s.a) / 3.0;
  s.on_edge = on_e(sa + middle * s.length);
  s.on_facing = on_f(sa + middle * s.length);
  const double near = sa + (s.b >= s.a ? 0.9 : 0.1) * s.length;
  s.beside = 0.5 * (on_e(near) + on_f(near));
  return s;
}

/// Depth in the other block of the deeper of the corners that bound the overlap.
inline double deepest_corner(const EdgesFacing& s, const BlockSet& b, const Pose& pose, Id e,
                             Id f) {
  const auto depth = [&](const EdgesFacing::Bound& bound) {
    return depth_of(b, pose, bound.corner, b.vertex_block[bound.of_edge ? f : e]);
  };
  return std::max(depth(s.at_a), depth(s.at_b));
}

/// Whether neither edge lies in the other block where it would press: these are far sides of two
/// thin blocks, which lie between them. Closures beyond half of the overlap do not count, since
/// those are corners.
inline bool presses_from_behind(const EdgesFacing& s, const BlockSet& b, const Pose& pose, Id e,
                                Id f) {
  const double shorter = std::min(b.edge_length[e], b.edge_length[f]);
  if (s.length < std::max(2.0 * s.closure(), 0.01 * shorter)) return false;
  const double in_facing = depth_of(b, pose, s.on_edge, b.vertex_block[f]);
  const double in_edge = depth_of(b, pose, s.on_facing, b.vertex_block[e]);
  return std::max(in_facing, in_edge) < -0.1 * s.closure();
}

struct ActingFaults {
  std::size_t decided = 0;   ///< closed faces for which the oracle is certain
  std::size_t apart = 0;     ///< of them, those on which the program differs
  std::size_t inactive = 0;  ///< of them, those that do not act
  std::size_t leaning = 0;   ///< faces that began to carry and for which the oracle is certain
                             ///< whether their corner leans
  std::size_t crossed = 0;   ///< of them, those with a third block beside the corner
  std::size_t askew = 0;     ///< of them, those on which the program differs
  std::size_t pressing = 0;  ///< faces that carry
  std::size_t behind = 0;    ///< of them, those that press from the far side of a block
  void add(const ActingFaults& f) {
    decided += f.decided;
    apart += f.apart;
    inactive += f.inactive;
    leaning += f.leaning;
    crossed += f.crossed;
    askew += f.askew;
    behind += f.behind;
    pressing += f.pressing;
  }
};

/// Keeps decisions from step to step; a face within rounding of a change is undecided until it
/// opens or ends.
class ActingOracle {
 public:
  explicit ActingOracle(double rounding) : rounding_(rounding) {}

  /// To be called after the faces were evaluated at a new step.
  ActingFaults look(const FaceSet& c, const FaceStates& states, const BlockSet& b,
                    const Pose& pose) {
    ActingFaults faults;
    std::map<EdgePair, Decision> now;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const Id e = c.edge[k], f = c.facing[k];
      const EdgesFacing s = edges_facing(b, pose, e, f);
      const Decision decided = decide(s, c, b, pose, k);
      if (decided == Decision::apart) continue;
      now[{e, f}] = decided;
      if (s.closure() > rounding_ && decided != Decision::unknown) {
        ++faults.decided;
        faults.inactive += decided == Decision::inactive ? 1 : 0;
        faults.apart += c.acts(k) == (decided == Decision::acts) ? 0 : 1;
      }
      const bool presses = states.now[k].energy > 0.0;
      if (presses && states.before[k].energy == 0.0) look_beside(s, c, b, pose, k, faults);
      if (presses && s.closure() > rounding_) {
        ++faults.pressing;
        faults.behind += presses_from_behind(s, b, pose, e, f) ? 1 : 0;
      }
    }
    before_ = std::move(now);
    return faults;
  }

 private:
  enum class Decision { apart, acts, inactive, unknown };

  Decision decide(const EdgesFacing& s, const FaceSet& c, const BlockSet& b, const Pose& pose,
                  std::size_t k) const {
    const auto old = before_.find({c.edge[k], c.facing[k]});
    const double closure = s.closure();
    // A closure beyond twice the overlap is the far side of a corner; a face in tension has no
    // closure.
    const double beyond = c.carries_tension(k) ? s.length : s.length - 0.5 * std::max(closure, 0.0);
    const double doubt =
        rounding_ + 0.3 * std::max(closure, 0.0) * (c.carries_tension(k) ? 0.0 : 1.0);
    if (!s.opposed || beyond < -doubt) return Decision::apart;
    if (s.angle_left < 1e-6 || beyond < doubt) return Decision::unknown;
    if (closure < -rounding_) return Decision::acts;
    if (old != before_.end() && old->second == Decision::acts) return Decision::acts;
    if (closure < rounding_) return Decision::unknown;
    if (old != before_.end()) return old->second;
    const double in_facing = depth_of(b, pose, s.on_edge, b.vertex_block[c.facing[k]]);
    const double in_edge = depth_of(b, pose, s.on_facing, b.vertex_block[c.edge[k]]);
    // Corners that pass each other move the ends inward a little.
    const double near = rounding_ + 0.1 * closure;
    const double depth = std::min(in_facing, in_edge);
    const double corner = deepest_corner(s, b, pose, c.edge[k], c.facing[k]) - 0.05 * closure;
    const double corner_near = 0.025 * closure;
    if (depth > near || corner > corner_near) return Decision::acts;
    return depth < -near && corner < -corner_near ? Decision::inactive : Decision::unknown;
  }

  /// Searches all blocks, whereas the program searches those of the faces in its list.
  void look_beside(const EdgesFacing& s, const FaceSet& c, const BlockSet& b, const Pose& pose,
                   std::size_t k, ActingFaults& faults) const {
    double deepest = -std::numeric_limits<double>::infinity();
    for (Id i = 0; i < b.size(); ++i) {
      if (i == b.vertex_block[c.edge[k]] || i == b.vertex_block[c.facing[k]]) continue;
      deepest = std::max(deepest, depth_of(b, pose, s.beside, i));
    }
    const double doubt = 1e-7 + 0.3 * std::abs(s.closure());
    if (std::abs(deepest) < doubt) return;
    ++faults.leaning;
    faults.crossed += deepest > 0.0 ? 1 : 0;
    faults.askew += c.leans(k) == (deepest < 0.0) ? 0 : 1;
  }

  double rounding_;  ///< m
  std::map<EdgePair, Decision> before_;
};

}  // namespace edda
