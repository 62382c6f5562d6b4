// The search for a factor of safety: its result, and that threads and interruptions do not change
// it.
#include "study/fos.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <atomic>
#include <chrono>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>
#include <thread>
#include <vector>

#include "run/prepared.hpp"
#include "study/fos_sets.hpp"
#include "study/sliding_block.hpp"

namespace edda::fos_test {
namespace {

using testing::coarse;
using testing::exact;
using testing::found;
using testing::model_of;
using testing::number;
using testing::on_ramp;
using testing::ramp;
using testing::rough;

/// All that a search tells and writes, but the time that it took.
struct Told {
  std::vector<std::string> lines;
  std::string files;
  FosResult result;
};

Told told(const Model& model, int threads) {
  Told t;
  FosOptions options;
  options.threads = threads;
  options.say = [&](const std::string& line) { t.lines.push_back(line); };
  Result<FosResult> r = find_factor(model, options);
  if (!r.ok()) ADD_FAILURE() << to_string(r.faults()[0]);
  t.result = std::move(r.value());
  t.result.seconds = 0.0;
  t.files = fos_csv(t.result.trials) + fos_summary(model, t.result, 0);
  if (!t.result.mechanism) return t;
  t.files += mechanism_csv(*t.result.failed, *t.result.mechanism);
  t.files += mechanism_joints_csv(*t.result.mechanism);
  return t;
}

void expect_same_for_all_threads(const Model& model) {
  const Told one = told(model, 1);
  for (const int threads : {2, 3, 4, 9}) {
    const Told more = told(model, threads);
    EXPECT_EQ(one.lines, more.lines) << threads;
    EXPECT_EQ(one.files, more.files) << threads;
    ASSERT_EQ(one.result.failed.has_value(), more.result.failed.has_value()) << threads;
    if (!one.result.failed) continue;
    EXPECT_EQ(one.result.failed->motion.state.position.x,
              more.result.failed->motion.state.position.x)
        << threads;
    EXPECT_EQ(one.result.failed->motion.state.velocity.y,
              more.result.failed->motion.state.velocity.y)
        << threads;
  }
}

TEST(Fos, DoesNotDependOnThreads) {
  const FosResult one = found(ramp(rough, coarse));
  EXPECT_EQ(one.status, FosStatus::found);
  EXPECT_NEAR(*one.factor, exact, 0.05);
  expect_same_for_all_threads(model_of(ramp(rough, coarse)));
}

/// Nor where it fails as given, holds whatever is tried, or has ends that must be moved, and where
/// trials change the load, a part of the model that copies of a simulation share.
TEST(Fos, DoesNotDependOnThreadsEither) {
  const std::string narrow = "[fos]\ntolerance = 0.02\nbracket = [2.5, 3.0]\n";
  const std::string push =
      "[[load]]\nname = 'push'\npoint = [1.1, -0.05]\nforce = [1e4, 0]\n[fos]\n"
      "vary = 'load:push'\ntolerance = 0.05\n";
  for (const std::string& text :
       {ramp("friction_angle = 20\n", coarse), ramp(rough, coarse + "exclude = ['j']\n"),
        ramp("friction_angle = 20\n", coarse + "exclude = ['j']\n"), ramp(rough, narrow),
        ramp(rough, push), ramp("friction_angle = 0\n", coarse)}) {
    expect_same_for_all_threads(model_of(text));
  }
}

/// The columns of Goodman and Bray: trials of very different length.
TEST(Fos, AnExampleDoesNotDependOnThreads) {
  const Result<Model> model = read_model(EDDA_SOURCE_DIR "/examples/toppling.toml",
                                         {"fos.tolerance=0.02"}, ReadFor::no_run);
  ASSERT_TRUE(model.ok());
  expect_same_for_all_threads(model.value());
}

/// The trials reported during the search are those that count in the end, in their order.
TEST(Fos, ReportsTheTrialsThatCount) {
  for (const int threads : {1, 3}) {
    const Told t = told(model_of(ramp(rough, coarse)), threads);
    const std::vector<Trial>& trials = t.result.trials;
    // What is tried besides, of blocks that may move further, is set back.
    ASSERT_GE(t.lines.size(), trials.size()) << threads;
    for (std::size_t k = trials.size(); k < t.lines.size(); ++k)
      EXPECT_TRUE(t.lines[k].starts_with("  ")) << t.lines[k];
    for (std::size_t k = 0; k < trials.size(); ++k)
      EXPECT_TRUE(t.lines[k].starts_with(fmt::format("factor {:.6g} ", trials[k].factor)))
          << t.lines[k];
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
  const Trial* const trial = trial_at(r.trials, 3.0);
  ASSERT_NE(trial, nullptr);
  EXPECT_EQ(trial->end, TrialEnd::holds) << trial->reason;
  EXPECT_NEAR(trial->displacement, 0.003, 3e-4);
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

/// A slab of 4 x 1 m that lies level under its weight, and a push at its foot of this force.
std::string pushed(const std::string& force) {
  return "[materials.rock]\ndensity = 2500\nyoung = 2e9\npoisson = 0.25\n[joints.j]\n"
         "friction_angle = 30\n[[block]]\nfixed = true\n"
         "polygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]\n[[block]]\n"
         "polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]\n[[load]]\nname = 'push'\n"
         "point = [0, 0.2]\nforce = [" +
         force + ", 0]\n" + coarse + "vary = 'load:push'\n";
}

const double slides = 2500.0 * 9.81 * 4.0 * std::tan(std::numbers::pi / 6.0);

/// The search begins where rigid blocks have their limit, if it would not get there otherwise.
TEST(Fos, FindsFactorsFarFromOne) {
  for (const double far : {400.0, 4e-4}) {
    const FosResult r = found(pushed(fmt::format("{}", slides / far)));
    ASSERT_TRUE(r.factor) << r.message;
    EXPECT_NEAR(*r.factor, far, 0.05 * far);
    EXPECT_LT(r.trials.size(), 10U);
  }
  expect_same_for_all_threads(model_of(pushed(fmt::format("{}", slides / 400.0))));
}

/// With a bracket of its own it stays there, and says that it has not seen all.
TEST(Fos, SaysThatABracketMayLookBeyond) {
  const FosResult above = found(pushed(fmt::format("{}", slides / 400.0)) + "bracket = [0.5, 2]\n");
  EXPECT_EQ(above.status, FosStatus::above);
  EXPECT_EQ(above.message,
            "the model holds at every factor tried, up to 64; give fos.bracket, such as [200, "
            "800], to look beyond");
  const FosResult below = found(pushed(fmt::format("{}", slides / 4e-4)) + "bracket = [0.5, 2]\n");
  EXPECT_EQ(below.status, FosStatus::below);
  EXPECT_EQ(below.message,
            "the model fails at every factor tried, down to 0.015625; give fos.bracket, such as "
            "[0.0002, 0.0008], to look beyond");
}

/// Where nothing acts the reported acceleration is that from which T follows.
TEST(Fos, TellsTheAccelerationThatItUses) {
  const FosResult r = found("gravity = [0, 0]\n" + ramp(rough, coarse, ""));
  EXPECT_EQ(r.acceleration, 9.81);
  EXPECT_NEAR(r.duration, 5.0 * std::sqrt(std::sqrt(2.0) / 9.81), 1e-5);
}

/// A model that does not stand as given has a factor below 1.
TEST(Fos, BelowOne) {
  const FosResult r = found(ramp("friction_angle = 20\n", coarse));
  EXPECT_EQ(r.status, FosStatus::found);
  EXPECT_NEAR(*r.factor, std::tan(20.0 * std::numbers::pi / 180.0) * std::sqrt(3.0), 0.05);
  EXPECT_EQ(r.trials.front().factor, 1.0);
  EXPECT_EQ(r.trials.front().end, TrialEnd::fails);
}

/// A block that hangs on its bond, too heavy for it: what breaks under the given weight may hold a
/// smaller one.
TEST(Fos, AWeightThatABrittleBondHolds) {
  for (const double part : {0.8, 0.2}) {
    const double weight = 2500.0 * 9.81;
    const FosResult r = found(
        "[materials.rock]\ndensity = 2500\nyoung = 2e9\npoisson = 0.2\n[joints.j]\nfriction_angle "
        "= 30\ncohesion = 1e6\ntensile_strength = " +
        number(part * weight) +
        "\n[solver]\nduration = 1\n[[block]]\nfixed = true\npolygon = [[-1, 0], [2, 0], [2, 1], "
        "[-1, 1]]\n[[block]]\npolygon = [[0, -1], [1, -1], [1, 0], [0, 0]]\n[fos]\nvary = "
        "'gravity'\n");
    ASSERT_TRUE(r.factor) << r.message;
    EXPECT_NEAR(*r.factor / part, 1.0, 0.01);
  }
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

/// A roof wedge that no strength of its joints holds falls while the trials' joints come to rest;
/// the factor is the limit of rigid blocks, and the result says what has fallen.
TEST(Fos, SaysWhatFallsHoweverStrongTheJointsAre) {
  const std::string rock =
      "[materials.rock]\ndensity = 2600\nyoung = 10e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[domain]\njoint = 'j'\n"
      "outline = [[-10, -10], [10, -10], [10, 10], [-10, 10]]\n"
      "[[trace]]\npoints = [[-2, 2], [0.5, 5]]\n[[trace]]\npoints = [[2.5, 2], [0.5, 5]]\n"
      "[[opening]]\nname = 't'\npolygon = [[-3, -2], [3, -2], [3, 2], [-3, 2]]\n"
      "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'fixed'\n";
  const FosResult r = found(rock);
  EXPECT_EQ(r.status, FosStatus::found);
  EXPECT_NEAR(r.factor.value_or(0.0), 0.7732, 1e-4);
  ASSERT_EQ(r.warnings.size(), 2u);
  EXPECT_NE(r.warnings[0].find("block 1"), std::string::npos) << r.warnings[0];
  EXPECT_NE(r.warnings[1].find("come loose before do not count"), std::string::npos);
}

/// With the same trials for any number of threads, even where more of them have been made.
TEST(Fos, StopsWhenAsked) {
  for (const int threads : {1, 2, 3, 4}) {
    std::atomic<bool> stop{false};
    FosOptions options;
    options.threads = threads;
    options.stop = &stop;
    int count = 0;
    options.say = [&](const std::string&) { stop = ++count >= 2; };
    const Result<FosResult> r = find_factor(model_of(ramp(rough, coarse)), options);
    ASSERT_TRUE(r.ok());
    EXPECT_EQ(r.value().status, FosStatus::interrupted);
    EXPECT_EQ(r.value().trials.size(), 2U) << threads;
    EXPECT_EQ(r.value().holds, 1.0);
  }
}

/// Also in the middle of trials.
TEST(Fos, StopsWithinATrial) {
  for (const int threads : {1, 3}) {
    std::atomic<bool> stop{false};
    FosOptions options;
    options.threads = threads;
    options.stop = &stop;
    std::jthread soon;
    options.say = [&](const std::string&) {
      if (soon.joinable()) return;
      soon = std::jthread([&] {
        std::this_thread::sleep_for(std::chrono::milliseconds(1));
        stop = true;
      });
    };
    const std::string endless = "[fos]\ntolerance = 1e-12\n";
    const Result<FosResult> r = find_factor(model_of(ramp(rough, endless)), options);
    ASSERT_TRUE(r.ok());
    EXPECT_EQ(r.value().status, FosStatus::interrupted);
    EXPECT_TRUE(r.value().message.starts_with("stopped; it holds at ")) << r.value().message;
  }
}

/// What the caller throws ends the search, with the trials that are being made.
TEST(Fos, EndsWhereTheCallerThrows) {
  for (const int threads : {1, 4}) {
    FosOptions options;
    options.threads = threads;
    int count = 0;
    options.say = [&](const std::string&) {
      if (++count == 3) throw std::runtime_error("enough");
    };
    EXPECT_THROW(find_factor(model_of(ramp(rough, coarse)), options), std::runtime_error);
    EXPECT_EQ(count, 3);
  }
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
