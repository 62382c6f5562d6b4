// Looks at open faces must say what the whole evaluation says, or that they do not know.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "contacts/face_step.hpp"

namespace edda::open_face_test {
namespace {

/// Edges of which a corner of one is near a corner of the other, with and without a locked closure:
/// as at crossings of joints, where overlaps are as short as closures.
class CornersNearCorners {
 public:
  FaceInputs next() {
    FaceInputs in{};
    const double le = length(), lf = length();
    const double tilt = uniform(-1.6, 1.6), size = std::pow(10.0, uniform(-9.0, -3.0));
    const Vec2 corner{size * uniform(-1.0, 1.0), size * uniform(-1.0, 1.0)};
    const Vec2 along{std::cos(tilt), std::sin(tilt)};
    in.at = {{0.0, 0.0}, {le, 0.0}, corner, corner - lf * along};  // q1 beside p1
    if (uniform(0.0, 1.0) < 0.5)                                   // or q2 beside it
      in.at = {{0.0, 0.0}, {le, 0.0}, corner + lf * along, corner};
    FacePair& pair = in.pair;
    pair.stiffness = 1e9;
    pair.ends = 1.0;
    pair.inverse_e = 1.0 / le;
    pair.inverse_f = 1.0 / lf;
    pair.gate_from = std::cos(85.0 * std::numbers::pi / 180.0);
    pair.gate_scale = 1.0 / (0.5 - pair.gate_from);
    pair.passing = 0.15 * std::min(le, lf);
    if (uniform(0.0, 1.0) < 0.5) pair.offset = {size * uniform(0.0, 4.0), size * uniform(0.0, 4.0)};
    for (Vec2* turn : {&pair.turn_p1, &pair.turn_p2, &pair.turn_q1, &pair.turn_q2}) *turn = {0, 1};
    in.before.on = uniform(0.0, 1.0) < 0.5;
    return in;
  }

 private:
  double uniform(double from, double to) {
    return std::uniform_real_distribution<double>(from, to)(rng_);
  }
  double length() { return uniform(0.2, 1.0); }
  std::mt19937 rng_{3};
};

TEST(OpenFace, LooksSayWhatTheEvaluationSays) {
  CornersNearCorners faces;
  int known = 0, faded = 0, on = 0;
  for (int n = 0; n < 200000 && !HasFailure(); ++n) {
    const FaceInputs in = faces.next();
    const EdgeGeometry stands = geometry_of_edges(in.at, in.pair);
    const OpenFace look = test_open_face(in, stands);
    const Face face =
        face_between<Formulas::all>(stands, overlap_of<Formulas::all>(stands, in.pair), in.pair);
    if (look.gate == 0.0) {
      EXPECT_EQ(face.gate, 0.0) << n;
    }
    if (look.may_close) continue;
    ++known;
    EXPECT_EQ(face.gate > 0.0, look.gate > 0.0) << n;
    EXPECT_EQ(face.energy, 0.0) << n;
    EXPECT_FALSE(needs_decision(in, face.gate > 0.0, face.drawn, face.energy > 0.0)) << n;
    on += look.gate > 0.0;
    const double deepest = larger(face.closure.a, face.closure.b);
    faded += face.gate == 0.0 && face.length > 0.0 && deepest > 0.0;
  }
  EXPECT_GT(known, 20000);
  EXPECT_GT(faded, 5000);
  EXPECT_GT(on, 5000);
}

/// Two edges that share a corner and gape from there on, and two that lie along each other.
TEST(OpenFace, CornersThatCoincideTouchByNoRounding) {
  for (const double degrees : {0.0, 5.0, 45.0, 80.0}) {
    const double tilt = degrees * std::numbers::pi / 180.0, gapes = std::sin(tilt);
    for (const double depth : {-1e-15, 0.0, 1e-15, 1e-13, 1e-10}) {
      FacePair pair;
      pair.stiffness = 1e9;
      pair.inverse_e = pair.inverse_f = 1.0;
      pair.gate_from = std::cos(85.0 * std::numbers::pi / 180.0);
      pair.gate_scale = 1.0 / (0.5 - pair.gate_from);
      pair.passing = 0.15;
      for (Vec2* turn : {&pair.turn_p1, &pair.turn_p2, &pair.turn_q1, &pair.turn_q2})
        *turn = {0, 1};
      const Vec2 q2{0.0, depth};
      const FacePoints at{{0.0, 0.0}, {1.0, 0.0}, q2 + Vec2{std::cos(tilt), -gapes}, q2};
      const Face face = face_between(at, pair);
      const bool closed = depth > (degrees == 0.0 ? 0.0 : 1e-12);
      EXPECT_EQ(std::max(face.closure.a, face.closure.b) > 0.0, closed) << degrees << ' ' << depth;
      EXPECT_EQ(face.energy > 0.0, closed) << degrees << ' ' << depth;
    }
  }
}

}  // namespace
}  // namespace edda::open_face_test
