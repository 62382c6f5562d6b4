// What is written in another program's way, or under another name, gets one message with the key
// that there is for it.
#include <gtest/gtest.h>

#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda::key_hints_test {
namespace {

using testing::base_model;
using testing::base_with;

/// All faults of a model, a line each.
std::string faults(const std::string& text) {
  const Result<Model> model = read_model_text(text, "m.toml");
  std::string lines;
  if (model.ok()) return lines;
  for (const Fault& fault : model.faults()) lines += to_string(fault) + '\n';
  return lines;
}

TEST(KeyHints, DeviationsOfAJointSet) {
  const auto with = [](const std::string& text) {
    return faults(base_with("spacing = 2.0", text));
  };
  const std::string set = "joint_set.bedding.";
  EXPECT_EQ(with("spacing = { mean = 2.0, deviation = 0.8 }"),
            "m.toml:20:11: " + set +
                "spacing: is a table: expects a length above 0 such as 2.5 or \"2.5 m\"; its "
                "deviation stands beside it: deviation = { spacing = ... }\n");
  EXPECT_EQ(with("spacing = 2.0\nangle_deviation = 4"),
            "m.toml:21:1: " + set +
                "angle_deviation: unknown key: did you mean deviation = { angle = ... }?\n");
  EXPECT_EQ(with("spacing = 2.0\ndeviation_spacing = 0.8"),
            "m.toml:21:1: " + set +
                "deviation_spacing: unknown key: did you mean deviation = { spacing = ... }?\n");
  EXPECT_EQ(with("spacing = 2.0\ndeviation = 0.8"),
            "m.toml:21:13: " + set +
                "deviation: is 0.8: expects a table such as { angle = ... }, of \"angle\", "
                "\"spacing\", \"trace_length\", \"gap\", \"distribution\"\n");
}

TEST(KeyHints, AKeyThatIsMissing) {
  const auto below = [](const std::string& text) { return faults(base_model + text); };
  EXPECT_EQ(below("[[convergence]]\nname = \"across\"\npoints = [[11, 1], [12, 2]]\n"),
            "m.toml:44:1: convergence.across.points: unknown key: did you mean \"between\"?\n");
  EXPECT_EQ(below("[[monitor]]\nname = \"top\"\nlocation = [11, 1]\n"),
            "m.toml:44:1: monitor.top.location: unknown key: did you mean \"point\"?\n");
  EXPECT_EQ(below("[[monitor]]\nname = \"top\"\npiont = [11, 1]\n"),
            "m.toml:44:1: monitor.top.piont: unknown key: did you mean \"point\"?\n");
  // What stands there is no list of points, and says nothing of the key that is missing.
  EXPECT_EQ(below("[[convergence]]\nname = \"across\"\nfrom = [11, 1]\n"),
            "m.toml:42:1: convergence.across.between: is missing: give a list of points such as "
            "[[0, 0], [2, 1]]\nm.toml:44:1: convergence.across.from: unknown key: from belongs to "
            "[[bolt]]\n");
  // A key of the file as a whole belongs there, whatever it looks like.
  EXPECT_NE(below("[[monitor]]\nname = \"top\"\ngravity = [0, -9.81]\n").find("at the top of"),
            std::string::npos);
}

}  // namespace
}  // namespace edda::key_hints_test
