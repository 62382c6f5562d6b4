// Values along a line: which cells it meets, and from where to where.
#include "report/along_line.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "report/two_blocks.hpp"

namespace edda::along_line_test {
namespace {

/// A square of two triangles from (0, 0) to (1, 1), and one from (2, 0) to (3, 1).
TEST(AlongLine, HasThePartsInTheirOrder) {
  const Grid g = two_blocks();
  const std::vector<LinePart> parts = parts_along(g, {-1.0, 0.25}, {3.5, 0.25});
  ASSERT_EQ(parts.size(), 3u);
  const double ends[][2] = {{1.0, 1.25}, {1.25, 2.0}, {3.0, 4.0}};
  const std::size_t cells[] = {1, 0, 2};
  for (std::size_t k = 0; k < parts.size(); ++k) {
    EXPECT_NEAR(parts[k].from, ends[k][0], 1e-12);
    EXPECT_NEAR(parts[k].to, ends[k][1], 1e-12);
    EXPECT_EQ(parts[k].cell, cells[k]);
  }
  // The other way round.
  const std::vector<LinePart> back = parts_along(g, {3.5, 0.25}, {-1.0, 0.25});
  ASSERT_EQ(back.size(), 3u);
  EXPECT_EQ(back[0].cell, 2u);
  EXPECT_NEAR(back[0].from, 0.5, 1e-12);
}

/// An edge between two cells, and one of the outline, either way: no part twice, none missing.
TEST(AlongLine, FollowsAnEdge) {
  const Grid g = two_blocks();
  for (const auto& [a, b] :
       {std::pair{Vec2{0, 0}, Vec2{1, 1}}, std::pair{Vec2{1, 1}, Vec2{0, 0}},
        std::pair{Vec2{0, 0}, Vec2{1, 0}}, std::pair{Vec2{1, 0}, Vec2{0, 0}}}) {
    const std::vector<LinePart> parts = parts_along(g, a, b);
    ASSERT_EQ(parts.size(), 1u);
    EXPECT_NEAR(parts[0].to - parts[0].from, norm(b - a), 1e-12);
  }
  EXPECT_TRUE(parts_along(g, {1.2, 0.0}, {1.2, 1.0}).empty());
  EXPECT_TRUE(parts_along(g, {0.0, 1.0}, {-1.0, 2.0}).empty());  // touches a corner
}

TEST(AlongLine, HasARowForEachPartAndAGapBetweenBlocks) {
  const Grid g = two_blocks();
  const Vec2 begin{0.0, 0.25}, end{3.0, 0.25};
  const std::vector<LineField> fields{
      {"displacement.x", shown_field("displacement.x", g, nullptr).value()},
      {"displacement", shown_field("displacement", g, nullptr).value()},
      {"id", shown_field("id", g, nullptr).value()}};
  const Table t = table_along(g, parts_along(g, begin, end), begin, end, fields);
  ASSERT_EQ(t.rows(), 3u);
  EXPECT_NEAR(t.column("distance")->values[0], 0.125, 1e-12);
  EXPECT_NEAR(t.column("x")->values[2], 2.5, 1e-12);
  EXPECT_NEAR(t.column("length")->values[1], 0.75, 1e-12);
  EXPECT_EQ(t.column("block")->values, (std::vector<double>{4, 4, 5}));
  EXPECT_EQ(t.column("displacement.x")->values, (std::vector<double>{0.5, 0.5, 0.5}));
  const Table drawn = with_gaps(t);
  ASSERT_EQ(drawn.rows(), 4u);
  EXPECT_TRUE(std::isnan(drawn.column("displacement")->values[2]));
  EXPECT_NEAR(drawn.column("distance")->values[2], 1.5, 1e-12);
  const std::vector<HistoryPanel> panels = panels_along(drawn, fields);
  ASSERT_EQ(panels.size(), 2u);
  EXPECT_EQ(panels[0].unit, "m");
  EXPECT_EQ(panels[0].lines.size(), 2u);
  EXPECT_EQ(panels[0].label, "displacement");
}

}  // namespace
}  // namespace edda::along_line_test
