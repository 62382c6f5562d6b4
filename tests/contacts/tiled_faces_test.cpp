// Faces in tiles, step by step beside the same faces evaluated one by one: what is decided of them
// counts in the same step.
#include "contacts/tiled_faces.hpp"

#include <gtest/gtest.h>

#include "contacts/faces_alone.hpp"
#include "contacts/moved_blocks.hpp"

namespace edda::tiled_faces_test {
namespace {

using test::MovedBlocks;
using test::Place;

/// Faces in tiles, and the same ones alone.
struct Both : MovedBlocks {
  FacesAlone alone;

  explicit Both(const JointLaw& joint, double gap, bool bonded = false)
      : MovedBlocks(test::square_on_base(joint)) {
    start();
    if (bonded) bond();
    put_still(1, {{0.0, gap}});
    begin_alone();
  }
  void begin_alone() {
    alone.faces = faces;
    alone.states = states();
    alone.forces = corner_forces(faces, tiled.tiles, blocks, pose);
  }
  void go_both(const Place& place) {
    alone.next_step();
    go(1, place);
    alone.evaluate(scene(), step);
    compare();
  }
  void compare() const {
    for (const auto& column : face_properties)
      EXPECT_EQ((faces.*column.values).values(), (alone.faces.*column.values).values())
          << column.name;
    EXPECT_EQ(faces.flags, alone.faces.flags);
    for (std::size_t k = 0; k < faces.size(); ++k) {
      const FaceFields& m = alone.states.now[k];
      if (m.gate == 0.0) continue;
      for (const FaceField& field : face_fields) {
        if (m.spring == 0.0 && field.value == &FaceFields::overlap) continue;
        EXPECT_EQ(now(k).*field.value, m.*field.value) << field.name << " of face " << k;
      }
    }
    EXPECT_EQ(corner_forces(faces, tiled.tiles, blocks, pose), alone.forces);
    EXPECT_EQ(faces.broken, alone.faces.broken);
  }
};

TEST(TiledFaces, BondsBreakInTheStepInWhichTheyFail) {
  Both m(test::rough_joint(30.0, 1e6, 2e5), 0.0, true);
  const double most = 2e5 / 2e9;
  for (const double part : {0.5, 0.9, 1.1, 1.2}) {
    m.go_both({{0.0, part * most}});
    EXPECT_EQ(m.force_on(1).y == 0.0, part > 1.0) << part;
  }
  EXPECT_EQ(m.faces.broken, 1u);
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
  m.change([](FaceSet& faces, FaceStates&) {
    for (std::size_t k = 0; k < faces.size(); ++k) faces.set(FaceFlag::acts, k, false);
  });
  m.put_still(1, {{0.0, -1e-4}});
  m.begin_alone();
  m.go_both({{0.0, -2e-4}});
  EXPECT_EQ(m.force_on(1).y, 0.0);
  m.go_both({{0.0, 1e-4}});
  m.go_both({{0.0, -1e-4}});
  EXPECT_GT(m.force_on(1).y, 0.0);
}

TEST(TiledFaces, FacesThatAreAwakeTakePartInCorrections) {
  Both m(test::rough_joint(30.0), -1e-4);
  m.go_both({{0.0, -2e-4}});
  BodyVectors on = zero_vectors(m.blocks);
  const FacesInStep here(m.faces, m.tiled, m.scene(), m.step, 0.0, {on});
  for (Id k = 0; k < m.faces.size(); ++k) EXPECT_TRUE(here.takes_part(0.0, k)) << k;
}

}  // namespace
}  // namespace edda::tiled_faces_test
