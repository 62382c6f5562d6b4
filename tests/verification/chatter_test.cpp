// Contacts that open and close without end are reported; those of ordinary runs are not.
#include "observe/chatter.hpp"

#include <gtest/gtest.h>

#include "run/prepared.hpp"
#include "verification/scene.hpp"

namespace edda::chatter_test {
namespace {

/// Blocks of width x height on a slope of 20 degrees, stable with friction of 30 degrees.
std::string slope(double width, double height, int count, const std::string& material,
                  const std::string& more = "") {
  const auto box = [](double u0, double v0, double u1, double v1) {
    return "[" + on_slope(20.0, u0, v0) + "," + on_slope(20.0, u1, v0) + "," +
           on_slope(20.0, u1, v1) + "," + on_slope(20.0, u0, v1) + "]";
  };
  std::string text =
      "[materials.rock]\ndensity = 2700\nyoung = 20e9\npoisson = 0.25\n" + material +
      "[joints.j]\nfriction_angle = 30\n[[block]]\nfixed = true\nmaterial = 'rock'\npolygon = " +
      box(-60.0, -2.0, 60.0, 0.0) + "\n";
  for (int i = 0; i < count; ++i) {
    text +=
        "[[block]]\nmaterial = 'rock'\npolygon = " + box(i * width, 0.0, (i + 1) * width, height) +
        "\n";
  }
  return text + "[solver]\nduration = 1\n" + more;
}

std::string chatter_of(const std::string& text) {
  const Outcome o = testing::ran(text).outcome;
  for (const std::string& check : o.failed_checks) {
    if (check.find("contacts are chattering") != std::string::npos) return check;
  }
  return {};
}

TEST(Chatter, IsReportedWithItsRemedy) {
  for (const auto& [width, height, count] :
       {std::tuple{2.0, 1.0, 1}, {3.0, 3.0, 1}, {1.0, 1.0, 4}}) {
    const std::string said =
        chatter_of(slope(width, height, count, "damping = 0\ndeformation = 'uniform'\n"));
    for (const char* part :
         {"openings and closings, limit ", "mostly between block", "materials.NAME.damping"}) {
      EXPECT_NE(said.find(part), std::string::npos) << width << " x " << height << ": " << said;
    }
  }
}

/// Whatever other blocks have.
TEST(Chatter, TheRemedyIsOneOfTheBlocksThatChatter) {
  const std::string said = chatter_of(
      slope(2.0, 1.0, 1, "damping = 0\ndeformation = 'uniform'\n") +
      "[materials.damped]\ndensity = 2700\nyoung = 20e9\npoisson = 0.25\n"
      "[[block]]\nmaterial = 'damped'\npolygon = [[99, 0], [101, 0], [101, 1], [99, 1]]\n"
      "[[block]]\nmaterial = 'damped'\nfixed = true\npolygon = [[90, -1], [110, -1], [110, 0], "
      "[90, "
      "0]]\n");
  EXPECT_NE(said.find("materials.NAME.damping"), std::string::npos) << said;
}

TEST(Chatter, OrdinaryRunsHaveNone) {
  for (const auto& [width, height, count] :
       {std::tuple{2.0, 1.0, 1}, {3.0, 3.0, 1}, {1.0, 1.0, 4}}) {
    EXPECT_EQ(chatter_of(slope(width, height, count, "")), "") << width << " x " << height;
  }
  // Dropped, with damping and without: it strikes and bounces.
  for (const char* damping : {"", "damping = 0\n"}) {
    std::string text = slope(1.0, 1.0, 0, damping);
    text.insert(text.find("[solver]"),
                "[[block]]\nmaterial = 'rock'\npolygon = [[0, 1], [1, 1.1], [1.1, 2.2], [0, 2]]\n");
    EXPECT_EQ(chatter_of(text), "") << damping;
  }
}

/// Where joints cross, corners of blocks coincide: rounding opens and closes nothing there.
TEST(Chatter, GroundAtRestOpensAndClosesNothing) {
  for (const auto& [first, second] : {std::pair{30, 110}, {20, 110}, {55, 80}}) {
    for (const char* k0 : {"0.5", "1.5"}) {
      std::string text =
          "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.25\n[joints.j]\n"
          "friction_angle = 35\n[domain]\noutline = [[0, 0], [20, 0], [20, 15], [0, 15]]\n"
          "[[boundary]]\nsides = ['left', 'right', 'bottom']\ntype = 'roller'\n[initial_stress]\n"
          "surface = 'outline'\nk0 = " +
          std::string(k0) + "\n[solver]\nduration = 0.02\n";
      for (const int angle : {first, second}) {
        text += "[[joint_set]]\njoint = 'j'\nspacing = 3\nangle = " + std::to_string(angle) + "\n";
      }
      const Simulation& sim = testing::ran(text).ready.sim;
      EXPECT_GT(sim.motion.state.steps, 1000U);
      // Corners drawn in contact settle by up to a millionth of what the stress closes.
      EXPECT_LT(sim.accounts.open_close.switched, 2 * sim.scene->blocks.size())
          << first << ", " << second << ", k0 " << k0;
    }
  }
}

}  // namespace
}  // namespace edda::chatter_test
