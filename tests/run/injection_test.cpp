// Where water is injected into joints, and what they take of it.
#include <algorithm>

#include "observe/summary.hpp"
#include "run/prepared.hpp"

namespace edda::injection_test {
namespace {

/// Ground of 16 squares of 2.5 m, open at its top, into which 1e-4 m2/s are injected.
std::string ground(const std::string& at, const std::string& stages,
                   const std::string& sides = "'left', 'right', 'bottom'",
                   const std::string& aperture = "3e-4") {
  return "[materials.rock]\ndensity = 2600\nyoung = 20e9\npoisson = 0.25\n"
         "[joints.wide]\nfriction_angle = 35\nkn = 20e9\naperture = 3e-4\n"
         "[joints.j]\nfriction_angle = 35\nkn = 20e9\naperture = " +
         aperture +
         "\n[contact]\njoint = 'j'\n[flow]\n"
         "[domain]\noutline = [[0, 0], [10, 0], [10, 10], [0, 10]]\nmaterial = 'rock'\n"
         "[[joint_set]]\nangle = 0\nspacing = 2.5\n[[joint_set]]\nangle = 90\nspacing = 2.5\n"
         "[[boundary]]\ntype = 'roller'\nsides = [" +
         sides + "]\n[[water]]\nname = 'bore'\ninjection = 1e-4\nat = " + at +
         "\n[[stage]]\nuntil = 'equilibrium'\n[[stage]]\nactivate = ['bore']\n" + stages;
}

struct Ran {
  PreparedRun run;
  Vec2 place;                 // of the injection at the end
  double comes, goes;         // m2/s at the end: of the injection, and from the open air
  std::vector<Check> failed;  // of injections
};
Ran ran(const std::string& toml) {
  Ran r{testing::prepared(toml), {}, 0.0, 0.0, {}};
  const Outcome outcome = run_model(r.run, RunOptions{}).value();
  const JointWater& water = r.run.sim.attached.joint_water;
  const BlockSet& b = r.run.sim.scene->blocks;
  if (const Id corner = water.injected.at(0); corner != no_id)
    r.place = b.vertex(corner) + b.origin;
  r.comes = water.inflow.at(0);
  r.goes = water.inflow.at(1);
  for (const Check& check : checks_of(r.run.sim, outcome)) {
    if (!check.pass && check.name.find("injection") != std::string::npos) r.failed.push_back(check);
  }
  return r;
}

const std::string steady = "until = 'equilibrium'\n",
                  timed = "ramp = { flow = [0, 2], steps = 2 }\n";

/// Near open ground it goes in at the nearest crossing inside the rock.
TEST(Injection, IsNotLostOnOpenGround) {
  for (const std::string& stage : {steady, timed}) {
    const Ran r = ran(ground("[5, 9.9]", stage));
    EXPECT_NEAR(norm(r.place - Vec2{5.0, 7.5}), 0.0, 1e-9) << stage;
    EXPECT_NEAR(r.comes, 1e-4, 1e-8) << stage;
    EXPECT_TRUE(r.failed.empty()) << stage;
  }
  EXPECT_NEAR(ran(ground("[5, 9.9]", steady)).goes, -1e-4, 1e-8);
}

/// Joints that have come to conduct by the time it acts count, and those that a stage takes away
/// do not.
TEST(Injection, GoesIntoTheJointsOfItsTime) {
  const Ran widened =
      ran(ground("[5, 5]", timed + "change = [{ joints = 'j', to = 'wide' }]\n", "'bottom'", "0"));
  EXPECT_NEAR(norm(widened.place - Vec2{5.0, 5.0}), 0.0, 1e-9);
  EXPECT_NEAR(widened.comes, 1e-4, 1e-8);
  EXPECT_TRUE(widened.failed.empty());
  const Ran excavated =
      ran(ground("[5.1, 7.5]", timed + "excavate = ['op']\n") +
          "[[opening]]\nname = 'op'\npolygon = [[2.5, 7.5], [5, 7.5], [5, 10], [2.5, 10]]\n");
  EXPECT_NEAR(norm(excavated.place - Vec2{7.5, 7.5}), 0.0, 1e-9);
  EXPECT_NEAR(excavated.comes, 1e-4, 1e-8);
  EXPECT_TRUE(excavated.failed.empty());
}

/// What no joint takes fails a check.
TEST(Injection, ThatPutsNothingInFailsACheck) {
  const std::string closed = "'left', 'right', 'bottom', 'top'";
  const Ran steadily = ran(ground("[5, 5]", steady, closed));
  EXPECT_EQ(steadily.comes, 0.0);
  ASSERT_EQ(steadily.failed.size(), 1u);
  EXPECT_NE(
      message_of(steadily.failed[0], steadily.run.sim, {}).find("the water can leave nowhere"),
      std::string::npos);
  const Ran in_time = ran(ground("[5, 5]", timed, closed));
  EXPECT_NEAR(in_time.comes, 1e-4, 1e-8);
  EXPECT_TRUE(in_time.failed.empty());
  EXPECT_EQ(ran(ground("[5, 5]", timed, closed, "0")).failed.size(), 1u);
}

/// A point far from all joints is warned of, with the place where the water goes in.
TEST(Injection, FarFromItsPointIsWarnedOf) {
  const auto warned = [](const std::string& at) {
    const PreparedRun run = testing::prepared(ground(at, steady));
    return std::count_if(run.warnings.begin(), run.warnings.end(), [](const std::string& w) {
      return w.find("m from there, at (10, 7.5)") != std::string::npos;
    });
  };
  EXPECT_EQ(warned("[500, 500]"), 1);
  EXPECT_EQ(warned("[8.5, 8.5]"), 0);
}

}  // namespace
}  // namespace edda::injection_test
