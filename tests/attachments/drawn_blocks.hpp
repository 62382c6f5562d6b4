// Blocks as given, for the tests of what is attached to them.
#pragma once

#include <optional>

#include "blocks/build_blocks.hpp"
#include "blocks/masses.hpp"

namespace edda::test {

inline Boundary boundary_along(BoundaryType type, Vec2 from, Vec2 to,
                               std::optional<double> stiffness = {}) {
  Boundary b;
  b.name = "b";
  b.type = type;
  b.along = {from, to};
  b.stiffness = stiffness;
  return b;
}

struct DrawnBlocks {
  Model model;
  PolygonSet set;
  BlockSet blocks;
  Masses masses;

  void add(const Ring& ring, bool fixed = false) {
    BlockPolygon p;
    p.rings = {ring};
    p.joint = {std::vector<Index>(ring.size(), none)};
    p.material = 0;
    p.fixed = fixed;
    set.blocks.push_back(p);
  }
  /// Of one rock.
  void build_all() {
    model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
    blocks = build_blocks(model, set);
    masses = given_masses(blocks);
  }
};

}  // namespace edda::test
