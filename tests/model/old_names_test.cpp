// Old names of keys are read, with a warning.
#include <gtest/gtest.h>

#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda::old_names_test {
namespace {

using testing::base_model;
using testing::base_with;

TEST(OldNames, AreReadWithAWarning) {
  const std::string text = base_with("[[fixed]]\n", "[[held]]\n") +
                           "[[stage]]\nduration = 0.05\nmass_scaling = \"static\"\n"
                           "[[stage]]\nduration = 0.05\nmass_scaling = \"as given\"\n";
  const Result<Model> read = read_model_text(text, "old.toml");
  ASSERT_TRUE(read.ok()) << to_string(read.faults()[0]);
  const Model& model = read.value();
  EXPECT_EQ(model.fixed.size(), 1U);
  EXPECT_EQ(model.stages[0].masses, StageMasses::scaled);
  EXPECT_EQ(model.stages[1].masses, StageMasses::as_given);
  ASSERT_EQ(model.warnings.size(), 3U);
  EXPECT_NE(model.warnings[0].find("[[held]] is named [[fixed]] now"), std::string::npos);
  EXPECT_NE(model.warnings[1].find("mass_scaling of [[stage]] is named masses now"),
            std::string::npos);
  EXPECT_NE(model.warnings[2].find("\"static\" as masses of [[stage]] is named \"scaled\" now"),
            std::string::npos);
}

TEST(OldNames, AreReadOnTheCommandLine) {
  const std::string text = std::string(base_model) + "[[stage]]\nduration = 0.1\n";
  const Result<Model> read = read_model_text(
      text, "new.toml", {"stage.0.mass_scaling=static", "held=[{point=[1, 1]}, {point=[2, 1]}]"});
  ASSERT_TRUE(read.ok()) << to_string(read.faults()[0]);
  EXPECT_EQ(read.value().stages[0].masses, StageMasses::scaled);
  EXPECT_EQ(read.value().fixed.size(), 2U);
  EXPECT_EQ(read.value().warnings.size(), 3U);
}

TEST(OldNames, TodaysNamesAreReadWithoutAWord) {
  const Result<Model> read = read_model_text(
      std::string(base_model) + "[[stage]]\nduration = 0.1\nmasses = \"scaled\"\n", "a");
  ASSERT_TRUE(read.ok());
  EXPECT_TRUE(read.value().warnings.empty());
}

TEST(OldNames, BothFormsAtOnceAreAFault) {
  const Result<Model> read =
      read_model_text(std::string(base_model) + "[[held]]\npoint = [1, 1]\n", "both.toml");
  ASSERT_FALSE(read.ok());
  ASSERT_EQ(read.faults().size(), 1U);
  EXPECT_EQ(read.faults()[0].where.key, "held");
  EXPECT_EQ(read.faults()[0].remedy, "move what it has to fixed");
}

}  // namespace
}  // namespace edda::old_names_test
