// What rigid limit analysis says where blocks that deform stand by a sharp tip, or a small
// block moves first.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <utility>

#include "run/prepared.hpp"
#include "run/run_model.hpp"
#include "study/fos_rigid.hpp"
#include "study/limit_analysis.hpp"
#include "study/sliding_block.hpp"

namespace edda::rigid_limit_test {
namespace {

using testing::found;
using testing::model_of;

constexpr double degree = std::numbers::pi / 180.0;

/// An active wedge on 50 degrees pushes a passive one along 10 degrees, across a vertical joint
/// through the kink of their base: the tip of the active wedge stands in the kink.
const std::string two_wedges =
    "[materials.rock]\ndensity = 2600\nyoung = 1e10\npoisson = 0.25\n[joints.j]\n"
    "friction_angle = 35\n[[block]]\nfixed = true\npolygon = [[-5, -8], [33.328322507, -8], "
    "[33.328322507, 18], [25.328322507, 18], [12, 2.1159237685], [0, 0], [0, -2], [-5, -2]]\n"
    "[[block]]\npolygon = [[0, 0], [12, 2.1159237685], [12, 18], [10.3923048454, 18]]\n[[block]]\n"
    "polygon = [[12, 2.1159237685], [25.328322507, 18], [12, 18]]\n";

/// Sum of the forces along x and y on both wedges, all of their joints at the friction angle phi:
/// what is left of the weight of the passive one, over the weight of both.
double left_over(double phi) {
  const double active = 0.5 * 13.328322507 * 15.8840762315;
  const double passive =
      0.5 * std::abs(12.0 * 18.0 - 12.0 * 2.1159237685 + 12.0 * 18.0 - 10.3923048454 * 18.0);
  // On the active wedge: N1 on 50 degrees, E across the vertical joint, which it slides down.
  const double s1 = std::sin(50.0 * degree), c1 = std::cos(50.0 * degree), t = std::tan(phi);
  // x: -N1 s1 + N1 t c1 + E = 0, y: N1 c1 + N1 t s1 + E t = W1
  const double n1 = active / (c1 + t * s1 + t * (s1 - t * c1)), e = n1 * (s1 - t * c1);
  const double s2 = std::sin(10.0 * degree), c2 = std::cos(10.0 * degree);
  // On the passive wedge: y: N2 (c2 + t s2) = W2 + E t; x: E + N2 s2 = N2 t c2 at the limit
  const double n2 = (passive + e * t) / (c2 + t * s2);
  return (n2 * (t * c2 - s2) - e) / (active + passive);
}
double factor_of_two_wedges() {
  double low = 0.2, high = 5.0;
  for (int round = 0; round < 60; ++round) {
    const double middle = 0.5 * (low + high);
    (left_over(std::atan(std::tan(35.0 * degree) / middle)) > 0.0 ? low : high) = middle;
  }
  return low;
}

/// 2 % are the accuracy of a search beside the limit; where the limits differ by more, a factor
/// between them agrees with neither.
TEST(RigidLimit, AgreesWithAFactorOnlyWithinTwoPercent) {
  for (const double most : {0.3, 1.0, 7.0}) {
    EXPECT_EQ(beside_limits(0.985 * most, most, most), BesideLimits::agrees);
    EXPECT_EQ(beside_limits(1.004 * most, 0.99 * most, most), BesideLimits::agrees);
    EXPECT_EQ(beside_limits(0.975 * most, most, most), BesideLimits::below);
    EXPECT_EQ(beside_limits(0.99 * most, 0.9 * most, most), BesideLimits::between);
    EXPECT_EQ(beside_limits(0.975 * most, 0.985 * most, most), BesideLimits::between);
    EXPECT_EQ(beside_limits(0.95 * most, 0.97 * most, most), BesideLimits::below);
  }
}

TEST(RigidLimit, EndsTrialsWhereATipHoldsWhatMoves) {
  const FosResult r = found(two_wedges + "[solver]\nduration = 1\n");
  ASSERT_TRUE(r.factor && r.rigid) << r.message;
  EXPECT_LE(*r.holds, 1.002 * factor_of_two_wedges());
  EXPECT_GE(*r.fails, factor_of_two_wedges());
  EXPECT_NEAR(*r.factor, factor_of_two_wedges(), 0.004 * *r.factor);
  EXPECT_TRUE(r.rigid->below_most);
  EXPECT_NE(r.proof.find("rigid blocks have no equilibrium"), std::string::npos) << r.proof;
  ASSERT_TRUE(r.mechanism && r.failed);
  EXPECT_EQ(r.mechanism->blocks.size(), 2U);
}

std::vector<std::string> failed_checks_with(double strength_factor) {
  const Model model = model_of(two_wedges + "[[stage]]\nuntil = 'equilibrium'\nstrength_factor = " +
                               std::to_string(strength_factor) + "\n");
  Result<PreparedRun> run = prepare_run(model);
  if (!run.ok()) ADD_FAILURE() << to_string(run.faults()[0]);
  RunOptions options;
  options.rigid_factor = [&](const Simulation& sim) { return rigid_factor(model, sim); };
  const Result<Outcome> outcome = run_model(run.value(), options);
  EXPECT_EQ(outcome.value().status, Status::equilibrium);
  return outcome.value().failed_checks;
}

/// A run until equilibrium says so, too.
TEST(RigidLimit, IsACheckOfRunsUntilEquilibrium) {
  EXPECT_TRUE(failed_checks_with(1.3).empty());
  const std::vector<std::string> failed = failed_checks_with(1.6);
  ASSERT_EQ(failed.size(), 1U);
  EXPECT_NE(failed[0].find("rigid blocks"), std::string::npos) << failed[0];
}

/// Wedges that no strength of their joints holds: none of them has any.
TEST(RigidLimit, IsZeroWhereThereIsNoEquilibriumAtAll) {
  std::string smooth = two_wedges + "[[stage]]\nuntil = 'equilibrium'\n";
  smooth.replace(smooth.find("= 35"), 4, "= 0");
  const Model model = model_of(smooth);
  const Result<PreparedRun> run = prepare_run(model);
  ASSERT_TRUE(run.ok());
  EXPECT_EQ(rigid_factor(model, run.value().sim), 0.0);
}

/// A block on a slope of 30 degrees, and a pebble on one of 45: the pebble moves first, and is left
/// out where that is asked for.
TEST(RigidLimit, TellsWhatMovesInOrder) {
  const std::string text =
      "[materials.rock]\ndensity = 2600\nyoung = 1e9\npoisson = 0.25\n[joints.j]\n"
      "friction_angle = 40\n[[block]]\nfixed = true\npolygon = [[0, 0], [20, 0], [20, 10], [12, "
      "2], "
      "[0, 8.9282032303]]\n[[block]]\npolygon = [[2, 7.7735026919], [6, 5.4641016151], "
      "[7, 7.1961524227], [3, 9.5055534994]]\n[[block]]\npolygon = [[16, 6], [16.1, 6.1], "
      "[16, 6.2], [15.9, 6.1]]\n[solver]\nduration = 1\n";
  const Result<LimitResult> limit = limit_analysis(model_of(text));
  ASSERT_TRUE(limit.ok());
  EXPECT_NEAR(limit.value().largest.lower, std::tan(40.0 * degree), 1e-4);
  const double larger = std::tan(40.0 * degree) / std::tan(30.0 * degree);
  ASSERT_EQ(limit.value().mechanisms.size(), 2u);
  EXPECT_NEAR(limit.value().mechanisms[1].value.lower, larger, 1e-4);
  const FosResult r = found(text);
  ASSERT_TRUE(r.factor && r.rigid) << r.message;
  EXPECT_NEAR(*r.factor, std::tan(40.0 * degree), 0.01);
  ASSERT_EQ(r.sets.size(), 2u) << r.message;
  EXPECT_NEAR(r.sets[0].area, 0.02, 1e-6);
  EXPECT_NEAR(r.sets[1].area, 8.0 * std::hypot(1.0, 0.0), 4.0);
  EXPECT_LE(r.sets[1].holds, larger);
  EXPECT_NEAR(r.sets[1].fails, larger, 0.02 * larger);
  const FosResult large = found(text + "[fos]\nleast_area = 0.1\n");
  ASSERT_TRUE(large.factor && large.rigid) << large.message;
  EXPECT_NEAR(*large.factor, larger, 0.01 * larger);
  EXPECT_NEAR(large.rigid->most, larger, 1e-4);
}

/// A slab on 35 degrees with a bolt across its joint, which presses with its pretension until the
/// slab slides and carries more only after that, while rigid blocks count all that it can carry:
/// F = (W cos 35 + P) tan 36/(W sin 35). Rounded coordinates give rigid blocks a limit, of 32768.
TEST(RigidLimit, DoesNotLetASlabSlideUntilItsBoltHolds) {
  const double c = std::cos(35.0 * degree), s = std::sin(35.0 * degree);
  for (const int digits : {6, 12}) {
    const auto ring = [&](double u0, double v0, double u1, double v1) {
      std::string text;
      for (const auto& [u, v] : {std::pair{u0, v0}, {u1, v0}, {u1, v1}, {u0, v1}})
        text += fmt::format("[{:.{}f}, {:.{}f}],", u * c - v * s, digits, u * s + v * c, digits);
      return "[" + text + "]\n";
    };
    const FosResult r = found(
        "[materials.rock]\ndensity = 2600\nyoung = 5e9\npoisson = 0.25\n[joints.j]\n"
        "friction_angle = 36\n[[block]]\nfixed = true\npolygon = " +
        ring(0, -6, 9, 0) + "[[block]]\npolygon = " + ring(3, 0, 6, 1.5) +
        fmt::format("[[bolt]]\nfrom = [{}, {}]\nto = [{}, {}]\n", 4.5 * c - 1.49 * s,
                    4.5 * s + 1.49 * c, 4.5 * c + 3.0 * s, 4.5 * s - 3.0 * c) +
        "type = 'end'\ndiameter = 0.03\nspacing = 1\npretension = 60000\n");
    const double weight = 2600.0 * 9.81 * 4.5;
    const double slides = (weight * c + 60e3) * std::tan(36.0 * degree) / (weight * s);
    EXPECT_NEAR(slides, 1.6998, 1e-3);
    ASSERT_TRUE(r.factor) << r.message;
    EXPECT_NEAR(*r.factor / slides, 1.0, 0.02) << digits;
    // Where the slab may move by a tenth of its size the stretched bolt counts: both are told.
    ASSERT_TRUE(r.holds_wide && r.fails_wide);
    EXPECT_GT(*r.holds_wide, 1.5 * slides);
    EXPECT_NE(r.message.find("where a hundredth of its size is too far for a block to move"),
              std::string::npos)
        << r.message;
  }
}

}  // namespace
}  // namespace edda::rigid_limit_test
