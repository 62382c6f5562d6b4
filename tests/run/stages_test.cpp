// Stages: equilibrium found and not found, displacements reset, falling blocks not waited for.
#include "run/stages.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <utility>

#include "run/prepared.hpp"

namespace edda::stages_test {
namespace {

using testing::prepared;

Outcome run(PreparedRun& ready) {
  const Result<Outcome> outcome = run_model(ready, RunOptions{});
  EXPECT_TRUE(outcome.ok());
  return outcome.value();
}

/// Two squares on a floor, one on the other, and one beside them that falls without end.
std::string tower(const std::string& more, double slope = 0.0, double phi = 30.0) {
  auto number = [](double v) { return std::to_string(v); };
  return R"(
[materials.rock]
density = 2500.0
young = 2e9
poisson = 0.0
[joints.j]
friction_angle = )" +
         number(phi) + R"(
[[block]]
name = "lower"
polygon = [[0, 0], [1, )" +
         number(slope) + "], [1, " + number(slope + 1) + R"(], [0, 1]]
[[block]]
name = "upper"
polygon = [[0, 1], [1, )" +
         number(slope + 1) + "], [1, " + number(slope + 2) + R"(], [0, 2]]
[[block]]
name = "falling"
polygon = [[30, 0], [31, 0], [31, 1], [30, 1]]
[[block]]
name = "floor"
fixed = true
polygon = [[-9, )" +
         number(-9 * slope) + "], [9, " + number(9 * slope) + R"(], [9, -9], [-9, -9]]
[[monitor]]
name = "top"
point = [0.5, )" +
         number(2.0 + 0.5 * slope) + "]\n" + more;
}

/// The settlement is that of statics: half of each block's own weight and the load on it, with E,
/// and two springs at each joint; the block that falls is not waited for.
TEST(Stages, EquilibriumIsThatOfStatics) {
  for (const auto& [method, ratio] : {std::pair{"edda", 1e-7}, std::pair{"dda", 1e-5}}) {
    PreparedRun ready =
        prepared(tower("[[stage]]\nuntil = 'equilibrium'\nratio = " +
                       std::string(method == std::string("edda") ? "1e-7" : "1e-5") +
                       "\n[solver]\nmethod = '" + method + "'\n"));
    const Outcome o = run(ready);
    EXPECT_EQ(o.status, Status::equilibrium) << method << o.message;
    EXPECT_LT(o.time, 5.0);
    const Balance b = balance_of(ready.sim);
    EXPECT_LE(b.mean, ratio);
    EXPECT_EQ(b.resting, 2u);
    EXPECT_EQ(b.detached, 1u);
    const double weight = 2500.0 * 9.81, young = 2e9, spring = 2e10;
    const double settlement =
        weight / (2.0 * spring) * 3.0 + weight / young * (0.5 + 1.0) + 0.5 * weight / young;
    const MonitorPoint& m = ready.gauges.monitors[0];
    EXPECT_NEAR(displacement_of(ready.sim.scene->blocks, ready.sim.motion.state, m).y / -settlement,
                1.0, 1e-3)
        << method;
  }
}

TEST(Stages, ProgressAndEndsAreReported) {
  PreparedRun ready =
      prepared(tower("[[stage]]\nname = 'settle'\nuntil = 'equilibrium'\n[[stage]]\nname = "
                     "'wait'\nduration = 0.01\n[solver]\n"));
  std::vector<StageReport> ends;
  std::vector<Progress> reported;
  RunOptions options;
  options.progress_every = 0.0;
  options.progress = [&](const Progress& p) { reported.push_back(p); };
  options.stage_ended = [&](const StageReport& s) { ends.push_back(s); };
  const Outcome o = run_model(ready, options).value();
  ASSERT_EQ(ends.size(), 2u);
  EXPECT_EQ(ends[0].name, "settle");
  EXPECT_LE(ends[0].ratio, 1e-5);
  EXPECT_EQ(ends[1].stage, 1u);
  EXPECT_EQ(ends[1].start, ends[0].end);
  EXPECT_NEAR(ends[1].end - ends[1].start, 0.01, 1e-12);
  EXPECT_EQ(ends[0].steps + ends[1].steps, o.steps);
  const Progress& last = reported.back();
  EXPECT_EQ(last.stage_name, "wait");
  EXPECT_EQ(last.stages, 2u);
  EXPECT_EQ(last.fraction, 1.0);
  EXPECT_EQ(reported.front().stage_name, "settle");
}

TEST(Stages, ProgressHasTheFastestBlock) {
  PreparedRun ready = prepared(tower("[solver]\nduration = 0.1\n"));
  Progress last;
  RunOptions options;
  options.progress = [&](const Progress& p) { last = p; };
  const Outcome o = run_model(ready, options).value();
  EXPECT_NEAR(last.largest_velocity, 9.81 * o.time, 0.01);  // that which falls beside the tower
  EXPECT_EQ(last.stages, 1u);
  EXPECT_TRUE(last.stage_name.empty());
}

/// A slider on a ground that is pushed for 0.2 s and then keeps its velocity, or no longer acts.
testing::Ran pushed(const std::string& apply, const std::string& acceleration,
                    const std::string& then) {
  return testing::ran(
      "[materials.rock]\ndensity = 2500\nyoung = 2e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 5\n[[block]]\nname = 'floor'\nfixed = true\n"
      "polygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]\n[[block]]\nname = 'slider'\n"
      "polygon = [[-1, 0], [1, 0], [1, 1], [-1, 1]]\n[[shaking]]\nname = 'push'\napply = '" +
      apply + "'\nacceleration = " + acceleration +
      "\n[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nduration = 0.21\nactivate = ['push']\n" +
      then + "[[stage]]\nuntil = 'equilibrium'\n");
}

/// What stands on a ground that keeps its velocity comes to rest on it, and one that stops being
/// moved jolts nothing: as in a frame that had the same motion.
TEST(Stages, EquilibriumIsOnTheGroundThatStillMoves) {
  const std::string record =
      "'" + std::string(EDDA_SOURCE_DIR) + "/tests/verification/short_push.csv'\nscale = 3";
  const std::string sine = "{ amplitude = 2.0, frequency = 2.5 }";
  for (const auto& [acceleration, then] :
       {std::pair{record, std::string()},
        {sine, std::string("[[stage]]\nduration = 0.01\ndeactivate = ['push']\n")}}) {
    double slid[2];
    std::size_t n = 0;
    for (const std::string apply : {"inertia", "base"}) {
      const testing::Ran r = pushed(apply, acceleration, then);
      EXPECT_EQ(r.outcome.status, Status::equilibrium) << apply << ": " << r.outcome.message;
      EXPECT_LT(norm(r.ready.sim.attached.ground.velocity), 1e-15) << apply;
      slid[n++] = r.moved("slider").x - r.moved("floor").x;
    }
    EXPECT_GT(std::abs(slid[0]), 0.005);
    EXPECT_NEAR(slid[1], slid[0], 2e-4 * std::abs(slid[0]));
  }
}

/// Where no equilibrium is found in time the run says so and names the blocks that move: neither
/// that it stands nor that it has collapsed.
TEST(Stages, TimeThatRunsOutIsNoVerdict) {
  PreparedRun ready = prepared(tower(
      "[[stage]]\nname = 'settle'\nuntil = 'equilibrium'\nduration = 0.3\n[solver]\n", 0.5, 10.0));
  const Outcome o = run(ready);
  EXPECT_EQ(o.status, Status::completed);
  EXPECT_EQ(o.unsettled, 1u);
  EXPECT_NEAR(o.time, 0.3, 1e-12);
  for (const char* part :
       {"stage 1 (settle)", "is not in equilibrium after 0.3 s", "upper", "1 fall freely"}) {
    EXPECT_NE(o.message.find(part), std::string::npos) << o.message << " lacks " << part;
  }
}

/// Nor does it end the run.
TEST(Stages, TimeThatRunsOutIsFollowedByTheNextStage) {
  PreparedRun ready = prepared(
      tower("[[stage]]\nname = 'settle'\nuntil = 'equilibrium'\nduration = 0.3\n[[stage]]\n"
            "duration = 0.01\n[solver]\n",
            0.5, 10.0));
  std::string warnings;
  RunOptions options;
  options.warn = [&](const std::string& warning) { warnings += warning + "\n"; };
  const Outcome o = run_model(ready, options).value();
  EXPECT_EQ(o.status, Status::completed) << o.message;
  EXPECT_NEAR(o.time, 0.31, 1e-12);
  EXPECT_EQ(o.unsettled, 1U);
  EXPECT_NE(warnings.find("is not in equilibrium after 0.3 s"), std::string::npos) << warnings;
  EXPECT_NE(warnings.find("; the run goes on\n"), std::string::npos) << warnings;
}

/// Where all blocks slide or fall away the stage does not wait.
TEST(Stages, AllThatGoesAwayIsACollapse) {
  PreparedRun ready = prepared(tower(
      "[[stage]]\nname = 'settle'\nuntil = 'equilibrium'\nduration = 1000\n[solver]\n", 0.5, 10.0));
  const Outcome o = run(ready);
  EXPECT_EQ(o.status, Status::collapsed);
  EXPECT_LT(o.time, 10.0);
  EXPECT_NE(
      o.message.find("stage 1 (settle) does not reach equilibrium: each block slides or falls"),
      std::string::npos)
      << o.message;
}

/// Columns of different heights rock to and fro as they settle, some for longer than others; none
/// has come loose (their factor of safety is 1.04).
TEST(Stages, WhatSettlesLateIsNotLoose) {
  std::string toml =
      "[materials.rock]\ndensity = 2500\nyoung = 20e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 28.673\n";
  const double c = std::cos(0.405137), s = std::sin(0.405137);
  const auto column = [&](double u, double width, double low, double high) {
    std::string ring;
    for (const auto& [x, y] : {std::pair{u, low}, {u + width, low}, {u + width, high}, {u, high}}) {
      ring += (ring.empty() ? "[" : ", [") + std::to_string(x * c - y * s) + ", " +
              std::to_string(x * s + y * c) + "]";
    }
    return "[[block]]\npolygon = [" + ring + "]\n";
  };
  toml += column(-8.0, 21.0, -3.0, 0.0) + "fixed = true\n";
  double u = 0.0;
  for (const double height :
       {1.021653, 1.875697, 3.114687, 1.935312, 3.295573, 1.585322, 2.271103}) {
    toml += column(u, 1.0, 0.0, height);
    u += 1.0;
  }
  const testing::Ran r = testing::ran(toml + "[[stage]]\nuntil = 'equilibrium'\n");
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_EQ(r.outcome.loose, 0U) << r.outcome.message;
}

/// What has fallen before the stage begins has not come loose in it.
TEST(Stages, WhatFellBeforeIsNotLoose) {
  PreparedRun ready = prepared(
      "[materials.rock]\ndensity = 2600\nyoung = 1e9\npoisson = 0.25\n[joints.j]\nfriction_angle = "
      "30\n[[block]]\nfixed = true\npolygon = [[-9, -1], [9, -1], [9, 0], [-9, 0]]\n[[block]]\n"
      "polygon = [[0, 3], [1, 3], [1, 4], [0, 4]]\n[[stage]]\nduration = 0.72\n[[stage]]\nuntil = "
      "'equilibrium'\n");
  const Outcome o = run(ready);
  EXPECT_EQ(o.status, Status::equilibrium) << o.message;
  EXPECT_EQ(o.loose, 0U);
}

/// A block whose friction is four hundredths too low, beside a wall that determines the frequency:
/// it creeps under the damping at that frequency, and is not in equilibrium.
TEST(Stages, WhatCreepsBesideAWallIsLoose) {
  const auto ends = [](double friction) {
    PreparedRun ready = prepared(
        "[materials.rock]\ndensity = 2600\nyoung = 2e10\npoisson = 0.25\n[joints.j]\n"
        "friction_angle = " +
        std::to_string(friction) +
        "\n[joints.dry]\nfriction_angle = 40\n[contact]\njoint = 'dry'\n[[block]]\nfixed = true\n"
        "polygon = [[-5, -1], [60, -1], [60, 0], [-5, 0]]\n[[brick_wall]]\ncolumns = 6\nrows = 8\n"
        "brick = [2, 1]\n[[block]]\nfixed = true\njoint = 'j'\npolygon = [[40.5, 9.133974596], "
        "[49.160254038, 14.133974596], [48.660254038, 15], [40, 10]]\n[[block]]\nname = 'slider'\n"
        "joint = 'j'\npolygon = [[44.330127019, 12.5], [45.196152423, 13], [44.696152423, "
        "13.866025404], [43.830127019, 13.366025404]]\n[[stage]]\nuntil = 'equilibrium'\n");
    return run(ready);
  };
  const Outcome creeps = ends(29.0);
  EXPECT_NE(creeps.message.find("come loose: block"), std::string::npos) << creeps.message;
  EXPECT_NE(creeps.message.find("(slider)"), std::string::npos) << creeps.message;
  const auto loose_check = [](const Outcome& o) {
    const auto found =
        std::find_if(o.failed_checks.begin(), o.failed_checks.end(),
                     [](const std::string& s) { return s.find("loose") < s.size(); });
    return found == o.failed_checks.end() ? std::string() : *found;
  };
  EXPECT_EQ(loose_check(creeps),
            "number of blocks that have come loose is 1, more than 0: the given strength is not "
            "enough to hold them; edda fos finds the factor of safety");
  const Outcome stands = ends(31.0);
  EXPECT_EQ(loose_check(stands), "");
  EXPECT_EQ(stands.status, Status::equilibrium);
  EXPECT_EQ(stands.message.find("loose"), std::string::npos) << stands.message;
}

/// Two blocks on a slope, which cohesion holds in equilibrium, but not what gravity does to them
/// where it acts at once.
TEST(Stages, GravityAtOnceBreaksWhatWouldHold) {
  const auto check = [](const std::string& more) {
    PreparedRun ready = prepared(
        "gravity = [4.905, -8.496]\n[materials.rock]\ndensity = 2500\nyoung = 1e10\npoisson = "
        "0.25\n"
        "[joints.j]\nfriction_angle = 5\ncohesion = 12000\n[[block]]\nfixed = true\n"
        "polygon = [[-10, -1], [20, -1], [20, 0], [-10, 0]]\n"
        "[[block]]\npolygon = [[0, 0], [2, 0], [2, 1], [0, 1]]\n"
        "[[block]]\npolygon = [[2, 0], [4, 0], [4, 1], [2, 1]]\n" +
        more);
    const Outcome o = run(ready);
    return std::count_if(o.failed_checks.begin(), o.failed_checks.end(), [](const auto& s) {
      return s.find("joints that broke where gravity acted at once") < s.size();
    });
  };
  EXPECT_EQ(check("[solver]\nduration = 0.3\n"), 1);
  EXPECT_EQ(check("[[stage]]\nuntil = 'equilibrium'\n"), 0);
}

/// Blocks that have come loose are left out, or end the run.
TEST(Stages, LooseBlocksMayEndTheRun) {
  const auto ends = [](const std::string& otherwise) {
    PreparedRun ready =
        prepared(tower("[[stage]]\nname = 'settle'\nuntil = 'equilibrium'\n" + otherwise +
                       "[[stage]]\nname = 'wait'\nduration = 0.01\n[solver]\n"));
    return run(ready);
  };
  EXPECT_EQ(ends("").status, Status::completed);
  EXPECT_EQ(ends("otherwise = 'go on'\n").status, Status::completed);
  const Outcome stopped = ends("otherwise = 'stop'\n");
  EXPECT_EQ(stopped.status, Status::collapsed);
  EXPECT_LT(stopped.time, 2.0);
  for (const char* part : {"the model is in equilibrium after ",
                           "except for 1 block (1 m2) that has come loose: block ", "(falling)",
                           "\"stop\" of stage 1 (settle) ends the run here"}) {
    EXPECT_NE(stopped.message.find(part), std::string::npos) << stopped.message;
  }
}

/// Local damping also reduces the acceleration of gravity, and a run in which blocks fall reports
/// so.
TEST(Stages, LocalDampingOfAFallIsReported) {
  const auto failed = [](const std::string& damping) {
    PreparedRun ready = prepared(tower("[solver]\nduration = 0.2\n" + damping));
    const Outcome o = run(ready);
    std::string all;
    for (const std::string& check : o.failed_checks) all += check + "\n";
    return all;
  };
  const char* const reported = "number of blocks that fell freely under local damping is 1, more";
  EXPECT_NE(failed("damping = { local = 0.5 }\n").find(reported), std::string::npos);
  EXPECT_EQ(failed("damping = { contact = 0.1 }\n").find(reported), std::string::npos);
}

/// Displacements count from the stage that resets them; damping is that of the stage.
TEST(Stages, ResetAndDampingApplyToTheirStage) {
  PreparedRun ready =
      prepared(tower("[[stage]]\nuntil = 'equilibrium'\nratio = 1e-7\n[[stage]]\nduration = "
                     "0.05\nreset_displacements = true\n[solver]\ndamping = { contact = 0.05 }\n"));
  const Outcome o = run(ready);
  EXPECT_EQ(o.status, Status::completed);
  const MonitorPoint& m = ready.gauges.monitors[0];
  EXPECT_LT(norm(displacement_of(ready.sim.scene->blocks, ready.sim.motion.state, m)), 1e-9);
  EXPECT_EQ(ready.sim.motion.damping.local, 0.0);
  EXPECT_EQ(ready.sim.motion.damping.contact, 0.05);
}

/// A stage by time is the same run as without stages, to the bit.
TEST(Stages, OneByTimeChangesNothing) {
  PreparedRun a = prepared(tower("[solver]\nduration = 0.05\n"));
  PreparedRun b = prepared(tower("[[stage]]\nduration = 0.05\n[solver]\n"));
  run(a);
  run(b);
  EXPECT_EQ(a.sim.motion.state.position.x, b.sim.motion.state.position.x);
  EXPECT_EQ(a.sim.motion.state.velocity.y, b.sim.motion.state.velocity.y);
}

}  // namespace
}  // namespace edda::stages_test
