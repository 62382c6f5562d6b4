// What the damping of strain takes at the frequencies of a model.
#include "observe/damping_report.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <numbers>

#include "forces/viscosity.hpp"
#include "observe/summary.hpp"
#include "run/prepared.hpp"
#include "scratch_folder.hpp"

namespace edda::damping_report_test {
namespace {

using testing::prepared;

std::string two_squares(const std::string& more, const std::string& damping = "0.5") {
  return "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\ndamping = " + damping +
         R"(
[joints.j]
friction_angle = 30
[[block]]
name = "small"
polygon = [[0, 0], [1, 0], [1, 1], [0, 1]]
[[block]]
name = "large"
polygon = [[2, 0], [5, 0], [5, 3], [2, 3]]
[[block]]
fixed = true
polygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]
)" + more +
         "[solver]\nduration = 0.01\n";
}

TEST(DampingReport, AFractionInProportionToTheFrequency) {
  PreparedRun run = prepared(two_squares(
      "[[shaking]]\nname = \"quake\"\nacceleration = { amplitude = 1, frequency = 2.5 }\n"));
  const auto found = strain_damping_at(run.sim);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_EQ(found[0].of, "shaking quake");
  EXPECT_EQ(found[0].frequency, 2.5);
  EXPECT_EQ(found[0].block, 1u);  // the larger one
  const double own =
      lowest_frequency(run.sim.scene->blocks, run.sim.motion.masses, 1) / (2.0 * std::numbers::pi);
  EXPECT_NEAR(found[0].fraction, 0.5 * 2.5 / own, 1e-9);
  const std::string line = strain_damping_report(run.sim).at(0);
  EXPECT_NE(line.find("of critical at 2.5 Hz, the frequency of shaking quake (in block 1 (large)"),
            std::string::npos)
      << line;
  const Outcome outcome = run_model(run, {}).value();
  const std::string summary = summary_json(run.sim, outcome, {}, {});
  const std::size_t at = summary.find("\"strain_damping\"");
  ASSERT_NE(at, std::string::npos);
  EXPECT_NE(summary.find("\"of\": \"shaking quake\"", at), std::string::npos) << summary.substr(at);
}

TEST(DampingReport, RecordsAndLoadsThatSwingCount) {
  const ScratchFolder folder;
  const auto write = [&](const char* name, bool ground) {
    std::ofstream file(folder.path() / name);
    for (int k = 0; k <= 2000; ++k) {
      const double t = 0.005 * k, a = std::sin(2.0 * std::numbers::pi * 3.0 * t);
      file << t << ',' << a << (ground ? ",0\n" : "\n");
    }
    return "\"" + (folder.path() / name).string() + "\"";
  };
  const std::string record = write("quake.csv", true), swing = write("swing.csv", false);
  std::ofstream(folder.path() / "rise.csv") << "0,0\n1,0.5\n2,1\n";
  const std::string rise = "\"" + (folder.path() / "rise.csv").string() + "\"";
  PreparedRun run = prepared(two_squares(
      "[[shaking]]\nacceleration = " + record +
      "\n[[load]]\nname = \"machine\"\npoint = [0.5, 1]\nforce = [0, -1e3]\nhistory = " + swing +
      "\n[[load]]\nname = \"fill\"\npoint = [3, 3]\nforce = [0, -1e3]\nhistory = " + rise + "\n"));
  const auto found = strain_damping_at(run.sim);
  ASSERT_EQ(found.size(), 2u);
  EXPECT_EQ(found[0].of, "shaking 0");
  EXPECT_EQ(found[1].of, "load machine");
  for (const StrainDampingAt& at : found) EXPECT_NEAR(at.frequency, 3.0, 0.05);
}

TEST(DampingReport, MuchOfItIsWarnedOf) {
  const auto warned = [](const std::string& frequency) {
    PreparedRun run = prepared(two_squares(
        "[[shaking]]\nacceleration = { amplitude = 1, frequency = " + frequency + " }\n"));
    return std::any_of(run.warnings.begin(), run.warnings.end(), [](auto& w) {
      return w.find("is lost to their strain damping") != std::string::npos;
    });
  };
  EXPECT_FALSE(warned("3"));
  EXPECT_TRUE(warned("20"));
}

}  // namespace
}  // namespace edda::damping_report_test
