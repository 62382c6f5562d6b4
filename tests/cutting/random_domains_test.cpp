// Outlines and openings of any shape under random sets and traces: no oracle for the count, but one
// for the area, the place of every block and the equality of sets with their lines drawn one by
// one.
#include <gtest/gtest.h>

#include <random>

#include "cutting/checks.hpp"
#include "cutting/line_models.hpp"

namespace edda::random_domains_test {
namespace {

using namespace test;

/// A star-shaped ring of n corners round `centre`, with radii from half of `radius` up to it.
Ring star(std::mt19937& random, Vec2 centre, double radius, int n) {
  std::uniform_real_distribution<double> part(0.5, 1.0);
  Ring ring;
  for (int i = 0; i < n; ++i) {
    ring.push_back(centre + rotated({radius * part(random), 0.0}, 2.0 * std::numbers::pi * i / n));
  }
  return ring;
}

Model random_domain(unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> place(-12.0, 12.0), angle(0.0, 180.0), spacing(0.8, 3.0);
  Model model = domain_model(star(random, {0, 0}, 12.0, 5 + static_cast<int>(seed % 20)), 2e-8);
  for (unsigned i = 0; i < seed % 3; ++i) {
    add_opening(model, star(random, {0.3 * place(random), 0.3 * place(random)}, 2.0, 7), 20);
  }
  for (unsigned i = 0; i < 1 + seed % 2; ++i) {
    Ring region;
    if (seed % 4 == 3) region = star(random, {0.2 * place(random), 0.0}, 8.0, 9);
    add_set(model, angle(random), spacing(random), {place(random), place(random)},
            static_cast<Index>(i), region);
  }
  for (unsigned i = 0; i < seed % 11; ++i) {
    add_trace(model,
              {{place(random), place(random)},
               {place(random), place(random)},
               {place(random), place(random)}},
              10);
  }
  return model;
}

/// A point inside a block: the middle of its largest corner triangle that holds no other vertex.
Vec2 inside_of(const BlockPolygon& block) {
  const Ring& ring = block.rings[0];
  Vec2 best = ring[0];
  double clearance = -1.0;
  for (std::size_t i = 0; i < ring.size(); ++i) {
    for (std::size_t j = i + 2; j < ring.size(); ++j) {
      for (const Vec2 p :
           {0.5 * (ring[i] + ring[j]), (ring[i] + ring[j] + ring[(i + 1) % ring.size()]) / 3.0}) {
        if (side_of(block.rings, p, 0.0) <= 0) continue;
        double nearest = 1e300;
        for (std::size_t k = 0; k < ring.size(); ++k) {
          const Vec2 a = ring[k], d = ring[(k + 1) % ring.size()] - a;
          const double t = std::clamp(dot(p - a, d) / dot(d, d), 0.0, 1.0);
          nearest = std::min(nearest, norm(p - (a + t * d)));
        }
        if (nearest > clearance) clearance = nearest, best = p;
      }
    }
  }
  return best;
}

void expect_in_place(const Model& model, const PolygonSet& set) {
  const auto openings_over = [&](Vec2 p) {
    return std::count_if(model.openings.begin(), model.openings.end(), [&](const Opening& o) {
      return side_of({&o.polygon, 1}, p, 0.0) > 0;
    });
  };
  for (const BlockPolygon& block : set.blocks) {
    const Vec2 p = inside_of(block) + set.origin;
    EXPECT_GE(side_of({&model.domain->outline, 1}, p, 1e-9), 0);
    EXPECT_EQ(openings_over(p), 0);
  }
  for (const BlockPolygon& gone : set.removed) {
    EXPECT_GE(openings_over(inside_of(gone) + set.origin), 1);
  }
}

TEST(RandomDomains, KeepAreaAndPlaceAndCountsTurned) {
  std::size_t blocks = 0, removed = 0;
  for (unsigned seed = 0; seed < 300; ++seed) {
    SCOPED_TRACE(seed);
    const Model model = random_domain(seed);
    const auto result = build_polygons(model);
    expect_sound(result, 2e-8);
    ASSERT_TRUE(result.ok());
    expect_in_place(model, result.value());
    blocks += result.value().blocks.size();
    removed += result.value().removed.size();
    for (double angle : {37.0, 181.3}) {
      const auto again = build_polygons(shifted(turned(model, angle), {1e5, 3e4}));
      expect_sound(again, 2e-8);
      ASSERT_TRUE(again.ok());
      EXPECT_EQ(again.value().blocks.size(), result.value().blocks.size());
      EXPECT_EQ(again.value().removed.size(), result.value().removed.size());
      EXPECT_EQ(again.value().report.dangling, result.value().report.dangling);
      EXPECT_NEAR(again.value().report.area_in, result.value().report.area_in, 1e-6);
      const auto expected = length_by_law(result.value().blocks);
      for (const auto& [law, length] : length_by_law(again.value().blocks)) {
        EXPECT_NEAR(length, expected.at(law), 1e-5);
      }
    }
  }
  EXPECT_GT(blocks, 10000u);
  EXPECT_GT(removed, 1000u);
}

TEST(RandomDomains, SetsCutLikeTheirLinesDrawnOneByOne) {
  for (unsigned seed = 0; seed < 150; ++seed) {
    SCOPED_TRACE(seed);
    Model model = random_domain(seed);
    for (JointSet& set : model.joint_sets) set.region.clear();
    Model drawn = model;
    drawn.joint_sets.clear();
    drawn.traces.clear();
    for (const JointSet& set : model.joint_sets) {
      const Vec2 d = rotated({1.0, 0.0}, set.angle * std::numbers::pi / 180.0);
      for (int k = -60; k <= 60; ++k) {
        const Vec2 p = set.origin + (k * set.spacing) * perp(d);
        add_trace(drawn, {p - 60.0 * d, p + 60.0 * d}, set.joint);
      }
    }
    for (const Trace& t : model.traces) drawn.traces.push_back(t);
    const auto a = build_polygons(model), b = build_polygons(drawn);
    expect_sound(a, 2e-8);
    expect_sound(b, 2e-8);
    ASSERT_TRUE(a.ok() && b.ok());
    ASSERT_EQ(a.value().blocks.size(), b.value().blocks.size());
    EXPECT_EQ(a.value().report.dangling, b.value().report.dangling);
    for (std::size_t i = 0; i < a.value().blocks.size(); ++i) {
      const Moments m = moments(a.value().blocks[i].rings), n = moments(b.value().blocks[i].rings);
      ASSERT_NEAR(m.area, n.area, 1e-9);
      ASSERT_NEAR(norm(m.centroid + a.value().origin - n.centroid - b.value().origin), 0.0, 1e-7);
    }
  }
}

}  // namespace
}  // namespace edda::random_domains_test
