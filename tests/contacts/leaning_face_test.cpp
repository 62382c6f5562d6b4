// The forces of a face of which a corner leans on the other edge.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "contacts/face_step.hpp"

namespace edda::leaning_face_test {
namespace {

constexpr double depth = 1e-4, side_length = 1.0;

/// A corner that has sunk into a level floor, which ends at a distance of `reach` (m) from it to
/// either side; one of its sides rises at `angle` (rad) towards `towards` (1: +x, -1: -x). The
/// floor is the first edge, or the second.
struct LeaningFace {
  FacePoints at;
  FacePair pair;
};
LeaningFace leaning(double angle, double towards, bool floor_first, double reach = 2.0) {
  const Vec2 right{reach, 0.0}, left{-reach, 0.0}, corner{0.0, -depth};
  const double floor_length = 2.0 * reach;
  const Vec2 top = corner + side_length * Vec2{towards * std::cos(angle), std::sin(angle)};
  const auto [q1, q2] = towards > 0.0 ? std::pair{corner, top} : std::pair{top, corner};
  LeaningFace f;
  f.at = floor_first ? FacePoints{right, left, q1, q2} : FacePoints{q1, q2, right, left};
  FacePair& pair = f.pair;
  pair.stiffness = 1e9;
  pair.ends = 1.0;
  pair.inverse_e = 1.0 / (floor_first ? floor_length : side_length);
  pair.inverse_f = 1.0 / (floor_first ? side_length : floor_length);
  pair.length_ratio = pair.inverse_e / pair.inverse_f;
  pair.gate_from = std::cos(85.0 * std::numbers::pi / 180.0);
  pair.gate_scale = 1.0 / (0.5 - pair.gate_from);
  pair.passing = 0.15 * std::min(side_length, floor_length);
  for (Vec2* turn : {&pair.turn_p1, &pair.turn_p2, &pair.turn_q1, &pair.turn_q2})
    *turn = {-0.8, 0.6};
  return f;
}

/// At Coulomb's limit the force on the floor has the friction of the joint, however the side that
/// leans stands, whichever end of the face the corner is at, and whichever edge is the first.
TEST(LeaningFace, HasTheFrictionOfTheJoint) {
  constexpr double friction = 0.6;
  for (const double degrees : {2.0, 15.0, 30.0, 45.0, 58.0}) {
    for (const double towards : {1.0, -1.0}) {
      for (const bool floor_first : {true, false}) {
        const LeaningFace f = leaning(degrees * std::numbers::pi / 180.0, towards, floor_first);
        const Face face = face_between(f.at, f.pair);
        ASSERT_GT(face.energy, 0.0) << degrees;
        const FaceEnds shear{friction * face.normal.a, friction * face.normal.b};
        const CornerForces pressure = face.force, along = end_forces(f.at, face, {}, shear);
        const Vec2 pressing = floor_first ? pressure.p1 + pressure.p2 : pressure.q1 + pressure.q2;
        const Vec2 sliding = floor_first ? along.p1 + along.p2 : along.q1 + along.q2;
        EXPECT_NEAR(pressing.x, 0.0, 1e-9 * std::abs(pressing.y)) << degrees;
        EXPECT_NEAR(sliding.y, 0.0, 1e-9 * std::abs(sliding.x)) << degrees;
        EXPECT_NEAR(std::abs(sliding.x), friction * std::abs(pressing.y),
                    1e-9 * std::abs(pressing.y))
            << degrees << ' ' << towards << ' ' << floor_first;
      }
    }
  }
}

/// The same where the overlap ends at the end of the floor, whose corner does not press.
TEST(LeaningFace, RubsAlongTheFloorWhereTheFloorEnds) {
  for (const double degrees : {15.0, 45.0, 58.0}) {
    for (const double towards : {1.0, -1.0}) {
      for (const bool floor_first : {true, false}) {
        const LeaningFace f =
            leaning(degrees * std::numbers::pi / 180.0, towards, floor_first, 0.3);
        const Face face = face_between(f.at, f.pair);
        const CornerForces along = end_forces(f.at, face, {}, {1.0, 2.0});
        const Vec2 sliding = floor_first ? along.p1 + along.p2 : along.q1 + along.q2;
        EXPECT_NEAR(sliding.y, 0.0, 1e-9 * std::abs(sliding.x)) << degrees << ' ' << towards;
        EXPECT_GT(std::abs(sliding.x), 3.0);
      }
    }
  }
}

/// As one corner passes the other at the deeper end, the edge that is pressed changes from one to
/// the other without a jump.
TEST(LeaningFace, FollowsOneEdgeAfterTheOtherAsCornersPass) {
  double last = 0.0;
  bool first = true, was_floor = false, was_side = false;
  constexpr double step = 1e-7;
  for (double reach = 1e-4; reach > -1e-4; reach -= step) {
    LeaningFace f = leaning(0.5, 1.0, true);
    f.at.p2.x = -reach;  // the floor ends beside the corner, and the corner leaves it
    const Face face = face_between(f.at, f.pair);
    if (!(face.energy > 0.0)) continue;
    if (!first) {
      EXPECT_NEAR(face.slope, last, 0.02) << reach;
    }
    first = false;
    last = face.slope;
    was_floor = was_floor || std::abs(last) > 0.2;
    was_side = was_side || (was_floor && std::abs(last) < 0.05);
  }
  EXPECT_TRUE(was_floor);
  EXPECT_TRUE(was_side);
}

/// The block of the corner moves along the floor: the slip is that distance over the cosine of half
/// the angle.
TEST(LeaningFace, SlipsAlongTheFloor) {
  for (const double degrees : {2.0, 30.0, 58.0}) {
    const double angle = degrees * std::numbers::pi / 180.0, way = 1e-6;
    const LeaningFace f = leaning(angle, 1.0, true);
    FacePoints then = f.at;
    for (Vec2* p : {&then.q1, &then.q2}) p->x -= way;
    const auto corners = [&](const FacePoints& p) {
      return coordinates_of(p, f.pair.inverse_e, f.pair.inverse_f);
    };
    const EndMotion moved =
        motion_of(face_between(f.at, f.pair), corners(f.at), corners(then), f.pair.length_ratio);
    for (const double slip : {moved.slip.a, moved.slip.b})
      EXPECT_NEAR(slip, -way / std::cos(0.5 * angle), 1e-9 * way) << degrees;
    for (const double closing : {moved.closure.a, moved.closure.b})
      EXPECT_NEAR(closing, 0.0, 1e-9 * way) << degrees;
  }
}

}  // namespace
}  // namespace edda::leaning_face_test
