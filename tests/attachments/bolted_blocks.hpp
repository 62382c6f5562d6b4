// Blocks as given with bolts in them, for the tests of bolts.
#pragma once

#include "attachments/bolts.hpp"
#include "attachments/drawn_blocks.hpp"

namespace edda::test {

struct Bolted : DrawnBlocks {
  State state;
  Bolts bolts;
  Faults faults;

  void build() {
    build_all();
    state = initial_state(blocks, set);
  }
  void attach() {
    Result<Bolts> found = attach_bolts(model, blocks, state, blocks.vertex_x, blocks.vertex_y);
    if (found.ok()) {
      bolts = std::move(found.value());
    } else {
      faults = found.faults();
    }
  }
};

inline Bolt grouted(Vec2 from, Vec2 to) {
  Bolt b;
  b.from = from;
  b.to = to;
  b.diameter = 0.02;
  b.bond = {1e9, 1e5};
  b.dowel = BoltDowel{1e7, 1e4};
  return b;
}

}  // namespace edda::test
