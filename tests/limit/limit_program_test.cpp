// Known answers of rigid limit analysis, and its invariants.
#include "limit/limit_program.hpp"

#include <gtest/gtest.h>

#include "limit/rigid_model.hpp"

namespace edda::limit_program_test {
namespace {

using testing::Rigid;
using testing::stone;
using testing::table;

std::string block(double width, double height, const std::string& more = "") {
  return fmt::format("[[block]]\nname = \"b\"\npolygon = [[0,0],[{0},0],[{0},{1}],[0,{1}]]\n{2}",
                     width, height, more);
}

/// A block on a table slides or overturns, whichever is first.
TEST(LimitProgram, ABlockSlidesOrOverturns) {
  struct Case {
    double mu, width, height;
  };
  for (const Case& c : {Case{0.3, 2.0, 1.0}, {0.6, 1.0, 2.0}, {0.5, 1.0, 3.0}, {0.9, 3.0, 1.0}}) {
    Rigid model(stone(c.mu) + table + block(c.width, c.height));
    const double exact = std::min(c.mu, c.width / c.height);
    for (const bool right : {true, false}) {
      const LimitState state = model.kh(right);
      ASSERT_EQ(state.end, LimitEnd::found);
      EXPECT_NEAR(state.multiplier, right ? exact : -exact, 1e-8);
      EXPECT_NEAR(state.kinematic, state.multiplier, 1e-8);
      EXPECT_LT(state.violation, 1e-8);
      EXPECT_LT(model.out_of_balance(state, state.multiplier), 1e-7 * model.blocks.force);
      const RigidMotion& motion = state.motion[0];
      EXPECT_GT(right ? motion.velocity.x : -motion.velocity.x, 0.0);
      // It turns about its corner, or it rises along the cone of friction as it slides.
      const bool slides = c.mu < c.width / c.height;
      EXPECT_NEAR(motion.spin, slides ? 0.0 : -motion.velocity.x / (0.5 * c.height), 1e-6);
      if (slides) {
        EXPECT_NEAR(motion.velocity.y, c.mu * std::abs(motion.velocity.x), 1e-6);
      }
    }
  }
}

TEST(LimitProgram, CohesionAndTensionHoldABlock) {
  const double weight = 2000.0 * 9.81 * 2.0 * 1.0, c = 8e3, mu = 0.4;
  {
    Rigid model(stone(mu, fmt::format("cohesion = {}\n", c)) + table + block(2.0, 1.0));
    // Slides: kh W = c L + mu W; overturns at kh = b/h = 2.
    EXPECT_NEAR(model.kh().multiplier, mu + c * 2.0 / weight, 1e-8);
  }
  // Hung from a ceiling: the joint carries t L against the weight and the load.
  const double t = 5e4;
  Rigid model(stone(mu, fmt::format("cohesion = 1e6\ntensile_strength = {}\n", t)) +
              "[[block]]\nfixed = true\npolygon = [[-1,1],[3,1],[3,2],[-1,2]]\n" + block(2.0, 1.0));
  model.problem.live = weights_under(model.blocks, model.sim(), model.gravity());
  model.problem.dead = 0.0 * model.problem.dead;
  const LimitState state = limit_state(model.problem, true);
  EXPECT_NEAR(state.multiplier, t * 2.0 / weight, 1e-7);
  EXPECT_NEAR(state.kinematic, state.multiplier, 1e-7);
}

/// Eccentric thrust crushes the edge: kh = (b/h)(1 - W/(f b t)), by the rectangle of stress f that
/// carries W at the edge.
TEST(LimitProgram, AnEdgeIsCrushed) {
  const double b = 1.0, h = 3.0, weight = 2000.0 * 9.81 * b * h, f = 4.0 * weight;
  const std::string rock = fmt::format(
      "[materials.stone]\ndensity = 2000\nyoung = 50e9\npoisson = 0.2\nstrength = {{ ucs = {}, "
      "tension = 1e5 }}\n[solver]\nduration = 1\n[joints.dry]\nfriction_angle = 60\n",
      f);
  Rigid crushed(rock + table + block(b, h), true), hard(rock + table + block(b, h));
  const LimitState state = crushed.kh();
  EXPECT_NEAR(state.multiplier, b / h * (1.0 - weight / (f * b)), 1e-6);
  EXPECT_NEAR(state.kinematic, state.multiplier, 1e-6);
  EXPECT_NEAR(hard.kh().multiplier, b / h, 1e-8);
}

TEST(LimitProgram, NoEquilibriumAndNoLimitAreToldApart) {
  const std::string floating =
      "[[block]]\npolygon = [[4.9,0],[6.9,0],[6.9,1],[4.9,1]]\n";  // overhangs
  Rigid falls(stone(0.5) + table + floating);
  const LimitState none = falls.kh();
  EXPECT_EQ(none.end, LimitEnd::no_equilibrium);
  ASSERT_FALSE(none.motion.empty());
  EXPECT_LT(none.motion[0].velocity.y, 0.0);
  Rigid stands(stone(0.5) + table + block(1.0, 1.0));
  stands.problem.live = weights_under(stands.blocks, stands.sim(), stands.gravity());
  EXPECT_EQ(limit_state(stands.problem, true).end, LimitEnd::no_limit);
}

/// A corner on an inclined edge presses across the edge, whatever the edges of its own block do.
TEST(LimitProgram, ACornerLeansOnAnEdge) {
  const double mu = 0.3;
  const std::string diamond = "[[block]]\npolygon = [[0,0],[1,1],[0,2],[-1,1]]\n";
  const std::string walls =
      "[[block]]\nfixed = true\npolygon = [[1,0.5],[2,0.5],[2,1.5],[1,1.5]]\n[[block]]\nfixed = "
      "true\npolygon = [[-2,0.5],[-1,0.5],[-1,1.5],[-2,1.5]]\n";
  Rigid alone(stone(mu) + table + diamond), held(stone(mu) + table + diamond + walls);
  EXPECT_EQ(alone.blocks.joints.size(), 1u);
  EXPECT_TRUE(alone.blocks.joints[0].is_corner());
  EXPECT_NEAR(std::abs(alone.blocks.joints[0].n.y), 1.0, 1e-12);
  EXPECT_NEAR(alone.kh().multiplier, 0.0, 1e-7);  // it stands on its tip
  EXPECT_EQ(held.blocks.joints.size(), 3u);
  EXPECT_EQ(held.kh().end, LimitEnd::no_limit);
}

/// What a bolt carries that holds a block below a roof, N.
double carried_by_bolt(const std::string& ends, const std::string& type) {
  Rigid model(stone(0.5) +
              "[[block]]\nname = \"roof\"\nfixed = true\npolygon = [[-1,1],[2,1],[2,4],[-1,4]]\n" +
              block(1.0, 1.0) + "[[bolt]]\n" + ends + "diameter = 0.02\nyield_stress = 5e8\n" +
              type);
  model.problem.live = weights_under(model.blocks, model.sim(), model.gravity());
  model.problem.dead = 0.0 * model.problem.dead;
  const LimitState state = limit_state(model.problem, true);
  EXPECT_NEAR(state.kinematic, state.multiplier, 1e-6 * state.multiplier);
  EXPECT_LT(model.out_of_balance(state, state.multiplier), 1e-6 * model.blocks.force);
  return state.multiplier * 2000.0 * 9.81;
}

TEST(LimitProgram, BoltsHoldUpToTheirYieldAndTheirBond) {
  const double yield = 5e8 * std::numbers::pi * 0.0001;
  for (const char* ends :
       {"from = [0.5, 0.0]\nto = [0.5, 3.0]\n", "from = [0.5, 3.0]\nto = [0.5, 0.0]\n"}) {
    EXPECT_NEAR(carried_by_bolt(ends, "type = \"end\"\n"), yield, 1e-4 * yield);
    EXPECT_NEAR(carried_by_bolt(ends, "bond = { stiffness = 1e9, strength = 1e6 }\n"), yield,
                1e-4 * yield);
    // The bond to the block is 1 m long, that to the roof 2 m.
    EXPECT_NEAR(carried_by_bolt(ends, "bond = { stiffness = 1e9, strength = 5e4 }\n"), 5e4,
                1e-4 * 5e4);
  }
}

TEST(LimitProgram, GluedBlocksAreOneBody) {
  const std::string two =
      "[joints.glue]\ntype = \"glued\"\n[contact]\njoint = \"dry\"\n[[block]]\njoint = \"glue\"\n"
      "polygon = [[0,0],[1,0],[1,1],[0,1]]\n[[block]]\njoint = \"glue\"\n"
      "polygon = [[0,1],[1,1],[1,3],[0,3]]\n";
  const std::string base =
      "[[block]]\nfixed = true\njoint = \"dry\"\npolygon = [[-5,-1],[5,-1],[5,0],[-5,0]]\n";
  Rigid model(stone(0.9) + two + base);
  EXPECT_EQ(model.blocks.bodies(), 1u);
  EXPECT_NEAR(model.kh().multiplier, 1.0 / 3.0, 1e-8);
}

TEST(LimitProgram, RollersHoldAcrossTheirLineAlone) {
  const std::string text = stone(0.4) + table + block(1.0, 2.0) +
                           "[[boundary]]\nname = \"right\"\nalong = [[1, 0], [1, 3]]\ntype = "
                           "\"roller\"\n";
  Rigid model(text);
  EXPECT_EQ(model.blocks.supports.size(), 2u);  // its two corners
  EXPECT_EQ(model.kh().end, LimitEnd::no_limit);
  // With gravity turned off the block can be lifted along the roller.
  model.problem.live = -1.0 * weights_under(model.blocks, model.sim(), model.gravity());
  EXPECT_NEAR(limit_state(model.problem, true).multiplier, 1.0, 1e-7);
}

/// Factors of strength and tilts have closed forms for a block on a plane.
TEST(LimitFactor, OfABlockOnAPlane) {
  const double angle = 30.0, a = angle * std::numbers::pi / 180.0, mu = 0.7, c = 4e3;
  const auto turned = [&](double x, double y) {
    return fmt::format("[{:.15g}, {:.15g}]", x * std::cos(a) - y * std::sin(a),
                       x * std::sin(a) + y * std::cos(a));
  };
  const auto rectangle = [&](double x0, double y0, double x1, double y1) {
    return "polygon = [" + turned(x0, y0) + ", " + turned(x1, y0) + ", " + turned(x1, y1) + ", " +
           turned(x0, y1) + "]\n";
  };
  const std::string slope =
      "[[block]]\nfixed = true\n" + rectangle(-3, -1, 6, 0) + "[[block]]\n" + rectangle(0, 0, 2, 1);
  const double weight = 2000.0 * 9.81 * 2.0;
  Rigid dry(stone(mu) + slope), with_cohesion(stone(mu, "cohesion = 4000\n") + slope);
  const StrengthFactor f = dry.factor_of_strength(), g = with_cohesion.factor_of_strength();
  ASSERT_EQ(f.end, LimitEnd::found);
  EXPECT_NEAR(f.holds, mu / std::tan(a), 2e-6 * f.holds);
  EXPECT_LE(f.fails - f.holds, 1e-6 * f.fails);
  EXPECT_NEAR(g.holds, (c * 2.0 + weight * std::cos(a) * mu) / (weight * std::sin(a)),
              2e-6 * g.holds);
  const auto dead = [&](double tilt) {
    const Vec2 t = std::cos(tilt) * dry.gravity() + std::sin(tilt) * perp(dry.gravity());
    return weights_under(dry.blocks, dry.sim(), t);
  };
  const auto turning = [&](double tilt) {
    const Vec2 t = std::cos(tilt) * dry.gravity() + std::sin(tilt) * perp(dry.gravity());
    return weights_under(dry.blocks, dry.sim(), perp(t));
  };
  // Tilted to the left the slope becomes steeper; tan(a + tilt) = mu.
  const LimitState tilt = tilt_limit(dry.problem, false, dead, turning);
  ASSERT_EQ(tilt.end, LimitEnd::found);
  EXPECT_NEAR(tilt.multiplier, -(std::atan(mu) - a), 1e-8);
}

}  // namespace
}  // namespace edda::limit_program_test
