#include "contacts/face.hpp"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <memory>
#include <numbers>
#include <random>

#include "contacts/face_step.hpp"
#include "contacts/face_stiffness.hpp"

namespace edda {
namespace {

constexpr double pi = std::numbers::pi;

Vec2 turn_of(double exterior) {
  return {std::cos(exterior), std::sin(exterior)};
}

struct RandomFace {
  FacePoints at;
  FacePair pair;

  /// The exterior angle of a corner: p1, p2, q1, q2.
  void turn(std::size_t corner, double angle) {
    Vec2* const turns[] = {&pair.turn_p1, &pair.turn_p2, &pair.turn_q1, &pair.turn_q2};
    *turns[corner] = turn_of(angle);
  }
};

/// Edges of 0.2 to 1 m, every second one nearly parallel; every law that a face may have.
class Faces {
 public:
  RandomFace next() {
    ++count_;
    RandomFace r;
    const double tilt = count_ % 3 == 0 ? uniform(-1.5, 1.5) : uniform(-0.02, 0.02);
    const double le = uniform(0.2, 1.0), lf = uniform(0.2, 1.0);
    const double shift = count_ % 5 == 0 ? uniform(-0.02, 0.06) : uniform(-0.6, 1.2);
    const double depth = count_ % 2 == 0 ? uniform(-0.1, 0.3) : uniform(-0.02, 0.05);
    r.at = {{0.0, 0.0},
            {le, 0.0},
            {shift, depth},
            {shift - lf * std::cos(tilt), depth + lf * std::sin(tilt)}};
    const double way = uniform(0.0, 2.0 * pi);
    for (Vec2* p : {&r.at.p1, &r.at.p2, &r.at.q1, &r.at.q2}) *p = rotated(*p, way) + Vec2{2.0, 1.0};
    r.pair.stiffness = 1.0;
    r.pair.ends = count_ % 4 == 1 ? 0.0 : 1.0;
    r.pair.carries_tension = count_ % 11 == 0 ? 1.0 : 0.0;
    if (count_ % 7 == 0) r.pair.offset = {0.01, uniform(0.0, 0.02)};
    r.pair.inverse_e = 1.0 / le;
    r.pair.inverse_f = 1.0 / lf;
    r.pair.length_ratio = lf / le;
    r.pair.gate_from = std::cos(85.0 * pi / 180.0);
    r.pair.gate_scale = 1.0 / (0.5 - r.pair.gate_from);
    r.pair.passing = 0.15 * std::min(le, lf);
    for (std::size_t corner = 0; corner < 4; ++corner) r.turn(corner, uniform(0.1, 2.8));
    return r;
  }

 private:
  double uniform(double a, double b) { return std::uniform_real_distribution<>(a, b)(random_); }
  std::mt19937 random_{7};
  int count_ = 0;
};

std::array<Vec2, 4> forces_of(const Face& face) {
  return {face.force.p1, face.force.p2, face.force.q1, face.force.q2};
}

double largest(const std::array<Vec2, 4>& forces) {
  double size = 0.0;
  for (const Vec2 f : forces) size = std::max(size, norm(f));
  return size;
}

/// Within the stencil the corners that bound the ends do not change, nor which end has the larger
/// closure.
bool is_smooth(const RandomFace& r, const Face& f) {
  constexpr double clear = 1e-5;
  const Vec2 e = r.at.p2 - r.at.p1;
  const double s2 = dot(e, f.t), r1 = dot(r.at.q1 - r.at.p1, f.t), r2 = dot(r.at.q2 - r.at.p1, f.t);
  return std::abs(s2 - r1) > clear && std::abs(r2) > clear && f.length > clear &&
         std::abs(f.closure.a) > clear && std::abs(f.closure.b) > clear &&
         std::abs(f.closure.a - f.closure.b) > clear;
}

/// The terms that a step omits for a plain face change no bit, except the sign of zeros.
TEST(Face, IsTheSameWherePlainPartsAreLeftOut) {
  const auto parts = [](const Face& f) {
    return std::array{f.length,     f.cohesive,   f.closure.a,    f.closure.b,   f.xi.a,
                      f.xi.b,       f.eta.a,      f.eta.b,        f.gate,        f.angle_gate,
                      f.share,      f.energy,     f.normal.a,     f.normal.b,    f.slope,
                      f.along.a,    f.along.b,    f.of_first.a,   f.of_first.b,  f.force.p1.x,
                      f.force.p1.y, f.force.p2.x, f.force.p2.y,   f.force.q1.x,  f.force.q1.y,
                      f.force.q2.x, f.force.q2.y, f.pressure.p1t, f.pressure.q2n};
  };
  const auto stands = [](const Face& f) {
    return std::array{f.length, f.cohesive, f.closure.a, f.closure.b, f.xi.a,
                      f.xi.b,   f.eta.a,    f.eta.b,     f.gate,      f.energy};
  };
  Faces faces;
  int closed = 0, open = 0, rare = 0;
  while (closed < 2000) {
    const RandomFace r = faces.next();
    const Face whole = face_between(r.at, r.pair);
    if (!is_plain(geometry_of_edges(r.at, r.pair), r.pair)) {
      ++rare;
      continue;
    }
    const Face plain = face_between<Formulas::plain>(r.at, r.pair);
    if (whole.gate > 0.0) {
      (whole.energy > 0.0 ? closed : open) += 1;
      EXPECT_EQ(parts(plain), parts(whole));
    } else {
      EXPECT_EQ(stands(plain), stands(whole));
      EXPECT_EQ(largest(forces_of(plain)), 0.0);
    }
  }
  EXPECT_GT(open, 100);
  EXPECT_GT(rare, 2000);
}

TEST(Face, ForcesAreTheGradientOfTheStoredEnergy) {
  Faces faces;
  double worst = 0.0;
  int tried = 0, faded = 0, turned = 0, partial = 0;
  while (tried < 20000) {
    RandomFace r = faces.next();
    const Face face = face_between(r.at, r.pair);
    if (!(face.energy > 1e-9) || !is_smooth(r, face)) continue;
    ++tried;
    faded += face.gate < face.angle_gate ? 1 : 0;
    turned += face.angle_gate < 1.0 ? 1 : 0;
    partial += std::min(face.closure.a, face.closure.b) < 0.0 ? 1 : 0;
    const std::array<Vec2, 4> forces = forces_of(face);
    const double scale = std::max(largest(forces), 1e-3 * std::sqrt(face.energy));
    const std::array<Vec2*, 4> points{&r.at.p1, &r.at.p2, &r.at.q1, &r.at.q2};
    for (std::size_t k = 0; k < 4; ++k) {
      for (const bool along_y : {false, true}) {
        double& u = along_y ? points[k]->y : points[k]->x;
        const double here = u, force = along_y ? forces[k].y : forces[k].x;
        const auto energy = [&](double by) {
          u = here + by;
          const double value = face_between(r.at, r.pair).energy;
          u = here;
          return value;
        };
        double error = 1.0;  // one of the two stencils may span a change of curvature, not both
        for (const double h : {1e-6, 1e-7}) {
          const double slope =
              (8.0 * (energy(h) - energy(-h)) - (energy(2.0 * h) - energy(-2.0 * h))) / (12.0 * h);
          error = std::min(error, std::abs(slope + force) / scale);
        }
        worst = std::max(worst, error);
      }
    }
  }
  EXPECT_LT(worst, 1e-7);
  EXPECT_GT(faded, 100);
  EXPECT_GT(turned, 100);
  EXPECT_GT(partial, 1000);
}

/// Moves the second edge along the first, past the corners at one end, to `x` from the point where
/// they meet.
RandomFace passing_by(RandomFace r, bool first_end, double x) {
  const Vec2 along = unit(r.at.p2 - r.at.p1);
  const Vec2 meet = first_end ? r.at.p1 - r.at.q2 : r.at.p2 - r.at.q1;
  const Vec2 by = (dot(meet, along) + x) * along;
  r.at.q1 += by;
  r.at.q2 += by;
  return r;
}

/// Corners that pass each other, a change of the bounding corner or of the end of larger closure:
/// no force jumps.
TEST(Face, ForcesAreContinuous) {
  Faces faces;
  double worst = 0.0;
  int tried = 0, passed = 0;
  while (tried < 500) {
    const RandomFace r = faces.next();
    const bool first_end = tried % 2 == 0;
    std::array<std::array<Vec2, 4>, 3> last{};
    double largest_force = 0.0, jump = 0.0;
    bool before = false, after = false;
    constexpr int steps = 4000;
    constexpr double reach = 0.002;
    for (int i = 0; i <= steps; ++i) {
      const RandomFace here = passing_by(r, first_end, reach * (2.0 * i / steps - 1.0));
      const Face face = face_between(here.at, here.pair);
      (2 * i < steps ? before : after) |= face.energy > 0.0;
      last = {last[1], last[2], forces_of(face)};
      largest_force = std::max(largest_force, largest(last[2]));
      for (std::size_t k = 0; i >= 2 && k < 4; ++k) {
        jump = std::max(jump, norm(last[0][k] - 2.0 * last[1][k] + last[2][k]));
      }
    }
    if (!(largest_force > 1e-6)) continue;
    ++tried;
    passed += before && after ? 1 : 0;
    worst = std::max(worst, jump / largest_force);
  }
  EXPECT_LT(worst, 1e-3);
  EXPECT_GT(passed, 300);
}

TEST(Face, ForcesSumToZeroAndHaveNoMoment) {
  Faces faces;
  for (int k = 0; k < 20000; ++k) {
    const RandomFace r = faces.next();
    const Face face = face_between(r.at, r.pair);
    const CornerForces shear = end_forces(r.at, face, {1.1, 0.2}, {0.3, -0.8});
    for (const CornerForces& f : {face.force, shear}) {
      const double size = norm(f.p1) + norm(f.p2) + norm(f.q1) + norm(f.q2) + 1e-12;
      EXPECT_LT(norm(f.p1 + f.p2 + f.q1 + f.q2), 1e-12 * size);
      const double moment =
          cross(r.at.p1, f.p1) + cross(r.at.p2, f.p2) + cross(r.at.q1, f.q1) + cross(r.at.q2, f.q2);
      EXPECT_LT(std::abs(moment), 1e-11 * size);
    }
  }
}

TEST(Face, IsTheSameSeenFromTheOtherBlock) {
  Faces faces;
  for (int k = 0; k < 20000; ++k) {
    const RandomFace r = faces.next();
    RandomFace other = r;
    other.at = {r.at.q1, r.at.q2, r.at.p1, r.at.p2};
    std::swap(other.pair.inverse_e, other.pair.inverse_f);
    std::swap(other.pair.turn_p1, other.pair.turn_q1);
    std::swap(other.pair.turn_p2, other.pair.turn_q2);
    std::swap(other.pair.offset.a, other.pair.offset.b);
    const Face one = face_between(r.at, r.pair), two = face_between(other.at, other.pair);
    if (std::abs(one.closure.a - one.closure.b) < 1e-9) continue;
    EXPECT_NEAR(one.energy, two.energy, 1e-12 * (1e-3 + one.energy));
    const std::array<Vec2, 4> f = forces_of(one), g = forces_of(two);
    for (std::size_t p = 0; p < 4; ++p) EXPECT_LT(norm(f[p] - g[(p + 2) % 4]), 1e-10);
  }
}

/// Two edges of 1 m, the second with the closure `depth` in the first and inclined by `tilt`.
RandomFace flat(double depth, double tilt) {
  RandomFace r;
  r.at = {{0.0, 0.0}, {1.0, 0.0}, {1.0, depth}, {1.0 - std::cos(tilt), depth + std::sin(tilt)}};
  r.pair.stiffness = 3e9;
  r.pair.inverse_e = r.pair.inverse_f = 1.0;
  r.pair.gate_from = std::cos(85.0 * pi / 180.0);
  r.pair.gate_scale = 1.0 / (0.5 - r.pair.gate_from);
  r.pair.passing = 0.15;
  for (std::size_t corner = 0; corner < 4; ++corner) r.turn(corner, pi / 2.0);
  return r;
}

TEST(Face, StoresWhatABedOfSpringsStores) {
  for (const double tilt : {-2e-3, -1e-4, 0.0, 3e-4, 4e-3}) {
    const RandomFace r = flat(1e-3, tilt);
    const Face face = face_between(r.at, r.pair);
    constexpr int springs = 200000;
    const double step = face.length / springs;
    double energy = 0.0, force = 0.0, moment = 0.0;
    for (int q = 0; q < springs; ++q) {
      const double part = (q + 0.5) / springs;
      const double d = std::max(0.0, face.closure.a + part * (face.closure.b - face.closure.a));
      energy += 0.5 * r.pair.stiffness * d * d * step;
      force += r.pair.stiffness * d * step;
      moment += r.pair.stiffness * d * step * part * face.length;
    }
    EXPECT_NEAR(face.energy / energy, 1.0, 1e-8);
    EXPECT_NEAR((face.normal.a + face.normal.b) / force, 1.0, 1e-8);
    EXPECT_NEAR(face.normal.b * face.length / moment, 1.0, 1e-8);
  }
}

TEST(Face, ACornerThatLeansKeepsTheSpringOfItsEnd) {
  for (const double tilt : {1e-3, 0.02, 0.2}) {
    RandomFace r = flat(1e-5, -tilt);
    r.pair.ends = 1.0;
    const Face face = face_between(r.at, r.pair);
    const double deepest = std::max(face.closure.a, face.closure.b);
    const double share = std::pow(std::cos(tilt), 2);  // the other edge makes 90 degrees less tilt
    EXPECT_NEAR(face.energy / (0.25 * share * r.pair.stiffness * face.length * deepest * deepest),
                1.0, 2e-2);
  }
}

CornerWeight share_at(Vec2 turn, double theta) {
  return corner_weight(turn, std::cos(theta), std::sin(theta));
}

TEST(Face, TheTwoEdgesOfACornerShareItsSpring) {
  for (const double exterior : {0.5, pi / 2.0, 2.0}) {
    for (const double part : {0.0, 0.2, 0.5, 0.9, 1.0}) {
      const double theta = part * exterior;
      const CornerWeight one = share_at(turn_of(exterior), theta);
      const CornerWeight two = share_at(turn_of(exterior), exterior - theta);
      EXPECT_NEAR(one.value + two.value, 1.0, 1e-12);
    }
    EXPECT_EQ(share_at(turn_of(exterior), 1.1 * exterior).value, 0.0);
  }
}

TEST(Face, ExistsOnlyWhileEdgesOverlapAndAreOpposed) {
  RandomFace r = flat(1e-3, 0.0);
  for (Vec2* q : {&r.at.q1, &r.at.q2}) *q += Vec2{1.01, 0.0};
  EXPECT_EQ(face_between(r.at, r.pair).energy, 0.0);  // beside each other
  r = flat(1e-3, 0.0);
  std::swap(r.at.q1, r.at.q2);
  EXPECT_EQ(face_between(r.at, r.pair).energy, 0.0);  // edges in the same direction
  r = flat(-1e-3, 0.0);
  EXPECT_EQ(face_between(r.at, r.pair).energy, 0.0);  // apart
  r.pair.carries_tension = 1.0;
  // its corners pass each other: the ends move inward by r/4
  const double furthest = 0.5 * r.pair.passing, u = std::sqrt(2.0) * 1e-3 / 6.0 / furthest;
  const double length = 1.0 - 0.5 * furthest * u * (2.0 - u);
  EXPECT_NEAR(face_between(r.at, r.pair).energy, 0.5 * 3e9 * 1e-6 * length, 1e-6);
  for (const double overlap : {1e-15, 1e-11, 2e-10}) {  // rounding, up to 1e-9 of `passing`
    r = flat(0.1 * overlap, 0.0);
    for (Vec2* q : {&r.at.q1, &r.at.q2}) *q += Vec2{1.0 - overlap, 0.0};
    EXPECT_EQ(face_between(r.at, r.pair).energy > 0.0, overlap > 1e-10);
    EXPECT_EQ(face_between<Formulas::plain>(r.at, r.pair).energy > 0.0, overlap > 1e-10);
  }
}

TEST(Face, WhatIsDeeperThanLongCarriesNothing) {
  RandomFace r = flat(0.02, 0.0);
  for (Vec2* q : {&r.at.q1, &r.at.q2}) *q += Vec2{0.995, 0.0};  // overlap 5 mm, closure 20 mm
  const Face face = face_between(r.at, r.pair);
  EXPECT_GT(face.length, 0.0);
  EXPECT_EQ(face.energy, 0.0);
}

/// Derivatives with respect to the closures of the ends, for faces that are closed all along or
/// gape, with the exact integral, the one at the ends, and weights between the two.
TEST(FaceStiffness, IsTheDerivativeOfTheNormalForces) {
  for (const double depth : {1e-3, 1e-4}) {
    for (const double tilt : {-2e-3, 1e-3, 0.3, -0.3}) {
      for (const double ends : {0.0, 0.5, 1.0}) {
        RandomFace r = flat(depth, 0.0);
        // Shorter than the other and in its middle, so that no corners pass each other.
        const Vec2 half = 0.3 * Vec2{std::cos(tilt), -std::sin(tilt)}, middle{0.5, depth};
        r.at.q1 = middle + half;
        r.at.q2 = middle - half;
        r.pair.inverse_f = 1.0 / 0.6;
        r.pair.ends = ends;
        const Face face = face_between(r.at, r.pair);
        if (!(face.energy > 0.0)) continue;
        const EndStiffness s = end_stiffness(face, r.pair, 0.0);
        const auto normal = [&](double a, double b) {
          r.pair.offset = {a, b};
          const FaceEnds n = face_between(r.at, r.pair).normal;
          r.pair.offset = {};
          return n;
        };
        const double d = 1e-8, scale = r.pair.stiffness;
        const FaceEnds up_a = normal(d, 0.0), down_a = normal(-d, 0.0), up_b = normal(0.0, d),
                       down_b = normal(0.0, -d);
        EXPECT_NEAR(s.aa, (up_a.a - down_a.a) / (2.0 * d), 1e-4 * scale) << tilt << ' ' << ends;
        EXPECT_NEAR(s.ab, (up_a.b - down_a.b) / (2.0 * d), 1e-4 * scale) << tilt << ' ' << ends;
        EXPECT_NEAR(s.ab, (up_b.a - down_b.a) / (2.0 * d), 1e-4 * scale) << tilt << ' ' << ends;
        EXPECT_NEAR(s.bb, (up_b.b - down_b.b) / (2.0 * d), 1e-4 * scale) << tilt << ' ' << ends;
      }
    }
  }
}

/// The forces at the ends do work on the motion of the points there: N on the closing normal to the
/// edge on which the corner presses, T on the slip.
TEST(Face, EndForcesWorkOnTheMotionOfTheEnds) {
  Faces faces;
  std::mt19937 random(11);
  std::uniform_real_distribution<> by(-1e-7, 1e-7);
  int tried = 0;
  while (tried < 2000) {
    const RandomFace r = faces.next();
    const Face face = face_between(r.at, r.pair);
    if (!(face.energy > 1e-9) || !is_smooth(r, face)) continue;
    ++tried;
    FacePoints then = r.at;
    for (Vec2* p : {&then.p1, &then.p2, &then.q1, &then.q2}) *p += Vec2{by(random), by(random)};
    const auto corners = [&](const FacePoints& p) {
      return coordinates_of(p, r.pair.inverse_e, r.pair.inverse_f);
    };
    const EndMotion motion = motion_of(face, corners(r.at), corners(then), r.pair.length_ratio);
    const FaceEnds normal{1.3, -0.4}, shear{0.7, 0.9};
    const CornerForces f = end_forces(r.at, face, normal, shear);
    const double work = dot(f.p1, r.at.p1 - then.p1) + dot(f.p2, r.at.p2 - then.p2) +
                        dot(f.q1, r.at.q1 - then.q1) + dot(f.q2, r.at.q2 - then.q2);
    const double expected = -normal.a * motion.closure.a - normal.b * motion.closure.b +
                            shear.a * motion.slip.a + shear.b * motion.slip.b;
    EXPECT_NEAR(work, expected, 1e-11);
  }
}

}  // namespace
}  // namespace edda
