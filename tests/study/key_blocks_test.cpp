// Key blocks: exact factors, what is locked, generations, and the cone against trying directions.
#include "study/key_blocks.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "model/read_model.hpp"
#include "study/limit_analysis.hpp"

namespace edda {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

std::string rock(const std::string& joint = "friction_angle = 30\n") {
  return "[materials.rock]\ndensity = 2500\nyoung = \"10 GPa\"\npoisson = 0.25\n[joints.j]\n" +
         joint;
}

std::string block(const std::vector<Vec2>& corners, const std::string& more = "") {
  std::string text = "[[block]]\n" + more + "polygon = [";
  for (const Vec2 c : corners)
    text +=
        (text.back() == '[' ? "[" : ", [") + std::to_string(c.x) + ", " + std::to_string(c.y) + "]";
  return text + "]\n";
}

const std::string fixed = "fixed = true\n";

Model model_of(const std::string& text) {
  Result<Model> model = read_model_text(text, "m.toml", {}, ReadFor::no_run);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : to_string(model.faults().front()));
  return model.value();
}

KeyBlocks found_in(const std::string& text, const KeyBlockOptions& options = {}) {
  const Result<KeyBlocks> found = key_blocks(model_of(text), options);
  EXPECT_TRUE(found.ok()) << (found.ok() ? "" : to_string(found.faults().front()));
  return found.value();
}

std::vector<Vec2> turned(std::vector<Vec2> points, double angle) {
  for (Vec2& p : points)
    p = {std::cos(angle) * p.x - std::sin(angle) * p.y,
         std::sin(angle) * p.x + std::cos(angle) * p.y};
  return points;
}

/// A slab 4 x 1 on a plane that dips by `dip` to the left.
std::string slab_on(double dip, const std::string& joint) {
  return rock(joint) +
         block(turned({{-10, -5}, {10, -5}, {10, 0}, {-10, 0}}, dip * degree), fixed) +
         block(turned({{0, 0}, {4, 0}, {4, 1}, {0, 1}}, dip * degree));
}

TEST(KeyBlocks, ASlabSlidesByFrictionAndCohesion) {
  const double weight = 2500 * 9.81 * 4, dip = 35 * degree;
  const KeyBlocks found = found_in(slab_on(35, "friction_angle = 30\ncohesion = 2000\n"));
  ASSERT_EQ(found.blocks.size(), 1u);
  const RemovableBlock& b = found.blocks[0];
  const double resists = weight * std::cos(dip) * std::tan(30 * degree) + 2000 * 4;
  EXPECT_EQ(b.mode, RemovalMode::slides);
  EXPECT_EQ(b.kind, BlockClass::key);
  EXPECT_NEAR(*b.by_translation, resists / (weight * std::sin(dip)), 1e-6);
  EXPECT_NEAR(*b.by_rotation, *b.by_translation, 1e-5);
  EXPECT_NEAR(b.weight, weight, 1e-6 * weight);
  EXPECT_NEAR(std::atan2(b.direction.y, b.direction.x), -std::numbers::pi + dip, 1e-6);
  EXPECT_NEAR(*b.support, weight * std::sin(dip) - resists, 1e-5 * weight);
  // With a factor of 1.5 more is asked for; a gentler slope holds.
  const KeyBlocks safer =
      found_in(slab_on(35, "friction_angle = 30\ncohesion = 2000\n"), {1.5, 10});
  EXPECT_NEAR(*safer.blocks[0].support, weight * std::sin(dip) - resists / 1.5, 1e-5 * weight);
  // Above the slab's lower corner there is no rock, in it the key block, below it the plane.
  const auto up = [&](double along, double across) { return turned({{along, across}}, dip)[0]; };
  const KeyBlocks seen = found_in(slab_on(35, "friction_angle = 30\n"),
                                  {1, 10, {up(0.1, 1.1), up(0.1, 0.9), up(0.1, -0.1)}});
  EXPECT_EQ(seen.at_place, (std::vector<std::optional<std::size_t>>{{}, 1u, 0u}));
  const KeyBlocks gentle = found_in(slab_on(25, "friction_angle = 30\n"));
  EXPECT_EQ(gentle.blocks[0].kind, BlockClass::held);
  EXPECT_NEAR(*gentle.blocks[0].factor, std::tan(30 * degree) / std::tan(25 * degree), 1e-6);
  EXPECT_EQ(gentle.key, 0u);
}

/// Rock on both sides of a wedge whose sides lean by `lean` from the vertical, wider below (roof)
/// or above (floor).
std::string wedge(double lean, bool roof, const std::string& joint) {
  const double t = std::tan(lean * degree), s = roof ? 1.0 : -1.0;
  const std::vector<Vec2> left{{-9, 0}, {-2 - s * t, 0}, {-2 + s * t, 2}, {-9, 2}};
  const std::vector<Vec2> right{{9, 0}, {9, 2}, {2 - s * t, 2}, {2 + s * t, 0}};
  const std::vector<Vec2> middle{{-2 - s * t, 0}, {2 + s * t, 0}, {2 - s * t, 2}, {-2 + s * t, 2}};
  return rock(joint) + block(left, fixed) + block(right, fixed) + block(middle);
}

/// What a ramp has reached acts: a seismic coefficient down the plane.
TEST(KeyBlocks, FeelTheEndOfARamp) {
  const double dip = 20 * degree, k = 0.1, c = std::cos(dip), s = std::sin(dip);
  const KeyBlocks found =
      found_in(slab_on(20, "friction_angle = 30\n") +
               "[[stage]]\nuntil = \"equilibrium\"\nramp = { kh = [0, -0.1] }\n");
  ASSERT_EQ(found.blocks.size(), 1u);
  EXPECT_NEAR(*found.blocks[0].by_translation, std::tan(30 * degree) * (c - k * s) / (s + k * c),
              1e-6);
}

TEST(KeyBlocks, AWedgeFallsFromTheRoofAndLiesInTheFloor) {
  const KeyBlocks roof = found_in(wedge(20, true, "friction_angle = 30\n"));
  ASSERT_EQ(roof.blocks.size(), 1u);
  EXPECT_EQ(roof.blocks[0].mode, RemovalMode::falls);
  EXPECT_EQ(*roof.blocks[0].factor, 0.0);
  EXPECT_NEAR(*roof.blocks[0].support, roof.blocks[0].weight, 1e-9 * roof.blocks[0].weight);
  // Up and out of the floor it could go, but nothing drives it.
  const KeyBlocks floor = found_in(wedge(20, false, "friction_angle = 30\n"));
  ASSERT_EQ(floor.blocks.size(), 1u);
  EXPECT_EQ(floor.blocks[0].kind, BlockClass::stable);
  EXPECT_FALSE(floor.blocks[0].factor);
}

TEST(KeyBlocks, BondsHoldAFallingWedgeByTheirCosines) {
  const KeyBlocks roof =
      found_in(wedge(20, true, "friction_angle = 30\ncohesion = 10000\ntensile_strength = 5000\n"));
  const RemovableBlock& b = roof.blocks[0];
  const double side = 2 / std::cos(20 * degree);
  const double resists = 2 * side * (10000 * std::cos(20 * degree) + 5000 * std::sin(20 * degree));
  EXPECT_NEAR(*b.by_translation, resists / b.weight, 1e-5);
}

TEST(KeyBlocks, BetweenParallelFacesBothCount) {
  // A drawer of 2 x 1 between two beds that dip by 40 degrees to the left; rock behind it.
  const double dip = 40 * degree;
  const std::string text = rock("friction_angle = 20\ncohesion = 1000\n") +
                           block(turned({{0, -3}, {9, -3}, {9, 0}, {0, 0}}, dip), fixed) +
                           block(turned({{0, 1}, {9, 1}, {9, 4}, {0, 4}}, dip), fixed) +
                           block(turned({{2, 0}, {9, 0}, {9, 1}, {2, 1}}, dip), fixed) +
                           block(turned({{0, 0}, {2, 0}, {2, 1}, {0, 1}}, dip));
  const KeyBlocks found = found_in(text);
  ASSERT_EQ(found.blocks.size(), 1u);
  const RemovableBlock& b = found.blocks[0];
  EXPECT_EQ(b.mode, RemovalMode::slides_on_two);
  const double resists = b.weight * std::cos(dip) * std::tan(20 * degree) + 1000 * (2 + 2);
  EXPECT_NEAR(*b.by_translation, resists / (b.weight * std::sin(dip)), 1e-5);
}

TEST(KeyBlocks, ATaperedBlockIsLocked) {
  // Wider behind than at the face on the left.
  const std::string text = rock() + block({{0, 0.5}, {3, 0}, {6, 0}, {6, -3}, {0, -3}}, fixed) +
                           block({{0, 1.5}, {0, 5}, {6, 5}, {6, 2}, {3, 2}}, fixed) +
                           block({{3, 0}, {6, 0}, {6, 2}, {3, 2}}, fixed) +
                           block({{0, 0.5}, {3, 0}, {3, 2}, {0, 1.5}});
  const KeyBlocks found = found_in(text);
  EXPECT_TRUE(found.blocks.empty());
  EXPECT_EQ(found.locked, 1u);
}

TEST(KeyBlocks, ASlenderColumnRotatesBeforeItSlides) {
  // 1 x 3 on a plane of 25 degrees: the resultant leaves its base where tan(25) > 1/3.
  const std::string text =
      rock("friction_angle = 40\n") +
      block(turned({{-10, -5}, {10, -5}, {10, 0}, {-10, 0}}, 25 * degree), fixed) +
      block(turned({{0, 0}, {1, 0}, {1, 3}, {0, 3}}, 25 * degree));
  const KeyBlocks found = found_in(text);
  const RemovableBlock& b = found.blocks[0];
  EXPECT_EQ(b.mode, RemovalMode::rotates);
  EXPECT_EQ(b.kind, BlockClass::key);
  EXPECT_NEAR(*b.by_translation, std::tan(40 * degree) / std::tan(25 * degree), 1e-6);
  EXPECT_LT(*b.by_rotation, 1e-3);  // no strength holds it
  EXPECT_FALSE(b.support);
}

TEST(KeyBlocks, OthersFollowOnceOneHasGone) {
  // Three slabs one behind the other on a plane of 35 degrees, against a fixed block above them.
  const double dip = 35 * degree;
  std::string text = rock("friction_angle = 20\n") +
                     block(turned({{-9, -5}, {20, -5}, {20, 0}, {-9, 0}}, dip), fixed) +
                     block(turned({{9, 0}, {20, 0}, {20, 1}, {9, 1}}, dip), fixed);
  for (int i = 0; i < 3; ++i) {
    const double x = 3.0 * i;
    text += block(turned({{x, 0}, {x + 3, 0}, {x + 3, 1}, {x, 1}}, dip));
  }
  const KeyBlocks found = found_in(text);
  ASSERT_EQ(found.key, 3u);
  EXPECT_EQ(found.generations, 3u);
  for (std::size_t g = 0; g < 3; ++g) {
    EXPECT_EQ(found.blocks[g].generation, g + 1);
    EXPECT_NEAR(*found.blocks[g].by_translation, std::tan(20 * degree) / std::tan(dip), 1e-6);
  }
  EXPECT_LT(found.blocks[0].centroid.x, found.blocks[1].centroid.x);
  EXPECT_EQ(found_in(text, {1.0, 1}).key, 1u);
  // The slabs behind could be lifted off, but rest on the first one until it has gone.
  EXPECT_EQ(found_in(text, {1.0, 1}).stable, 2u);
}

TEST(KeyBlocks, AgreeWithLimitAnalysisOfASingleBlock) {
  for (const double dip : {20.0, 32.0, 44.0}) {
    const std::string text = slab_on(dip, "friction_angle = 35\ncohesion = 1500\n");
    const Result<LimitResult> limit = limit_analysis(model_of(text));
    ASSERT_TRUE(limit.ok());
    EXPECT_NEAR(*found_in(text).blocks[0].factor, limit.value().largest.lower, 1e-5);
  }
}

TEST(KeyBlocks, TurnWithTheModelAndItsGravity) {
  const auto at = [&](double angle) {
    const Vec2 g = turned({{0, -9.81}}, angle)[0];
    std::string text = "gravity = [" + std::to_string(g.x) + ", " + std::to_string(g.y) + "]\n" +
                       rock("friction_angle = 33\ncohesion = 700\n");
    text += block(turned({{-10, -5}, {10, -5}, {10, 0}, {-10, 0}}, angle + 40 * degree), fixed);
    text += block(turned({{0, 0}, {4, 0}, {4, 1}, {0, 1}}, angle + 40 * degree));
    return *found_in(text).blocks[0].factor;
  };
  for (const double angle : {0.7, 2.1, -1.3}) EXPECT_NEAR(at(angle), at(0.0), 1e-5);
}

TEST(KeyBlocks, SaysWhatItCannotLookAt) {
  const std::string text = "gravity = [0, 0]\n" + slab_on(30, "friction_angle = 30\n");
  const Result<KeyBlocks> none = key_blocks(model_of(text), {});
  ASSERT_FALSE(none.ok());
  EXPECT_NE(to_string(none.faults().front()).find("carries a load"), std::string::npos);
}

}  // namespace
}  // namespace edda
