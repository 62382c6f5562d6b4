// The driver: rows, frames, velocities, revolutions, limits, stopping.
#include "run/run_model.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <atomic>
#include <chrono>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <sstream>

#include "model/read_model.hpp"
#include "results/files.hpp"
#include "scratch_folder.hpp"

namespace edda::run_model_test {
namespace {

namespace fs = std::filesystem;

constexpr const char* falling = R"(
gravity = [0.0, -10.0]
[materials.rock]
density = 2000.0
young = 1e8
poisson = 0.25
[joints.j]
friction_angle = 30.0
[[block]]
name = "flyer"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
velocity = [3.0, 0.0]
angular_velocity = 7.0
[[monitor]]
name = "M"
point = [0.5, 0.5]
[solver]
duration = 3.0
[output]
every = 1.5
history_every = 0.3
)";

Result<PreparedRun> prepared(const std::string& toml, const std::vector<std::string>& sets = {}) {
  Result<Model> model = read_model_text(toml, "m.toml", sets);
  if (!model.ok()) return model.faults();
  return prepare_run(std::move(model.value()));
}

std::vector<std::vector<std::string>> table(const std::string& path) {
  std::ifstream in(path);
  std::vector<std::vector<std::string>> rows;
  for (std::string line; std::getline(in, line);) {
    std::stringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

TEST(RunModel, RowsAtEveryMultipleWithVelocitiesOfTheirTime) {
  const ScratchFolder scratch;
  const std::string folder = scratch.at("out");
  Result<PreparedRun> run = prepared(falling);
  ASSERT_TRUE(run.ok());
  const Result<Outcome> outcome = run_model(run.value(), {.folder = folder, .progress = {}});
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().status, Status::completed);
  const auto rows = table(folder + "/history.csv");
  ASSERT_EQ(rows.size(), 12u);
  EXPECT_EQ(rows[0][1], "M.ux");
  EXPECT_EQ(rows[4][0], "0.9");
  for (std::size_t r = 1; r < rows.size(); ++r) {
    const double t = std::stod(rows[r][0]);
    // Free flight: v_n is exact at t, not half a step before.
    EXPECT_NEAR(std::stod(rows[r][3]), 3.0, 1e-9);
    EXPECT_NEAR(std::stod(rows[r][4]), -10.0 * t, 1e-9) << t;
    EXPECT_NEAR(std::stod(rows[r][1]), 3.0 * t, 1e-9);
  }
  const auto blocks = table(folder + "/blocks.csv");
  ASSERT_EQ(blocks.size(), 2u);
  // 21 rad are more than three revolutions; the rotation causes a little centrifugal strain.
  EXPECT_NEAR(std::stod(blocks[1][8]), 21.0, 0.02);
  EXPECT_NEAR(std::stod(blocks[1][11]), 7.0, 0.01);
  int frames = 0;
  for (const auto& entry : fs::directory_iterator(folder + "/frames")) {
    frames += entry.path().filename().string().starts_with("blocks_");
  }
  EXPECT_EQ(frames, 3);
}

TEST(RunModel, StopFlagEndsItWithEverythingWritten) {
  const ScratchFolder scratch;
  const std::string folder = scratch.at("out");
  Result<PreparedRun> run = prepared(falling);
  ASSERT_TRUE(run.ok());
  std::atomic<bool> stop{false};
  RunOptions options{.folder = folder, .progress = {}, .progress_every = 0.0, .stop = &stop};
  options.progress = [&](const Progress& p) {
    if (p.time > 1.0) stop = true;
  };
  const Result<Outcome> outcome = run_model(run.value(), options);
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().status, Status::interrupted);
  EXPECT_GT(outcome.value().time, 1.0);
  EXPECT_LT(outcome.value().time, 1.2);
  for (const char* file :
       {"summary.json", "blocks.csv", "joints.csv", "history.csv", "blocks.pvd"}) {
    EXPECT_TRUE(fs::exists(folder + "/" + file)) << file;
  }
  const auto rows = table(folder + "/history.csv");
  EXPECT_EQ(std::stod(rows.back()[0]), outcome.value().time);
}

TEST(RunModel, GivenStepAboveTheBoundIsRefusedWithTheBound) {
  const Result<PreparedRun> run = prepared(falling, {"solver.time_step=0.1"});
  ASSERT_FALSE(run.ok());
  ASSERT_EQ(run.faults().size(), 1u);
  EXPECT_EQ(run.faults()[0].where.key, "solver.time_step");
  EXPECT_NE(run.faults()[0].problem.find("critical step"), std::string::npos);
  EXPECT_TRUE(prepared(falling, {"solver.time_step=0.1", "solver.allow_unstable=true"}).ok());
}

TEST(RunModel, UnstableStepFailsWithBlockPlaceTimeAndCause) {
  const ScratchFolder scratch;
  const std::string folder = scratch.at("out");
  const Result<PreparedRun> stable = prepared(falling);
  ASSERT_TRUE(stable.ok());
  const std::string step = fmt::format("{}", 30.0 * stable.value().sim.control.bound.critical_step);
  Result<PreparedRun> run = prepared(
      falling, {"solver.time_step=" + step, "solver.allow_unstable=true", "gravity=[0.0, 0.0]",
                "solver.max_displacement_ratio=1.0", "block.flyer.angular_velocity=0.1"});
  ASSERT_TRUE(run.ok());
  const Result<Outcome> outcome = run_model(run.value(), {.folder = folder, .progress = {}});
  ASSERT_TRUE(outcome.ok());
  EXPECT_EQ(outcome.value().status, Status::failed);
  const std::string& message = outcome.value().message;
  EXPECT_NE(message.find("block 0 (flyer)"), std::string::npos) << message;
  EXPECT_NE(message.find("t = "), std::string::npos) << message;
  EXPECT_NE(message.find("above the critical step"), std::string::npos) << message;
  EXPECT_TRUE(fs::exists(folder + "/summary.json"));
  EXPECT_GE(table(folder + "/history.csv").size(), 2u);
}

TEST(RunModel, MonitorsOutsideEveryBlockAreFaults) {
  const Result<PreparedRun> run = prepared(falling, {"monitor.M.point=[5.0, 5.0]"});
  ASSERT_FALSE(run.ok());
  EXPECT_NE(run.faults()[0].where.key.find("monitor"), std::string::npos);
}

TEST(RunModel, MonitorsOnASharedEdgeBelongToTheLowestId) {
  const std::string second = R"(
[[block]]
name = "second"
polygon = [[1, 0], [2, 0], [2, 1], [1, 1]]
)";
  const auto block_of = [&](const char* point) {
    Result<PreparedRun> run = prepared(falling + second, {std::string("monitor.M.point=") + point});
    EXPECT_TRUE(run.ok());
    return run.value().gauges.monitors.at(0).block;
  };
  EXPECT_EQ(block_of("[1.0, 0.5]"), 0u);
  EXPECT_EQ(block_of("[1.1, 0.5]"), 1u);
  EXPECT_EQ(block_of("[2.0000000005, 0.5]"), 1u);  // outside, within snap
}

TEST(RunModel, WarnsOfWhatLooksRightAndIsNot) {
  const std::string on_floor = std::string(falling) + R"(
[[block]]
name = "floor"
fixed = true
polygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]
)";
  auto warned = [&](const std::vector<std::string>& sets, const char* word) {
    Result<PreparedRun> run = prepared(on_floor, sets);
    EXPECT_TRUE(run.ok());
    for (const std::string& w : run.value().warnings) {
      if (w.find(word) != std::string::npos) return true;
    }
    return false;
  };
  const std::string still = "block.flyer.velocity=[0, 0]", rests = "block.flyer.angular_velocity=0";
  EXPECT_TRUE(warned({still, rests}, "gravity acts at once"));
  EXPECT_FALSE(warned({}, "gravity acts at once")) << "it is meant to move";
  EXPECT_FALSE(warned({still, rests, "solver.damping.local=0.8"}, "gravity acts at once"));
  EXPECT_FALSE(warned({}, "springs so"));
  EXPECT_TRUE(warned({"contact.normal_stiffness=1e6"}, "so soft"));
  // A stiffness that the joint gives is used as it is.
  EXPECT_FALSE(warned({"joints.j.kn=1e5"}, "so soft"));
  EXPECT_TRUE(warned({"contact.normal_stiffness=1e12"}, "so stiff"));
  EXPECT_FALSE(warned({}, "less than a hundredth of"));
  EXPECT_FALSE(warned({"solver.time_step=1e-5"}, "less than a hundredth of"));
  EXPECT_TRUE(warned({"solver.time_step=1e-7"}, "1e-07 s is less than a hundredth of the"));
  EXPECT_FALSE(warned({}, "overlap at the start"));
  EXPECT_TRUE(warned({"block.flyer.polygon=[[0, -5e-4], [1, -5e-4], [1, 1], [0, 1]]"},
                     "draw the blocks so that they touch, or cut both from one [domain] with a "
                     "[[trace]], or begin with a [[stage]] until = \"equilibrium\""));
}

TEST(RunModel, TwoInOneProcessDoNotMeet) {
  Result<PreparedRun> a = prepared(falling), b = prepared(falling);
  ASSERT_TRUE(a.ok() && b.ok());
  const Result<Outcome> first = run_model(a.value(), {}), second = run_model(b.value(), {});
  EXPECT_EQ(a.value().sim.motion.state.position.x, b.value().sim.motion.state.position.x);
  EXPECT_EQ(first.value().steps, second.value().steps);
}

/// A slab with a short edge at one corner, dropped on a floor.
std::string dropped(const std::string& solver) {
  return "[materials.rock]\ndensity = 2000\nyoung = 1e8\npoisson = 0.2\n[joints.j]\n"
         "friction_angle = 30\n[contact]\nnormal_stiffness = 2e7\n"
         "[[block]]\nname = \"floor\"\nfixed = true\n"
         "polygon = [[-2, -1], [3, -1], [3, 0], [-2, 0]]\n"
         "[[block]]\nname = \"slab\"\nvelocity = [0, -2]\n"
         "polygon = [[0, 0.1], [0.999, 0.1], [1, 0.101], [1, 0.5], [0, 0.5]]\n[solver]\n" +
         solver;
}

TEST(RunModel, OverlapsAreMeasuredByTheBlocksThatOverlap) {
  Result<PreparedRun> run = prepared(dropped("duration = 0.3\ndamping = { contact = 0.3 }\n"));
  ASSERT_TRUE(run.ok());
  const Outcome o = run_model(run.value(), {}).value();
  EXPECT_NEAR(run.value().sim.scene->blocks.inradius[1], 0.2, 1e-9);
  EXPECT_DOUBLE_EQ(o.overlap.ratio, o.overlap.depth / run.value().sim.scene->blocks.inradius[1]);
  EXPECT_LE(o.overlap.depth, run.value().sim.accounts.max_penetration * (1 + 1e-9));
  EXPECT_GT(o.overlap.depth, 0.9 * run.value().sim.accounts.max_penetration);
  EXPECT_GT(o.overlap.depth, 1e-3) << "deeper than the shortest edge is long";
  EXPECT_EQ(std::minmax(o.overlap.block_i, o.overlap.block_j), std::minmax(Id{0}, Id{1}));
  EXPECT_NEAR(o.overlap.place.y, -o.overlap.depth, 1e-3);
  EXPECT_NEAR(o.overlap.time, 0.05, 0.03);
  EXPECT_LT(o.overlap_now, 0.3 * o.overlap.ratio);
  for (const std::string& check : o.failed_checks)
    EXPECT_EQ(check.find("overlap"), check.npos) << check;
}

TEST(RunModel, DeepPenetrationsAreReportedWithPlaceAndTime) {
  Result<PreparedRun> run = prepared(dropped("duration = 0.3\n"), {"contact.normal_stiffness=1e6"});
  ASSERT_TRUE(run.ok());
  const Outcome o = run_model(run.value(), {}).value();
  ASSERT_FALSE(o.failed_checks.empty());
  EXPECT_EQ(o.failed_checks[0].substr(0, 46), "largest overlap over half width of a block is ");
  EXPECT_NE(o.failed_checks[0].find("m between block "), std::string::npos) << o.failed_checks[0];
  EXPECT_NE(o.failed_checks[0].find("(slab)"), std::string::npos);
  EXPECT_NE(o.failed_checks[0].find(", t = 0."), std::string::npos);
}

TEST(RunModel, TheEndReportsWhetherAllIsInEquilibrium) {
  const auto message = [](const std::string& solver) {
    Result<PreparedRun> run = prepared(dropped(solver));
    EXPECT_TRUE(run.ok());
    return run_model(run.value(), {}).value().message;
  };
  EXPECT_EQ(message("duration = 1.5\ndamping = { contact = 0.3, local = 0.5 }\n"),
            "the run has reached its duration, in equilibrium");
  EXPECT_EQ(message("duration = 0.02\n").substr(0, 83),
            "the run has reached its duration, still moving: fastest is block 1 (slab), at 2.2 m");
}

TEST(RunModel, ARateIsThatOfTheStepsMadeSinceTheRunWasTakenUp) {
  const ScratchFolder scratch;
  const std::string folder = scratch.at("out");
  Result<PreparedRun> first = prepared(falling, {"solver.time_step=2e-5"});
  ASSERT_TRUE(first.ok());
  std::atomic<bool> stop{false};
  RunOptions options{.folder = folder, .progress = {}};
  options.stop = &stop;
  options.after_step = [&] {
    if (first.value().sim.motion.state.steps >= 100000) stop = true;
    return false;
  };
  ASSERT_EQ(run_model(first.value(), options).value().status, Status::interrupted);
  Result<PreparedRun> second = prepared(falling, {"solver.time_step=2e-5"});
  ASSERT_TRUE(second.ok());
  std::vector<Progress> reported;
  RunOptions again{.folder = folder, .progress = [&](const Progress& p) { reported.push_back(p); }};
  again.resume = true;
  again.progress_every = 0.0;
  const auto start = std::chrono::steady_clock::now();
  ASSERT_EQ(run_model(second.value(), again).value().status, Status::completed);
  const double wall =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  ASSERT_GT(reported.size(), 1000u);
  ASSERT_GE(reported.front().steps, 100000u);
  const double mean = static_cast<double>(reported.back().steps - reported.front().steps) / wall;
  EXPECT_LT(reported.front().rate, 100.0 * mean) << "the 100,000 steps before were not made now";
}

TEST(RunModel, AnEquilibriumReportsItsTimeAndWhatStillFalls) {
  const std::string stages =
      "[[stage]]\nname = \"settle\"\nuntil = \"equilibrium\"\n[[stage]]\nname = \"wait\"\n"
      "until = \"equilibrium\"\n";
  const auto model = [&](const std::string& more) {
    std::string text = dropped("");
    text.replace(text.find("[0, -2]"), 7, "[0, 0]");
    return text.substr(0, text.rfind("[solver]")) + more + stages;
  };
  const auto message = [](const std::string& text) {
    Result<PreparedRun> run = prepared(text);
    EXPECT_TRUE(run.ok());
    return run_model(run.value(), {}).value().message;
  };
  const std::string rest = message(model(""));
  EXPECT_EQ(rest.substr(0, 31), "the model is in equilibrium at ");
  EXPECT_NE(rest.find(" s after the start of stage 2 (wait)"), std::string::npos) << rest;
  const std::string loose =
      message(model("[[block]]\nname = \"loose\"\npolygon = [[9, 0], [9.5, 0], [9, 0.5]]\n"));
  EXPECT_NE(
      loose.find(
          "(wait), except for 1 block (0.125 m2) that has come loose: block 2 (loose) (moved "),
      std::string::npos)
      << loose;
}

TEST(RunModel, ProgressCountsFromWhereStagesBeforeHaveEnded) {
  std::string text = dropped("");
  text = text.substr(0, text.rfind("[solver]")) +
         "[[stage]]\nuntil = \"equilibrium\"\nduration = 100\n[[stage]]\nduration = 0.05\n";
  Result<PreparedRun> run = prepared(text);
  ASSERT_TRUE(run.ok());
  std::vector<Progress> reported;
  RunOptions options{.folder = {}, .progress = [&](const Progress& p) { reported.push_back(p); }};
  options.progress_every = 0.0;
  ASSERT_EQ(run_model(run.value(), options).value().status, Status::completed);
  const auto second =
      std::find_if(reported.begin(), reported.end(), [](auto& p) { return p.stage == 1; });
  ASSERT_NE(second, reported.end());
  const double start = second->time;
  EXPECT_LT(start, 10.0);
  EXPECT_NEAR(second->fraction, start / (start + 0.05), 0.05);
  EXPECT_LT(second->seconds_left, 100.0);
  for (std::size_t k = 1; k < reported.size(); ++k)
    EXPECT_GE(reported[k].fraction, reported[k - 1].fraction);
}

/// A flake of 15 kg that falls 15 m, tip first, on springs as stiff as those of large blocks.
TEST(RunModel, AFlakeThatCannotBeSteppedDoesNotEndTheRun) {
  Result<PreparedRun> run = prepared(
      "[materials.rock]\ndensity = 2600\nyoung = '40 GPa'\npoisson = 0.18\n[joints.bed]\n"
      "friction_angle = 41\nkn = '20 GPa/m'\n[[block]]\nfixed = true\n"
      "polygon = [[-5, -2], [5, -2], [5, 0], [-5, 0]]\n[[block]]\nname = 'flake'\n"
      "polygon = [[0, 15.0], [0, 15.830559], [0.01406, 15.831789]]\n[solver]\nduration = 2.0\n");
  ASSERT_TRUE(run.ok());
  const Outcome o = run_model(run.value(), {}).value();
  EXPECT_EQ(o.status, Status::completed) << o.message;
  EXPECT_NEAR(o.time, 2.0, 1e-4);
  const std::vector<SetAside>& aside = run.value().sim.accounts.set_aside;
  ASSERT_EQ(aside.size(), 1U);
  EXPECT_EQ(aside[0].block, 1U);
  EXPECT_NEAR(aside[0].time, std::sqrt(2.0 * 15.0 / 9.81), 0.01);
  EXPECT_TRUE(std::any_of(o.failed_checks.begin(), o.failed_checks.end(), [](const auto& check) {
    return check.find("blocks that were set aside is 1, more than 0: block 1 (flake)") <
           check.size();
  }));
}

}  // namespace
}  // namespace edda::run_model_test
