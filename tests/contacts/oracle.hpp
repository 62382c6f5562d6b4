// The faces that the list must contain, found by examining every pair of edges.
#pragma once

#include <algorithm>
#include <numbers>
#include <utility>
#include <vector>

#include "contacts/face_set.hpp"

namespace edda {

using EdgePair = std::pair<Id, Id>;

/// Cosine of the angle between the edges e and f beyond which no face acts: 85 degrees, and where
/// one of their ends is a needle of alpha < 90 degrees (90 - alpha)/2 more.
inline double least_opposed(const BlockSet& b, Id e, Id f) {
  double sharpest = 0.5 * std::numbers::pi;
  for (const Id v : {e, b.next[e], f, b.next[f]}) sharpest = std::min(sharpest, b.corner[v]);
  return std::cos(85.0 / 180.0 * std::numbers::pi + 0.5 * (0.5 * std::numbers::pi - sharpest));
}

inline bool oppose(const BlockSet& b, const std::vector<double>& x, const std::vector<double>& y,
                   Id e, Id f) {
  const auto direction = [&](Id edge) {
    const Id end = b.next[edge];
    return unit(Vec2{x[end] - x[edge], y[end] - y[edge]});
  };
  return -dot(direction(e), direction(f)) > least_opposed(b, e, f);
}

/// Every two opposed edges of different blocks of which a corner of one is nearer than `near` (m)
/// to the other, in order. O(n^2): only the definition of "near" is shared with the search.
inline std::vector<EdgePair> all_near(const BlockSet& b, const std::vector<std::uint8_t>& alive,
                                      const std::vector<double>& x, const std::vector<double>& y,
                                      double near) {
  const auto corner = [&](Id v) { return Vec2{x[v], y[v]}; };
  const auto distance = [&](Id v, Id edge) {
    return distance_to_segment(corner(v), corner(edge), corner(b.next[edge]));
  };
  const auto low = [&](const std::vector<double>& u, Id e) { return std::min(u[e], u[b.next[e]]); };
  const auto high = [&](const std::vector<double>& u, Id e) {
    return std::max(u[e], u[b.next[e]]);
  };
  std::vector<EdgePair> pairs;
  for (Id e = 0; e < b.vertex_count(); ++e) {
    const Id i = b.vertex_block[e];
    if (!alive[i]) continue;
    for (Id f = e + 1; f < b.vertex_count(); ++f) {
      const Id j = b.vertex_block[f];
      if (i == j || !alive[j] || (b.fixed[i] && b.fixed[j])) continue;
      if (low(x, e) > high(x, f) + near || low(x, f) > high(x, e) + near ||
          low(y, e) > high(y, f) + near || low(y, f) > high(y, e) + near) {
        continue;
      }
      const double least = std::min(
          {distance(e, f), distance(b.next[e], f), distance(f, e), distance(b.next[f], e)});
      if (least < near && oppose(b, x, y, e, f)) pairs.push_back({e, f});
    }
  }
  return pairs;
}

struct ListFaults {
  std::size_t wanted = 0;    ///< pairs that must be in the list
  std::size_t missed = 0;    ///< of them, not in the list
  std::size_t repeated = 0;  ///< in the list more than once
};

/// Farthest that any vertex has moved since the list was made, m.
inline double moved_since_built(const FaceSet& c, const std::vector<double>& x,
                                const std::vector<double>& y) {
  double most = 0.0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    most = std::max(most, norm(Vec2{x[v] - c.built_x[v], y[v] - c.built_y[v]}));
  }
  return most;
}

/// Checks that the list contains all pairs nearer than its reach less twice the distance that a
/// vertex has moved since.
inline ListFaults check_list(const FaceSet& c, const BlockSet& b,
                             const std::vector<std::uint8_t>& alive, const std::vector<double>& x,
                             const std::vector<double>& y) {
  ListFaults faults;
  std::vector<EdgePair> list;
  for (std::size_t k = 0; k < c.size(); ++k) list.push_back({c.edge[k], c.facing[k]});
  std::sort(list.begin(), list.end());
  for (std::size_t k = 1; k < list.size(); ++k) faults.repeated += list[k - 1] < list[k] ? 0 : 1;
  const double near = c.reach - 2.0 * moved_since_built(c, x, y);
  if (near <= 0.0) return faults;
  for (const EdgePair& pair : all_near(b, alive, x, y, near)) {
    ++faults.wanted;
    faults.missed += std::binary_search(list.begin(), list.end(), pair) ? 0 : 1;
  }
  return faults;
}

}  // namespace edda
