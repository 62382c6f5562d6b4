// Looks at every step of a run for what a contact must never do.
#pragma once

#include <map>

#include "contacts/oracle.hpp"
#include "verification/scene.hpp"

namespace edda {

/// Call look() after every step. Force of a pair of blocks: what all contacts between them put on
/// the block of lower number.
class HeapWatch {
 public:
  double worst_jump = 0.0;  ///< change of a pair's force in a step over the sum of p |u|, u how far
                            ///< its contacts have moved in the step
  double worst_share = 0.0;  ///< how far a share lies outside [0, 1]
  ListFaults list;           ///< summed over the steps looked at
  double jump_at = 0.0;      ///< s
  std::pair<Id, Id> jump_of{};

  explicit HeapWatch(std::uint64_t list_every) : list_every_(list_every) {}

  void look(const Simulation& s) {
    const ContactSet& c = s.contacts;
    std::map<std::pair<Id, Id>, Pair> now;
    for (std::size_t k = 0; k < c.size(); ++k) {
      worst_share = std::max({worst_share, -c.share[k], c.share[k] - 1.0});
      const Vec2 f = c.on_vertex(k);
      const bool carries = norm(f) > 0.0;
      if (!carries && !c.is(k, contact_state::closed)) continue;
      Pair& pair = now[std::minmax(c.block_i[k], c.block_j[k])];
      pair.force += c.block_i[k] < c.block_j[k] ? f : -f;
      pair.contacts.push_back({c.vertex[k], c.edge[k], c.edge_end[k], c.kn[k]});
    }
    if (!x_.empty()) compare(s, now);
    before_ = std::move(now);
    x_ = s.pose.x1;  // where the forces of the last step belong
    y_ = s.pose.y1;
    if (s.state.steps % list_every_ != 0) return;
    const ListFaults f = check_list(c, s.blocks, s.state.alive, s.pose.x, s.pose.y);
    list.wanted += f.wanted;
    list.missed += f.missed;
    list.repeated += f.repeated;
  }

 private:
  struct Contact {
    Id vertex, edge, edge_end;
    double kn;
  };
  struct Pair {
    Vec2 force;
    std::vector<Contact> contacts;
  };

  /// How far the vertex moves from one pose to the next, m: against the edge's own points, and as
  /// seen from the edge as it turns.
  static double moved(const Contact& c, const std::vector<double>& x0,
                      const std::vector<double>& y0, const std::vector<double>& x,
                      const std::vector<double>& y) {
    const Vec2 p = at(x, y, c.vertex), q = at(x, y, c.edge), r = at(x, y, c.edge_end);
    const Vec2 p0 = at(x0, y0, c.vertex), q0 = at(x0, y0, c.edge), r0 = at(x0, y0, c.edge_end);
    const double xi = std::clamp(dot(p - q, r - q) / dot(r - q, r - q), 0.0, 1.0);
    const Vec2 against = p - p0 - ((1.0 - xi) * (q - q0) + xi * (r - r0));
    const Gap now = gap_to(edge_frame(q, r), p), before = gap_to(edge_frame(q0, r0), p0);
    return std::max(norm(against), std::hypot(now.depth - before.depth, now.foot - before.foot));
  }

  void compare(const Simulation& s, const std::map<std::pair<Id, Id>, Pair>& now) {
    std::map<std::pair<Id, Id>, Pair> all = now;
    for (const auto& [key, pair] : before_) {
      Pair& p = all[key];
      for (const Contact& c : pair.contacts) {
        const bool known = std::any_of(p.contacts.begin(), p.contacts.end(), [&](const Contact& o) {
          return o.vertex == c.vertex && o.edge == c.edge;
        });
        if (!known) p.contacts.push_back(c);
      }
      p.force -= pair.force;
    }
    for (const auto& [key, pair] : all) {
      double scale = 0.0;
      for (const Contact& c : pair.contacts) {
        // The step between the two forces, and the one made with the second: a contact that opens
        // in it has its force cut for that.
        scale += c.kn * std::max(moved(c, x_, y_, s.pose.x1, s.pose.y1),
                                 moved(c, s.pose.x1, s.pose.y1, s.pose.x, s.pose.y));
      }
      if (scale <= 0.0) continue;
      const double jump = norm(pair.force) / scale;
      if (jump <= worst_jump) continue;
      worst_jump = jump;
      jump_at = s.state.time;
      jump_of = key;
    }
  }

  std::uint64_t list_every_;
  std::vector<double> x_, y_;
  std::map<std::pair<Id, Id>, Pair> before_;
};

}  // namespace edda
