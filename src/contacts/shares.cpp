#include "contacts/shares.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "base/vector_loop.hpp"
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
EDDA_INLINE double against(Vec2 te, Vec2 tf) {
  constexpr double fade = 0.01;
  return smaller(larger((-dot(te, tf) - (opposite - fade)) / fade, 0.0), 1.0);
}

/// A shared edge carries to r_v beyond its end.
void run_on(NextShare& next, bool at_start, double reach) {
  double& further = at_start ? next.before : next.beyond;
  further = std::max(further, reach);
}

/// Where the edge carries has changed: the foot may count as on it, or no longer, without having
/// moved.
void change_range(ContactSet& c, std::size_t k, const NextShare& next) {
  if (c.before[k] == next.before && c.beyond[k] == next.beyond) return;
  c.before[k] = next.before;
  c.beyond[k] = next.beyond;
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

/// Where the two corners of a pair stand.
struct PairStand {
  double first, second;  ///< delta_A, delta_B, m
  double against;
};

/// How far the foot of k lies inside its edge, measured from the start (at_end = 0) or the end (1).
template <class Contacts>
EDDA_INLINE double inside(const Contacts& c, std::size_t k, double at_end) {
  const double foot = c.foot[k];
  return foot + at_end * (c.span[k] - 2.0 * foot);
}

template <class Contacts>
EDDA_INLINE PairStand stand_of(const Contacts& c, Id e, Id f, double e_end, double f_end) {
  return {inside(c, e, e_end), inside(c, f, f_end), against(c.tangent(e), c.tangent(f))};
}

PairStand stand_of(const ContactSet& c, const CornerPair& p) {
  return stand_of(c, p.first, p.second, p.first_at_start ? 0.0 : 1.0,
                  p.second_at_start ? 0.0 : 1.0);
}

/// Before the pairs of candidate k have been looked at: all of the spring, on the edge alone.
NextShare start_share(const ContactSet& c, Id k) {
  NextShare next{1.0, 0.0, 0.0, false};
  const auto it = std::lower_bound(c.run_ons.begin(), c.run_ons.end(), k,
                                   [](const RunOn& r, Id id) { return r.candidate < id; });
  if (it != c.run_ons.end() && it->candidate == k) {
    next.before = it->before;
    next.beyond = it->beyond;
  }
  return next;
}

/// Corners so far apart, or edges so turned, that all of each spring stays where it is.
EDDA_INLINE bool apart(double first, double second, double against, double zone) {
  const bool first_away = std::abs(first) >= zone, second_away = std::abs(second) >= zone;
  return first_away | second_away | (against == 0.0);
}

/// Distance within which corners share, m.
double zone_of(const CornerPair& p) {
  return 2.0 * p.reach;
}

void set_shares(const CornerPair& p, const PairStand& stand, NextShare& of_first,
                NextShare& of_second) {
  if (apart(stand.first, stand.second, stand.against, zone_of(p))) return;
  const Share share = share_of(p, stand.first, stand.second, stand.against);
  of_first.share *= share.first;
  of_second.share *= share.second;
  if (!p.same_way()) return;
  of_first.balanced = of_second.balanced = true;
  run_on(of_first, p.first_at_start, p.reach);
  run_on(of_second, p.second_at_start, p.reach);
}

/// A bond holds on to an edge that its corner has slid past, and the corner that it has passed has
/// the whole spring: it does not get it back.
void leave_to_partner(const ContactSet& c, const CornerPair& p, const PairStand& stand,
                      NextShare& of_first, NextShare& of_second) {
  if (!p.same_way() || stand.against == 0.0 ||
      !apart(stand.first, stand.second, stand.against, zone_of(p))) {
    return;
  }
  if (stand.first < 0.0 && c.is(p.first, contact_state::bonded)) of_first.share = 0.0;
  if (stand.second < 0.0 && c.is(p.second, contact_state::bonded)) of_second.share = 0.0;
}

void take_share(ContactSet& c, std::size_t k, const NextShare& next) {
  change_range(c, k, next);
  change_share(c, k, next.share, next.balanced);
}

/// Part of the zone 2 r_v that a corner may move before shares are set again: at rest nothing
/// changes.
constexpr double slack = 0.5e-4;
constexpr double never = std::numeric_limits<double>::infinity();

struct PairView {
  const Id *first, *second;
  const double *first_end, *second_end, *first_seen, *second_seen, *against, *zone;
};

/// Whether the shares of pair p must be set again.
EDDA_INLINE bool has_moved(const PairView& m, const ContactView& c, std::size_t p) {
  const PairStand now = stand_of(c, m.first[p], m.second[p], m.first_end[p], m.second_end[p]);
  const double first = m.first_seen[p], second = m.second_seen[p], zone = m.zone[p];
  const double moved = std::abs(now.first - first) + std::abs(now.second - second);
  const bool changed = (moved > slack * zone) | (now.against != m.against[p]);
  const bool out_now = apart(now.first, now.second, now.against, zone);
  const bool out_then = apart(first, second, m.against[p], zone), out = out_now & out_then;
  return (first == never) | (changed & !out);
}

constexpr std::size_t pairs_at_once = 64;

/// moved[p] of each pair: 1 if its shares must be set again. Whether there is any.
EDDA_VECTOR bool find_moved(PairView m, ContactView c, double* moved, std::size_t begin,
                            std::size_t end) {
  double any = 0.0;
#pragma omp simd reduction(max : any)
  for (std::size_t p = begin; p < end; ++p) {
    moved[p] = has_moved(m, c, p) ? 1.0 : 0.0;
    any = larger(any, moved[p]);
  }
  return any > 0.0;
}

PairStand see(ContactSet& c, std::size_t p) {
  const PairStand now = stand_of(c, c.pairs[p]);
  PairMemory& m = c.pair_memory;
  m.first_seen[p] = now.first;
  m.second_seen[p] = now.second;
  m.against[p] = now.against;
  return now;
}

void update_lone_pair(ContactSet& c, std::size_t p) {
  const CornerPair& pair = c.pairs[p];
  const PairStand now = see(c, p);
  NextShare first = start_share(c, pair.first), second = start_share(c, pair.second);
  set_shares(pair, now, first, second);
  leave_to_partner(c, pair, now, first, second);
  take_share(c, pair.first, first);
  take_share(c, pair.second, second);
}

/// Which pairs the tangled candidates are in.
void find_pairs_of_tangled(ContactSet& c) {
  Tangle& t = c.tangle;
  const auto place_of = [&t](Id k) {
    const auto it = std::lower_bound(t.candidate.begin(), t.candidate.end(), k);
    return static_cast<std::size_t>(it - t.candidate.begin());
  };
  t.begin.assign(t.candidate.size() + 1, 0);
  const auto each = [&](auto visit) {
    for (std::size_t p = c.lone_pairs; p < c.pairs.size(); ++p) {
      for (const Id k : {c.pairs[p].first, c.pairs[p].second}) visit(place_of(k), p);
    }
  };
  each([&](std::size_t q, std::size_t) { ++t.begin[q + 1]; });
  for (std::size_t q = 0; q < t.candidate.size(); ++q) t.begin[q + 1] += t.begin[q];
  std::vector<Id> fill(t.begin.begin(), t.begin.end() - 1);
  t.pair.resize(t.begin.back());
  t.place.resize(2 * (c.pairs.size() - c.lone_pairs));
  std::size_t entry = 0;
  each([&](std::size_t q, std::size_t p) {
    t.pair[fill[q]++] = static_cast<Id>(p);
    t.place[entry++] = static_cast<Id>(q);
  });
  t.stale.assign(t.candidate.size(), 0);
}

/// Where the corners of a pair stood when its shares were last set, so that both are set alike.
PairStand seen(const ContactSet& c, std::size_t p) {
  const PairMemory& m = c.pair_memory;
  return {m.first_seen[p], m.second_seen[p], m.against[p]};
}

}  // namespace

bool divides(const ContactSet& c, std::size_t p) {
  const PairStand stand = seen(c, p);
  return c.pairs[p].same_way() &&
         !apart(stand.first, stand.second, stand.against, zone_of(c.pairs[p]));
}

namespace {

/// The share of the tangled candidate q: all of its pairs have a say. Where its corner and another
/// pass each other, the edge beyond that corner, bent a little, has none: it belongs to the same
/// joint, and would take away half of a spring that stands for all of it.
void update_tangled(ContactSet& c, std::size_t q) {
  const Id k = c.tangle.candidate[q];
  NextShare next = start_share(c, k);
  double passing = 0.0;
  for (Id e = c.tangle.begin[q]; e < c.tangle.begin[q + 1]; ++e) {
    const Id p = c.tangle.pair[e];
    if (divides(c, p)) passing = std::max(passing, seen(c, p).against);
  }
  for (Id e = c.tangle.begin[q]; e < c.tangle.begin[q + 1]; ++e) {
    const Id p = c.tangle.pair[e];
    const CornerPair& pair = c.pairs[p];
    const double before = next.share;
    NextShare other{};
    const bool is_first = pair.first == k;
    set_shares(pair, seen(c, p), is_first ? next : other, is_first ? other : next);
    leave_to_partner(c, pair, seen(c, p), is_first ? next : other, is_first ? other : next);
    if (!pair.same_way()) next.share += passing * (before - next.share);
  }
  take_share(c, k, next);
}

/// Pairs that share no candidate with another come first.
void part_pairs(ContactSet& c) {
  std::vector<std::uint8_t> pairs_of(c.size(), 0);
  for (const CornerPair& p : c.pairs) {
    for (const Id k : {p.first, p.second}) {
      if (pairs_of[k] < 2) ++pairs_of[k];
    }
  }
  const auto rest = std::stable_partition(c.pairs.begin(), c.pairs.end(), [&](const CornerPair& p) {
    return pairs_of[p.first] == 1 && pairs_of[p.second] == 1;
  });
  c.lone_pairs = static_cast<std::size_t>(rest - c.pairs.begin());
}

}  // namespace

void list_pairs(ContactSet& c) {
  PairMemory& m = c.pair_memory;
  for (auto* ids : {&m.first, &m.second}) ids->clear();
  for (auto* values : {&m.first_end, &m.second_end, &m.zone}) values->clear();
  for (const CornerPair& pair : c.pairs) {
    m.first.push_back(pair.first);
    m.second.push_back(pair.second);
    m.first_end.push_back(pair.first_at_start ? 0.0 : 1.0);
    m.second_end.push_back(pair.second_at_start ? 0.0 : 1.0);
    m.zone.push_back(zone_of(pair));
  }
  std::vector<Id>& list = c.tangle.candidate;
  list.clear();
  for (std::size_t p = c.lone_pairs; p < c.pairs.size(); ++p) {
    list.push_back(c.pairs[p].first);
    list.push_back(c.pairs[p].second);
  }
  std::sort(list.begin(), list.end());
  list.erase(std::unique(list.begin(), list.end()), list.end());
  find_pairs_of_tangled(c);
}

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
  part_pairs(c);
  PairMemory& m = c.pair_memory;
  for (auto* seen : {&m.first_seen, &m.second_seen, &m.against}) {
    seen->assign(c.pairs.size(), never);
  }
  list_pairs(c);
  c.pair_of.assign(c.size(), no_id);
  for (std::size_t p = 0; p < c.pairs.size(); ++p) {
    for (const Id k : {c.pairs[p].first, c.pairs[p].second}) {
      if (c.pair_of[k] == no_id || c.pairs[p].same_way()) c.pair_of[k] = static_cast<Id>(p);
    }
  }
}

void update_shares(ContactSet& c) {
  const PairMemory& m = c.pair_memory;
  const PairView view{m.first.data(),      m.second.data(),     m.first_end.data(),
                      m.second_end.data(), m.first_seen.data(), m.second_seen.data(),
                      m.against.data(),    m.zone.data()};
  const std::size_t pairs = c.pairs.size();
  c.pair_moved.resize(pairs);
  c.pairs_moved.resize((pairs + pairs_at_once - 1) / pairs_at_once);
  const ContactView contacts = c.view();
  parallel_chunks(pairs, pairs_at_once, [&](std::size_t q, std::size_t begin, std::size_t end) {
    c.pairs_moved[q] = find_moved(view, contacts, c.pair_moved.data(), begin, end) ? 1 : 0;
  });
  Tangle& t = c.tangle;
  for (std::size_t q = 0; q < c.pairs_moved.size(); ++q) {
    if (c.pairs_moved[q] == 0) continue;
    const std::size_t end = std::min(pairs, (q + 1) * pairs_at_once);
    for (std::size_t p = q * pairs_at_once; p < end; ++p) {
      if (c.pair_moved[p] == 0.0) continue;
      if (p < c.lone_pairs) {
        update_lone_pair(c, p);
        continue;
      }
      see(c, p);
      const std::size_t entry = 2 * (p - c.lone_pairs);
      t.stale[t.place[entry]] = t.stale[t.place[entry + 1]] = 1;
    }
  }
  for (std::size_t q = 0; q < t.stale.size(); ++q) {
    if (t.stale[q] == 0) continue;
    update_tangled(c, q);
    t.stale[q] = 0;
  }
}

}  // namespace edda
