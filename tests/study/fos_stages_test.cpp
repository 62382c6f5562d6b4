// The search for a factor of safety after stages, and of models that are loose as given.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "study/sliding_block.hpp"

namespace edda::fos_stages_test {
namespace {

using testing::coarse;
using testing::exact;
using testing::found;
using testing::on_ramp;
using testing::ramp;
using testing::rough;

/// Blocks that no strength of joints would support are excluded, and named.
TEST(Fos, LooseHoweverStrong) {
  const FosResult r =
      found(ramp(rough, on_ramp(-4.3, -3.8, 0.0, 0.3, "name = 'overhang'") + coarse));
  EXPECT_EQ(r.status, FosStatus::found) << r.message;
  EXPECT_NEAR(*r.factor, exact, 0.05);
}

/// Blocks that stronger joints would support determine the factor.
TEST(Fos, LooseInAStage) {
  const std::string on_strong_joint = on_ramp(-3.0, -2.0, 0.0, 1.0, "joint = 'held'"),
                    stage = "[[stage]]\nuntil = 'equilibrium'\n";
  const std::string law =
      "friction_angle = 25\n[joints.held]\nfriction_angle = 60\n[contact]\njoint = 'j'\n";
  std::vector<std::string> messages;
  const FosResult r = found(ramp(law, on_strong_joint + stage + coarse, ""), 1, &messages);
  EXPECT_EQ(r.status, FosStatus::found) << r.message;
  EXPECT_EQ(messages.front(),
            "blocks come loose in stage 1 with the given strength; it is run again with a thousand "
            "times the strength");
  EXPECT_NEAR(*r.factor,
              std::tan(25.0 * std::numbers::pi / 180.0) / std::tan(std::numbers::pi / 6.0), 0.03);
}

/// The stage that reaches no equilibrium is named.
TEST(Fos, ReportsWhichStageIsRunAgain) {
  const std::string stages =
      "[[stage]]\nname = 'held'\nuntil = 'equilibrium'\njoints = 'glued'\n"
      "[[stage]]\nname = 'static'\nuntil = 'equilibrium'\n[[stage]]\nuntil = 'equilibrium'\n";
  std::vector<std::string> messages;
  const FosResult r = found(ramp("friction_angle = 20\n", stages + coarse, ""), 1, &messages);
  EXPECT_EQ(r.status, FosStatus::found) << r.message;
  EXPECT_EQ(messages.front(),
            "stage 2 (static) does not reach equilibrium with the given strength; the stages are "
            "run again with a thousand times the strength");
}

/// The trials begin from the end of the stage named, with the strength that it has there.
TEST(Fos, BeginsFromAStage) {
  const std::string stages =
      "[[stage]]\nname = 'rest'\nuntil = 'equilibrium'\n[[stage]]\nname = 'weak'\nuntil = "
      "'equilibrium'\nstrength_factor = 1.25\n";
  std::string text = ramp(rough);
  text.erase(text.find("duration = 0.5\n"), 15);
  const FosResult first = found(text + stages + coarse + "stage = 'rest'\n");
  const FosResult last = found(text + stages + coarse);
  EXPECT_NEAR(*first.factor, exact, 0.05);
  EXPECT_NEAR(*last.factor, exact / 1.25, 0.05);
}

/// A load that no stage has activated yet acts in the trials.
TEST(Fos, SwitchesOnWhatItVaries) {
  std::string text = ramp("friction_angle = 45\n",
                          "[[load]]\nname = 'push'\npoint = [1.1, -0.05]\nforce = [1e4, 0]\n"
                          "[[stage]]\nname = 'rest'\nuntil = 'equilibrium'\n[[stage]]\nname = "
                          "'pushed'\nuntil = 'equilibrium'\nactivate = ['push']\n");
  text.erase(text.find("duration = 0.5\n"), 15);
  const double s = 0.5, c = std::sqrt(0.75), weight = 2500.0 * 2.0 * 9.81;
  for (const char* stage : {"rest", "pushed"}) {
    const FosResult r =
        found(text + coarse + "vary = 'load:push'\nbracket = [0.5, 2]\nstage = '" + stage + "'\n");
    ASSERT_TRUE(r.factor) << r.message;
    EXPECT_NEAR(*r.factor, weight * (c - s) / (c + s) / 1e4, 0.05);
  }
}

}  // namespace
}  // namespace edda::fos_stages_test
