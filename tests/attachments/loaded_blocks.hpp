// Drawn blocks with the loads and waters of a model on them.
#pragma once

#include <array>
#include <utility>
#include <vector>

#include "attachments/drawn_blocks.hpp"
#include "attachments/loads.hpp"

namespace edda::test {

/// Blocks as given, with the loads and waters of a model on them.
struct Loaded : test::DrawnBlocks {
  Loads loads;
  Faults faults;

  void attach() {
    build_all();
    Result<Loads> found = attach_loads(model, set, blocks);
    if (found.ok()) {
      loads = std::move(found.value());
    } else {
      faults = found.faults();
    }
  }
  /// Resultant on block i, and its moment about the centroid, with the vertices at x, y.
  struct Resultant {
    Vec2 force;
    double moment;
  };
  Resultant on(std::size_t i, const std::vector<double>& x, const std::vector<double>& y,
               double time = 0.0) const {
    BlockForces all{blocks, i};
    add_loads(all, loads_at(model, loads, time), x, y);
    const NodeVectors& f = all.sum.nodes;
    // Nodes move with the vertices: as the block is drawn here it is not deformed.
    Resultant r{f[0] + f[1] + f[2], 0.0};
    for (std::size_t k = 0; k < 3; ++k) {
      r.moment += cross(Vec2{blocks.node_x[k][i] - blocks.centroid_x[i],
                             blocks.node_y[k][i] - blocks.centroid_y[i]},
                        f[k]);
    }
    return r;
  }
  Resultant on(std::size_t i, double time = 0.0) const {
    return on(i, blocks.vertex_x, blocks.vertex_y, time);
  }
};

inline Water lake(std::vector<Vec2> table) {
  Water w;
  w.table = std::move(table);
  return w;
}

inline const Ring odd_shape{{0, 0}, {3, 0.5}, {2.5, 2}, {1.2, 0.9}, {0.2, 1.7}};

}  // namespace edda::test
