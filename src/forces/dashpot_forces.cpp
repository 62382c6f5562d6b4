#include "forces/dashpot_forces.hpp"

#include <algorithm>

#include "forces/block_matrices.hpp"

namespace edda {
namespace {

bool acts(const Dashpots& d, const Dashpot& at) {
  return d.acts[static_cast<std::size_t>(at.boundary)] != 0;
}

/// sum over the points of w w^T (x) C.
Matrix6 damping_matrix(const Dashpots& d, Id first, Id last) {
  Matrix6 m = Matrix6::Zero();
  for (Id p = first; p < last; ++p) {
    const Dashpot& at = d.points[p];
    if (!acts(d, at)) continue;
    Eigen::Matrix2d c;
    c << at.cxx, at.cxy, at.cxy, at.cyy;
    for (int k = 0; k < 3; ++k) {
      for (int l = 0; l < 3; ++l) {
        m.block<2, 2>(2 * k, 2 * l) +=
            at.weight[static_cast<std::size_t>(k)] * at.weight[static_cast<std::size_t>(l)] * c;
      }
    }
  }
  return m;
}

Vec2 times(const Dashpot& at, Vec2 v) {
  return {at.cxx * v.x + at.cxy * v.y, at.cxy * v.x + at.cyy * v.y};
}

Vec2 push_of(const DashpotStep& step, std::size_t p) {
  return step.push.empty() ? Vec2{} : step.push[p];
}

void spread_to(NodalForces& forces, const Dashpot& at, Vec2 f) {
  for (std::size_t k = 0; k < 3; ++k) {
    forces.x[k][at.block] += at.weight[k] * f.x;
    forces.y[k][at.block] += at.weight[k] * f.y;
  }
}

}  // namespace

void add_dashpots(NodalForces& forces, std::vector<Vec2>& on_point, const Dashpots& d,
                  const BlockSet& b, const State& state, const Nodes& vx, const Nodes& vy,
                  const DashpotStep& step, std::size_t begin, std::size_t end) {
  const auto first = std::lower_bound(d.blocks.begin(), d.blocks.end(), static_cast<Id>(begin));
  for (auto it = first; it != d.blocks.end() && *it < end; ++it) {
    const Id i = *it;
    const auto q = static_cast<std::size_t>(it - d.blocks.begin());
    if (!state.alive[i] || !std::binary_search(d.damped.begin(), d.damped.end(), i)) {
      std::fill(on_point.begin() + d.begin[q], on_point.begin() + d.begin[q + 1], Vec2{});
      continue;
    }
    const Matrix6 mass = mass_matrix(b, i);
    const Matrix6 c = damping_matrix(d, d.begin[q], d.begin[q + 1]);
    const Vector6 before = nodal(vx, vy, i);
    Vector6 push = nodal(forces.x, forces.y, i);
    for (Id p = d.begin[q]; p < d.begin[q + 1]; ++p) {
      if (!acts(d, d.points[p])) continue;
      push += along(d.points[p].weight, times(d.points[p], step.reference[p]) + push_of(step, p));
    }
    const Vector6 right = (1.0 - step.drag) * (mass * before) + step.h * (push - 0.5 * c * before);
    const Matrix6 strain = viscous_matrix(b, i, deformation(b, state.x, state.y, i));
    const Matrix6 left = (1.0 + step.drag) * mass + (0.5 * step.h) * c + step.h * strain;
    const Vector6 mean = 0.5 * (before + Eigen::LLT<Matrix6>(left).solve(right));
    for (Id p = d.begin[q]; p < d.begin[q + 1]; ++p) {
      const Dashpot& at = d.points[p];
      on_point[p] = {};
      if (!acts(d, at)) continue;
      Vec2 v;
      for (std::size_t k = 0; k < 3; ++k) {
        const auto n = static_cast<Eigen::Index>(2 * k);
        v += at.weight[k] * Vec2{mean[n], mean[n + 1]};
      }
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
