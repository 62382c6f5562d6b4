// What the damping of strain takes at the frequencies of a model.
#include "observe/damping_report.hpp"

#include <fmt/format.h>
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

/// Rayleigh damping goes by its own name and key, that of the stage in which the ground moves, and
/// what is not in force is not spoken of.
TEST(DampingReport, NamesTheDampingThatActs) {
  const std::string quake =
      "[[shaking]]\nname = 'q'\nacceleration = { amplitude = 1, frequency = 20 }\n";
  const auto warning = [&](const std::string& damping, const std::string& stage) {
    std::string model = two_squares(
        quake + "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nactivate = ['q']\nduration = 1\n" +
            stage,
        damping);
    model.erase(model.find("[solver]"));
    for (const std::string& w : prepared(model).warnings) {
      if (w.find("is lost to the") != std::string::npos) return w;
    }
    return std::string();
  };
  const auto has = [](const std::string& text, const char* words) {
    return text.find(words) != std::string::npos;
  };
  const std::string own = warning("0.5\nrayleigh = { fraction = 0.3, frequency = 4 }", "");
  EXPECT_TRUE(has(own, "is lost to the stiffness-proportional part of Rayleigh damping")) << own;
  EXPECT_TRUE(has(own, "give materials.rock.rayleigh a lower fraction")) << own;
  EXPECT_FALSE(has(own, "multiply the damping")) << own;
  const std::string of_stage =
      warning("0.5", "damping = { rayleigh = { fraction = 0.3, frequency = 4 } }\n");
  EXPECT_TRUE(has(of_stage, "give stage.1.damping.rayleigh a lower fraction")) << of_stage;
  const std::string strain = warning("0.5", "");
  EXPECT_TRUE(has(strain, "is lost to their strain damping")) << strain;
  EXPECT_TRUE(has(strain, "multiply the damping of the materials")) << strain;
  // 0.3 of critical at 4 Hz, of which the part is half, grows with the frequency.
  const std::string fraction = fmt::format("up to {:.2g} of critical", 0.5 * 0.3 * 20.0 / 4.0);
  EXPECT_TRUE(has(own, fraction.c_str())) << own;
}

}  // namespace
}  // namespace edda::damping_report_test
