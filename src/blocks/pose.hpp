// Vertex positions, derived from the nodes: at the current step and at the two steps before.
#pragma once

#include <vector>

#include "blocks/kinematics.hpp"

namespace edda {

struct Pose {
  std::vector<double> x, y;              ///< [nv] at step n, m
  std::vector<double> x1, y1;            ///< [nv] at step n - 1, m
  std::vector<double> x2 = {}, y2 = {};  ///< [nv] at step n - 2, m
};

/// Position of vertex v.
inline Vec2 at(const std::vector<double>& x, const std::vector<double>& y, Id v) {
  return {x[v], y[v]};
}

/// Computes the vertices of block i from its nodes (Eq. 19) and modes. Of velocities: those of the
/// vertices.
inline void place_vertices(const BlockSet& b, const BodyVectors& u, std::size_t i,
                           std::vector<double>& px, std::vector<double>& py) {
  const double x0 = u.x[0][i], x1 = u.x[1][i], x2 = u.x[2][i];
  const double y0 = u.y[0][i], y1 = u.y[1][i], y2 = u.y[2][i];
  for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
    px[v] = b.weight[0][v] * x0 + b.weight[1][v] * x1 + b.weight[2][v] * x2;
    py[v] = b.weight[0][v] * y0 + b.weight[1][v] * y1 + b.weight[2][v] * y2;
  }
  const BlockModes modes = b.modes(i);
  for (std::size_t at = 0; modes.count > 0 && at < modes.corners; ++at) {
    const Vec2 bent = modes.at(u.modes, at);
    px[b.vertex_begin[i] + at] += bent.x;
    py[b.vertex_begin[i] + at] += bent.y;
  }
}

/// Computes the next vertices of the blocks [begin, end) from their nodes, into pose.x1, y1.
/// Returns the largest squared distance from pose.x, y, m2; 1e300 if one is not finite.
double place_next(const BlockSet& blocks, const State& state, Pose& pose, std::size_t begin,
                  std::size_t end);

/// Sets pose.x1, y1 of the free blocks to a step of h (s) earlier, at the state's velocities:
/// x_{n-1} = x_n - h v.
void place_a_step_back(const BlockSet& blocks, const State& state, double h, Pose& pose);

}  // namespace edda
