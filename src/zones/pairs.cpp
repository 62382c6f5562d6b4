#include "zones/pairs.hpp"

#include <algorithm>
#include <array>
#include <map>
#include <tuple>

namespace edda {
namespace {

using Neighbours = std::vector<std::vector<std::uint32_t>>;

/// Partners of the triangles.
class Matching {
 public:
  explicit Matching(const Neighbours& neighbours)
      : neighbours_(neighbours),
        partner_(neighbours.size(), no_partner),
        reached_(neighbours.size(), no_partner) {}

  void match(std::uint32_t one, std::uint32_t other) {
    if (partner_[one] != no_partner || partner_[other] != no_partner) return;
    partner_[one] = other;
    partner_[other] = one;
  }
  /// Gives a triangle without one a partner, where others change theirs along a path that ends at
  /// another triangle without one.
  void find_partner(std::uint32_t t) {
    if (partner_[t] == no_partner) augment(t, t, longest);
  }
  std::uint32_t partner(std::uint32_t t) const { return partner_[t]; }

 private:
  static constexpr int longest = 12;  // pairs along a path

  bool augment(std::uint32_t t, std::uint32_t start, int left) {
    reached_[t] = start;
    for (const std::uint32_t n : neighbours_[t]) {
      if (reached_[n] == start) continue;
      const std::uint32_t next = partner_[n];
      if (next == no_partner || (left > 0 && reached_[next] != start)) {
        reached_[n] = start;
        if (next == no_partner || augment(next, start, left - 1)) {
          partner_[t] = n;
          partner_[n] = t;
          return true;
        }
      }
    }
    return false;
  }

  const Neighbours& neighbours_;
  std::vector<std::uint32_t> partner_, reached_;
};

}  // namespace

std::vector<std::pair<std::uint32_t, std::uint32_t>> pair_triangles(const Mesh& mesh) {
  std::map<std::pair<std::uint32_t, std::uint32_t>, std::uint32_t> of_edge;
  // How good, both triangles.
  std::vector<std::tuple<double, std::uint32_t, std::uint32_t>> candidates;
  const auto square = [&](std::uint32_t a, std::uint32_t b) {
    const Vec2 u = mesh.nodes[a] - mesh.nodes[b];
    return dot(u, u);
  };
  const auto around = [&](std::uint32_t t) {
    const Triangle& n = mesh.triangles[t];
    return square(n[0], n[1]) + square(n[1], n[2]) + square(n[2], n[0]);
  };
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    for (std::size_t k = 0; k < mesh.triangles[t].size(); ++k) {
      const std::uint32_t from = mesh.triangles[t][k],
                          to = mesh.triangles[t][(k + 1) % mesh.triangles[t].size()];
      const auto other = of_edge.find({to, from});
      if (other == of_edge.end()) {
        of_edge[{from, to}] = t;
        continue;
      }
      const double shared = square(from, to);
      candidates.push_back({-shared / (around(t) + around(other->second)), other->second, t});
    }
  }
  std::sort(candidates.begin(), candidates.end());
  Neighbours neighbours(mesh.triangles.size());
  for (const auto& [order, one, other] : candidates) {
    neighbours[one].push_back(other);
    neighbours[other].push_back(one);
  }
  Matching matching(neighbours);
  for (const auto& [order, one, other] : candidates) matching.match(one, other);
  std::vector<std::pair<std::uint32_t, std::uint32_t>> pairs;
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) matching.find_partner(t);
  for (std::uint32_t t = 0; t < mesh.triangles.size(); ++t) {
    if (matching.partner(t) > t) pairs.push_back({t, matching.partner(t)});  // or none
  }
  std::sort(pairs.begin(), pairs.end());
  return pairs;
}

}  // namespace edda
