#include "contacts/shares.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/candidates.hpp"
#include "contacts/gap.hpp"
#include "contacts/stored_energy.hpp"

namespace edda {
namespace {

/// Candidate (vertex, edge), or no_id.
Id find_candidate(const ContactSet& c, Id vertex, Id edge) {
  const auto begin = c.edge.begin() + c.begin_of_vertex[vertex];
  const auto end = c.edge.begin() + c.begin_of_vertex[vertex + 1];
  const auto it = std::lower_bound(begin, end, edge);
  return it != end && *it == edge ? static_cast<Id>(it - c.edge.begin()) : no_id;
}

Vec2 edge_tangent(const BlockSet& b, const Pose& pose, Id edge) {
  return unit(at(pose.x, pose.y, b.next[edge]) - at(pose.x, pose.y, edge));
}

/// 1 where the edges lie against each other, 0 where they have turned away.
double against(Vec2 te, Vec2 tf) {
  constexpr double fade = 0.01;
  return std::clamp((-dot(te, tf) - (opposite - fade)) / fade, 0.0, 1.0);
}

/// A shared edge carries to r_v beyond its end.
void run_on(ContactSet& c, std::size_t k, bool at_start, double reach) {
  double& further = at_start ? c.next_before[k] : c.next_beyond[k];
  further = std::max(further, reach);
}

/// Where the edge carries has changed: the foot may count as on it, or no longer, without having
/// moved.
void change_range(ContactSet& c, std::size_t k) {
  if (c.before[k] == c.next_before[k] && c.beyond[k] == c.next_beyond[k]) return;
  c.before[k] = c.next_before[k];
  c.beyond[k] = c.next_beyond[k];
  c.stir(k);
}

struct Share {
  double first, second;
};

Share share_of(const CornerPair& p, double delta_first, double delta_second, double o) {
  if (p.same_way()) {
    const double w = std::clamp(0.5 + (delta_first - delta_second) / (4.0 * p.reach), 0.0, 1.0);
    // Apart, whichever corner is inside has it all.
    const double alone = delta_first >= delta_second ? 1.0 : 0.0;
    const double first = o * w + (1.0 - o) * alone;
    return {first, 1.0 - first};
  }
  const double w = std::clamp(0.5 + (delta_first + delta_second) / (4.0 * p.reach), 0.5, 1.0);
  return {o * w + (1.0 - o), o * w + (1.0 - o)};
}

}  // namespace

void change_share(ContactSet& c, std::size_t k, double share, bool balanced) {
  const double old = c.share[k];
  if (share == old) return;
  if (!c.is(k, contact_state::closed)) {
    c.share[k] = share;
    return;
  }
  const double energy = stored_energy(c, k);
  if (!balanced && share > old && old > 0.0) {
    c.rest[k] = c.depth[k] - (c.depth[k] - c.rest[k]) * old / share;
  }
  c.share[k] = share;
  c.friction_work[k] += energy - stored_energy(c, k);
}

void pair_corners(ContactSet& c, const BlockSet& b, const Pose& pose) {
  c.pairs.clear();
  for (std::size_t k = 0; k < c.size(); ++k) {
    const Id a = c.vertex[k], e = c.edge[k];
    const Vec2 te = edge_tangent(b, pose, e);
    for (const bool at_start : {true, false}) {
      const Id corner = at_start ? e : c.edge_end[k];
      if (norm(at(pose.x, pose.y, a) - at(pose.x, pose.y, corner)) > 2.0 * c.reach) continue;
      for (const Id f : {b.previous[a], a}) {
        if (-dot(te, edge_tangent(b, pose, f)) < opposite - 0.1) continue;
        const Id other = find_candidate(c, corner, f);
        if (other == no_id || other < k) continue;
        c.pairs.push_back({static_cast<Id>(k), other, at_start, f == a,
                           corner_reach * std::min(b.edge_length[e], b.edge_length[f])});
      }
    }
  }
  c.paired.clear();
  c.pair_of.assign(c.size(), no_id);
  for (std::size_t p = 0; p < c.pairs.size(); ++p) {
    for (const Id k : {c.pairs[p].first, c.pairs[p].second}) {
      c.paired.push_back(k);
      if (c.pair_of[k] == no_id || c.pairs[p].same_way()) c.pair_of[k] = static_cast<Id>(p);
    }
  }
  std::sort(c.paired.begin(), c.paired.end());
  c.paired.erase(std::unique(c.paired.begin(), c.paired.end()), c.paired.end());
}

void update_shares(ContactSet& c) {
  for (const Id k : c.paired) {
    c.next_share[k] = 1.0;
    c.balanced[k] = 0;
    c.next_before[k] = c.extend_start[k];
    c.next_beyond[k] = c.extend_end[k];
  }
  for (const CornerPair& p : c.pairs) {
    const Id e = p.first, f = p.second;
    const double delta_first = p.first_at_start ? c.foot[e] : c.span[e] - c.foot[e];
    const double delta_second = p.second_at_start ? c.foot[f] : c.span[f] - c.foot[f];
    const double zone = 2.0 * p.reach;
    if (std::abs(delta_first) >= zone || std::abs(delta_second) >= zone) continue;
    const double o = against(tangent_of(c, e), tangent_of(c, f));
    if (o == 0.0) continue;
    const Share share = share_of(p, delta_first, delta_second, o);
    c.next_share[e] *= share.first;
    c.next_share[f] *= share.second;
    if (!p.same_way()) continue;
    c.balanced[e] = c.balanced[f] = 1;
    run_on(c, e, p.first_at_start, p.reach);
    run_on(c, f, p.second_at_start, p.reach);
  }
  for (const Id k : c.paired) {
    change_range(c, k);
    change_share(c, k, c.next_share[k], c.balanced[k] != 0);
  }
}

}  // namespace edda
