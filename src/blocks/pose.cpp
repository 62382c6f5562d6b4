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

constexpr double lost = 1e300;  ///< square of a distance that is not finite

/// The largest square of a distance between both places of a vertex.
EDDA_INLINE double largest_move(const VertexView& p, std::size_t begin, std::size_t end) {
  double largest = 0.0;
#pragma omp simd reduction(max : largest)
  for (std::size_t v = begin; v < end; ++v) {
    const double dx = p.to_x[v] - p.from_x[v], dy = p.to_y[v] - p.from_y[v];
    const double d2 = dx * dx + dy * dy;
    largest = larger(largest, d2 <= lost ? d2 : lost);
  }
  return largest;
}

EDDA_VECTOR double place(VertexView p, ConstNodeValues x, ConstNodeValues y, std::size_t begin,
                         std::size_t end) {
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

/// Blocks of which some bend.
struct BentBlocks {
  ConstNodeValues x, y;
  const Id* vertex_begin;
  const Bending& bending;
  const double *bend_x, *bend_y;
  const Meshes& meshes;
};

/// The corners of block i, which is meshed.
void place_meshed(const VertexView& p, const BentBlocks& b, std::size_t i) {
  const Id first = b.vertex_begin[i];
  const std::size_t mesh = b.bending.modes() + b.meshes.begin[i];
  const NodeVectors nodes = vectors_of(b.x, b.y, i);
  for (std::size_t v = first; v < b.vertex_begin[i + 1]; ++v) {
    const double w1 = p.weight[1][v], w2 = p.weight[2][v];
    const Vec2 at = weighted({1.0 - w1 - w2, w1, w2}, nodes);
    p.to_x[v] = at.x + b.bend_x[mesh + (v - first)];
    p.to_y[v] = at.y + b.bend_y[mesh + (v - first)];
  }
}

/// The same of these.
EDDA_VECTOR double place_bent(VertexView p, BentBlocks b, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end; ++i) {
    if (b.meshes.nodes_of(i) > 0) {
      place_meshed(p, b, i);
      continue;
    }
    const Id first = b.vertex_begin[i];
    const BlockModes modes = modes_of(b.bending, i, b.vertex_begin[i + 1] - first);
    const double x0 = b.x[0][i], x1 = b.x[1][i], x2 = b.x[2][i];
    const double y0 = b.y[0][i], y1 = b.y[1][i], y2 = b.y[2][i];
    const auto place_all = [&](auto count) __attribute__((always_inline)) {
      Two q[most_modes];
      for (std::size_t a = 0; a < count; ++a) q[a] = Two{b.bend_x[modes[a]], b.bend_y[modes[a]]};
      for (std::size_t at = 0; at < modes.corners; ++at) {
        const std::size_t v = first + at;
        const double w1 = p.weight[1][v], w2 = p.weight[2][v], w0 = 1.0 - w1 - w2;
        Two sum{w0 * x0 + w1 * x1 + w2 * x2, w0 * y0 + w1 * y1 + w2 * y2};
        for (std::size_t a = 0; a < count; ++a) {
          const double h = modes.shape[at * count + a];
          sum += Two{h, h} * q[a];
        }
        p.to_x[v] = sum[0];
        p.to_y[v] = sum[1];
      }
    };
    with_count(modes.count, place_all);
  }
  return largest_move(p, b.vertex_begin[begin], b.vertex_begin[end]);
}

}  // namespace

double place_next(const BlockSet& b, const State& s, Pose& pose, std::size_t begin,
                  std::size_t end) {
  const VertexView view{values_of(b.weight), b.vertex_block.data(), pose.x.data(),
                        pose.y.data(),       pose.x1.data(),        pose.y1.data()};
  if (b.mode_places() > 0) {
    const BentBlocks blocks{values_of(s.position.x),
                            values_of(s.position.y),
                            b.vertex_begin.data(),
                            b.bending,
                            s.position.modes.x.data(),
                            s.position.modes.y.data(),
                            b.meshes};
    return place_bent(view, blocks, begin, end);
  }
  return place(view, values_of(s.position.x), values_of(s.position.y), b.vertex_begin[begin],
               b.vertex_begin[end]);
}

void place_a_step_back(const BlockSet& b, const State& state, double h, Pose& pose) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (!is_free(b, state, i)) return;
    place_vertices(b, state.velocity, i, pose.x1, pose.y1);
    for (Id v = b.vertex_begin[i]; v < b.vertex_begin[i + 1]; ++v) {
      pose.x1[v] = pose.x[v] - h * pose.x1[v];
      pose.y1[v] = pose.y[v] - h * pose.y1[v];
    }
  });
}

}  // namespace edda
