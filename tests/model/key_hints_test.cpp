// Keys written as in another program, or under another name, give one message with the key to use
// instead.
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
                "spacing: is a table: give spacing = 2, a length above 0 such as 2.5 or \"2.5 m\", "
                "and its deviation as deviation = { spacing = ... }\n");
  EXPECT_NE(
      with("spacing = { mean = 3 }\ndeviation = { spacing = 1 }")
          .find("is a table: give spacing = 3, a length above 0 such as 2.5 or \"2.5 m\", and "
                "its deviation as deviation = { spacing = ... }\n"),
      std::string::npos);
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
            "m.toml:44:1: convergence.across.points: unknown key: here that is between of "
            "[[convergence]]\n");
  EXPECT_EQ(below("[[monitor]]\nname = \"top\"\nlocation = [11, 1]\n"),
            "m.toml:44:1: monitor.top.location: unknown key: did you mean \"point\"?\n");
  EXPECT_EQ(below("[[monitor]]\nname = \"top\"\npiont = [11, 1]\n"),
            "m.toml:44:1: monitor.top.piont: unknown key: did you mean \"point\"?\n");
  // The value is no list of points, and does not explain the missing key.
  EXPECT_EQ(below("[[convergence]]\nname = \"across\"\nfrom = [11, 1]\n"),
            "m.toml:42:1: convergence.across.between: is missing: give a list of points such as "
            "[[0, 0], [2, 1]]\nm.toml:44:1: convergence.across.from: unknown key: from belongs to "
            "[[bolt]]\n");
  // A key of another table belongs there, and the missing key is reported as missing.
  const std::string monitor = "[[monitor]]\nname = \"top\"\n";
  EXPECT_EQ(below(monitor + "force = [0, -1000]\nvelocity = [0, -1]\n"),
            "m.toml:42:1: monitor.top.point: is missing: give a point such as [1.0, 2.5]\n"
            "m.toml:44:1: monitor.top.force: unknown key: force belongs to [[load]]\n"
            "m.toml:45:1: monitor.top.velocity: unknown key: velocity belongs to [[block]] or "
            "[[boundary]]\n");
  // One unknown key is taken for one missing key.
  EXPECT_EQ(below(monitor + "location = [11, 1]\nplace = [12, 1]\n"),
            "m.toml:44:1: monitor.top.location: unknown key: did you mean \"point\"?\n"
            "m.toml:45:1: monitor.top.place: unknown key: known are \"name\", \"point\"\n");
  // A key of the file as a whole belongs there, whatever key it resembles.
  EXPECT_NE(below("[[monitor]]\nname = \"top\"\ngravity = [0, -9.81]\n").find("at the top of"),
            std::string::npos);
}

/// The message on the last line of a text.
std::string message_on(const std::string& text) {
  const std::string all = faults(text);
  const std::size_t at = all.rfind("unknown key: ");
  return at == std::string::npos ? all : all.substr(at + 13, all.find('\n', at) - at - 13);
}

TEST(KeyHints, WordsForAKeyOfTheTable) {
  const auto below = [](const std::string& text) { return message_on(base_model + text); };
  const auto of_set = [](const std::string& text) {
    return message_on(base_with("spacing = 2.0", "spacing = 2.0\n" + text));
  };
  EXPECT_EQ(below("[[block]]\nheld = true\n"), "here that is fixed of [[block]]");
  EXPECT_EQ(below("[[load]]\nat = [11, 1]\n"), "here that is point of [[load]]");
  const std::string bolt = faults(
      base_model + "[[bolt]]\ntype = \"end\"\ndiameter = 0.02\nhead = [0, 0]\ntoe = [2, 0]\n");
  EXPECT_NE(bolt.find("bolt.0.head: unknown key: here that is from of [[bolt]]"),
            std::string::npos);
  EXPECT_NE(bolt.find("bolt.0.toe: unknown key: here that is to of [[bolt]]"), std::string::npos);
  EXPECT_EQ(bolt.find("is missing"), std::string::npos) << bolt;
  EXPECT_EQ(of_set("deviation = { dip = 3 }"), "here that is deviation.angle of [[joint_set]]");
  EXPECT_EQ(below("[[trace]]\npoints = [[0, 0], [1, 1]]\ndip = 3\n"),
            "dip belongs to [[joint_set]]");
  EXPECT_EQ(of_set("spacing_std = 1"), "did you mean deviation = { spacing = ... }?");
  EXPECT_EQ(of_set("length_deviation = 1"), "did you mean deviation = { trace_length = ... }?");
  EXPECT_EQ(below("[fos]\ndisplacement = 0.1\n"), "did you mean fails = { displacement = ... }?");
  EXPECT_EQ(below("[[bolt]]\nstiffness = 3\n"),
            "did you mean bond = { stiffness = ... } or dowel = { stiffness = ... }?");
}

}  // namespace
}  // namespace edda::key_hints_test
