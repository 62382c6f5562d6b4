// Blocks that rest on nothing are told, those that are meant to fall or to fly are not.
#include "observe/resting.hpp"

#include <algorithm>

#include "run/prepared.hpp"

namespace edda::resting_test {
namespace {

using testing::prepared;
using testing::ran;

const std::string head =
    "[materials.rock]\ndensity = 2600\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
    "friction_angle = 30\n[solver]\nduration = 0.05\ndamping = { local = 0.5 }\n";

std::string block(double x, double y, const std::string& keys = {}) {
  const auto corner = [](double a, double b) {
    return "[" + std::to_string(a) + ", " + std::to_string(b) + "]";
  };
  return "[[block]]\npolygon = [" + corner(x, y) + ", " + corner(x + 1, y) + ", " +
         corner(x + 1, y + 1) + ", " + corner(x, y + 1) + "]\n" + keys;
}

std::vector<std::string> said_of(const std::string& text) {
  const PreparedRun run = prepared(text);
  std::vector<std::string> said;
  for (const std::string& w : run.warnings) {
    if (w.find("fall freely") != std::string::npos || w.find("unsupported") != std::string::npos)
      said.push_back(w);
  }
  EXPECT_EQ(said.empty(), run.on_nothing == 0);
  return said;
}

TEST(Resting, AllBlocksWhereNothingIsHeld) {
  const std::string wall = head + "[[brick_wall]]\ncolumns = 6\nrows = 6\nbrick = [1.0, 0.5]\n";
  const auto said = said_of(wall);
  ASSERT_EQ(said.size(), 1u);
  EXPECT_EQ(said[0].substr(0, 80),
            "no block is fixed and no boundary supports any: all 39 blocks will fall freely; ");
  EXPECT_TRUE(said_of(wall + "[[boundary]]\nsides = [\"bottom\"]\n").empty());
  EXPECT_EQ(
      said_of(wall + "[[boundary]]\nsides = [\"left\", \"right\"]\ntype = \"roller\"\n").size(), 1u)
      << "rollers hold across themselves alone";
  EXPECT_TRUE(said_of("gravity = [0, 0]\n" + wall).empty());
}

TEST(Resting, GroupsThatTouchNothingHeld) {
  const std::string floor = head + block(0, 0, "fixed = true\n");
  EXPECT_TRUE(said_of(floor + block(0, 1) + block(0.3, 5)).empty()) << "it falls onto the others";
  const auto beside = said_of(floor + block(5, 1) + block(5, 2) + block(9, 0, "name = \"x\"\n"));
  ASSERT_EQ(beside.size(), 2u);
  EXPECT_EQ(
      beside[0].substr(0, 87),
      "2 blocks that touch each other, block 1 at (5.5, 1.5) among them, are unsupported, and ");
  EXPECT_EQ(beside[1].substr(0, 45), "block 3 (x) at (9.5, 0.5) is unsupported, and");
  EXPECT_TRUE(said_of(floor + block(5, 1, "velocity = [-3, 0]\n")).empty()) << "it is thrown";
  EXPECT_TRUE(said_of(floor + block(1, 0)).empty()) << "it may stick to its neighbour";
  EXPECT_EQ(said_of(floor + block(0.2, -3)).size(), 1u) << "held above, not below";
  EXPECT_TRUE(
      said_of(head + "[[load]]\npoint = [0.5, 0.9]\nforce = [0, 3e4]\n" + block(0, 0)).empty());
}

/// Dashpots carry no static load, unless they have taken one over from an initial stress.
TEST(Resting, NothingRestsOnDashpotsAlone) {
  const auto sinks = [](const std::string& more, const std::string& first = {}) {
    const PreparedRun run = prepared(
        first +
        "[materials.rock]\ndensity = 2600\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
        "friction_angle = 30\n[domain]\noutline = [[0, 0], [10, 0], [10, 10], [0, 10]]\n"
        "[[joint_set]]\nangle = 0\nspacing = 2.5\norigin = [0, 1]\n[[boundary]]\nname = 'base'\n"
        "sides = ['bottom']\ntype = 'viscous'\n" +
        more);
    const bool said =
        std::any_of(run.warnings.begin(), run.warnings.end(), [](const std::string& warning) {
          return warning.find("on a viscous boundary alone") != std::string::npos;
        });
    EXPECT_EQ(said, run.on_nothing > 0);
    return said;
  };
  const std::string run = "[solver]\nduration = 1\n",
                    roller = "[[boundary]]\nsides = ['left', 'right']\ntype = 'roller'\n",
                    stress = "[initial_stress]\nk0 = 0.5\nsurface_y = 10\n";
  EXPECT_TRUE(sinks(run));
  EXPECT_TRUE(sinks(roller + run));
  EXPECT_FALSE(sinks(run, "gravity = [0, 0]\n")) << "a wave alone needs no support";
  EXPECT_FALSE(sinks(roller + stress + run));
  EXPECT_FALSE(sinks("[[boundary]]\nsides = ['left']\ntype = 'fixed'\n" + run));
  EXPECT_FALSE(
      sinks("[[boundary]]\nname = 'held'\nsides = ['bottom']\ntype = 'fixed'\n"
            "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nduration = 1\n"
            "activate = ['base']\ndeactivate = ['held']\n"));
}

/// A boundary that is taken away leaves the weight to dashpots, unless they begin where it ends.
TEST(Resting, DashpotsTakeOverOnlyWhereTheyReplaceASupport) {
  const auto told = [](const std::string& activate, const std::string& deactivate) {
    const PreparedRun run = prepared(
        "[materials.rock]\ndensity = 2600\nyoung = 1e9\npoisson = 0.2\n[joints.j]\n"
        "friction_angle = 30\n[domain]\noutline = [[0, 0], [10, 0], [10, 10], [0, 10]]\n"
        "[[joint_set]]\nangle = 0\nspacing = 2.5\norigin = [0, 1]\n[[boundary]]\nname = 'base'\n"
        "sides = ['bottom']\ntype = 'viscous'\n[[boundary]]\nname = 'held'\nsides = ['bottom']\n"
        "[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nduration = 1\nactivate = [" +
        activate + "]\ndeactivate = [" + deactivate + "]\n");
    EXPECT_EQ(run.on_nothing, 0u);
    return std::any_of(run.warnings.begin(), run.warnings.end(), [](const std::string& warning) {
      return warning.starts_with("in stage 2 nothing but a viscous boundary");
    });
  };
  EXPECT_TRUE(told("", "'held'"));
  EXPECT_FALSE(told("'base'", "'held'"));
  EXPECT_FALSE(told("'base'", ""));
}

TEST(Resting, IsACheckThatDoesNotPass) {
  const auto failed = [](const testing::Ran& r) {
    return std::count_if(
        r.outcome.failed_checks.begin(), r.outcome.failed_checks.end(), [](const std::string& s) {
          return s.starts_with("number of blocks that rest on nothing at the start is 1");
        });
  };
  EXPECT_EQ(failed(ran(head + block(0, 0))), 1);
  EXPECT_EQ(failed(ran(head + block(0, 0, "velocity = [1, 0]\n"))), 0);
}

TEST(BorderPoints, AreToldAndGoWithTheBlockThatMoves) {
  const auto with = [](Vec2 p) {
    return prepared(head + block(0, 0, "fixed = true\nname = \"floor\"\n") +
                    block(0, 1, "name = \"slider\"\n") + block(1, 1) +
                    "[[monitor]]\nname = \"M\"\npoint = [" + std::to_string(p.x) + ", " +
                    std::to_string(p.y) + "]\n");
  };
  const auto said = [](const PreparedRun& run) {
    std::vector<std::string> found;
    for (const std::string& w : run.warnings) {
      if (w.find("boundary between") != std::string::npos) found.push_back(w);
    }
    return found;
  };
  const PreparedRun bed = with({0.5, 1.0});
  EXPECT_EQ(bed.gauges.monitors[0].block, 1u);
  ASSERT_EQ(said(bed).size(), 1u);
  EXPECT_EQ(said(bed)[0],
            "monitor M at (0.5, 1) lies on the boundary between blocks: it moves with block 1 "
            "(slider), not with block 0 (floor); move it into the block that is meant");
  const PreparedRun between = with({1.0, 1.5});
  EXPECT_EQ(between.gauges.monitors[0].block, 1u);
  EXPECT_EQ(said(between).size(), 1u);
  EXPECT_TRUE(said(with({0.5, 1.5})).empty());
}

}  // namespace
}  // namespace edda::resting_test
