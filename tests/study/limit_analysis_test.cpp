// Rigid limit analysis of whole models: public figures, and what must not change an answer.
#include "study/limit_analysis.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>

#include "model/read_model.hpp"
#include "study/masonry_panel.hpp"

namespace edda::limit_analysis_test {
namespace {

using testing::masonry_panel;

constexpr double degree = std::numbers::pi / 180.0;

LimitResult limit_of(const std::string& text, const std::string& vary) {
  Result<Model> model =
      read_model_text(text + "[fos]\nvary = \"" + vary + "\"\n", "m.toml", {}, ReadFor::no_run);
  if (!model.ok()) {
    ADD_FAILURE() << to_string(model.faults()[0]);
    return {};
  }
  Result<LimitResult> r = limit_analysis(model.value());
  if (!r.ok()) {
    ADD_FAILURE() << to_string(r.faults()[0]);
    return {};
  }
  return std::move(r.value());
}

std::string stone(double mu) {
  return fmt::format(
      "[materials.stone]\ndensity = 2000\nyoung = 50e9\npoisson = 0.2\n[joints.dry]\n"
      "friction_angle = {:.15g}\n",
      std::atan(mu) / degree);
}

struct Turned {
  double angle = 0.0;
  Vec2 shift;
  std::string operator()(double x, double y) const {
    const double c = std::cos(angle), s = std::sin(angle);
    return fmt::format("[{:.15g}, {:.15g}]", c * x - s * y + shift.x, s * x + c * y + shift.y);
  }
};

/// An arch of n equal voussoirs between fixed springers; R of the middle line, 10 m.
std::string arch(int n, double embrace, double thickness, double mu, const Turned& at = {}) {
  const double from = 0.5 * (180.0 - embrace) * degree, step = embrace * degree / n;
  const double in = 10.0 - 0.5 * thickness, out = 10.0 + 0.5 * thickness;
  const auto polar = [&](double r, double a, double beyond) {
    return at(r * std::cos(a) - beyond * std::sin(a), r * std::sin(a) + beyond * std::cos(a));
  };
  std::string text = stone(mu);
  const auto quad = [&](double a, double b, double beyond_a, double beyond_b) {
    return "polygon = [" + polar(in, a, beyond_a) + ", " + polar(out, a, beyond_a) + ", " +
           polar(out, b, beyond_b) + ", " + polar(in, b, beyond_b) + "]\n";
  };
  for (int k = 0; k < n; ++k)
    text += "[[block]]\n" + quad(from + k * step, from + (k + 1) * step, 0.0, 0.0);
  text += "[[block]]\nfixed = true\n" + quad(from, from, -0.3, 0.0);
  text += "[[block]]\nfixed = true\n" + quad(from + n * step, from + n * step, 0.0, 0.3);
  return text;
}

void expect_sharp(const LimitResult& r, double exact, double digits) {
  ASSERT_EQ(r.largest.status, LimitEnd::found) << r.message;
  EXPECT_NEAR(r.largest.lower, exact, digits);
  EXPECT_NEAR(r.largest.upper, r.largest.lower, 1e-8);
  EXPECT_LT(r.violation, 1e-7);
}

TEST(LimitAnalysis, CircularArchUnderHorizontalAcceleration) {
  expect_sharp(limit_of(arch(7, 157.5, 1.0, 1.0), "kh"), 0.1990239, 5e-8);
  expect_sharp(limit_of(arch(7, 157.5, 1.5, 1.0), "kh"), 0.3736117, 5e-8);
  expect_sharp(limit_of(arch(7, 157.5, 2.0, 1.0), "kh"), 0.5265889, 5e-8);
}

TEST(LimitAnalysis, NamesTheHingesOfAnArch) {
  const LimitResult r = limit_of(arch(7, 157.5, 1.5, 1.0), "kh");
  ASSERT_TRUE(r.mechanism);
  EXPECT_EQ(r.mechanism->joints.size(), 4u);
  EXPECT_TRUE(r.mechanism->text.starts_with("hinging: 4 hinges at")) << r.mechanism->text;
  // Where it hinges the thrust is at an edge; between them it lies within.
  std::size_t at_edges = 0;
  for (const ContactRecord& c : r.forces) {
    const double part = norm(c.position - c.a) / norm(c.b - c.a);
    if (part < 1e-6 || part > 1.0 - 1e-6) ++at_edges;
  }
  EXPECT_EQ(at_edges, 4u);
}

/// The least thickness of a semicircular arch of 27 voussoirs depends on friction below 0.4.
TEST(LimitAnalysis, LeastThicknessOfASemicircularArch) {
  struct Least {
    double mu, thickness;
  };
  for (const Least& l : {Least{0.31, 0.195995},
                         {0.35, 0.151185},
                         {0.39, 0.111630},
                         {0.40, 0.106721},
                         {0.60, 0.106721}}) {
    const auto stands = [&](double part) {
      return limit_of(arch(27, 180.0, 10.0 * part, l.mu), "kh").largest.status == LimitEnd::found;
    };
    EXPECT_TRUE(stands(l.thickness + 2e-6)) << l.mu;
    EXPECT_FALSE(stands(l.thickness - 2e-6)) << l.mu;
  }
}

TEST(LimitAnalysis, PanelOfFerrisAndTinLoi) {
  const LimitResult r = limit_of(masonry_panel(50e9), "kh");
  expect_sharp(r, 0.6428590, 5e-8);
  ASSERT_TRUE(r.smallest);
  EXPECT_NEAR(r.smallest->lower, -0.6428590, 5e-8);
  ASSERT_TRUE(r.without_dilation);
  EXPECT_NEAR(*r.without_dilation, 0.6428590, 1e-4);
  const LimitResult tilt = limit_of(masonry_panel(50e9), "tilt");
  EXPECT_NEAR(std::tan(tilt.largest.lower * degree), 0.6428590, 1e-7);
}

/// A column of 1 m x 3 m overturns beside a lower block at kh = b/h. Dilating joints would hold it
/// by its back, at 0.457, and so would joints that do not, if they began with that thrust.
TEST(LimitAnalysis, AColumnOverturnsBesideALowerBlock) {
  const LimitResult r = limit_of(
      stone(std::tan(40.0 * degree)) +
          "[[block]]\nfixed = true\npolygon = [[-5, -1], [6, -1], [6, 0], [-5, 0]]\n[[block]]\n"
          "polygon = [[-2, 0], [0, 0], [0, 0.5], [-2, 0.5]]\n[[block]]\n"
          "polygon = [[0, 0], [1, 0], [1, 3], [0, 3]]\n",
      "kh");
  EXPECT_NEAR(r.largest.lower, 0.457143, 1e-6);
  EXPECT_NEAR(r.without_dilation.value_or(0.0), 1.0 / 3.0, 1e-4);
}

/// Rotated with its gravity, moved far away, mirrored: the same multiplier.
TEST(LimitAnalysis, DoesNotDependOnWhereAndHowAModelIsDrawn) {
  const double angle = 1.1, g = 9.81;
  const std::string turned =
      fmt::format("gravity = [{:.15g}, {:.15g}]\n", g * std::sin(angle), -g * std::cos(angle)) +
      arch(7, 157.5, 1.5, 1.0, {angle, {4e5, -2e5}});
  const LimitResult r = limit_of(turned, "kh");
  expect_sharp(r, 0.3736117, 1e-6);
  ASSERT_TRUE(r.smallest);
  EXPECT_NEAR(r.smallest->lower, -r.largest.lower, 1e-6);
}

/// A load at a point, its multiplier and the dead loads.
TEST(LimitAnalysis, LoadsAndWaterAreMultiplied) {
  const std::string block =
      stone(0.5) +
      "[[block]]\nfixed = true\npolygon = [[-5,-1],[5,-1],[5,0],[-5,0]]\n[[block]]\n"
      "polygon = [[0,0],[4,0],[4,2],[0,2]]\n[[load]]\nname = \"push\"\npoint = [0, 0.5]\n"
      "force = [1000, 0]\n[[load]]\nname = \"weight\"\npoint = [2, 2]\nforce = [0, -50000]\n";
  const double down = 2000.0 * 9.81 * 8.0 + 50000.0;
  const LimitResult r = limit_of(block, "load:push");
  expect_sharp(r, 0.5 * down / 1000.0, 1e-5);
  EXPECT_TRUE(r.mechanism->text.starts_with("sliding along dry")) << r.mechanism->text;
}

/// A joint with cohesion that it loses at failure: both strengths are reported.
TEST(LimitAnalysis, ReportsWhatBrokenJointsCarry) {
  const std::string text = stone(0.3) +
                           "cohesion = 1e4\n[[block]]\nfixed = true\n"
                           "polygon = [[-5,-1],[5,-1],[5,0],[-5,0]]\n[[block]]\n"
                           "polygon = [[0,0],[2,0],[2,0.5],[0,0.5]]\n";
  const LimitResult r = limit_of(text, "kh");
  const double weight = 2000.0 * 9.81;
  expect_sharp(r, 0.3 + 2e4 / weight, 1e-7);
  ASSERT_TRUE(r.residual);
  EXPECT_NEAR(*r.residual, 0.3, 1e-7);
}

/// Joints of Barton and Bandis: the friction angle at the normal stress of the joint, 28 + 8
/// log10(50e6/19620) degrees; with blocks on each other that of each joint.
TEST(LimitAnalysis, BartonBandisAtItsNormalStress) {
  const auto block = [](double from, double to) {
    return fmt::format("[[block]]\npolygon = [[0,{0}],[6,{0}],[6,{1}],[0,{1}]]\n", from, to);
  };
  const std::string rock =
      "[materials.stone]\ndensity = 2000\nyoung = 50e9\npoisson = 0.2\n[joints.rough]\n"
      "type = \"barton-bandis\"\njrc = 8\njcs = 50e6\nresidual_angle = 28\n[[block]]\n"
      "fixed = true\npolygon = [[-9,-1],[9,-1],[9,0],[-9,0]]\n";
  const double stress = 2000.0 * 9.81;
  const auto slides_at = [&](double sigma) {
    return std::tan((28.0 + 8.0 * std::log10(50e6 / sigma)) * degree);
  };
  EXPECT_NEAR(limit_of(rock + block(0, 1), "kh").largest.lower, slides_at(stress), 1e-5);
  // The lower joint has twice the stress and slides first.
  EXPECT_NEAR(limit_of(rock + block(0, 1) + block(1, 2), "kh").largest.lower,
              slides_at(2.0 * stress), 1e-5);
}

/// Stages: what they excavate is gone, what they activate acts.
TEST(LimitAnalysis, MakesTheChangesOfStages) {
  const std::string text =
      stone(0.3) +
      "[domain]\noutline = [[0,0],[6,0],[6,3],[0,3]]\n[[trace]]\npoints = [[0,1],[6,1]]\n"
      "[[trace]]\npoints = [[2,1],[2,3]]\n[[trace]]\npoints = [[4,1],[4,3]]\n[[fixed]]\n"
      "point = [3, 0.5]\n[[opening]]\nname = \"right\"\n"
      "polygon = [[4,1],[6,1],[6,3],[4,3]]\njoint = \"dry\"\n"
      "[[load]]\nname = \"push\"\npoint = [0, 1.5]\nforce = [1000, 0]\n";
  const std::string stages =
      "[[stage]]\nname = \"all\"\nuntil = \"equilibrium\"\n[[stage]]\nname = \"last\"\n"
      "until = \"equilibrium\"\nexcavate = [\"right\"]\n"
      "activate = [\"push\"]\n";
  const double block = 2000.0 * 9.81 * 4.0;
  const LimitResult last = limit_of(text + stages, "load:push");
  EXPECT_NEAR(last.largest.lower, 0.3 * 2.0 * block / 1000.0, 1e-4);
  const LimitResult first = limit_of(text + stages, "load:push\"\nstage = \"all");
  EXPECT_NEAR(first.largest.lower, 0.3 * 3.0 * block / 1000.0, 1e-4);
}

/// What a ramp has reached stays; a factor on the same load refers to the load as given.
TEST(LimitAnalysis, TakesRampsAtTheirEnd) {
  const std::string text = stone(0.5) +
                           "[[block]]\nfixed = true\npolygon = [[-1,-1],[3,-1],[3,0],[-1,0]]\n"
                           "[[block]]\npolygon = [[0,0],[2,0],[2,1],[0,1]]\n"
                           "[[load]]\nname = \"push\"\npoint = [0.1, 0.1]\nforce = [1000, 0]\n";
  const auto ramp = [](const char* keys) {
    return fmt::format("[[stage]]\nuntil = \"equilibrium\"\nramp = {{ {} }}\n", keys);
  };
  const double weight = 2000.0 * 9.81 * 2.0, pushed = 1000.0 / weight;
  EXPECT_NEAR(limit_of(text + ramp("kh = [0, 0.2]"), "strength").largest.lower,
              0.5 / (0.2 + pushed), 1e-5);
  EXPECT_NEAR(limit_of(text + ramp("'load:push' = [0, 4]"), "strength").largest.lower,
              0.5 / (4.0 * pushed), 1e-5);
  EXPECT_NEAR(limit_of(text + ramp("'load:push' = [0, 4]"), "load:push").largest.lower,
              0.5 / pushed, 1e-3);
  EXPECT_NEAR(limit_of(text + ramp("kv = [0, 0.2]"), "kh").largest.lower, 0.5 * 0.8 - pushed, 1e-6);
  const double tilt = 5.0 * degree;
  EXPECT_NEAR(
      limit_of(text + ramp("tilt = [0, 5]"), "kh").largest.lower,
      (0.5 * std::cos(tilt) - std::sin(tilt) - pushed) / (std::cos(tilt) + 0.5 * std::sin(tilt)),
      1e-6);
}

/// Beyond a collapse there is nothing to start from, but for what its own ramp varies.
TEST(LimitAnalysis, StopsBeforeACollapse) {
  const std::string text = stone(0.5) +
                           "[[block]]\nfixed = true\npolygon = [[-1,-1],[3,-1],[3,0],[-1,0]]\n"
                           "[[block]]\npolygon = [[0,0],[2,0],[2,1],[0,1]]\n[[stage]]\n"
                           "until = \"collapse\"\nramp = { kh = [0, 0.9] }\n";
  EXPECT_NEAR(limit_of(text, "kh").largest.lower, 0.5, 1e-6);
  const Result<Model> model = read_model_text(text, "m.toml", {}, ReadFor::no_run);
  ASSERT_TRUE(model.ok());
  EXPECT_FALSE(limit_analysis(model.value()).ok());
}

/// The traction of a boundary is a load; the displacement of one has no limit.
TEST(LimitAnalysis, BoundariesAreMultiplied) {
  const std::string text = stone(0.5) +
                           "[[block]]\nfixed = true\npolygon = [[-1,-1],[3,-1],[3,0],[-1,0]]\n"
                           "[[block]]\npolygon = [[0,0],[2,0],[2,1],[0,1]]\n"
                           "[[boundary]]\nname = \"side\"\nalong = [[0,0],[0,1]]\n";
  const LimitResult r =
      limit_of(text + "type = \"stress\"\ntraction = [1000, 0]\n", "boundary:side");
  EXPECT_NEAR(r.largest.lower, 0.5 * 2000.0 * 9.81 * 2.0 / 1000.0, 1e-4);
  const Result<Model> model =
      read_model_text(text +
                          "type = \"displacement\"\ndisplacement = [0.01, 0]\n[fos]\nvary = "
                          "\"boundary:side\"\n",
                      "m.toml", {}, ReadFor::no_run);
  ASSERT_TRUE(model.ok());
  const Result<LimitResult> none_found = limit_analysis(model.value());
  ASSERT_FALSE(none_found.ok());
  EXPECT_NE(to_string(none_found.faults()[0]).find("no limit"), std::string::npos);
}

TEST(LimitAnalysis, RefusesWhatHasNoLimit) {
  const std::string text = stone(0.3) + "[[block]]\npolygon = [[0,0],[1,0],[1,1],[0,1]]\n";
  const auto fault = [](const std::string& toml) {
    const Result<Model> model = read_model_text(toml, "m.toml", {}, ReadFor::no_run);
    if (!model.ok()) return to_string(model.faults()[0]);
    const Result<LimitResult> r = limit_analysis(model.value());
    return r.ok() ? std::string() : to_string(r.faults()[0]);
  };
  const std::string shaking =
      "[[shaking]]\nname = \"quake\"\nacceleration = { amplitude = 1, frequency = 1 }\n";
  EXPECT_NE(fault(text + shaking + "[fos]\nvary = \"shaking:quake\"\n").find("kh"),
            std::string::npos);
  EXPECT_NE(fault("gravity = [0, 0]\n" + text + "[fos]\nvary = \"kh\"\n").find("gravity"),
            std::string::npos);
  EXPECT_NE(fault(text + "[limit]\ncrushing = true\n").find("ucs"), std::string::npos);
  std::string cracking = text;
  cracking.insert(cracking.find("[[block]]"),
                  "[joints.grains]\nfriction_angle = 30\ncohesion = 1e6\ntensile_strength = 1e5\n"
                  "fracture_energy = 9\nshear_fracture_energy = 90\n");
  EXPECT_NE(fault(cracking + "[fos]\nvary = \"strength\"\n").find("grains.fracture_energy"),
            std::string::npos);
}

/// A weight that holds a block against a push: more of it holds as well, less of it does not.
TEST(LimitAnalysis, NamesTheOtherEndWhereThereIsNoLargest) {
  const LimitResult r =
      limit_of(stone(0.5) +
                   "[[block]]\nfixed = true\npolygon = [[-1, -1], [3, -1], [3, 0], [-1, 0]]\n"
                   "[[block]]\npolygon = [[0, 0], [2, 0], [2, 1], [0, 1]]\n"
                   "[[load]]\npoint = [0, 0.1]\nforce = [10e3, 0]\n",
               "gravity");
  EXPECT_EQ(r.largest.status, LimitEnd::no_limit);
  ASSERT_TRUE(r.smallest);
  const double exact = 10e3 / (0.5 * 2000 * 9.81 * 2.0);
  EXPECT_NEAR(r.smallest->lower, exact, 1e-5);
  EXPECT_NE(r.message.find(fmt::format("at the other end the limit is {:.5g}", exact)),
            std::string::npos)
      << r.message;
  EXPECT_FALSE(r.mechanism);
}

/// Where no factor moves the blocks there is no mechanism either.
TEST(LimitAnalysis, NamesNoMechanismWhereNothingMoves) {
  const LimitResult r =
      limit_of(stone(0.5) +
                   "[[block]]\nfixed = true\npolygon = [[-1, -1], [3, -1], [3, 0], [-1, 0]]\n"
                   "[[block]]\npolygon = [[0, 0], [2, 0], [2, 1], [0, 1]]\n",
               "strength");
  EXPECT_EQ(r.largest.status, LimitEnd::no_limit);
  EXPECT_EQ(r.message, "no factor of safety moves the rigid blocks");
  EXPECT_FALSE(r.mechanism);
  EXPECT_FALSE(r.moved);
}

}  // namespace
}  // namespace edda::limit_analysis_test
