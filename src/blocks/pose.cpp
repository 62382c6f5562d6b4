#include "blocks/pose.hpp"

#include <algorithm>

#include "base/parallel.hpp"

namespace edda {
namespace {

struct VertexView {
  ConstNodeValues weight;
  const Id* block;
  const double *from_x, *from_y;
  double *to_x, *to_y;
};

EDDA_VECTOR double place(VertexView p, ConstNodeValues x, ConstNodeValues y, std::size_t begin,
                         std::size_t end) {
  constexpr double lost = 1e300;
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t v = begin; v < end; ++v) {
    const Id i = p.block[v];
    const double w1 = p.weight[1][v], w2 = p.weight[2][v], w0 = 1.0 - w1 - w2;
    const double px = w0 * x[0][i] + w1 * x[1][i] + w2 * x[2][i];
    const double py = w0 * y[0][i] + w1 * y[1][i] + w2 * y[2][i];
    const double dx = px - p.from_x[v], dy = py - p.from_y[v], d2 = dx * dx + dy * dy;
    p.to_x[v] = px;
    p.to_y[v] = py;
    largest = larger(largest, d2 <= lost ? d2 : lost);
  }
  return largest;
}

/// The same of blocks of which some bend.
double place_bent(const VertexView& p, const BlockSet& b, const State& s, std::size_t begin,
                  std::size_t end) {
  constexpr double lost = 1e300;
  double largest = 0.0;
  for (std::size_t i = begin; i < end; ++i) {
    const NodeVectors x = vectors_of(s.x, s.y, i);
    const BlockModes modes = b.modes(i);
    const Id first = b.vertex_begin[i];
    for (std::size_t at = 0; at < modes.corners; ++at) {
      const std::size_t v = first + at;
      const double w1 = p.weight[1][v], w2 = p.weight[2][v], w0 = 1.0 - w1 - w2;
      double px = w0 * x[0].x + w1 * x[1].x + w2 * x[2].x;
      double py = w0 * x[0].y + w1 * x[1].y + w2 * x[2].y;
      for (std::size_t a = 0; a < modes.count; ++a) {
        px += modes.of(a, at) * s.bend.x[modes.first + a];
        py += modes.of(a, at) * s.bend.y[modes.first + a];
      }
      const double dx = px - p.from_x[v], dy = py - p.from_y[v], d2 = dx * dx + dy * dy;
      p.to_x[v] = px;
      p.to_y[v] = py;
      largest = larger(largest, d2 <= lost ? d2 : lost);
    }
  }
  return largest;
}

}  // namespace

double place_next(const BlockSet& b, const State& s, Pose& pose, std::size_t begin,
                  std::size_t end) {
  const VertexView view{values_of(b.weight), b.vertex_block.data(), pose.x.data(),
                        pose.y.data(),       pose.x1.data(),        pose.y1.data()};
  if (b.bending.any()) return place_bent(view, b, s, begin, end);
  return place(view, values_of(s.x), values_of(s.y), b.vertex_begin[begin], b.vertex_begin[end]);
}

void place_a_step_back(const BlockSet& b, const State& state, const Nodes& vx, const Nodes& vy,
                       double h, Pose& pose) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (!is_free(b, state, i)) return;
    place_vertices(b, vx, vy, state.bend_rate, i, pose.x1, pose.y1);
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      pose.x1[v] = pose.x[v] - h * pose.x1[v];
      pose.y1[v] = pose.y[v] - h * pose.y1[v];
    }
  });
}

}  // namespace edda
