// Both ends of a limit, mechanisms in order, progress and stopping.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>

#include "model/read_model.hpp"
#include "study/limit_analysis.hpp"

namespace edda::limit_ends_test {
namespace {

constexpr double degree = std::numbers::pi / 180.0;

LimitResult limit_of(const std::string& text, const LimitOptions& options = {}) {
  const Result<Model> model = read_model_text(text, "m.toml", {}, ReadFor::no_run);
  if (!model.ok()) {
    ADD_FAILURE() << to_string(model.faults()[0]);
    return {};
  }
  Result<LimitResult> r = limit_analysis(model.value(), options);
  if (!r.ok()) {
    ADD_FAILURE() << to_string(r.faults()[0]);
    return {};
  }
  return std::move(r.value());
}

const std::string stone =
    "[materials.stone]\ndensity = 2000\nyoung = 50e9\npoisson = 0.2\n[joints.dry]\n"
    "friction_angle = 40\n";

/// A fixed wedge of this angle, and a slab of 4 m x 1 m on it.
std::string slab_on(double angle, double x) {
  const double c = std::cos(angle * degree), s = std::sin(angle * degree);
  const auto at = [&](double along, double up) {
    return fmt::format("[{:.15g}, {:.15g}]", x + along * c - up * s, along * s + up * c);
  };
  return fmt::format(
      "[[block]]\nfixed = true\npolygon = [{}, [{:.15g}, -5], {}]\n[[block]]\npolygon = [{}, {}, "
      "{}, {}]\n",
      at(-6, 0), x, at(6, 0), at(-2, 0), at(2, 0), at(2, 1), at(-2, 1));
}

/// kh up and down a slope: tan(40 -+ a), each with its mechanism; "-kh" asks for the other first.
TEST(LimitEnds, OfASlabOnASlope) {
  for (const double angle : {10.0, -15.0}) {
    const std::string model = stone + slab_on(angle, 0.0) + "[fos]\nvary = ";
    const LimitResult r = limit_of(model + "\"kh\"\n"), back = limit_of(model + "\"-kh\"\n");
    // Downhill is to the left where the slope rises to the right.
    const double right = std::tan((40.0 + angle) * degree);
    const double left = std::tan((40.0 - angle) * degree);
    EXPECT_NEAR(r.largest.lower, right, 1e-6);
    ASSERT_TRUE(r.smallest && r.other_motion && r.mechanism);
    EXPECT_NEAR(r.smallest->lower, -left, 1e-6);
    EXPECT_EQ(r.other_governs, angle > 0.0);
    EXPECT_GT(r.mechanism->blocks.at(0).displacement.x, 0.0);
    EXPECT_LT(r.other_motion->mechanism.blocks.at(0).displacement.x, 0.0);
    EXPECT_NEAR(back.largest.lower, left, 1e-6);
    EXPECT_NEAR(back.smallest->lower, -right, 1e-6);
    EXPECT_LT(back.mechanism->blocks.at(0).displacement.x, 0.0);
    EXPECT_NE(back.message.find("to the left"), std::string::npos) << back.message;
    const std::string summary = limit_summary({}, r);
    EXPECT_NE(summary.find("\"governs\": " + std::string(angle > 0.0 ? "true" : "false")),
              std::string::npos)
        << summary;
  }
}

TEST(LimitEnds, OfATiltToTheLeftAndOfWeightDownwards) {
  const std::string model = stone + slab_on(10.0, 0.0) + "[fos]\nvary = ";
  EXPECT_NEAR(limit_of(model + "\"-tilt\"\n").largest.lower, 30.0, 1e-6);
  EXPECT_NEAR(limit_of(model + "\"tilt\"\n").smallest->lower, -30.0, 1e-6);
  // More weight moves nothing; no weight at all lets it go.
  const LimitResult down = limit_of(model + "\"-kv\"\n");
  EXPECT_EQ(down.largest.status, LimitEnd::no_limit);
  EXPECT_NEAR(down.smallest->lower, -1.0, 1e-6);
}

/// Neither end is nearer than the other, from whichever side they are seen.
TEST(LimitEnds, OfWhatIsSymmetricAreEqual) {
  const std::string ground =
      "[[block]]\nfixed = true\npolygon = [[-9, -1], [9, -1], [9, 0], "
      "[-9, 0]]\n";
  const std::string column = ground +
                             "[[block]]\npolygon = [[-0.15, 0], [0.15, 0], [0.15, 1], "
                             "[-0.15, 1]]\n[[block]]\npolygon = [[-0.15, 1], [0.15, 1], "
                             "[0.15, 2], [-0.15, 2]]\n";
  for (const auto& [blocks, limit] :
       {std::pair{slab_on(0.0, 0.0), std::tan(40.0 * degree)}, {column, 0.15}}) {
    for (const char* vary : {"kh", "-kh"}) {
      const LimitResult r = limit_of(stone + blocks + "[fos]\nvary = \"" + vary + "\"\n");
      ASSERT_TRUE(r.smallest);
      EXPECT_NEAR(r.largest.lower, limit, 1e-6);
      EXPECT_NEAR(r.smallest->lower, -limit, 1e-6);
      EXPECT_FALSE(r.other_governs) << vary;
      EXPECT_EQ(r.message.find("which is nearer"), std::string::npos) << r.message;
    }
  }
}

/// Three slabs on slopes of 35, 25 and 30 degrees, far from each other.
TEST(LimitMechanisms, ComeInTheOrderOfTheirFactors) {
  const std::string model =
      stone + slab_on(35.0, 0.0) + slab_on(25.0, 100.0) + slab_on(30.0, 200.0);
  const LimitResult r = limit_of(model);
  ASSERT_EQ(r.mechanisms.size(), 3u);
  const double angles[] = {35.0, 30.0, 25.0};
  for (std::size_t q = 0; q < 3; ++q) {
    EXPECT_NEAR(r.mechanisms[q].value.lower, std::tan(40 * degree) / std::tan(angles[q] * degree),
                2e-6);
    EXPECT_EQ(r.mechanisms[q].blocks.size(), 1u);
    EXPECT_NEAR(r.mechanisms[q].area, 4.0, 1e-9);
    EXPECT_FALSE(r.mechanisms[q].left_out);
  }
  EXPECT_EQ(r.largest.lower, r.mechanisms[0].value.lower);
}

TEST(LimitMechanisms, SmallerOnesAreLeftOutWhereItIsAskedFor) {
  const std::string pebble =
      "[[block]]\nfixed = true\npolygon = [[50, 0], [60, 0], [60, 10]]\n[[block]]\npolygon = "
      "[[55, 5], [55.1, 5.1], [55, 5.2], [54.9, 5.1]]\n";
  const std::string model = stone + slab_on(30.0, 0.0) + pebble;
  const double of_slab = std::tan(40 * degree) / std::tan(30 * degree);
  const LimitResult all = limit_of(model), large = limit_of(model + "[fos]\nleast_area = 0.5\n");
  EXPECT_NEAR(all.largest.lower, std::tan(40 * degree), 2e-6);
  ASSERT_EQ(all.mechanisms.size(), 2u);
  EXPECT_NEAR(all.mechanisms[1].value.lower, of_slab, 4e-6);
  EXPECT_NEAR(large.largest.lower, of_slab, 4e-6);
  ASSERT_EQ(large.mechanisms.size(), 2u);
  EXPECT_TRUE(large.mechanisms[0].left_out);
  EXPECT_NEAR(large.mechanisms[0].value.lower, std::tan(40 * degree), 2e-6);
  EXPECT_FALSE(large.mechanisms[1].left_out);
}

TEST(LimitAnalysis, NamesInitialStressAsLeftOut) {
  const std::string model = stone + slab_on(30.0, 0.0);
  const auto warns = [](const LimitResult& r) {
    return std::any_of(r.warnings.begin(), r.warnings.end(), [](const std::string& w) {
      return w.find("initial_stress is left out of the limit") != std::string::npos;
    });
  };
  EXPECT_FALSE(warns(limit_of(model)));
  EXPECT_TRUE(warns(limit_of(model + "[initial_stress]\nstress = [-2e4, 0, 0]\n")));
}

TEST(LimitAnalysis, EndsWhereItIsAskedTo) {
  const std::atomic<bool> stop = true;
  LimitOptions options;
  options.stop = &stop;
  const LimitResult r = limit_of(stone + slab_on(30.0, 0.0), options);
  EXPECT_TRUE(r.interrupted);
  EXPECT_EQ(r.largest.status, LimitEnd::not_solved);
  EXPECT_NE(r.message.find("interrupted"), std::string::npos);
}

TEST(LimitAnalysis, IsTheSameWithAnyNumberOfThreads) {
  const std::string model = stone + slab_on(35.0, 0.0) + slab_on(30.0, 100.0);
  LimitOptions options;
  options.threads = 4;
  for (const char* vary : {"strength", "kh"}) {
    const std::string text = model + "[fos]\nvary = \"" + vary + "\"\n";
    LimitResult one = limit_of(text), four = limit_of(text, options);
    one.seconds = four.seconds = 0.0;
    EXPECT_EQ(limit_summary({}, one), limit_summary({}, four));
  }
}

}  // namespace
}  // namespace edda::limit_ends_test
