// What is read of all faces at once is what each of them says.
#include "step/faces_now.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

#include "contacts/activity.hpp"
#include "contacts/evaluate_face.hpp"
#include "contacts/face_reading.hpp"
#include "run/prepared.hpp"
#include "step/step.hpp"

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
  double largest = 0.0;
  while (sim.motion.state.time < 0.05) {
    ASSERT_FALSE(step(sim));
    const std::vector<double> all = normal_forces_now(sim);
    const FaceMeasures measures = measure_faces(sim);
    for (std::size_t k = 0; k < all.size(); ++k) {
      const FaceRow face = face_row(sim, k);
      const double force = is_closed(face) ? normal_force(face) : 0.0;
      EXPECT_EQ(is_closed_now(sim, k), is_closed(face)) << "face " << k;
      EXPECT_EQ(all[k], force) << "face " << k;
      EXPECT_EQ(measures.normal[k], force) << "face " << k;
      largest = std::max(largest, force);
    }
  }
  EXPECT_GT(largest, 1e5);
}

TEST(FacesNow, NormalForcesAreThoseOfTheFaces) {
  for (const char* contact_damping : {"0", "0.1"}) compare_normal_forces(contact_damping);
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
    const FaceRow row = face_row(sim, k);
    const double ratio = closure_of(row) / narrower_radius(b, c, k);
    const Face face = face_at(c, b, pose.x, pose.y, k);
    if (row.state.energy > 0.0 && ratio > deepest.ratio &&
        overlap_where_pressed(c, b, pose, face, k))
      deepest = {k, ratio};
  }
  return deepest;
}

TEST(FacesNow, TheDeepestIsThatOfAllFaces) {
  Simulation sim = falling("0");
  constexpr double rounding = 1e-13;
  double largest = 0.0;
  int found = 0, none = 0;
  while (sim.motion.state.time < 0.05) {
    ASSERT_FALSE(step(sim));
    const DeepestNow any = deepest_now(sim, 0.0), more = deepest_now(sim, 1.001 * largest);
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
    const FaceRow row = face_row(sim, deepest.face);
    const FaceFields& m = row.state;
    const Pose& pose = sim.motion.pose;
    const Vec2 place = deeper_end(face_points(c, pose.x, pose.y, deepest.face),
                                  {m.closure_a, m.closure_b}, {m.xi_a, m.xi_b}, {m.eta_a, m.eta_b});
    EXPECT_NEAR(more.depth, closure_of(row), rounding);
    EXPECT_LT(norm(more.place - place), rounding);
    largest = more.ratio;
  }
  EXPECT_GT(found, 0);
  EXPECT_GT(none, 0);
}

}  // namespace
}  // namespace edda::faces_now_test
