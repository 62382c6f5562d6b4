#include "paper/points.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include "contacts/joint_strength.hpp"
#include "contacts/search.hpp"

namespace edda {
namespace {

Id block_of_vertex(const PointSet& c, const BlockSet& b, std::size_t k) {
  return b.vertex_block[c.vertex[k]];
}
Id block_of_edge(const PointSet& c, const BlockSet& b, std::size_t k) {
  return b.vertex_block[c.edge[k]];
}

bool on_edge(const PointGap& g) {
  constexpr double rounding = 1e-9;
  return g.along >= -rounding * g.length && g.along <= (1.0 + rounding) * g.length;
}

/// A vertex enters from outside: both its neighbours on its block lie outside the edge, up to 6
/// degrees.
bool enters_from_outside(const PointSet& c, const BlockSet& b, const Pose& pose, const PointGap& g,
                         std::size_t k) {
  constexpr double leans = 0.1;
  const Id v = c.vertex[k];
  const Vec2 n = outward_normal(g.tangent);
  for (const Id w : {b.previous[v], b.next[v]}) {
    const Vec2 away = at(pose.x, pose.y, w) - at(pose.x, pose.y, v);
    if (dot(away, n) < -leans * norm(away)) return false;
  }
  return true;
}

/// First entrance: a vertex is in contact with one edge of a block, and keeps that edge until it
/// opens or runs off its end; a new contact is made with the entered edge of least penetration.
/// Returns the number of the contact in [first, end), all of one vertex and one block; `end`: none.
std::size_t entrance(const PointSet& c, const BlockSet& b, const Pose& pose, std::size_t first,
                     std::size_t end) {
  std::size_t found = end;
  double least =
      std::min(b.inradius[block_of_vertex(c, b, first)], b.inradius[block_of_edge(c, b, first)]);
  for (std::size_t k = first; k < end; ++k) {
    const PointGap g = gap_of(c, b, pose, k);
    if (!(g.depth > 0.0) || !on_edge(g)) continue;
    if (c.closed[k] > 0.0) return k;
    if (g.depth < least && enters_from_outside(c, b, pose, g, k)) {
      least = g.depth;
      found = k;
    }
  }
  return found;
}

/// N = p_n d_n (Eq. 30). T = -p_t s, s = (P1 - P0).t (Eqs. 34, 36); where that exceeds friction,
/// F_0 = N tan(phi) sgn(s) replaces it and P0 moves along (Eqs. 37, 38).
/// Energy between two steps: N_{n-1} N_n/(2 p_n) + T_{n-1} T_n/(2 p_t), T_n before it is cut.
void press(PointSet& c, const PointGap& g, double friction, std::size_t k) {
  const double normal_before = c.normal[k], shear_before = c.shear[k];
  const double normal = c.stiffness * g.depth;
  const double trial = -c.shear_stiffness * (g.along - c.position[k] * g.length);
  const double limit = coulomb_limit(0.0, friction, normal);
  const bool slides = std::abs(trial) > limit;
  const double shear = slides ? std::copysign(limit, trial) : trial;
  if (slides) c.position[k] = (g.along + shear / c.shear_stiffness) / g.length;
  c.normal[k] = normal;
  c.shear[k] = shear;
  c.slides[k] = slides ? 1.0 : 0.0;
  if (slides) c.slipped[k] = 1.0;
  c.energy +=
      0.5 * normal_before * normal / c.stiffness + 0.5 * shear_before * trial / c.shear_stiffness;
  c.due += 0.5 * (trial - shear) * (shear_before + shear) / c.shear_stiffness;
  c.deepest = std::max(c.deepest, g.depth);
}

/// One past the last contact that has the vertex and the block of the one at `first`.
std::size_t end_of_group(const PointSet& c, const BlockSet& b, std::size_t first) {
  std::size_t end = first + 1;
  while (end < c.size() && c.vertex[end] == c.vertex[first] &&
         block_of_edge(c, b, end) == block_of_edge(c, b, first))
    ++end;
  return end;
}

/// Lists one spring on each side for each vertex and other block, at the nearest of the edges that
/// the vertex may enter.
void list_springs(PointSet& c, const BlockSet& b, const Pose& pose) {
  std::vector<std::pair<Id, SpringOnBlock>> springs;
  const auto add = [&](Id block, const NodeWeights& weight, Id against) {
    // In both directions, since it is not known which edge the vertex will meet.
    const double p = (b.fixed[against] != 0 ? 1.0 : 2.0) * std::max(c.stiffness, c.shear_stiffness);
    springs.push_back({block, {no_id, no_id, weight, {1.0, 0.0}, {0.0, 1.0}, p, p, 0.0, 0.0}});
  };
  for (std::size_t first = 0, end = 0; first < c.size(); first = end) {
    end = end_of_group(c, b, first);
    double nearest = std::numeric_limits<double>::infinity(), xi = 0.0;
    Id edge = no_id;
    for (std::size_t k = first; k < end; ++k) {
      const PointGap g = gap_of(c, b, pose, k);
      const double beyond = std::max({-g.along, g.along - g.length, 0.0});
      const double distance = std::hypot(g.depth, beyond);
      if (!(distance < nearest) || !enters_from_outside(c, b, pose, g, k)) continue;
      nearest = distance;
      edge = c.edge[k];
      xi = std::clamp(g.along / g.length, 0.0, 1.0);
    }
    if (edge == no_id) continue;
    const Id i = block_of_vertex(c, b, first), j = b.vertex_block[edge];
    add(i, weights_of(b.weight, c.vertex[first]), j);
    add(j, weights_between(b, edge, b.next[edge], xi), i);
  }
  std::stable_sort(springs.begin(), springs.end(),
                   [](const auto& p, const auto& q) { return p.first < q.first; });
  c.springs = {};
  c.springs.begin.assign(b.size() + 1, 0);
  for (const auto& [block, spring] : springs) {
    ++c.springs.begin[block + 1];
    c.springs.springs.push_back(spring);
  }
  for (std::size_t i = 0; i < b.size(); ++i) c.springs.begin[i + 1] += c.springs.begin[i];
}

/// F_i = -p_n S0 H/l, F_j = -p_n S0 G/l with H and G of Eq. 31 (Eq. 30), S0/l the penetration;
/// shear as in Eqs. 34 and 35, on P1 and on P0.
std::vector<NodeVectors> forces_of(const PointSet& c, const BlockSet& b, const Pose& pose) {
  std::vector<NodeVectors> on(b.size(), NodeVectors{});
  for (std::size_t k = 0; k < c.size(); ++k) {
    if (c.closed[k] == 0.0) continue;
    const Id v = c.vertex[k], e = c.edge[k], to = b.next[e];
    const PointGap g = gap_of(c, b, pose, k);
    const Vec2 p1 = at(pose.x, pose.y, v), p2 = at(pose.x, pose.y, e), p3 = at(pose.x, pose.y, to);
    const double pressure = -c.normal[k] / g.length;
    auto& on_edge_block = on[b.vertex_block[e]];
    spread(on[b.vertex_block[v]], b, v, force_on_vertex(c, b, pose, k));
    spread(on_edge_block, b, e, pressure * Vec2{p3.y - p1.y, p1.x - p3.x});
    spread(on_edge_block, b, to, pressure * Vec2{p1.y - p2.y, p2.x - p1.x});
    spread(on_edge_block, weights_between(b, e, to, c.position[k]), g.tangent, -c.shear[k]);
  }
  return on;
}

}  // namespace

PointGap gap_of(const PointSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  const Vec2 p2 = at(pose.x, pose.y, c.edge[k]), p3 = at(pose.x, pose.y, b.next[c.edge[k]]);
  const Vec2 from = at(pose.x, pose.y, c.vertex[k]) - p2;
  const double l = norm(p3 - p2);
  const Vec2 t = (1.0 / l) * (p3 - p2);
  return {-dot(from, outward_normal(t)), dot(from, t), l, t};
}

bool meets(const PointSet& c, const BlockSet& b, const Pose& pose, std::size_t k, double noise) {
  if (c.closed[k] > 0.0) return true;
  const PointGap g = gap_of(c, b, pose, k);
  return std::abs(g.depth) <= noise && on_edge(g) && enters_from_outside(c, b, pose, g, k);
}

Vec2 force_on_vertex(const PointSet& c, const BlockSet& b, const Pose& pose, std::size_t k) {
  const Vec2 t = gap_of(c, b, pose, k).tangent;
  return c.normal[k] * outward_normal(t) + c.shear[k] * t;
}

void find_points(PointSet& c, const BlockSet& b, const State& state, const Pose& pose,
                 const LawTable& laws, double reach) {
  const PointSet old = std::move(c);
  c = PointSet{};
  c.energy = old.energy;
  c.friction = old.friction;
  c.due = old.due;
  c.deepest = old.deepest;
  const std::vector<NearPair> near = near_pairs(b, state.alive, pose.x, pose.y, reach);
  for (const auto column : point_columns) (c.*column).assign(near.size(), 0.0);
  std::size_t q = 0;
  for (std::size_t k = 0; k < near.size(); ++k) {
    const auto [v, e] = near[k];
    c.vertex.push_back(v);
    c.edge.push_back(e);
    const Id before = b.previous[v];
    // The edge of the vertex that is more nearly parallel to the other.
    const PointGap g = gap_of(c, b, pose, k);
    const Vec2 in = at(pose.x, pose.y, before) - at(pose.x, pose.y, v),
               out = at(pose.x, pose.y, b.next[v]) - at(pose.x, pose.y, v);
    const Id own = dot(in, g.tangent) / norm(in) > -dot(out, g.tangent) / norm(out) ? before : v;
    c.law.push_back(laws.resolve_met(b.edge_joint[e], b.edge_joint[own],
                                     b.material[b.vertex_block[e]], b.material[b.vertex_block[v]]));
    while (q < old.size() && std::pair(old.vertex[q], old.edge[q]) < std::pair(v, e)) ++q;
    if (q == old.size() || old.vertex[q] != v || old.edge[q] != e) continue;
    for (const auto column : point_columns) (c.*column)[k] = (old.*column)[q];
    c.law[k] = old.law[q];
  }
  complete_points(c, b, pose, laws);
}

void move_points(PointSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws) {
  c.friction += c.due;
  c.energy = c.due = c.deepest = 0.0;
  for (std::size_t first = 0, end = 0; first < c.size(); first = end) {
    end = end_of_group(c, b, first);
    const std::size_t kept = entrance(c, b, pose, first, end);
    for (std::size_t k = first; k < end; ++k) {
      if (k == kept) {
        const PointGap g = gap_of(c, b, pose, k);
        if (c.closed[k] == 0.0) c.position[k] = g.along / g.length;
        if (c.closed[k] == 0.0 && c.opened[k] == 0.0) c.entered[k] = c.position[k];
        c.closed[k] = 1.0;
        press(c, g, laws.rows[c.law[k]].peak_friction, k);
      } else if (c.closed[k] > 0.0) {
        c.closed[k] = c.normal[k] = c.shear[k] = c.slides[k] = 0.0;
        c.opened[k] = 1.0;
      }
    }
  }
}

void complete_points(PointSet& c, const BlockSet& b, const Pose& pose, const LawTable& laws) {
  c.stiffness = laws.thickness * laws.penalty.normal;
  c.shear_stiffness = laws.thickness * laws.penalty.shear;
  list_springs(c, b, pose);
}

void sum_points(BodyVectors& on, const BlockSet& b, const PointSet& c, const Pose& pose) {
  const std::vector<NodeVectors> forces = forces_of(c, b, pose);
  for (std::size_t i = 0; i < b.size(); ++i) store(forces[i], on, i);
}

}  // namespace edda
