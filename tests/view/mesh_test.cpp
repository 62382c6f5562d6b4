#include "view/mesh.hpp"

#include <gtest/gtest.h>

#include "view/frames_of.hpp"

namespace edda::mesh_test {
namespace {

const std::vector<TestBlock> two{{0, {{0, 0}, {2, 0}, {2, 1}, {0, 1}}, false},
                                 {7, {{1e6, 5}, {1e6 + 3, 5}, {1e6, 9}}, true}};

TEST(ViewMesh, HasEachVertexOnceFromItsBlocksCentre) {
  const ViewMesh mesh = view_mesh(frame_of(two, stays, nothing));
  ASSERT_EQ(mesh.size(), 2u);
  EXPECT_EQ(mesh.id, (std::vector<std::int32_t>{0, 7}));
  EXPECT_EQ(mesh.fixed, (std::vector<std::uint8_t>{0, 1}));
  EXPECT_EQ(mesh.begin, (std::vector<std::size_t>{0, 4, 7}));
  EXPECT_EQ(mesh.centre[0], (Vec2{1.0, 0.5}));
  EXPECT_NEAR(mesh.centre[1].x, 1e6 + 1.0, 1e-9);
  EXPECT_EQ(mesh.vertex[2], (Vec2{1.0, 0.5}));
  EXPECT_EQ(mesh.triangles.size(), 3u);
  EXPECT_EQ(mesh.edges.size(), 7u);
  EXPECT_EQ(mesh.row_of(7), 1u);
  EXPECT_EQ(mesh.row_of(3), mesh.size());
}

// An L is drawn as triangles; its edges are those of the outline alone.
TEST(ViewMesh, OutlineOfTrianglesLeavesOutTheirOwnEdges) {
  Grid g = frame_of({{0, {{0, 0}, {2, 0}, {2, 1}, {1, 1}, {1, 2}, {0, 2}}, false}}, stays, nothing);
  g.corners = {0, 1, 3, 1, 2, 3, 0, 3, 5, 3, 4, 5};
  g.ends = {3, 6, 9, 12};
  g.types.assign(4, cell_type::triangle);
  for (Field& f : g.cell_fields) {
    const std::vector<double> one = f.values;
    for (int k = 0; k < 3; ++k) f.values.insert(f.values.end(), one.begin(), one.end());
  }
  const ViewMesh mesh = view_mesh(g);
  ASSERT_EQ(mesh.size(), 1u);
  EXPECT_EQ(mesh.vertex.size(), 6u);
  EXPECT_EQ(mesh.triangles.size(), 4u);
  EXPECT_EQ(mesh.edges.size(), 6u);
  EXPECT_NEAR(mesh.centre[0].x, 5.0 / 6.0, 1e-15);
}

TEST(ViewMesh, AnAffineFieldComesBackExactly) {
  const ViewMesh mesh = view_mesh(frame_of(two, stays, nothing));
  const BlockMotion m{{0.3, -2.0}, 0.1, -0.7, 0.4, -0.2};
  for (std::size_t row = 0; row < mesh.size(); ++row) {
    const BlockMotion found = block_motion(mesh, row, [&](std::size_t v) {
      const Vec2 r = mesh.vertex[v];
      return m.d + Vec2{m.xx * r.x + m.xy * r.y, m.yx * r.x + m.yy * r.y};
    });
    EXPECT_NEAR(found.d.x, m.d.x, 1e-14);
    EXPECT_NEAR(found.d.y, m.d.y, 1e-14);
    EXPECT_NEAR(found.xx, m.xx, 1e-14);
    EXPECT_NEAR(found.xy, m.xy, 1e-14);
    EXPECT_NEAR(found.yx, m.yx, 1e-14);
    EXPECT_NEAR(found.yy, m.yy, 1e-14);
  }
}

/// A node within an edge counts by its part of the boundary: u at it alone has the mean gradient u
/// G^T, G = (y_next - y_before, x_before - x_next)/(2 A), and moves the block by its part of the
/// mass.
TEST(ViewMesh, ANodeWithinAnEdgeCountsByItsEdges) {
  const ViewMesh mesh =
      view_mesh(frame_of({{0, {{0, 0}, {1, 0}, {2, 0}, {2, 1}, {0, 1}}, false}}, stays, nothing));
  const BlockMotion found = block_motion(mesh, 0, [&](std::size_t v) {
    return norm(mesh.vertex[v] - Vec2{0.0, -0.5}) < 1e-12 ? Vec2{0.3, 0.6} : Vec2{};
  });
  EXPECT_NEAR(found.xx, 0.0, 1e-14);
  EXPECT_NEAR(found.yx, 0.0, 1e-14);
  EXPECT_NEAR(found.xy, -0.5 * 0.3, 1e-14);
  EXPECT_NEAR(found.yy, -0.5 * 0.6, 1e-14);
  EXPECT_NEAR(found.d.x, 0.3 / 6.0, 1e-14);
  EXPECT_NEAR(found.d.y, 0.6 / 6.0, 1e-14);
}

}  // namespace
}  // namespace edda::mesh_test
