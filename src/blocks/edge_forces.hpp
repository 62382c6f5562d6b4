// Forces on a block from those on both ends of its edges (Eq. 15): all that contacts know of it.
#pragma once

#include <algorithm>

#include "base/vector_loop.hpp"
#include "blocks/block_set.hpp"
#include "blocks/body_vectors.hpp"

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edda {

/// Where the forces on the edges of the blocks go.
struct EdgeForcesView {
  ConstNodeValues weight;
  const Id *vertex_begin, *next;
  const Bending* bending;  ///< null where no block bends
  const Meshes* meshes;    ///< null where none is meshed
  NodeValues x, y;
  double *modes_x, *modes_y;
};
inline EdgeForcesView edge_forces_view(const BlockSet& b, BodyVectors& on) {
  return {values_of(b.weight),
          b.vertex_begin.data(),
          b.next.data(),
          b.bending.any() ? &b.bending : nullptr,
          b.meshes.any() ? &b.meshes : nullptr,
          values_of(on.x),
          values_of(on.y),
          on.modes.x.data(),
          on.modes.y.data()};
}

/// Gathers the forces on the edges of block i: x and y at the first vertex of an edge, then at its
/// second, N. Every edge must be set once.
class EdgeForces {
 public:
  EDDA_INLINE EdgeForces(const EdgeForcesView& to, std::size_t i)
      : to_(to),
        block_(i),
        first_(to.vertex_begin[i]),
        bends_(to.bending != nullptr && to.bending->modes_of(i) > 0) {
    if (to.meshes != nullptr && to.meshes->nodes_of(i) > 0) begin_mesh();
  }
  EDDA_INLINE void set_none(Id e) {
    if (bends_) sums_[e - first_] = Four{};
  }
  EDDA_INLINE void set(Id e, Four forces) {
    const Id end = to_.next[e];
    on_[0] += forces;
    for (std::size_t k = 1; k < nodes_per_block; ++k) {
      const double w = to_.weight[k][e], w_end = to_.weight[k][end];
      on_[k] += Four{w, w, w_end, w_end} * forces;
    }
    if (bends_) sums_[e - first_] = forces;
    if (mesh_ != no_mesh) add_to_mesh(e, end, forces);
  }
  /// Stores the forces on the block. The weights sum to 1, so the first node has what the others
  /// leave.
  EDDA_INLINE void store() {
    NodeVectors f;
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      f[k] = {on_[k][0] + on_[k][2], on_[k][1] + on_[k][3]};
    }
    for (std::size_t k = 1; k < nodes_per_block; ++k) f[0] -= f[k];
    NodeValues x = to_.x, y = to_.y;
    edda::store(f, x, y, block_);
    if (bends_) store_on_modes();
  }

 private:
  static constexpr std::size_t no_mesh = static_cast<std::size_t>(-1);

  /// Mesh nodes have their forces at once.
  void begin_mesh() {
    const Meshes& m = *to_.meshes;
    mesh_ = (to_.bending == nullptr ? 0 : to_.bending->modes()) + m.begin[block_];
    std::fill_n(to_.modes_x + mesh_, m.nodes_of(block_), 0.0);
    std::fill_n(to_.modes_y + mesh_, m.nodes_of(block_), 0.0);
  }
  void add_to_mesh(Id e, Id end, Four forces) const {
    to_.modes_x[mesh_ + (e - first_)] += forces[0];
    to_.modes_y[mesh_ + (e - first_)] += forces[1];
    to_.modes_x[mesh_ + (end - first_)] += forces[2];
    to_.modes_y[mesh_ + (end - first_)] += forces[3];
  }
  EDDA_INLINE void store_on_modes() {
    const BlockModes modes = modes_of(*to_.bending, block_, to_.vertex_begin[block_ + 1] - first_);
    Two corner[most_corners_that_bend];
    for (std::size_t at = 0; at < modes.corners; ++at) corner[at] = Two{sums_[at][0], sums_[at][1]};
    for (std::size_t at = 0; at < modes.corners; ++at)
      corner[to_.next[first_ + at] - first_] += Two{sums_[at][2], sums_[at][3]};
    Two on[most_modes];
    const auto gather = [&](auto count) __attribute__((always_inline)) {
      for (std::size_t a = 0; a < count; ++a) on[a] = Two{};
      for (std::size_t at = 0; at < modes.corners; ++at) {
        for (std::size_t a = 0; a < count; ++a) {
          const double h = modes.shape[at * count + a];
          on[a] += Two{h, h} * corner[at];
        }
      }
    };
    with_count(modes.count, gather);
    for (std::size_t a = 0; a < modes.count; ++a) {
      to_.modes_x[modes[a]] = on[a][0];
      to_.modes_y[modes[a]] = on[a][1];
    }
  }

  const EdgeForcesView& to_;
  std::size_t block_;
  Id first_;
  bool bends_;
  std::size_t mesh_ = no_mesh;         ///< place of its first mesh node
  Four on_[nodes_per_block] = {};      ///< of node 0: of all nodes
  Four sums_[most_corners_that_bend];  ///< of the edges of a block that bends
};

}  // namespace edda
