// --set key=value.
#include <gtest/gtest.h>

#include <string>
#include <vector>

#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda::overrides_test {
namespace {

using testing::base_model;
using testing::base_with;

Model read(const std::vector<std::string>& overrides, const std::string& text = base_model) {
  const Result<Model> result = read_model_text(text, "m.toml", overrides);
  if (!result) {
    for (const Fault& fault : result.faults()) ADD_FAILURE() << to_string(fault);
    return read_model_text(base_model, "m.toml").value();
  }
  return result.value();
}

std::vector<std::string> faults(const std::vector<std::string>& overrides) {
  const Result<Model> result = read_model_text(base_model, "m.toml", overrides);
  std::vector<std::string> lines;
  if (result.ok()) return lines;
  for (const Fault& fault : result.faults()) lines.push_back(to_string(fault));
  return lines;
}

TEST(Override, Values) {
  EXPECT_EQ(read({"solver.duration=0.2"}).solver.duration, 0.2);
  EXPECT_EQ(read({"solver.duration = 200 ms"}).solver.duration, 0.2) << "no TOML: a string";
  EXPECT_EQ(read({"solver.duration=\"200 ms\""}).solver.duration, 0.2);
  EXPECT_EQ(read({"solver.duration=1", "solver.duration=2"}).solver.duration, 2.0);
  EXPECT_EQ(read({"title=a = b"}).title, "a = b");
  EXPECT_EQ(read({"title="}).title, "");
  EXPECT_EQ(read({"title=1\nthickness = 2"}).title, "1\nthickness = 2") << "one value, not two";
  EXPECT_EQ(read({"gravity=[0, -5]"}).gravity, (Vec2{0, -5}));
  EXPECT_EQ(read({"solver.mass=covering"}).solver.mass, MassKind::covering);
}

TEST(Override, Elements) {
  EXPECT_FALSE(read({"block.floor.fixed=false"}).blocks[0].fixed);
  EXPECT_TRUE(read({"block.1.fixed=true"}).blocks[1].fixed);
  EXPECT_EQ(read({"block.0.polygon=[[0, 0], [9, 0], [0, 9]]"}).blocks[0].polygon.size(), 3U);
  EXPECT_EQ(read({"trace.0.points=[[12, 1], [13, 1], [13, 4]]"}).traces[0].points.size(), 3U);
  EXPECT_EQ(read({"joint_set.bedding.spacing=4"}).joint_sets[0].spacing, 4.0);
  EXPECT_EQ(read({"joints.rough.friction_angle=20"}).joints[0].peak.friction_angle, 20.0);
  EXPECT_TRUE(read({"monitor=[]"}).monitors.empty());
  EXPECT_EQ(read({"block.1.name=top", "block.top.fixed=true"}).blocks[1].name, "top");
  EXPECT_EQ(read({"block.\"a.b\".fixed=true"}, base_with("\"floor\"", "\"a.b\"")).blocks.size(),
            2U);
}

TEST(Override, MakesWhatIsMissing) {
  EXPECT_EQ(read({"solver.safety=0.5"}).solver.safety, 0.5);
  EXPECT_EQ(read({"solver.damping.contact=0.1"}).solver.damping.contact, 0.1);
  EXPECT_EQ(read({"contact.normal_stiffness=5"}).contact.normal_stiffness, 5.0);
  EXPECT_EQ(read({"joints.rough.residual.cohesion=3"}).joints[0].residual.cohesion, 3.0);
  EXPECT_EQ(
      read({"solver.duration=3"}, base_with("[solver]\nduration = 0.1\n", "")).solver.duration,
      3.0);
  const Model m = read({"joints.new={friction_angle=1}", "contact.joint=new"});
  ASSERT_EQ(m.joints.size(), 2U);
  EXPECT_EQ(m.joints[1].name, "new");
  EXPECT_EQ(m.contact.joint, 1);
}

TEST(Override, Faults) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(
      faults({"solver.safety=0.5", "solver.safety=2"}),
      Lines{"--set:2:1: solver.safety: 2 is out of range: expects a number above 0 and at most 1"});
  EXPECT_EQ(faults({"solver.safty=1"}),
            Lines{"--set:1:1: solver.safty: unknown key: did you mean \"safety\"?"});
  EXPECT_EQ(
      faults({"solver.duration=soon"}),
      Lines{"--set:1:1: solver.duration: \"soon\" is not a time: expects a time above 0 such as "
            "0.1 or \"100 ms\""});
  EXPECT_EQ(faults({"block.2.fixed=true"}),
            Lines{"--set:1:1: block: no element is called \"2\": known are \"1\", \"floor\""});
  EXPECT_EQ(faults({"block.flor.fixed=true"}),
            Lines{"--set:1:1: block: no element is called \"flor\": did you mean \"floor\"?"});
  EXPECT_EQ(
      faults({"block.0.polygon.2=[0, 0]"}),
      Lines{"--set:1:1: block.0.polygon: a list is replaced whole: set block.0.polygon to a list"});
  EXPECT_EQ(faults({"title.x=1"}),
            Lines{"--set:1:1: title: is \"base\" and has no keys: set title itself"});
  EXPECT_EQ(faults({"duration"}),
            Lines{"--set:1:1: \"duration\" has no \"=\": write key=value, such as "
                  "solver.duration=0.2"});
  EXPECT_EQ(faults({"=1", "a..b=1", ".=1", "\"a=1"}).size(), 4U);
  EXPECT_EQ(
      faults({"block.0.polygon=[[0, 0], [1, 1], [1, nan]]"}),
      Lines{"--set:1:1: block.floor.polygon[2][1]: is not a finite number: expects a length such "
            "as 2.5 or \"2.5 m\""});
  std::string deep = "a";
  for (int i = 0; i < 1000; ++i) deep += ".a";
  EXPECT_EQ(faults({deep + "=1"}).size(), 1U);
}

TEST(Override, OfANameThatTheModelHasNot) {
  using Lines = std::vector<std::string>;
  EXPECT_EQ(
      faults({"joints.rock.friction_angle=5"}),
      Lines{"--set:1:1: joints.rock: the model has no [joints.rock]: it has \"rough\"; a whole "
            "table, joints.rock = { ... }, adds one"});
  EXPECT_EQ(faults({"joints.b={friction_angle=5}", "contact.joint=b", "joints.roufh.cohesion=5"}),
            Lines{"--set:3:1: joints.roufh: the model has no [joints.roufh]: it has \"rough\", "
                  "\"b\"; a whole table, joints.roufh = { ... }, adds one"});
  EXPECT_EQ(faults({"materials.new.young=1"}),
            Lines{"--set:1:1: materials.new: the model has no [materials.new]: it has \"rock\"; a "
                  "whole table, materials.new = { ... }, adds one"});
  const std::string single =
      "[materials.rock]\ndensity = 2700\nyoung = 1e9\npoisson = 0.2\n[[block]]\n"
      "polygon = [[0, 0], [1, 0], [1, 1]]\n[solver]\nduration = 1\n";
  const auto none = read_model_text(single, "m.toml", {"joints.rock.friction_angle=5"});
  ASSERT_FALSE(none.ok());
  ASSERT_EQ(none.faults().size(), 1U);
  EXPECT_EQ(none.faults()[0].remedy,
            "it has no [joints.NAME] at all; a whole table, joints.rock = { ... }, adds one");
}

TEST(Override, FaultsComeAfterThoseOfTheFile) {
  const auto result =
      read_model_text(base_with("young = 20e9", "young = 0"), "m.toml", {"title=1", "thickness=0"});
  ASSERT_FALSE(result.ok());
  ASSERT_EQ(result.faults().size(), 3U);
  EXPECT_EQ(result.faults()[0].where.line, 5);
  EXPECT_EQ(result.faults()[1].where.file, "--set");
  EXPECT_EQ(result.faults()[2].where.line, 2);
}

TEST(Override, OfAListThatTheModelHasNot) {
  const auto result = read_model_text(base_with("[[trace]]\npoints = [[11, 1], [12, 5]]\n", ""),
                                      "m.toml", {"trace.0.points=[[0, 0], [1, 1]]"});
  ASSERT_FALSE(result.ok());
  ASSERT_EQ(result.faults().size(), 1U);
  EXPECT_EQ(result.faults()[0].problem, "the model has no [[trace]]");
}

}  // namespace
}  // namespace edda::overrides_test
