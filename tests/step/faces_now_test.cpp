// Looks at faces whose rows are behind must see what the rows say once they are up to date.
#include "step/faces_now.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "contacts/activity.hpp"
#include "contacts/evaluate_faces.hpp"
#include "contacts/face_reading.hpp"
#include "run/prepared.hpp"
#include "step/invariants.hpp"
#include "step/step.hpp"
#include "step/tile_step.hpp"
#include "step/touching.hpp"

namespace edda::faces_now_test {
namespace {

/// Two blocks of unequal size fall on a slope, one upon the other.
Simulation falling(const std::string& contact_damping) {
  Simulation sim = testing::prepared(
                       "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.2\n"
                       "damping = 0\n[joints.j]\nfriction_angle = 20\n[contact]\n"
                       "normal_stiffness = 2e9\n[solver.damping]\ncontact = " +
                       contact_damping +
                       "\n[solver]\nduration = 1\n[[block]]\nfixed = true\n"
                       "polygon = [[-3,-1],[3,-1],[3,0],[-3,0]]\n[[block]]\nvelocity = [1, -2]\n"
                       "polygon = [[0,0.01],[1,0.06],[0.95,1.06],[-0.05,1.01]]\n[[block]]\n"
                       "velocity = [0, -3]\npolygon = [[0.3,1.1],[0.7,1.1],[0.7,1.4],[0.3,1.4]]\n")
                       .sim;
  start(sim, 1.0);
  return sim;
}

void compare_normal_forces(const std::string& contact_damping) {
  Simulation sim = falling(contact_damping);
  constexpr double rounding = 1e-4;  // N
  double largest = 0.0;
  std::size_t behind = 0;
  while (sim.motion.state.time < 0.05) {
    ASSERT_FALSE(step_ahead(sim));
    if (sim.motion.tiled.ahead) ++behind;  // not after a step that has made a new list
    const std::size_t n = sim.motion.contacts.size();
    std::vector<double> seen(n);
    for (std::size_t k = 0; k < n; ++k) seen[k] = normal_force_now(sim, k);
    update_face_rows(sim);
    const FaceSet& c = sim.motion.contacts;
    for (std::size_t k = 0; k < n; ++k) {
      const double in_row = is_closed(c, k) ? normal_force(c, k) : 0.0;
      EXPECT_NEAR(seen[k], in_row, rounding) << "face " << k;
      EXPECT_NEAR(seen[k], normal_force_now(sim, k), rounding) << "face " << k;
      largest = std::max(largest, in_row);
    }
  }
  EXPECT_GT(largest, 1e9 * rounding);
  EXPECT_TRUE(invariants_are_checked || behind > sim.motion.state.steps / 2);
}

TEST(FacesNow, NormalForcesAreThoseOfTheRows) {
  for (const char* contact_damping : {"0", "0.1"}) compare_normal_forces(contact_damping);
}

/// All that a table or a picture says of a face, to the bit.
void compare_faces(const std::string& contact_damping) {
  Simulation sim = falling(contact_damping);
  std::size_t behind = 0;
  while (sim.motion.state.time < 0.02) {
    ASSERT_FALSE(step_ahead(sim));
    if (sim.motion.tiled.ahead) ++behind;
    std::vector<FaceFields<double>> states;
    std::vector<CornerForces> forces;
    for (std::size_t k = 0; k < sim.motion.contacts.size(); ++k) {
      const FaceRow face = face_row(sim, k);
      states.push_back(face.state);
      forces.push_back(face.force);
    }
    update_face_rows(sim);
    for (std::size_t k = 0; k < states.size(); ++k) {
      FaceRow row = face_row(sim, k);
      if (row.state.spring == 0.0) row.state.overlap = 0.0;  // of springs that are not there
      for (const auto& field : face_fields<double>)
        ASSERT_EQ(states[k].*field.values, row.state.*field.values) << field.name << k;
      for (const auto corner :
           {&CornerForces::p1, &CornerForces::p2, &CornerForces::q1, &CornerForces::q2}) {
        ASSERT_EQ((forces[k].*corner).x, (row.force.*corner).x) << k;
        ASSERT_EQ((forces[k].*corner).y, (row.force.*corner).y) << k;
      }
    }
  }
  EXPECT_TRUE(invariants_are_checked || behind > sim.motion.state.steps / 2);
}

TEST(FacesNow, FacesByValueAreTheRowsToTheBit) {
  for (const char* contact_damping : {"0", "0.1"}) compare_faces(contact_damping);
}

TEST(FacesNow, BlocksThatTouchAreThoseOfTheRows) {
  Simulation sim = falling("0.1");
  std::size_t touched = 0, apart = 0;
  while (sim.motion.state.time < 0.05) {
    ASSERT_FALSE(step_ahead(sim));
    const std::vector<std::uint8_t> seen = touching(sim);
    update_face_rows(sim);
    ASSERT_EQ(seen, touching(sim)) << sim.motion.state.steps;
    for (const std::uint8_t touches : seen) (touches != 0 ? touched : apart) += 1;
  }
  EXPECT_GT(touched, 100u);
  EXPECT_GT(apart, 100u);
}

struct DeepestRow {
  std::size_t face = 0;
  double ratio = 0.0;
};
DeepestRow deepest_row(const Simulation& sim) {
  const FaceSet& c = sim.motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  const Pose& pose = sim.motion.pose;
  DeepestRow deepest;
  for (std::size_t k = 0; k < c.size(); ++k) {
    const double ratio = closure_of(c, k) / narrower_radius(b, c, k);
    const Face face = face_at(c, b, pose.x, pose.y, k);
    if (c.now.energy[k] > 0.0 && ratio > deepest.ratio &&
        overlap_where_pressed(c, b, pose, face, k))
      deepest = {k, ratio};
  }
  return deepest;
}

TEST(FacesNow, TheDeepestIsThatOfTheRows) {
  Simulation sim = falling("0");
  constexpr double rounding = 1e-13;
  double largest = 0.0;
  int found = 0, none = 0, behind = 0;
  while (sim.motion.state.time < 0.05) {
    ASSERT_FALSE(step_ahead(sim));
    if (sim.motion.tiled.ahead) ++behind;
    const DeepestNow any = deepest_now(sim, 0.0), more = deepest_now(sim, 1.001 * largest);
    update_face_rows(sim);
    const FaceSet& c = sim.motion.contacts;
    const DeepestRow deepest = deepest_row(sim);
    EXPECT_NEAR(any.ratio, deepest.ratio, rounding);
    EXPECT_EQ(more.ratio, any.ratio > 1.001 * largest ? any.ratio : 0.0);
    if (!(more.ratio > 0.0)) {
      ++none;
      continue;
    }
    ++found;
    EXPECT_EQ(more.face, deepest.face);
    EXPECT_NEAR(more.depth, closure_of(c, deepest.face), rounding);
    EXPECT_LT(norm(more.place - deeper_end(c, sim.motion.pose, deepest.face)), rounding);
    largest = more.ratio;
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(none, 0);
  EXPECT_TRUE(invariants_are_checked || behind > 100);  // checks read the rows after every step
}

}  // namespace
}  // namespace edda::faces_now_test
