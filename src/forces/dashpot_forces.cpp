#include "forces/dashpot_forces.hpp"

#include <algorithm>

#include "forces/block_matrices.hpp"

namespace edda {
namespace {

bool acts(const Dashpots& d, const Dashpot& at) {
  return d.acts[static_cast<std::size_t>(at.boundary)] != 0;
}

/// sum over the points of w w^T (x) C.
NodalMatrix damping_matrix(const Dashpots& d, Id first, Id last) {
  NodalMatrix m = NodalMatrix::Zero();
  for (Id p = first; p < last; ++p) {
    const Dashpot& at = d.points[p];
    if (!acts(d, at)) continue;
    Eigen::Matrix2d c;
    c << at.cxx, at.cxy, at.cxy, at.cyy;
    add_at(m, at.weight, c);
  }
  return m;
}

Vec2 times(const Dashpot& at, Vec2 v) {
  return {at.cxx * v.x + at.cxy * v.y, at.cxy * v.x + at.cyy * v.y};
}

Vec2 push_of(const DashpotStep& step, std::size_t p) {
  return step.push.empty() ? Vec2{} : step.push[p];
}

void spread_to(NodalForces& forces, const Dashpot& at, Vec2 force) {
  NodeVectors f = vectors_of(forces.x, forces.y, at.block);
  spread(f, at.weight, force);
  store(f, forces.x, forces.y, at.block);
}

}  // namespace

void add_dashpots(NodalForces& forces, std::vector<Vec2>& on_point, const Dashpots& d,
                  const DashpotScene& scene, const DashpotStep& step, std::size_t begin,
                  std::size_t end) {
  const BlockSet& b = scene.blocks;
  const State& state = scene.state;
  const auto first = std::lower_bound(d.blocks.begin(), d.blocks.end(), static_cast<Id>(begin));
  for (auto it = first; it != d.blocks.end() && *it < end; ++it) {
    const Id i = *it;
    const auto q = static_cast<std::size_t>(it - d.blocks.begin());
    if (!state.alive[i] || !std::binary_search(d.damped.begin(), d.damped.end(), i)) {
      std::fill(on_point.begin() + d.begin[q], on_point.begin() + d.begin[q + 1], Vec2{});
      continue;
    }
    const NodalMatrix mass = mass_matrix(scene.masses, i);
    const NodalMatrix c = damping_matrix(d, d.begin[q], d.begin[q + 1]);
    const NodalVector before = nodal(scene.vx, scene.vy, i);
    NodalVector push = nodal(forces.x, forces.y, i);
    for (Id p = d.begin[q]; p < d.begin[q + 1]; ++p) {
      if (!acts(d, d.points[p])) continue;
      push += along(d.points[p].weight, times(d.points[p], step.reference[p]) + push_of(step, p));
    }
    const NodalVector right =
        (1.0 - step.half_damping_of(i)) * (mass * before) + step.h * (push - 0.5 * c * before);
    const NodalMatrix strain =
        viscous_matrix(b, scene.masses, i, deformation(b, state.x, state.y, i));
    const NodalMatrix left =
        (1.0 + step.half_damping_of(i)) * mass + (0.5 * step.h) * c + step.h * strain;
    const NodeVectors mean =
        vectors_of(0.5 * (before + Eigen::LLT<NodalMatrix>(left).solve(right)));
    for (Id p = d.begin[q]; p < d.begin[q + 1]; ++p) {
      const Dashpot& at = d.points[p];
      on_point[p] = {};
      if (!acts(d, at)) continue;
      const Vec2 v = weighted(at.weight, mean);
      on_point[p] = push_of(step, p) - times(at, v - step.reference[p]);
      spread_to(forces, at, on_point[p]);
    }
  }
}

void remove_dashpots(NodalForces& forces, const std::vector<Vec2>& on_point, const Dashpots& d) {
  for (std::size_t p = 0; p < d.points.size(); ++p) {
    spread_to(forces, d.points[p], -on_point[p]);
  }
}

}  // namespace edda
