// Forces on the nodes of a block, from those on both ends of its edges (Eq. 15).
#pragma once

#include "base/vector_loop.hpp"
#include "blocks/block_set.hpp"

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edda {

/// Adds up the forces on the edges of one block.
class EdgeForces {
 public:
  /// Adds the two forces on the edge from vertex e to `to`: x and y at e, x and y at `to`, N.
  EDDA_INLINE void add(const ConstNodeValues& weight, Id e, Id to, Four forces) {
    on_[0] += forces;
    for (std::size_t k = 1; k < nodes_per_block; ++k) {
      const double w = weight[k][e], w_to = weight[k][to];
      on_[k] += Four{w, w, w_to, w_to} * forces;
    }
  }
  /// The forces on the nodes: the weights sum to 1, so the first has what the others leave.
  EDDA_INLINE NodeVectors on_nodes() const {
    NodeVectors f;
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      f[k] = {on_[k][0] + on_[k][2], on_[k][1] + on_[k][3]};
    }
    for (std::size_t k = 1; k < nodes_per_block; ++k) f[0] -= f[k];
    return f;
  }

 private:
  Four on_[nodes_per_block] = {};  ///< of node 0: of all nodes
};

/// Sets the forces on the modes of a block from the sums on its edges. next: of its first vertex
/// on; x, y: [modes of all blocks].
EDDA_INLINE void gather_modes(const BlockModes& modes, const Id* next, Id first, const Four* sums,
                              double* x, double* y) {
  Two corner[most_corners_that_bend];
  for (std::size_t at = 0; at < modes.corners; ++at) corner[at] = Two{sums[at][0], sums[at][1]};
  for (std::size_t at = 0; at < modes.corners; ++at)
    corner[next[at] - first] += Two{sums[at][2], sums[at][3]};
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
    x[modes[a]] = on[a][0];
    y[modes[a]] = on[a][1];
  }
}

}  // namespace edda
