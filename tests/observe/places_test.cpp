// Faults that only the cut blocks show stand at the line of their key; loads say what they act on.
#include <gtest/gtest.h>

#include <algorithm>

#include "model/read_model.hpp"
#include "observe/load_report.hpp"
#include "run/run_model.hpp"

namespace edda::places_test {
namespace {

// 17 lines.
const std::string square = R"(title = "square"
[materials.rock]
density = 2700.0
young = 20e9
poisson = 0.25
[joints.rough]
friction_angle = 30.0
[domain]
outline = [[0, 0], [20, 0], [20, 20], [0, 20]]
[[joint_set]]
angle = 0
spacing = 5
origin = [0, 2.5]
[[fixed]]
point = [1, 1]
[solver]
duration = 0.1
)";

Fault fault_of(const std::string& more, const std::vector<std::string>& sets = {}) {
  Result<Model> model = read_model_text(square + more, "m.toml", sets);
  EXPECT_TRUE(model.ok()) << (model.ok() ? "" : to_string(model.faults()[0]));
  if (!model.ok()) return model.faults()[0];
  const Result<PreparedRun> run = prepare_run(std::move(model.value()));
  EXPECT_FALSE(run.ok());
  return run.ok() ? Fault{} : run.faults()[0];
}

void expect_place(const Fault& fault, const std::string& key, int line, int column) {
  EXPECT_EQ(fault.where.key, key) << to_string(fault);
  EXPECT_EQ(fault.where.line, line) << to_string(fault);
  EXPECT_EQ(fault.where.column, column) << to_string(fault);
}

TEST(Places, AreThoseOfTheKeys) {
  expect_place(fault_of("[[monitor]]\nname = \"crown\"\npoint = [50, 50]\n"), "monitor.crown.point",
               20, 9);
  expect_place(fault_of("[[load]]\nforce = [1, 0]\npoint = [50, 50]\n"), "load.0.point", 20, 9);
  expect_place(fault_of("[[fixed]]\npoint = [50, 50]\n"), "fixed.1.point", 19, 9);
  expect_place(fault_of("[[convergence]]\nname = \"c\"\nbetween = [[1, 1], [50, 50]]\n"),
               "convergence.c.between[1]", 20, 11);
  expect_place(
      fault_of("[[region]]\nmaterial = \"rock\"\npolygon = [[50, 50], [51, 50], [51, 51]]\n"),
      "region.0.polygon", 20, 11);
  expect_place(fault_of("[[bolt]]\nname = \"b\"\ndiameter = 0.025\nfrom = [50, 50]\nto = [51, 50]\n"
                        "bond = { stiffness = 1e9, strength = 1e5 }\n"),
               "bolt.b.from", 21, 8);
  expect_place(
      fault_of("[[bolt]]\nname = \"name\"\ndiameter = 0.025\nfrom = [50, 50]\nto = [51, 50]\n"
               "bond = { stiffness = 1e9, strength = 1e5 }\n"),
      "bolt.name.from", 21, 8);
}

TEST(Places, OfAnOpeningByShapeNameTheShape) {
  expect_place(fault_of("[[opening]]\nname = \"o\"\n"
                        "shape = { kind = \"circle\", at = [50, 50], width = 4 }\n"),
               "opening.o.shape", 20, 9);
}

TEST(Places, OfOverridesAreTheirs) {
  const Fault fault = fault_of("[[monitor]]\nname = \"crown\"\npoint = [5, 5]\n",
                               {"solver.duration=1", "monitor.crown.point=[50, 50]"});
  EXPECT_EQ(fault.where.file, "--set");
  EXPECT_EQ(fault.where.line, 2);
}

TEST(Warnings, OfIdleJointsAndSlipsOfUnitsReachTheRun) {
  Result<Model> model = read_model_text(square + "[[trace]]\npoints = [[30, 30], [40, 40]]\n",
                                        "m.toml", {"materials.rock.young=20"});
  ASSERT_TRUE(model.ok());
  const Result<PreparedRun> run = prepare_run(std::move(model.value()));
  ASSERT_TRUE(run.ok());
  const auto said = [&](const std::string& begin) {
    const auto& warnings = run.value().warnings;
    return std::count_if(warnings.begin(), warnings.end(),
                         [&](const std::string& w) { return w.starts_with(begin); });
  };
  EXPECT_EQ(said("trace.0 cuts nothing"), 1);
  EXPECT_EQ(said("materials.rock.young: 20 Pa"), 1);
}

std::string first_load_of(const std::string& more) {
  Result<Model> model = read_model_text(square + more, "m.toml");
  EXPECT_TRUE(model.ok());
  const Result<PreparedRun> run = prepare_run(std::move(model.value()));
  EXPECT_TRUE(run.ok());
  return run.ok() ? load_report(run.value().sim).at(0) : "";
}

TEST(LoadReport, SaysTheWetLength) {
  // The lowest block is held. Above it the table at 10 wets 2 x 7.5 m of the sides, 20 m of the
  // joint at 2.5 and both faces, 40 m, of that at 7.5.
  const std::string line = first_load_of("[[water]]\ntable = [[0, 10], [20, 10]]\n");
  EXPECT_NE(line.find("over 75 m of faces, 0 of 0 openings full"), std::string::npos) << line;
  // At the level of a joint its faces are dry.
  const std::string at_joint = first_load_of("[[water]]\ntable = [[0, 12.5], [20, 12.5]]\n");
  EXPECT_NE(at_joint.find("over 80 m of faces"), std::string::npos) << at_joint;
}

TEST(LoadReport, CountsInTheSingular) {
  const std::string line =
      first_load_of("[[bolt]]\ntype = \"end\"\ndiameter = 0.025\nfrom = [5, 16]\nto = [5, 19]\n");
  EXPECT_EQ(line, "1 bolt of 2 nodes crosses 1 joint");
}

}  // namespace
}  // namespace edda::places_test
