#include "report/plot.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "report/colours.hpp"
#include "report/shapes.hpp"
#include "report/ticks.hpp"

namespace edda {
namespace {

/// A square of two triangles (block 4) and a square cell (block 5), moved by (0.5, 0).
Grid two_blocks() {
  Grid g;
  g.points = {0, 0, 0, 1, 0, 0, 1, 1, 0, 0, 1, 0, 2, 0, 0, 3, 0, 0, 3, 1, 0, 2, 1, 0};
  g.corners = {0, 1, 2, 0, 2, 3, 4, 5, 6, 7};
  g.ends = {3, 6, 10};
  g.types = {cell_type::triangle, cell_type::triangle, cell_type::polygon};
  std::vector<double> u;
  for (int k = 0; k < 8; ++k) u.insert(u.end(), {0.5, 0.0, 0.0});
  g.point_fields = {{"displacement", 3, u, {}, false}};
  g.cell_fields = {{"id", 1, {4, 4, 5}, {}, true},
                   {"fixed", 1, {0, 0, 1}, {}, true},
                   {"displacement", 3, {0.5, 0, 0, 0.5, 0, 0, 0.5, 0, 0}, {}, false}};
  return g;
}

TEST(Shapes, TrianglesOfOneBlockHaveOneOutline) {
  const auto shapes = block_shapes(two_blocks());
  ASSERT_EQ(shapes.size(), 2u);
  EXPECT_EQ(shapes[0].outline.size(), 4u);
  EXPECT_EQ(shapes[1].outline.size(), 4u);
  const Grid g = two_blocks();
  const Vec2 c = centre_of(g, shapes[0], drawn_points(g, 1.0));
  EXPECT_NEAR(c.x, 0.5, 1e-12);
  EXPECT_NEAR(c.y, 0.5, 1e-12);
}

TEST(Shapes, MaterialPointsAreFollowed) {
  const Grid g = two_blocks();
  const auto drawn = drawn_points(g, 3.0);
  Vec2 now;
  ASSERT_TRUE(follow(g, drawn, {-0.25, 0.75}, now));  // in block 4 as it lay at the start
  EXPECT_NEAR(now.x, -0.25 + 1.5, 1e-12);
  EXPECT_NEAR(now.y, 0.75, 1e-12);
  EXPECT_FALSE(follow(g, drawn, {9.0, 9.0}, now));
}

TEST(Ticks, AreRoundAndInside) {
  const auto t = ticks(-0.31, 1.02, 6);
  ASSERT_EQ(t.size(), 3u);
  EXPECT_EQ(t[0].label, "0.0");
  EXPECT_EQ(t[1].label, "0.5");
  EXPECT_TRUE(ticks(1.0, 1.0, 5).empty());
  EXPECT_EQ(ticks(0.0, 100.0, 5).size(), 6u);
}

TEST(Ticks, UnitsTakeThePrefixThatSuits) {
  EXPECT_EQ(scaled_unit("Pa", 2.3e6).name, "MPa");
  EXPECT_EQ(scaled_unit("m", 0.004).name, "mm");
  EXPECT_EQ(scaled_unit("m", 5000.0).name, "m");
  EXPECT_EQ(scaled_unit("degrees", 1e-5).name, "degrees");
  EXPECT_DOUBLE_EQ(scaled_unit("N", 1500.0).factor, 1e-3);
}

TEST(Colours, LightnessOfTheSequentialMapOnlyRises) {
  double before = -1.0;
  for (int k = 0; k <= 100; ++k) {
    const Colour c = sequential(k / 100.0);
    const double light =
        0.2126 * std::pow(c.r, 2.2) + 0.7152 * std::pow(c.g, 2.2) + 0.0722 * std::pow(c.b, 2.2);
    EXPECT_GT(light, before) << k;
    before = light;
  }
}

TEST(Plot, DrawsBothFormatsAndNamesUnknownFields) {
  const Grid g = two_blocks();
  const Result<ShownField> field = shown_field("displacement", g, nullptr);
  ASSERT_TRUE(field.ok());
  EXPECT_DOUBLE_EQ(field.value().values[0], 0.5);
  for (const char* name : {"plot.png", "plot.svg"}) {
    const std::string path = testing::TempDir() + name;
    std::filesystem::remove(path);
    PlotOptions options;
    options.title = "Title <&> of it";
    options.monitors = {{"M", {0.0, 0.5}}};
    ASSERT_FALSE(plot(g, nullptr, field.value(), options, path));
    const std::string bytes = read_file(path).value();
    const bool png = path.ends_with("png");
    EXPECT_EQ(bytes.substr(0, png ? 4 : 5), png ? "\x89PNG" : "<?xml");
    EXPECT_GT(bytes.size(), 2000u);
    std::filesystem::remove(path);
  }
  const Result<ShownField> none = shown_field("displacment", g, nullptr);
  ASSERT_FALSE(none.ok());
  EXPECT_NE(none.faults()[0].remedy.find("displacement"), std::string::npos);
  EXPECT_TRUE(plot(g, nullptr, field.value(), {}, testing::TempDir() + "none/x.png"));
}

}  // namespace
}  // namespace edda
