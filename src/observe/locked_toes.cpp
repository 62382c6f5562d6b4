#include "observe/locked_toes.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <numeric>

#include "step/labels.hpp"

namespace edda {
namespace {

constexpr double pi = std::numbers::pi;
constexpr double flat = pi / 180.0;      // below it, edges form one straight line
constexpr double open_air = 5.0 * flat;  // below it, the gap is an open joint
constexpr double one_point = 1e-6;       // of the shorter edge

/// The rock of one block around a point: from the direction of the edge that starts there,
/// counter-clockwise over its interior angle.
struct Sector {
  Id vertex;
  double start, end;  ///< rad
};

/// The sectors of the vertices at one point, counter-clockwise by their start.
std::vector<Sector> sectors_at(const BlockSet& b, const std::vector<Id>& vertices) {
  std::vector<Sector> sectors;
  for (const Id v : vertices) {
    const Vec2 along = b.vertex(b.next[v]) - b.vertex(v);
    const double start = std::atan2(along.y, along.x);
    sectors.push_back({v, start, start + b.corner[v]});
  }
  std::sort(sectors.begin(), sectors.end(),
            [](const Sector& p, const Sector& q) { return p.start < q.start; });
  return sectors;
}

/// Checks the tip `v` of a block between the joint under it, which runs along `edge` to the vertex
/// `other`, and a gap of `gap` rad. The extension of the joint beyond the tip makes the exterior
/// angle of the tip with its free side; where the gap is smaller, the joint runs into rock.
void look_at_tip(const Simulation& sim, Id v, Id edge, Id other, double gap,
                 std::vector<LockedToe>& found) {
  const BlockSet& b = sim.scene->blocks;
  const Id i = b.vertex_block[v];
  const double into = pi - b.corner[v] - gap;
  if (b.fixed[i] != 0 || into <= flat) return;
  const Vec2 ahead = unit(b.vertex(v) - b.vertex(other));
  if (dot(ahead, sim.scene->model.gravity) <= std::sin(flat) * norm(sim.scene->model.gravity))
    return;
  found.push_back({i, v, b.edge_joint[edge], into});
}

void look_at_point(const Simulation& sim, const std::vector<Id>& vertices,
                   std::vector<LockedToe>& found) {
  if (vertices.size() < 2) return;
  const BlockSet& b = sim.scene->blocks;
  const std::vector<Sector> sectors = sectors_at(b, vertices);
  const std::size_t n = sectors.size();
  const auto gap_after = [&](std::size_t q) {
    const double next = sectors[(q + 1) % n].start + (q + 1 == n ? 2.0 * pi : 0.0);
    return next - sectors[q].end;
  };
  for (std::size_t q = 0; q < n; ++q) {
    const double gap = gap_after(q);
    if (gap < open_air) continue;
    // Each of the two blocks beside the gap is checked if its other side is a closed joint.
    const Id before = sectors[q].vertex, after = sectors[(q + 1) % n].vertex;
    if (gap_after((q + n - 1) % n) < flat)
      look_at_tip(sim, before, before, b.next[before], gap, found);
    if (gap_after((q + 1) % n) < flat)
      look_at_tip(sim, after, b.previous[after], b.previous[after], gap, found);
  }
}

}  // namespace

std::vector<LockedToe> locked_toes(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<Id> order(b.vertex_count());
  std::iota(order.begin(), order.end(), Id{0});
  std::sort(order.begin(), order.end(), [&](Id p, Id q) {
    const Vec2 a = b.vertex(p), c = b.vertex(q);
    return a.x != c.x ? a.x < c.x : a.y != c.y ? a.y < c.y : p < q;
  });
  const auto near = [&](Id v) {
    return one_point * std::min(b.edge_length[v], b.edge_length[b.previous[v]]);
  };
  std::vector<LockedToe> found;
  std::vector<std::uint8_t> seen(b.vertex_count(), 0);
  std::vector<Id> here;
  for (std::size_t q = 0; q < order.size(); ++q) {
    if (seen[order[q]] != 0) continue;
    const Vec2 p = b.vertex(order[q]);
    here.clear();
    for (std::size_t r = q; r < order.size(); ++r) {
      const double tolerance = std::min(near(order[q]), near(order[r]));
      const Vec2 apart = b.vertex(order[r]) - p;
      if (apart.x > near(order[q])) break;
      if (seen[order[r]] != 0 || norm(apart) > tolerance) continue;
      seen[order[r]] = 1;
      here.push_back(order[r]);
    }
    look_at_point(sim, here, found);
  }
  std::sort(found.begin(), found.end(),
            [](const LockedToe& p, const LockedToe& q) { return p.vertex < q.vertex; });
  return found;
}

void warn_of_locked_toes(const Simulation& sim, std::vector<std::string>& warnings) {
  const std::vector<LockedToe> toes = locked_toes(sim);
  if (toes.empty()) return;
  const LockedToe& toe = toes.front();
  const BlockSet& b = sim.scene->blocks;
  const std::string joint = toe.joint == none
                                ? std::string("joint")
                                : sim.scene->model.joints[static_cast<std::size_t>(toe.joint)].name;
  warnings.push_back(fmt::format(
      "the {} under {} daylights at {} in a re-entrant corner of the ground: in a run the rock in "
      "front supports the tip of the sliding blocks{}, while as rigid blocks they slide; let the "
      "joint daylight above the corner, by more than the blocks are to slide",
      joint, block_label(b, toe.block), place_label(b.vertex(toe.vertex) + b.origin),
      toes.size() == 1 ? std::string{} : fmt::format(" ({} such places)", toes.size())));
}

}  // namespace edda
