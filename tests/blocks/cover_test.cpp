#include "blocks/cover.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

#include "blocks/build_blocks.hpp"
#include "blocks/kinematics.hpp"
#include "blocks/masses.hpp"

namespace edda::cover_test {
namespace {

Ring random_star(std::mt19937& rng, int n) {
  std::uniform_real_distribution<double> radius(0.4, 2.0);
  Ring ring;
  for (int i = 0; i < n; ++i) {
    const double a = 2.0 * std::numbers::pi * i / n;
    ring.push_back(radius(rng) * Vec2{std::cos(a), std::sin(a)} + Vec2{3.0, -7.0});
  }
  return ring;
}

TEST(Moments, SquareWithAHole) {
  const std::vector<Ring> rings{{{0, 0}, {4, 0}, {4, 4}, {0, 4}}, {{1, 1}, {1, 3}, {3, 3}, {3, 1}}};
  const Moments m = moments(rings);
  EXPECT_DOUBLE_EQ(m.area, 12.0);
  EXPECT_DOUBLE_EQ(m.centroid.x, 2.0);
  EXPECT_DOUBLE_EQ(m.sxx, (256.0 - 16.0) / 12.0);
  EXPECT_NEAR(m.sxy, 0.0, 1e-14);
}

TEST(MatchedCover, ConsistentMassIsOneThirdIdentity) {
  std::mt19937 rng(1);
  for (int trial = 0; trial < 50; ++trial) {
    const std::vector<Ring> rings{random_star(rng, 3 + trial % 9)};
    const Moments m = moments(rings);
    const auto mass = consistent_mass(m, gradients(matched_cover(m)), {1 / 3., 1 / 3., 1 / 3.});
    EXPECT_NEAR(mass[0], 1 / 3., 2e-14);
    EXPECT_NEAR(mass[3], 1 / 3., 2e-14);
    EXPECT_NEAR(mass[5], 1 / 3., 2e-14);
    EXPECT_NEAR(mass[1], 0.0, 2e-14);
    EXPECT_NEAR(mass[2], 0.0, 2e-14);
    EXPECT_NEAR(mass[4], 0.0, 2e-14);
  }
}

TEST(CoveringCover, ContainsTheBlockAndIsTheLeast) {
  std::mt19937 rng(2);
  for (int trial = 0; trial < 30; ++trial) {
    const Ring ring = random_star(rng, 3 + trial % 9);
    const Vec2 c = moments(std::vector<Ring>{ring}).centroid;
    const Cover cover = covering_cover(ring, c);
    const double radius = norm(cover[0] - c);
    const auto g = gradients(cover);
    for (Vec2 p : ring) {
      for (std::size_t k = 0; k < 3; ++k) EXPECT_GE(1 / 3. + dot(g[k], p - c), -1e-12);
    }
    // Brute force over orientations: none may be smaller, and the best must come close.
    double best = 1e300;
    for (int step = 0; step < 20000; ++step) {
      const double angle = 2.0 * std::numbers::pi / 3.0 * step / 20000;
      double r = 0.0;
      for (int k = 0; k < 3; ++k) {
        const double a = angle + 2.0 * std::numbers::pi * k / 3.0;
        for (Vec2 p : ring) r = std::max(r, dot(p - c, Vec2{std::cos(a), std::sin(a)}));
      }
      best = std::min(best, 2.0 * r);
    }
    EXPECT_LE(radius, best * (1.0 + 1e-12));
    EXPECT_GE(radius, best * (1.0 - 1e-3));
  }
}

TEST(CoveringCover, InertiaOfThePapersBlock) {
  // Theory, section 2.3: 9.6 times too large for the paper's own 2 x 1 block.
  const Ring ring{{0, 0}, {2, 0}, {2, 1}, {0, 1}};
  const Moments m = moments(std::vector<Ring>{ring});
  const double r = norm(covering_cover(ring, m.centroid)[0] - m.centroid);
  EXPECT_NEAR(r * r * m.area / (m.sxx + m.syy), 9.6, 0.05);
}

TEST(InverseSymmetric, TimesItselfIsIdentity) {
  const std::array<double, 6> a{4, 1, 0.5, 3, -0.2, 2};
  const auto b = inverse_symmetric(a);
  EXPECT_NEAR(a[0] * b[0] + a[1] * b[1] + a[2] * b[2], 1.0, 1e-14);
  EXPECT_NEAR(a[0] * b[1] + a[1] * b[3] + a[2] * b[4], 0.0, 1e-14);
  EXPECT_NEAR(a[1] * b[1] + a[3] * b[3] + a[4] * b[4], 1.0, 1e-14);
  EXPECT_NEAR(a[2] * b[2] + a[4] * b[4] + a[5] * b[5], 1.0, 1e-14);
}

PolygonSet one_polygon(const Ring& ring, Vec2 velocity, double omega) {
  PolygonSet set;
  BlockPolygon p;
  p.rings = {ring};
  p.joint = {std::vector<Index>(ring.size(), none)};
  p.material = 0;
  p.velocity = velocity;
  p.angular_velocity = omega;
  set.blocks.push_back(p);
  return set;
}

TEST(BuildBlocks, KineticEnergyOfALinearFieldIsExact) {
  Model model;
  model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  std::mt19937 rng(3);
  for (MassKind kind : {MassKind::matched, MassKind::consistent}) {
    model.solver.mass = kind;
    const PolygonSet set = one_polygon(random_star(rng, 7), {1.0, -2.0}, 3.0);
    const BlockSet b = build_blocks(model, set);
    const Masses masses = given_masses(b);
    const State s = initial_state(b, set);
    const Moments m = moments(set.blocks[0].rings);
    const double exact = 0.5 * b.mass[0] * 5.0 + 0.5 * 2600.0 * (m.sxx + m.syy) * 9.0;
    double kinetic = 0.0;
    if (kind == MassKind::matched) {
      for (std::size_t k = 0; k < 3; ++k) {
        kinetic +=
            0.5 * masses.node[k][0] *
            (s.velocity.x[k][0] * s.velocity.x[k][0] + s.velocity.y[k][0] * s.velocity.y[k][0]);
      }
    } else {
      std::array<double, 6> inverse;
      for (std::size_t e = 0; e < 6; ++e) inverse[e] = masses.inverse[e][0];
      const auto mass = inverse_symmetric(inverse);
      constexpr std::size_t at[3][3] = {{0, 1, 2}, {1, 3, 4}, {2, 4, 5}};
      for (std::size_t k = 0; k < 3; ++k) {
        for (std::size_t l = 0; l < 3; ++l) {
          kinetic +=
              0.5 * mass[at[k][l]] *
              (s.velocity.x[k][0] * s.velocity.x[l][0] + s.velocity.y[k][0] * s.velocity.y[l][0]);
        }
      }
    }
    EXPECT_NEAR(kinetic, exact, 2e-13 * exact);
  }
}

/// A vertex by which an edge is divided has no exterior angle, however it is rounded; one at which
/// the outline turns inwards counts as a right angle.
TEST(BuildBlocks, CornersThatHardlyTurnAreStraight) {
  Model model;
  model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  for (const auto& [out, cosine, sine] : {std::array{0.0, 1.0, 0.0},
                                          {1e-15, 1.0, 0.0},
                                          {-5e-4, 1.0, 0.0},
                                          {7e-4, 1.0, 0.0},
                                          {0.5, 0.0, 1.0},
                                          {-0.1, 0.0, 1.0}}) {
    const PolygonSet set =
        one_polygon({{0.0, 0.0}, {0.5, -out}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}}, {}, 0.0);
    const BlockSet b = build_blocks(model, set);
    EXPECT_NEAR(b.exterior_cosine[1], cosine, 1e-12) << out;
    EXPECT_EQ(b.exterior_sine[1] == 0.0, sine == 0.0) << out;
    EXPECT_NEAR(b.exterior_sine[1], sine, 1e-12) << out;
  }
}

TEST(BuildBlocks, VertexWeightsReproduceTheVertices) {
  Model model;
  model.materials.push_back({"rock", 2600.0, 1e9, 0.2, {}});
  std::mt19937 rng(4);
  const PolygonSet set = one_polygon(random_star(rng, 9), {}, 0.0);
  const BlockSet b = build_blocks(model, set);
  const State s = initial_state(b, set);
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    const Vec2 p = corner_at(b, s.position, v);
    EXPECT_NEAR(p.x, b.vertex_x[v], 1e-14);
    EXPECT_NEAR(p.y, b.vertex_y[v], 3e-14);
  }
}

}  // namespace
}  // namespace edda::cover_test
