// Bad loads, waters and stages, with exactly the fault each must give.
#include <gtest/gtest.h>

#include "model/base_model.hpp"
#include "model/read_model.hpp"

namespace edda {
namespace {

struct Bad {
  std::string text;  ///< after the base model, from its line 42 on
  int line;
  std::string key, fragment;
};

void expect_fault(const Bad& bad) {
  const Result<Model> result = read_model_text(testing::base_model + bad.text, "m.toml", {});
  ASSERT_FALSE(result.ok()) << bad.text;
  ASSERT_EQ(result.faults().size(), 1U) << bad.text << to_string(result.faults()[1]);
  const Fault& f = result.faults()[0];
  EXPECT_EQ(f.where.line, bad.line) << to_string(f);
  EXPECT_EQ(f.where.key, bad.key) << to_string(f);
  EXPECT_NE(to_string(f).find(bad.fragment), std::string::npos) << to_string(f);
}

TEST(BadModel, Loads) {
  const std::string at = "[[load]]\npoint = [15, 9]\n",
                    line = "[[load]]\nalong = [[10, 0], [10, 9]]\n";
  for (const Bad& bad : {
           Bad{"[[load]]\nforce = [1, 0]\n", 42, "load.0", "neither point nor along"},
           Bad{at, 42, "load.0", "neither force nor pressure"},
           Bad{at + "along = [[0, 0], [1, 0]]\nforce = [1, 0]\n", 44, "load.0.along",
               "point is given too"},
           Bad{at + "force = [1, 0]\npressure = 5\n", 45, "load.0.pressure", "force is given too"},
           Bad{at + "pressure = 5\n", 44, "load.0.pressure", "no face"},
           Bad{at + "force = [0, \"3 kPa\"]\n", 44, "load.0.force", "is not a force"},
           Bad{line + "force = [0, \"3 kN\"]\n", 44, "load.0.force", "is not a stress"},
           Bad{at + "force = [0, \"3 m\"]\n", 44, "load.0.force[1]", "is not a load"},
           Bad{at + "force = 3\n", 44, "load.0.force", "two numbers"},
           Bad{at + "force = [1, 0]\nhistory = \"no.csv\"\n", 45, "load.0.history",
               "no.csv no such file"},
           Bad{at + "force = [1, 0]\nhistory = \"\"\n", 45, "load.0.history", "is empty"},
           Bad{at +
                   "force = [1, 0]\nname = \"a\"\n[[load]]\nname = \"a\"\npoint = [15, 9]\nforce = "
                   "[1, 0]\n",
               47, "load.a.name", "is the name of element 0"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, Waters) {
  for (const Bad& bad : {
           Bad{"[[water]]\n", 42, "water.0.table", "is missing"},
           Bad{"[[water]]\ntable = [[0, 1]]\n", 43, "water.0.table", "has 1 point"},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1], [1, 1]]\n", 43, "water.0.table[2]",
               "to the right"},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1]]\nflooded = [\"hol\"]\n", 44, "water.0.flooded",
               "did you mean \"hole\""},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1]]\nflooded = \"hole\"\n", 44, "water.0.flooded",
               "a list of names"},
           Bad{"[[water]]\ntable = [[0, 1], [2, 1]]\nunit_weight = 0\n", 44, "water.0.unit_weight",
               "out of range"},
       }) {
    expect_fault(bad);
  }
}

TEST(BadModel, Stages) {
  for (const Bad& bad : {
           Bad{"[[stage]]\nduration = 0.1\nuntil = \"rest\"\n", 44, "stage.0.until", "not known"},
           Bad{"[[stage]]\nname = \"a\"\n", 42, "stage.a.duration", "is missing"},
           Bad{"[[stage]]\nduration = 0.1\nratio = 0\n", 44, "stage.0.ratio", "out of range"},
           Bad{"[[stage]]\nduration = 0.05\n[[stage]]\nduration = 0.1\n", 39, "solver.duration",
               "is not the 0.15 s of the stages together"},
           Bad{"[[stage]]\nduration = 0.1\ndamping = { local = 1.5 }\n", 44,
               "stage.0.damping.local", "out of range"},
       }) {
    expect_fault(bad);
  }
  const auto missing = read_model_text(testing::base_with("duration = 0.1\n", ""), "m.toml", {});
  ASSERT_FALSE(missing.ok());
  EXPECT_EQ(missing.faults()[0].where.key, "solver.duration");
  EXPECT_EQ(missing.faults()[0].where.line, 38);
}

}  // namespace
}  // namespace edda
