#include "observe/cannot_rest.hpp"

#include <algorithm>
#include <cmath>

#include "observe/observe.hpp"
#include "step/faces_now.hpp"

namespace edda {
namespace {

/// Force, and moment over the size of the block.
struct Wrench {
  Vec2 force;
  double moment = 0.0;
};

double product(const Wrench& a, const Wrench& b) {
  return dot(a.force, b.force) + a.moment * b.moment;
}

/// The smallest part of `load` that no sum of these forces with factors of at least 0 carries.
double part_not_carried(const std::vector<Wrench>& forces, const Wrench& load) {
  constexpr int sweeps = 400;
  const double all = product(load, load);
  Wrench rest = load;
  std::vector<double> factor(forces.size(), 0.0);
  for (int n = 0; n < sweeps && product(rest, rest) > 1e-8 * all; ++n) {
    for (std::size_t j = 0; j < forces.size(); ++j) {
      const Wrench& f = forces[j];
      const double next = std::max(0.0, factor[j] - product(f, rest) / product(f, f));
      rest.force += (next - factor[j]) * f.force;
      rest.moment += (next - factor[j]) * f.moment;
      factor[j] = next;
    }
  }
  return std::sqrt(product(rest, rest) / all);
}

/// Per block, the forces of its faces at the limit of friction in both directions, and whether
/// something else than friction holds it.
struct Supports {
  std::vector<std::vector<Wrench>> forces;
  std::vector<std::uint8_t> held;
};

Supports supports_of(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const FaceSet& f = sim.motion.contacts;
  Supports s{std::vector<std::vector<Wrench>>(b.size()), b.fixed};
  for (std::size_t k = 0; k < f.size(); ++k) {
    const FaceRow row = face_row(sim, k);
    if (!meets(row)) continue;
    const Id one = block_of_edge(b, f, k), other = block_of_facing(b, f, k);
    const bool glued = f.cohesion[k] > 0.0 || f.glued(k) || f.carries_tension(k);
    if (glued) s.held[one] = s.held[other] = 1;
    const Vec2 t = unit(Vec2{sim.motion.pose.x[f.edge_end[k]] - sim.motion.pose.x[f.edge[k]],
                             sim.motion.pose.y[f.edge_end[k]] - sim.motion.pose.y[f.edge[k]]});
    const FaceSpan span = span_of(row, sim.motion.pose);
    for (const Vec2 at : {span.a, span.b}) {
      for (const double slip : {-1.0, 1.0}) {
        const Vec2 on = outward_normal(t) + slip * f.friction[k] * t;
        const auto add = [&](Id i, Vec2 force) {
          const Vec2 arm = at - Vec2{b.centroid_x[i], b.centroid_y[i]};
          s.forces[i].push_back({force, cross(arm, force) / std::sqrt(b.area[i])});
        };
        add(other, on);
        add(one, -on);
      }
    }
  }
  const BoundarySprings& springs = sim.attached.springs;
  for (std::size_t q = 0; q < springs.size(); ++q) s.held[b.vertex_block[springs.vertex[q]]] = 1;
  for (const Id host : sim.attached.bolts.host) s.held[host] = 1;
  return s;
}

}  // namespace

bool some_block_moves(const Simulation& sim) {
  constexpr double much = 5e-3;  // as on a slope a third of a degree steeper than friction
  const BlockSet& b = sim.scene->blocks;
  const Supports s = supports_of(sim);
  const LoadsNow now = loads_at(sim.scene->model, sim.attached.loads, 0.0);
  for (Id i = 0; i < b.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) continue;
    if (vectors_of(sim.motion.state.velocity, i) != NodeVectors{}) return true;
    if (s.held[i]) continue;
    const Vec2 load = b.mass[i] * sim.scene->model.gravity + load_on(b, now, sim.motion.pose, i);
    if (load == Vec2{} || s.forces[i].empty()) continue;  // what touches nothing falls first
    const double size = norm(load);
    if (part_not_carried(s.forces[i], {load / size, 0.0}) > much) return true;
  }
  return false;
}

}  // namespace edda
