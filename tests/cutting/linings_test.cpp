// Strips of linings along outlines and lines.
#include "cutting/linings.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "base/polygon.hpp"
#include "cutting/build_polygons.hpp"
#include "model/read_model.hpp"

namespace edda::linings_test {
namespace {

const std::string ground =
    "[solver]\nduration = 1\n[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
    "[joints.rough]\nfriction_angle = 30\n"
    "[domain]\noutline = [[-10, -10], [10, -10], [10, 10], [-10, 10]]\n"
    "[[opening]]\nname = 'room'\npolygon = [[-2, -1], [2, -1], [2, 1], [-2, 1]]\n";

struct Made {
  PolygonSet polygons;
  Faults faults;
  const BlockPolygon& last() const { return polygons.blocks.back(); }
};
Made made(const std::string& toml) {
  const Result<Model> model = read_model_text(ground + toml, "m.toml", {});
  if (!model.ok()) ADD_FAILURE() << to_string(model.faults().front());
  Made m{build_polygons(model.value()).value(), {}};
  m.faults = add_linings(model.value(), m.polygons);
  return m;
}

TEST(Linings, WholeOutline) {
  const Made m = made("[[lining]]\nopening = 'room'\nthickness = 0.2\nsize = 0.5\n");
  ASSERT_TRUE(m.faults.empty());
  const BlockPolygon& strip = m.last();
  ASSERT_EQ(strip.rings.size(), 2U);
  EXPECT_EQ(strip.lining, 0);
  EXPECT_NEAR(moments(strip.rings).area, 4.0 * 2.0 - 3.6 * 1.6, 1e-12);
  const StripSections s = sections_of(strip);
  EXPECT_TRUE(s.closed);
  EXPECT_EQ(s.count, 24U);
  EXPECT_EQ(s.pieces(), 24U);
  // Sections join an outer corner to the inner one across from it.
  const Ring& inner = strip.rings[1];
  for (std::uint32_t k = 0; k < s.count; ++k)
    EXPECT_NEAR(norm(strip.rings[0][s.outer(k)] - inner[s.inner(k) - s.count]), 0.2,
                0.2 * (std::numbers::sqrt2 - 1.0) + 1e-12);
}

TEST(Linings, PartOfAnOutlineAndALayerOnIt) {
  const Made m = made(
      "[[lining]]\nname = 'a'\nopening = 'room'\nfrom_angle = 0\nto_angle = 180\nthickness = 0.2\n"
      "size = 0.5\n[[lining]]\non = 'a'\nthickness = 0.1\nsize = 1\n");
  ASSERT_TRUE(m.faults.empty());
  const BlockPolygon& first = m.polygons.blocks[m.polygons.blocks.size() - 2];
  ASSERT_EQ(first.rings.size(), 1U);
  // From (2, 0) over both upper corners to (-2, 0).
  EXPECT_NEAR(moments(first.rings).area, 0.2 * (1.0 + 3.6 + 1.0), 1e-9);
  const BlockPolygon& second = m.last();
  EXPECT_NEAR(moments(second.rings).area, 0.1 * (0.8 + 3.4 + 0.8), 1e-9);
  const StripSections s = sections_of(first);
  EXPECT_FALSE(s.closed);
  EXPECT_EQ(s.pieces() + 1, s.count);
  EXPECT_NEAR(second.rings[0][0].x, first.rings[0][s.inner(0)].x, 1e-12);
}

TEST(Linings, PartThatGoesRoundTheStartOfTheOutline) {
  const Made m =
      made("[[lining]]\nopening = 'room'\nfrom_angle = 180\nto_angle = 90\nthickness = 0.2\n");
  ASSERT_TRUE(m.faults.empty());
  // From (-2, 0) by the floor to (0, 1).
  EXPECT_NEAR(moments(m.last().rings).area, 0.2 * (0.9 + 3.8 + 1.8 + 1.9), 1e-9);
}

TEST(Linings, OnTheLeftOfALine) {
  const Made m = made("[[lining]]\nalong = [[-2, 1], [-2, -1], [2, -1]]\nthickness = 0.2\n");
  ASSERT_TRUE(m.faults.empty());
  EXPECT_NEAR(moments(m.last().rings).area, 0.2 * (1.8 + 4.0), 1e-9);
}

/// Where one goes on as another they meet in one plane, whatever their order and thickness.
TEST(Linings, ThatMeetDoNotOverlap) {
  const std::string wall = "[[lining]]\nname = 'w'\nalong = [[2, -1], [2, 1]]\nthickness = 0.2\n",
                    roof = "[[lining]]\nname = 'r'\nalong = [[2, 1], [-2, 1]]\nthickness = 0.3\n",
                    layer = "[[lining]]\non = 'r'\nthickness = 0.1\n";
  for (const bool wall_first : {true, false}) {
    const Made m = made((wall_first ? wall + roof : roof + wall) + layer);
    ASSERT_TRUE(m.faults.empty());
    const std::vector<BlockPolygon>& b = m.polygons.blocks;
    const double first = moments(b[b.size() - 3].rings).area,
                 second = moments(b[b.size() - 2].rings).area;
    EXPECT_NEAR(wall_first ? first : second, 0.2 * (2.0 - 0.1), 1e-12);
    EXPECT_NEAR(wall_first ? second : first, 0.3 * (4.0 - 0.15), 1e-12);
    EXPECT_NEAR(moments(m.last().rings).area, 0.1 * (3.7 - 0.05), 1e-12);
  }
}

TEST(Linings, OneFaultEach) {
  const auto fault = [](const std::string& toml) {
    const Faults faults = made(toml).faults;
    EXPECT_EQ(faults.size(), 1U) << toml;
    return faults.empty() ? std::string() : to_string(faults.front());
  };
  EXPECT_NE(fault("[[lining]]\nalong = [[-1, 0], [1, 0]]\nthickness = 0.1\n")
                .find("m.toml:14:1: lining.0: touches no block"),
            std::string::npos);
  EXPECT_NE(fault("[[lining]]\nopening = 'room'\nthickness = 0.6\nsize = 0.5\n")
                .find("too thick for its corners"),
            std::string::npos);
}

}  // namespace
}  // namespace edda::linings_test
