// What a candidate list must hold, by looking at every vertex and every edge.
#pragma once

#include <algorithm>
#include <vector>

#include "contacts/contact_set.hpp"
#include "contacts/gap.hpp"
#include "contacts/search.hpp"

namespace edda {

/// Every vertex nearer than `near` (m) to an edge of another block that it faces, in order.
/// O(n^2): nothing is shared with the search but the meaning of "near" and "faces".
inline std::vector<NearPair> all_near(const BlockSet& b, const std::vector<std::uint8_t>& alive,
                                      const std::vector<double>& x, const std::vector<double>& y,
                                      double near) {
  std::vector<NearPair> pairs;
  for (Id v = 0; v < b.vertex_count(); ++v) {
    const Id i = b.vertex_block[v];
    if (!alive[i]) continue;
    const Vec2 p{x[v], y[v]};
    for (Id e = 0; e < b.vertex_count(); ++e) {
      const Id j = b.vertex_block[e];
      if (i == j || !alive[j] || (b.fixed[i] && b.fixed[j])) continue;
      const Vec2 q{x[e], y[e]}, r{x[b.next[e]], y[b.next[e]]};
      if (std::max(q.x, r.x) < p.x - near || std::min(q.x, r.x) > p.x + near ||
          std::max(q.y, r.y) < p.y - near || std::min(q.y, r.y) > p.y + near) {
        continue;
      }
      const Vec2 u = r - q;
      const double s = std::clamp(dot(p - q, u) / dot(u, u), 0.0, 1.0);
      if (norm(p - (q + s * u)) >= near) continue;
      if (facing(b, x, y, v, outward_normal(unit(u)))) pairs.push_back({v, e});
    }
  }
  return pairs;
}

struct ListFaults {
  std::size_t wanted = 0;    ///< pairs that must be there
  std::size_t missed = 0;    ///< of them, not in the list
  std::size_t repeated = 0;  ///< in the list more than once, or out of order
};

/// Farthest that any vertex has moved since the list was made, m.
inline double moved_since_built(const ContactSet& c, const std::vector<double>& x,
                                const std::vector<double>& y) {
  double most = 0.0;
  for (std::size_t v = 0; v < x.size(); ++v) {
    most = std::max(most, norm(Vec2{x[v] - c.built_x[v], y[v] - c.built_y[v]}));
  }
  return most;
}

/// Holds the list to everything nearer than its reach less twice what a vertex has moved since.
inline ListFaults check_list(const ContactSet& c, const BlockSet& b,
                             const std::vector<std::uint8_t>& alive, const std::vector<double>& x,
                             const std::vector<double>& y) {
  ListFaults faults;
  std::vector<NearPair> list;
  for (std::size_t k = 0; k < c.size(); ++k) list.push_back({c.vertex[k], c.edge[k]});
  for (std::size_t k = 1; k < list.size(); ++k) faults.repeated += list[k - 1] < list[k] ? 0 : 1;
  const double near = c.reach - 2.0 * moved_since_built(c, x, y);
  if (near <= 0.0) return faults;
  for (const NearPair& pair : all_near(b, alive, x, y, near)) {
    ++faults.wanted;
    faults.missed += std::binary_search(list.begin(), list.end(), pair) ? 0 : 1;
  }
  return faults;
}

}  // namespace edda
