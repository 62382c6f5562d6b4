// Meshes of polygons: they cover them once, keep their edges, and have the size and shape asked
// for.
#include "cutting/mesh.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <set>

#include "base/polygon.hpp"

namespace edda::mesh_test {
namespace {

struct Region {
  std::string name;
  std::vector<Ring> rings;
};

Ring circle(Vec2 centre, double radius, int corners, bool clockwise = false) {
  Ring ring;
  for (int k = 0; k < corners; ++k) {
    const double angle = (clockwise ? -2.0 : 2.0) * std::numbers::pi * k / corners;
    ring.push_back(centre + radius * Vec2{std::cos(angle), std::sin(angle)});
  }
  return ring;
}

std::vector<Region> regions() {
  return {{"square", {{{0, 0}, {1, 0}, {1, 1}, {0, 1}}}},
          {"bar", {{{0, 0}, {10, 0}, {10, 1}, {0, 1}}}},
          {"L", {{{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}}},
          {"pentagon", {{{0, 0}, {1.2, -0.1}, {1.7, 0.8}, {0.6, 1.5}, {-0.3, 0.7}}}},
          {"ring", {circle({0, 0}, 3.0, 40), circle({0.3, 0.1}, 1.0, 24, true)}},
          {"rock around a tunnel",
           {{{-8, -8}, {8, -8}, {8, 8}, {-8, 8}}, circle({0, 0}, 2.0, 32, true)}}};
}

double twice_area(const Mesh& m, const Triangle& t) {
  return cross(m.nodes[t[1]] - m.nodes[t[0]], m.nodes[t[2]] - m.nodes[t[0]]);
}
double least_angle(const Mesh& m, const Triangle& t) {
  double least = std::numbers::pi;
  for (std::size_t k = 0; k < 3; ++k) {
    const Vec2 u = m.nodes[t[(k + 1) % 3]] - m.nodes[t[k]],
               v = m.nodes[t[(k + 2) % 3]] - m.nodes[t[k]];
    least = std::min(least, std::atan2(cross(u, v), dot(u, v)));
  }
  return least * 180.0 / std::numbers::pi;
}
double area_of(const std::vector<Ring>& rings) {
  double sum = 0.0;
  for (const Ring& r : rings) {
    for (std::size_t k = 0; k < r.size(); ++k) sum += 0.5 * cross(r[k], r[(k + 1) % r.size()]);
  }
  return sum;
}
std::vector<Ring> all_divided(const std::vector<Ring>& rings, const MeshSize& size) {
  std::vector<Ring> out;
  for (const Ring& ring : rings) out.push_back(divided(ring, size));
  return out;
}

/// Every edge of the rings bounds one triangle, every other edge two; the areas add up.
void expect_whole(const Mesh& m, const std::vector<Ring>& rings, const std::string& name) {
  std::set<std::pair<std::uint32_t, std::uint32_t>> bounds, edges;
  std::uint32_t first = 0;
  for (const Ring& ring : rings) {
    const auto n = static_cast<std::uint32_t>(ring.size());
    for (std::uint32_t k = 0; k < n; ++k) bounds.insert({first + k, first + (k + 1) % n});
    first += n;
  }
  double area = 0.0;
  for (const Triangle& t : m.triangles) {
    EXPECT_GT(twice_area(m, t), 0.0) << name;
    area += 0.5 * twice_area(m, t);
    for (std::size_t k = 0; k < 3; ++k)
      EXPECT_TRUE(edges.insert({t[k], t[(k + 1) % 3]}).second) << name;
  }
  const double whole = area_of(rings);
  EXPECT_NEAR(area, whole, 1e-9 * whole) << name;
  for (const auto& e : edges)
    EXPECT_NE(edges.count({e.second, e.first}), bounds.count(e))
        << name << ' ' << e.first << ' ' << e.second;
  for (const auto& e : bounds) EXPECT_EQ(edges.count(e), 1u) << name;
}

TEST(Mesh, CoversItsPolygonOnceAndKeepsItsEdges) {
  for (const Region& r : regions()) {
    for (const double h : {0.7, 0.25, 0.1}) {
      const MeshSize size = [h](Vec2) { return h; };
      const std::vector<Ring> rings = all_divided(r.rings, size);
      expect_whole(mesh_polygon(rings, size), rings, r.name);
      expect_whole(mesh_polygon(r.rings, size), r.rings, r.name + ", undivided");
    }
  }
}

TEST(Mesh, HasTheSizeAskedFor) {
  for (const Region& r : regions()) {
    for (const double h : {0.25, 0.1}) {
      const MeshSize size = [h](Vec2) { return h; };
      const Mesh m = mesh_polygon(all_divided(r.rings, size), size);
      const double mean = area_of(r.rings) / static_cast<double>(m.triangles.size());
      EXPECT_NEAR(mean / (std::sqrt(3.0) / 4.0 * h * h), 1.0, 0.35) << r.name << ' ' << h;
      double flattest = 180.0, longest = 0.0;
      for (const Triangle& t : m.triangles) {
        flattest = std::min(flattest, least_angle(m, t));
        for (std::size_t k = 0; k < 3; ++k)
          longest = std::max(longest, norm(m.nodes[t[k]] - m.nodes[t[(k + 1) % 3]]));
      }
      EXPECT_GT(flattest, 22.0) << r.name << ' ' << h;
      EXPECT_LT(longest, 1.8 * h) << r.name << ' ' << h;
    }
  }
}

/// Fine at the wall, coarse far from it: as many triangles as the integral of the size asks for.
TEST(Mesh, IsGraded) {
  const std::vector<Ring> rock = regions().back().rings;
  const MeshSize size = [](Vec2 p) { return 0.15 + 0.2 * std::max(norm(p) - 2.0, 0.0); };
  const std::vector<Ring> rings = all_divided(rock, size);
  const Mesh m = mesh_polygon(rings, size);
  expect_whole(m, rings, "graded");
  double flattest = 180.0;
  for (const Triangle& t : m.triangles) {
    const Vec2 at = (m.nodes[t[0]] + m.nodes[t[1]] + m.nodes[t[2]]) / 3.0;
    const double h = std::sqrt(2.0 * twice_area(m, t) / std::sqrt(3.0));
    EXPECT_LT(h, 1.5 * size(at));
    EXPECT_GT(h, 0.35 * size(at));
    flattest = std::min(flattest, least_angle(m, t));
  }
  EXPECT_GT(flattest, 20.0);
  EXPECT_LT(m.triangles.size(), 2500u);
}

TEST(Mesh, BothSidesOfAJointAreDividedAlike) {
  const MeshSize size = [](Vec2 p) { return 0.1 + 0.05 * norm(p); };
  const Vec2 a{0.3, 0.2}, b{4.1, 1.7};
  Ring one = divided({a, b, {0.3, 3.0}}, size), other = divided({b, a, {4.1, -2.0}}, size);
  one.resize(static_cast<std::size_t>(std::find(one.begin(), one.end(), b) - one.begin()));
  other.resize(static_cast<std::size_t>(std::find(other.begin(), other.end(), a) - other.begin()));
  ASSERT_EQ(one.size(), other.size());
  ASSERT_GT(one.size(), 10u);
  for (std::size_t k = 1; k < one.size(); ++k) EXPECT_EQ(one[k], other[other.size() - k]);
}

}  // namespace
}  // namespace edda::mesh_test
