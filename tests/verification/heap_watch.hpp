// Checks in every step of a run that contact forces are continuous and the list of contacts is
// complete.
#pragma once

#include <map>

#include "contacts/face_reading.hpp"
#include "contacts/oracle.hpp"
#include "verification/scene.hpp"

namespace edda {

/// Call look() after every step. Force of a pair of blocks: that of all faces between them on the
/// block of lower number.
class HeapWatch {
 public:
  double worst_jump = 0.0;  ///< change of a pair's force in a step over the sum of k L |u|, u how
                            ///< far its edges have moved in the step, one against the other
  ListFaults list;          ///< summed over the steps that were checked
  double jump_at = 0.0;     ///< s
  std::pair<Id, Id> jump_of{};

  explicit HeapWatch(std::uint64_t list_every) : list_every_(list_every) {}

  void look(const Simulation& s) {
    const FaceSet& c = s.motion.contacts;
    std::map<std::pair<Id, Id>, Pair> now;
    for (std::size_t k = 0; k < c.size(); ++k) {
      const FaceRow row = face_row(s, k);
      if (!is_closed(row)) continue;
      const Id i = block_of_edge(s.scene->blocks, c, k), j = block_of_facing(s.scene->blocks, c, k);
      Pair& pair = now[std::minmax(i, j)];
      pair.force += (j < i ? 1.0 : -1.0) * force_on_facing(row);
      const double spring = std::max(c.stiffness[k], c.shear_stiffness[k]) * row.state.length;
      pair.faces.push_back({{c.edge[k], c.edge_end[k]}, {c.facing[k], c.facing_end[k]}, spring});
    }
    if (!x_.empty()) compare(s, now);
    before_ = std::move(now);
    x_ = s.motion.pose.x;
    y_ = s.motion.pose.y;
    if (s.motion.state.steps % list_every_ != 0) return;
    const ListFaults f =
        check_list(c, s.scene->blocks, s.motion.state.alive, s.motion.pose.x, s.motion.pose.y);
    list.wanted += f.wanted;
    list.missed += f.missed;
    list.repeated += f.repeated;
  }

 private:
  struct Contact {
    Id edge[2], facing[2];
    double spring;  ///< N/m
  };
  struct Pair {
    Vec2 force;
    std::vector<Contact> faces;
  };

  /// Largest relative displacement of a corner of one edge and a corner of the other, m.
  double moved(const Contact& c, const Pose& pose) const {
    double most = 0.0;
    const auto way = [&](Id v) { return at(pose.x, pose.y, v) - at(x_, y_, v); };
    for (const Id p : c.edge) {
      for (const Id q : c.facing) most = std::max(most, norm(way(p) - way(q)));
    }
    return most;
  }

  void compare(const Simulation& s, const std::map<std::pair<Id, Id>, Pair>& now) {
    std::map<std::pair<Id, Id>, Pair> all = now;
    for (const auto& [key, pair] : before_) {
      Pair& p = all[key];
      p.faces.insert(p.faces.end(), pair.faces.begin(), pair.faces.end());
      p.force -= pair.force;
    }
    for (const auto& [key, pair] : all) {
      double scale = 0.0;
      for (const Contact& c : pair.faces) scale += c.spring * moved(c, s.motion.pose);
      if (scale <= 0.0) continue;
      const double jump = norm(pair.force) / scale;
      if (jump <= worst_jump) continue;
      worst_jump = jump;
      jump_at = s.motion.state.time;
      jump_of = key;
    }
  }

  std::uint64_t list_every_;
  std::vector<double> x_, y_;
  std::map<std::pair<Id, Id>, Pair> before_;
};

}  // namespace edda
