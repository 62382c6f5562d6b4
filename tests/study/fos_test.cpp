// The search for a factor of safety: its result, and that threads and interruptions do not change
// it.
#include "study/fos.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <numbers>
#include <string>
#include <vector>

#include "run/prepared.hpp"
#include "study/sliding_block.hpp"

namespace edda::fos_test {
namespace {

using testing::coarse;
using testing::exact;
using testing::found;
using testing::model_of;
using testing::on_ramp;
using testing::ramp;
using testing::rough;

TEST(Fos, DoesNotDependOnThreads) {
  const FosResult one = found(ramp(rough, coarse));
  EXPECT_EQ(one.status, FosStatus::found);
  EXPECT_NEAR(*one.factor, exact, 0.05);
  const FosResult three = found(ramp(rough, coarse), 3);
  EXPECT_EQ(fos_csv(one.trials), fos_csv(three.trials));
  EXPECT_EQ(one.failed->motion.state.x, three.failed->motion.state.x);
  EXPECT_EQ(mechanism_csv(*one.failed, *one.mechanism),
            mechanism_csv(*three.failed, *three.mechanism));
}

/// The trials reported during the search are those that count in the end, in their order.
TEST(Fos, ReportsTheTrialsThatCount) {
  for (const int threads : {1, 3}) {
    std::vector<std::string> reported;
    FosOptions options;
    options.threads = threads;
    options.say = [&](const std::string& line) { reported.push_back(line); };
    const Result<FosResult> r = find_factor(model_of(ramp(rough, coarse)), options);
    ASSERT_TRUE(r.ok());
    const std::vector<Trial>& trials = r.value().trials;
    ASSERT_EQ(reported.size(), trials.size()) << threads;
    for (std::size_t k = 0; k < reported.size(); ++k)
      EXPECT_TRUE(reported[k].starts_with(fmt::format("factor {:.6g} ", trials[k].factor)))
          << reported[k];
  }
}

/// A search needs no duration, and ignores one that is given.
TEST(Fos, NeedsNoDuration) {
  const FosResult none = found(ramp(rough, coarse, ""));
  EXPECT_NEAR(*none.factor, exact, 0.05);
  for (const char* duration : {"0.5", "500"}) {
    const FosResult given =
        found(ramp(rough, coarse, "[solver]\nduration = " + std::string(duration) + "\n"));
    EXPECT_EQ(fos_csv(given.trials), fos_csv(none.trials));
  }
}

/// But the length of a sine is that of the run.
TEST(Fos, ASineNeedsADuration) {
  const Result<FosResult> r = find_factor(
      model_of(
          ramp(rough,
               "[[shaking]]\nname = 'push'\nacceleration = { amplitude = 1, frequency = 5 }\n" +
                   coarse + "vary = 'shaking:push'\n",
               "")),
      {});
  ASSERT_FALSE(r.ok());
  EXPECT_EQ(to_string(r.faults()[0]),
            "m.toml:18:8: fos.vary: the duration of the ground motion is not given: give "
            "solver.duration, or a record as the acceleration of the shaking");
}

/// A run does need one.
TEST(Fos, ARunNeedsADuration) {
  const Result<PreparedRun> run = prepare_run(model_of(ramp(rough, "", "")));
  ASSERT_FALSE(run.ok());
  EXPECT_EQ(run.faults()[0].where.key, "solver.duration");
  EXPECT_EQ(run.faults()[0].where.file, "m.toml");
}

/// Joints that keep their strength cannot fail; the search ends all the same.
TEST(Fos, ExcludedJointsKeepTheirStrength) {
  const FosResult r = found(ramp(rough, coarse + "exclude = ['j']\n"));
  EXPECT_EQ(r.status, FosStatus::above);
  EXPECT_FALSE(r.factor);
  EXPECT_GE(*r.holds, 64.0);
  EXPECT_NE(r.message.find("holds at every factor"), std::string::npos);
}

/// A block that slides a little until a fixed block stops it has not failed.
TEST(Fos, StopsBeforeWhatFails) {
  const FosResult r = found(ramp(rough, on_ramp(2.003, 3.0, 0.0, 1.0, "fixed = true") + coarse));
  ASSERT_GE(r.trials.size(), 2u);
  EXPECT_EQ(r.trials[1].factor, 3.0);
  EXPECT_EQ(r.trials[1].end, TrialEnd::holds) << r.trials[1].reason;
  EXPECT_NEAR(r.trials[1].displacement, 0.003, 3e-4);
}

/// Blocks that a load compresses, however far, have not failed.
TEST(Fos, PressedTogether) {
  for (const char* young : {"2e8", "2e9"}) {
    const FosResult r = found(
        "[materials.rock]\ndensity = 2600\nyoung = " + std::string(young) +
        "\npoisson = 0.2\n[joints.j]\nfriction_angle = 35\n[[block]]\nfixed = true\n"
        "polygon = [[-5, -1], [9, -1], [9, 0], [-5, 0]]\n[[brick_wall]]\ncolumns = 4\nrows = 3\n"
        "brick = [1, 0.5]\n[[load]]\nname = 'top'\nalong = [[0, 1.5], [4, 1.5]]\n"
        "pressure = 1e5\n[solver]\nduration = 1\n[fos]\nvary = 'load:top'\ntolerance = 0.5\n");
    EXPECT_EQ(r.status, FosStatus::above) << young << ": " << r.message;
  }
}

/// Where nothing acts the reported acceleration is that from which T follows.
TEST(Fos, TellsTheAccelerationThatItUses) {
  const FosResult r = found("gravity = [0, 0]\n" + ramp(rough, coarse, ""));
  EXPECT_EQ(r.criterion.acceleration, 9.81);
  EXPECT_NEAR(r.criterion.duration, 5.0 * std::sqrt(std::sqrt(2.0) / 9.81), 1e-5);
}

/// A model that does not stand as given has a factor below 1.
TEST(Fos, BelowOne) {
  const FosResult r = found(ramp("friction_angle = 20\n", coarse));
  EXPECT_EQ(r.status, FosStatus::found);
  EXPECT_NEAR(*r.factor, std::tan(20.0 * std::numbers::pi / 180.0) * std::sqrt(3.0), 0.05);
  EXPECT_EQ(r.trials.front().factor, 1.0);
  EXPECT_EQ(r.trials.front().end, TrialEnd::fails);
}

/// Where excluded joints are too weak no factor is found; without friction, or without contact, no
/// equilibrium is found.
TEST(Fos, NothingToBracket) {
  const FosResult below = found(ramp("friction_angle = 20\n", coarse + "exclude = ['j']\n"));
  EXPECT_EQ(below.status, FosStatus::below);
  EXPECT_LE(*below.fails, 0.5 / 16.0);
  const FosResult falling =
      found("[materials.rock]\ndensity = 2500\nyoung = 2e8\npoisson = 0.2\n[joints.j]\n" + rough +
            "[solver]\nduration = 1\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 1], [0, 1]]\n");
  EXPECT_EQ(found(ramp("friction_angle = 0\n", coarse)).status, FosStatus::unstable);
  EXPECT_EQ(falling.status, FosStatus::unstable);
  EXPECT_NE(falling.message.find("does not reach equilibrium"), std::string::npos)
      << falling.message;
}

TEST(Fos, StopsWhenAsked) {
  std::atomic<bool> stop{false};
  FosOptions options;
  options.stop = &stop;
  int count = 0;
  options.say = [&](const std::string&) { stop = ++count >= 2; };
  const Result<FosResult> r = find_factor(model_of(ramp(rough, coarse)), options);
  ASSERT_TRUE(r.ok());
  EXPECT_EQ(r.value().status, FosStatus::interrupted);
  EXPECT_EQ(r.value().trials.size(), 2U);
  EXPECT_EQ(r.value().holds, 1.0);
}

TEST(Fos, RefusesWhatItCannotDo) {
  for (const auto& [line, key] :
       {std::pair{"method = 'dda'\n", "solver.method"}, {"mass = 'consistent'\n", "solver.mass"}}) {
    std::string text = ramp(rough);
    text.insert(text.find("duration"), line);
    const Result<FosResult> r = find_factor(model_of(text), {});
    ASSERT_FALSE(r.ok());
    EXPECT_EQ(r.faults()[0].where.key, key);
  }
}

/// The factor also divides a strength that depends on slip and stress.
TEST(Fos, DividesLawsThatChange) {
  const double sigma = 2500.0 * 9.81 * std::cos(std::numbers::pi / 6.0);
  const FosResult barton =
      found(ramp("type = 'barton-bandis'\njrc = 5\njcs = 1e7\nresidual_angle = 30\n", coarse));
  const double angle = 30.0 + 5.0 * std::log10(1e7 / sigma);
  EXPECT_NEAR(*barton.factor, std::tan(angle * std::numbers::pi / 180.0) * std::sqrt(3.0), 0.05);
  const FosResult weak = found(
      ramp("type = 'slip-weakening'\nfriction_angle = 45\nresidual = { friction_angle = 20 }\n"
           "slip_distance = 0.05\n",
           coarse));
  EXPECT_NEAR(*weak.factor, exact, 0.05);
}

}  // namespace
}  // namespace edda::fos_test
