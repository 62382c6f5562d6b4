// The search for a factor of safety after stages, and of models that are loose as given.
#include <gtest/gtest.h>

#include <atomic>
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

/// Trials begin from what a ramp has reached, and refuse a stage that ends in collapse.
TEST(Fos, BeginsFromTheEndOfARamp) {
  const std::string floor =
      "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 45\n[[block]]\nfixed = true\npolygon = [[-1,-1],[3,-1],[3,0],[-1,0]]\n"
      "[[block]]\npolygon = [[0,0],[2,0],[2,1],[0,1]]\n";
  const std::string pushed = "[[stage]]\nramp = { kh = [0, 0.5], steps = 5 }\n";
  const FosResult strength = found(floor + pushed + coarse);
  ASSERT_TRUE(strength.factor) << strength.message;
  EXPECT_NEAR(*strength.factor, 1.0 / 0.5, 0.06);
  const FosResult kh = found(floor + pushed + coarse + "vary = 'kh'\nbracket = [0.6, 1.5]\n");
  ASSERT_TRUE(kh.factor) << kh.message;
  EXPECT_NEAR(*kh.factor, 1.0, 0.04);
  const Result<FosResult> collapsed = find_factor(
      testing::model_of(floor + "[[stage]]\nuntil = 'collapse'\nramp = { kh = [0, 2] }\n"), {});
  ASSERT_FALSE(collapsed.ok());
  EXPECT_NE(to_string(collapsed.faults()[0]).find("until collapse"), std::string::npos);
}

/// The traction of a boundary, and the displacement of a support.
TEST(Fos, VariesBoundaries) {
  const std::string floor =
      "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[[block]]\nfixed = true\npolygon = [[-1,-1],[3,-1],[3,0],[-1,0]]\n"
      "[[block]]\npolygon = [[0,0],[2,0],[2,1],[0,1]]\n[[boundary]]\nname = 'side'\n"
      "along = [[0,0],[0,1]]\n";
  const double holds = 2500.0 * 2.0 * 9.81 * std::tan(std::numbers::pi / 6.0);
  const FosResult traction = found(floor + "type = 'stress'\ntraction = [1e4, 0]\n" + coarse +
                                   "vary = 'boundary:side'\nbracket = [1, 5]\n");
  ASSERT_TRUE(traction.factor) << traction.message;
  EXPECT_NEAR(*traction.factor, holds / 1e4, 0.05 * holds / 1e4);
  ASSERT_TRUE(traction.rigid);
  EXPECT_TRUE(traction.rigid->below_most);
  // A lintel falls off a pier that is displaced by its bearing of 0.3 m.
  const auto lintel = [&](const std::string& displacement, const std::string& bracket) {
    return found(
        "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
        "friction_angle = 30\n[[block]]\nfixed = true\n"
        "polygon = [[-1,0],[1,0],[1,2],[-1,2]]\n"
        "[[block]]\npolygon = [[3.7,0],[4.7,0],[4.7,2],[3.7,2]]\n"
        "[[block]]\npolygon = [[0,2],[4,2],[4,2.5],[0,2.5]]\n[[boundary]]\nname = 'pier'\n"
        "along = [[3.7,0],[4.7,0]]\ntype = 'displacement'\ndisplacement = " +
        displacement + "\n" + coarse + "vary = 'boundary:pier'\nbracket = " + bracket + "\n");
  };
  const FosResult bearing = lintel("[0.3, 0]", "[0.5, 1.5]");
  ASSERT_TRUE(bearing.factor) << bearing.message;
  EXPECT_NEAR(*bearing.factor, 1.0, 0.03);
  const FosResult rests = lintel("[0.002, 0]", "[0.5, 1.5]");
  EXPECT_EQ(rests.status, FosStatus::above);
  EXPECT_NE(rests.message.find("up to 48; give fos.bracket, such as [48, 96], to look beyond"),
            std::string::npos)
      << rests.message;
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

/// A search that is stopped in the stages before its trials has found nothing, not even that the
/// model is unstable.
TEST(Fos, IsStoppedBeforeItsTrials) {
  const std::atomic<bool> stop{true};
  FosOptions options;
  options.stop = &stop;
  for (const char* law : {rough.c_str(), "friction_angle = 20\n"}) {
    const Result<FosResult> r = find_factor(
        testing::model_of(ramp(law, "[[stage]]\nuntil = 'equilibrium'\n" + coarse, "")), options);
    ASSERT_TRUE(r.ok());
    EXPECT_EQ(r.value().status, FosStatus::interrupted) << r.value().message;
    EXPECT_TRUE(r.value().trials.empty());
    EXPECT_FALSE(r.value().factor);
    EXPECT_EQ(r.value().message.find("unstable"), std::string::npos) << r.value().message;
  }
}

}  // namespace
}  // namespace edda::fos_stages_test
