// Rigid limit analysis of the slopes whose factors limit equilibrium gives exactly.
#include <gtest/gtest.h>

#include "model/read_model.hpp"
#include "study/limit_analysis.hpp"
#include "verification/exact_slopes.hpp"
#include "verification/record.hpp"

namespace edda::limit_slopes_test {
namespace {

/// Rows 63 and 64. Where blocks topple, joints that dilate are held by their neighbours: no factor
/// of theirs is below the exact one. Successive programs for joints that do not come within 1 %.
TEST(LimitSlopes, FactorsOfRigidBlocks) {
  for (const ExactSlope& slope : exact_slopes()) {
    const std::string fos = slope.exclude.empty() ? std::string("[fos]\n")
                                                  : "[fos]\nexclude = [" + slope.exclude + "]\n";
    const Result<Model> model = read_model_text(slope.model + fos, "m.toml", {}, ReadFor::no_run);
    ASSERT_TRUE(model.ok()) << to_string(model.faults()[0]);
    const Result<LimitResult> r = limit_analysis(model.value());
    ASSERT_TRUE(r.ok()) << to_string(r.faults()[0]);
    ASSERT_EQ(r.value().largest.status, LimitEnd::found) << slope.name;
    const double factor = r.value().largest.lower;
    if (slope.motion.starts_with("toppling")) {
      expect_at_least({64, slope.name, "factor of joints that dilate", ""}, factor, slope.factor);
      ASSERT_TRUE(r.value().without_dilation);
      expect_at_least({64, slope.name, "factor of joints that do not", ""},
                      *r.value().without_dilation, 0.99 * slope.factor);
    } else {
      expect_relative({63, slope.name, "factor of safety", ""}, factor, slope.factor, 1e-4);
      EXPECT_TRUE(r.value().mechanism->text.starts_with(slope.motion.substr(0, 7)))
          << slope.name << ": " << r.value().mechanism->text;
    }
  }
}

}  // namespace
}  // namespace edda::limit_slopes_test
