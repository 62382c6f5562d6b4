// Each triangle is in one pair, and few remain alone.
#include "zones/pairs.hpp"

#include <gtest/gtest.h>

#include <set>

namespace edda::pairs_test {
namespace {

TEST(Pairs, EveryTriangleIsInOne) {
  const MeshSize size = [](Vec2 p) { return 0.1 + 0.05 * p.x; };
  const std::vector<Ring> rings{divided({{0, 0}, {3, 0}, {3, 2}, {0, 2}}, size)};
  const Mesh mesh = mesh_polygon(rings, size);
  std::set<std::uint32_t> seen;
  std::size_t alone = 0;
  for (const auto& [one, other] : pair_triangles(mesh)) {
    EXPECT_TRUE(seen.insert(one).second);
    if (other == no_partner) {
      ++alone;
      continue;
    }
    EXPECT_TRUE(seen.insert(other).second);
    int shared = 0;
    for (const std::uint32_t a : mesh.triangles[one]) {
      for (const std::uint32_t b : mesh.triangles[other]) shared += a == b;
    }
    EXPECT_EQ(shared, 2);
  }
  EXPECT_EQ(seen.size(), mesh.triangles.size());
  EXPECT_LT(static_cast<double>(alone), 0.01 * static_cast<double>(mesh.triangles.size()));
}

}  // namespace
}  // namespace edda::pairs_test
