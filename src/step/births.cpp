#include "step/births.hpp"

#include <algorithm>
#include <cmath>

#include "contacts/evaluate_face.hpp"
#include "contacts/face_bonds.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/energy_balance.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"

namespace edda {

std::optional<Vec2> displacement_of_walls(const Simulation& sim,
                                          const std::vector<std::uint8_t>& there, Vec2 drawn,
                                          double within) {
  const BlockSet& b = sim.scene->blocks;
  const Pose& pose = sim.motion.pose;
  Vec2 sum;
  int count = 0;
  for (Id i = 0; i < b.size(); ++i) {
    if (there[i] == 0 ||
        norm(drawn - Vec2{b.centroid_x[i], b.centroid_y[i]}) > b.radius[i] + within)
      continue;
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      const Id w = b.next[v];
      const Vec2 from = b.vertex(v), along = b.vertex(w) - from;
      const double s = std::clamp(dot(drawn - from, along) / dot(along, along), 0.0, 1.0);
      if (norm(from + s * along - drawn) > within) continue;
      const auto moved = [&](Id at) { return Vec2{pose.x[at], pose.y[at]} - b.vertex(at); };
      sum += (1.0 - s) * moved(v) + s * moved(w);
      ++count;
    }
  }
  if (count == 0) return {};
  return sum / count;
}

std::vector<Vec2> completed(const std::vector<std::optional<Vec2>>& some, bool closed) {
  const std::size_t n = some.size();
  std::vector<Vec2> all(n);
  for (std::size_t k = 0; k < n; ++k) {
    std::optional<std::size_t> before, after;
    for (std::size_t d = 0; d < n && !(before && after); ++d) {
      if (!before && (closed || d <= k) && some[(k + n - d) % n]) before = d;
      if (!after && (closed || k + d < n) && some[(k + d) % n]) after = d;
    }
    if (!before && !after) continue;
    const Vec2 left = *some[(k + n - before.value_or(n - *after)) % n],
               right = *some[(k + after.value_or(n - *before)) % n];
    const double from = before ? double(*before) : 1.0, to = after ? double(*after) : 1.0;
    const double part = !before ? 1.0 : !after || from + to == 0.0 ? 0.0 : from / (from + to);
    all[k] = (1.0 - part) * left + part * right;
  }
  return all;
}

void place_mesh(Simulation& sim, std::size_t i, const std::vector<Vec2>& node) {
  const BlockSet& b = sim.scene->blocks;
  const Meshes& m = b.meshes;
  Motion& motion = sim.motion;
  State& state = motion.state;
  const std::size_t first = m.begin[i], mode = b.bending.modes();
  AffinePart affine;
  for (std::size_t j = 0; j < node.size(); ++j)
    m.add(affine, first + j, m.share[first + j] * node[j]);
  affine = m.solve(i, affine);
  NodeVectors at;
  for (std::size_t k = 0; k < nodes_per_block; ++k)
    at[k] = affine.one + (b.node_x[k][i] - b.centroid_x[i]) * affine.x +
            (b.node_y[k][i] - b.centroid_y[i]) * affine.y;
  for (BodyVectors* of : {&state.position, &state.reference}) {
    store(at, *of, i);
    for (std::size_t j = 0; j < node.size(); ++j)
      of->modes.set(mode + first + j, node[j] - m.at(affine, first + j));
  }
  set_zero(b, state.velocity, i);
  Pose& pose = motion.pose;
  place_vertices(b, state.position, i, pose.x, pose.y);
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    pose.x1[v] = pose.x2[v] = pose.x[v];
    pose.y1[v] = pose.y2[v] = pose.y[v];
  }
}

namespace {

/// Whether face k of fill is of edges that touch as drawn.
bool is_drawn_closed(const FaceSet& faces, const BlockSet& b, double width, std::size_t k) {
  constexpr double rounding = 1e-3;
  const Face face = face_at(faces, b, b.vertex_x, b.vertex_y, k);
  const FaceEnds apart = face.drawn;
  return face.length > 0.0 && std::max(std::abs(apart.a), std::abs(apart.b)) <= rounding * width;
}

/// Faces of these blocks are closed without force and have the strength of edges that touch as
/// drawn: those of linings where there is less than half their thickness between the edges, or an
/// overlap; those of fill where they touch as drawn, whatever the walls have done since. Where they
/// overlap by now, they are without force, too.
void close_faces(Simulation& sim, FaceSet& faces, FaceStates& states,
                 const std::vector<std::uint8_t>& born) {
  const BlockSet& b = sim.scene->blocks;
  const Pose& pose = sim.motion.pose;
  for (std::size_t k = 0; k < faces.size(); ++k) {
    const Id one = b.vertex_block[faces.edge[k]], other = b.vertex_block[faces.facing[k]];
    if (born[one] == 0 && born[other] == 0) continue;
    const Id own = born[one] != 0 ? one : other;
    const Face face = face_at(faces, b, pose.x, pose.y, k);
    const FaceEnds now = face.drawn;
    if (!(face.length > 0.0)) continue;
    const bool fits = b.is_fill(own) ? is_drawn_closed(faces, b, b.inradius[own], k)
                                     : std::min(now.a, now.b) >= -b.inradius[own];
    if (!fits && (!b.is_fill(own) || std::max(now.a, now.b) <= 0.0)) continue;
    faces.locked_closure_a[k] = fits ? -now.a : -std::max(now.a, 0.0);
    faces.locked_closure_b[k] = fits ? -now.b : -std::max(now.b, 0.0);
    faces.set(FaceFlag::acts, k);
    faces.set(FaceFlag::leans, k);
    states.before[k].gate = face.gate;
  }
  bond_faces(faces, states, b, pose, sim.motion.laws, &born);
}

}  // namespace

void begin_blocks(Simulation& sim, const std::vector<Id>& blocks) {
  const AsExternalWork work(sim);
  Motion& motion = sim.motion;
  std::vector<std::uint8_t> born(sim.scene->blocks.size(), 0);
  for (const Id i : blocks) born[i] = motion.state.alive[i] = 1;
  sim.control.near_edges = NearEdges();  // those near each other without these blocks
  search(sim, next_reach(sim));
  change_faces(sim,
               [&](FaceSet& faces, FaceStates& states) { close_faces(sim, faces, states, born); });
  reevaluate_faces(sim);
}

}  // namespace edda
