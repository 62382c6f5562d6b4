// Fill that comes into being between two steps.
#include <algorithm>
#include <cmath>

#include "base/polygon.hpp"
#include "cutting/overlaps.hpp"
#include "step/births.hpp"
#include "step/changes.hpp"
#include "step/labels.hpp"
#include "step/simulation.hpp"
#include "step/step_control.hpp"

namespace edda {
namespace {

/// Corners of the rings of block i, ring after ring, as drawn.
std::vector<Ring> drawn_rings(const BlockSet& b, std::size_t i) {
  std::vector<Ring> rings;
  for (Id first = b.vertex_begin[i]; first < b.vertex_begin[i + 1];) {
    Ring& ring = rings.emplace_back();
    for (Id v = first; ring.empty() || v != first; v = b.next[v]) ring.push_back(b.vertex(v));
    first += static_cast<Id>(ring.size());
  }
  return rings;
}

/// Displacements of the corners of block i with what is there; where a corner touches nothing, from
/// the nearest on its ring that do. Empty: none does.
std::vector<Vec2> moves_of_corners(const Simulation& sim, const std::vector<std::uint8_t>& there,
                                   std::size_t i, const std::vector<Ring>& rings) {
  constexpr double rounding = 1e-3;  // of half the width
  const double within = rounding * sim.scene->blocks.inradius[i];
  std::vector<Vec2> moves;
  bool any = false;
  for (const Ring& ring : rings) {
    std::vector<std::optional<Vec2>> some;
    for (const Vec2 p : ring) some.push_back(displacement_of_walls(sim, there, p, within));
    any = any || std::any_of(some.begin(), some.end(), [](const auto& m) { return m.has_value(); });
    const std::vector<Vec2> all = completed(some, true);
    moves.insert(moves.end(), all.begin(), all.end());
  }
  return any ? moves : std::vector<Vec2>{};
}

/// Interpolation at p between values at the corners of a polygon, exact where these are linear
/// (mean value coordinates; Hormann and Floater 2006):
///   sum w_v u_v / sum w_v,  w_v = (tan(a_v-1 / 2) + tan(a_v / 2)) / |x_v - p|,
/// a_v the angle at which edge v is seen from p.
Vec2 between_corners(const std::vector<Ring>& rings, const std::vector<Vec2>& values, Vec2 p) {
  Vec2 sum;
  double weights = 0.0;
  std::size_t first = 0;
  for (const Ring& ring : rings) {
    const std::size_t n = ring.size();
    const auto half_tangent = [&](std::size_t k) {
      const Vec2 a = ring[k % n] - p, b = ring[(k + 1) % n] - p;
      return std::tan(0.5 * std::atan2(cross(a, b), dot(a, b)));
    };
    for (std::size_t k = 0; k < n; ++k) {
      const double w = (half_tangent(k + n - 1) + half_tangent(k)) / norm(ring[k] - p);
      sum += w * values[first + k];
      weights += w;
    }
    first += n;
  }
  return sum / weights;
}

/// Where the mesh nodes of block i are when its corners are moved so; its corners come first.
std::vector<Vec2> moved_nodes(const BlockSet& b, std::size_t i, const std::vector<Ring>& rings,
                              const std::vector<Vec2>& moves) {
  const Vec2 centroid{b.centroid_x[i], b.centroid_y[i]};
  std::vector<Vec2> node = arms_of(b.meshes, i);
  for (std::size_t j = 0; j < node.size(); ++j) {
    node[j] += centroid;
    node[j] += j < moves.size() ? moves[j] : between_corners(rings, moves, node[j]);
  }
  return node;
}

/// Block i where it is.
BlockPolygon polygon_now(const Simulation& sim, std::size_t i) {
  BlockPolygon block;
  block.rings = drawn_rings(sim.scene->blocks, i);
  Id v = sim.scene->blocks.vertex_begin[i];
  for (Ring& ring : block.rings) {
    for (Vec2& p : ring) {
      p = {sim.motion.pose.x[v], sim.motion.pose.y[v]};
      ++v;
    }
  }
  return block;
}

/// A block that lies where fill i has been placed: they overlap by more than half of its
/// half-width, or of that of the fill.
std::optional<Id> block_within(const Simulation& sim, std::size_t i) {
  const BlockSet& b = sim.scene->blocks;
  const State& state = sim.motion.state;
  const BlockPolygon placed = polygon_now(sim, i);
  for (Id j = 0; j < b.size(); ++j) {
    if (state.alive[j] == 0 || b.is_lining(j)) continue;
    const double apart = norm(centroid(state.position, i) - centroid(state.position, j));
    if (apart > 1.1 * (b.radius[i] + b.radius[j])) continue;
    const double most = 0.5 * std::min(b.inradius[i], b.inradius[j]);
    if (overlap_depth(placed, polygon_now(sim, j)) > most) return j;
  }
  return {};
}

Fault without_room(const Simulation& sim, std::size_t i, const std::string& problem) {
  const Fill& fill = sim.scene->model.fills[static_cast<std::size_t>(sim.scene->blocks.fill[i])];
  return {fill.where, "there is no room for \"" + fill.name + "\": " + problem,
          "place it earlier, support the rock, or give it a polygon where there is room"};
}

/// Places those of the blocks that wait and touch what is there; all, as drawn, where none does.
/// The rest goes on waiting.
std::optional<Fault> place_next(Simulation& sim, std::vector<std::uint8_t>& there,
                                std::vector<Id>& waiting) {
  const BlockSet& b = sim.scene->blocks;
  std::vector<Id> later, placed;
  std::vector<std::vector<Vec2>> nodes;
  for (const Id i : waiting) {
    const std::vector<Ring> rings = drawn_rings(b, i);
    const std::vector<Vec2> moves = moves_of_corners(sim, there, i, rings);
    if (moves.empty()) {
      later.push_back(i);
      continue;
    }
    placed.push_back(i);
    nodes.push_back(moved_nodes(b, i, rings, moves));
  }
  if (placed.empty()) later.clear();
  for (std::size_t k = 0; k < placed.size(); ++k) place_mesh(sim, placed[k], nodes[k]);
  for (const Id i : placed.empty() ? waiting : placed) {
    there[i] = 1;
    if (!begin_fill(sim.scene->zones, b, sim.motion.state, i, sim.motion.zones))
      return without_room(sim, i, "the walls have moved too far for its zones");
    if (const auto other = block_within(sim, i))
      return without_room(sim, i, block_label(b, *other) + " has moved into it");
  }
  waiting = std::move(later);
  return {};
}

}  // namespace

std::optional<Fault> place_fills(Simulation& sim, const std::vector<Index>& rows) {
  const BlockSet& b = sim.scene->blocks;
  const Owners owners(sim.scene->model);
  std::vector<Id> waiting;
  for (Id i = 0; i < b.size(); ++i) {
    if (b.is_fill(i) && std::find(rows.begin(), rows.end(), b.fill[i]) != rows.end())
      waiting.push_back(i);
  }
  const std::vector<Id> born = waiting;
  std::vector<std::uint8_t> there = sim.motion.state.alive;
  while (!waiting.empty()) {
    if (auto fault = place_next(sim, there, waiting)) return fault;
  }
  for (const Id i : born)
    sim.attached.springs.engage_block(i, sim.motion.pose.x, sim.motion.pose.y);
  const State& state = sim.motion.state;
  // At the start of a run all weights are applied gradually.
  for (const Index row : rows) {
    SteppedValue& carried =
        sim.attached.loads.remaining[static_cast<std::size_t>(owners.of_weight(row))];
    carried = state.steps == 0 ? SteppedValue{} : SteppedValue{0.0, 1.0, state.time};
  }
  begin_blocks(sim, born);
  set_limit(sim);
  return {};
}

}  // namespace edda
