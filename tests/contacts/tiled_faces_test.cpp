// Faces in tiles, step by step beside the rows of the same blocks: what is decided of them counts
// in the same step.
#include "contacts/tiled_faces.hpp"

#include <gtest/gtest.h>

#include "contacts/moved_blocks.hpp"

namespace edda::tiled_faces_test {
namespace {

using test::MovedBlocks;
using test::Place;

struct Both : MovedBlocks {
  FaceSet in_tiles;
  TiledFaces tiled;
  Nodes x, y;
  ModeVectors modes;

  explicit Both(const JointLaw& joint, double gap, bool bonded = false)
      : MovedBlocks(test::square_on_base(joint)) {
    start();
    if (bonded) bond_faces(faces, blocks, pose, laws);
    put_still(1, {{0.0, gap}});
    load_tiles(tiled, faces, blocks, state, pose, true, blocks.size());
    in_tiles = faces;
    x = y = zero_nodes(blocks.size());
    modes.assign(blocks.bending.modes(), 0.0);
  }
  FacesInStep in_step() { return {in_tiles, tiled, scene(), step, 1.0, {x, y, modes}}; }
  void go_both(const Place& place) {
    go(1, place);
    next_step(in_tiles, tiled.tiles);
    FacesInStep here = in_step();
    here.sweep();
    here.decide_and_evaluate(here.asking());
    compare();
  }
  void compare() const {
    FaceSet seen = in_tiles;
    unload_faces(seen, tiled.tiles, blocks, pose);
    for (const auto& column : face_properties)
      EXPECT_EQ((seen.*column.values).values(), (faces.*column.values).values()) << column.name;
    for (std::size_t k = 0; k < faces.size(); ++k) {
      if (faces.now.gate[k] == 0.0) continue;
      for (const auto column :
           {&FaceFields<ChunkColumn>::energy, &FaceFields<ChunkColumn>::normal_a,
            &FaceFields<ChunkColumn>::shear_b, &FaceFields<ChunkColumn>::slip_a})
        EXPECT_EQ((seen.now.*column)[k], (faces.now.*column)[k]) << k;
    }
    EXPECT_EQ(seen.force, faces.force);
    EXPECT_EQ(seen.broken, faces.broken);
  }
};

TEST(TiledFaces, BondsBreakInTheStepInWhichTheyFail) {
  Both m(test::rough_joint(30.0, 1e6, 2e5), 0.0, true);
  const double most = 2e5 / 2e9;
  for (const double part : {0.5, 0.9, 1.1, 1.2}) {
    m.go_both({{0.0, part * most}});
    EXPECT_EQ(m.force_on(1).y == 0.0, part > 1.0) << part;
  }
  EXPECT_EQ(m.in_tiles.broken, 1u);
}

TEST(TiledFaces, FacesActFromTheStepInWhichTheyClose) {
  Both m(test::rough_joint(30.0), 1e-3);
  for (const double y : {5e-4, -1e-4, -2e-4, 1e-4, -1e-4}) {
    m.go_both({{1e-5, y}});
    EXPECT_EQ(m.force_on(1).y > 0.0, y < 0.0) << y;
  }
}

/// A face that does not act, as the far side of a thin block, does so once it has been open.
TEST(TiledFaces, WhatDidNotActActsOnceItHasBeenOpen) {
  Both m(test::rough_joint(30.0), -1e-4);
  for (FaceSet* faces : {&m.faces, &m.in_tiles}) faces->acts.fill(0.0);
  m.put_still(1, {{0.0, -1e-4}});
  load_tiles(m.tiled, m.faces, m.blocks, m.state, m.pose, true, m.blocks.size());
  m.in_tiles = m.faces;
  m.go_both({{0.0, -2e-4}});
  EXPECT_EQ(m.force_on(1).y, 0.0);
  m.go_both({{0.0, 1e-4}});
  m.go_both({{0.0, -1e-4}});
  EXPECT_GT(m.force_on(1).y, 0.0);
}

TEST(TiledFaces, FacesThatAreAwakeTakePartInCorrections) {
  Both m(test::rough_joint(30.0), -1e-4);
  m.go_both({{0.0, -2e-4}});
  for (Id k = 0; k < m.faces.size(); ++k) EXPECT_TRUE(m.in_step().takes_part(0.0, k)) << k;
}

}  // namespace
}  // namespace edda::tiled_faces_test
