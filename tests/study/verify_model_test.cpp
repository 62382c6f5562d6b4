#include "study/verify_model.hpp"

#include <gtest/gtest.h>

#include "model/read_model.hpp"

namespace edda::verify_model_test {
namespace {

/// A block that slides on a floor and penetrates it under its weight: a result that depends on the
/// springs, and on the step in the last digits.
const std::string slab = R"(
[materials.rock]
density = 2600.0
young = 1e9
poisson = 0.2
[joints.j]
friction_angle = 10.0
[[block]]
fixed = true
polygon = [[-5, -1], [5, -1], [5, 0], [-5, 0]]
[[block]]
name = "slab"
velocity = [1.0, 0.0]
polygon = [[0, 0], [2, 0], [2, 1], [0, 1]]
[[block]]
polygon = [[0.2, 1], [1.7, 1], [1.7, 1.5], [0.2, 1.5]]
)";
const std::string monitor = "[[monitor]]\nname = 'M'\npoint = [1.0, 0.9]\n";

Result<Verification> verified(const std::string& more) {
  const Result<Model> model = read_model_text(slab + more, "slab.toml", {});
  EXPECT_TRUE(model.ok());
  return verify_model(model.value(), {});
}

TEST(VerifyModel, PutsBarsOnEveryMonitor) {
  for (const std::string solver :
       {"", "time_step = 2e-5\n", "method = 'dda'\ntime_step = 1e-4\n", "method = 'dda'\n"}) {
    std::vector<std::string> runs;
    VerifyOptions options;
    options.starts = [&](const std::string& run) { runs.push_back(run); };
    const Result<Model> model = read_model_text(slab + monitor + "[solver]\nduration = 0.05\n" +
                                                    solver + "[output]\nhistory_every = 0.01\n",
                                                "slab.toml", {});
    ASSERT_TRUE(model.ok());
    const Result<Verification> v = verify_model(model.value(), options);
    ASSERT_TRUE(v.ok());
    EXPECT_EQ(runs.size(), 4u);
    EXPECT_EQ(v.value().failed, "");
    ASSERT_EQ(v.value().monitors.size(), 1u);
    const MonitorBar& m = v.value().monitors[0];
    EXPECT_EQ(m.name, "M");
    EXPECT_GT(m.displacement.x, 0.04);
    EXPECT_GT(m.step, 0.0) << solver;
    EXPECT_GT(m.stiffness, 0.0) << solver;
    EXPECT_LT(m.step, 2e-3) << solver;
    EXPECT_LT(m.stiffness, 2e-3) << solver;
    EXPECT_LT(m.order, 1e-6) << solver;
  }
}

TEST(VerifyModel, AsksForMonitors) {
  const Result<Verification> v = verified("[solver]\nduration = 0.01\n");
  ASSERT_FALSE(v.ok());
  EXPECT_NE(to_string(v.faults().front()).find("add a [[monitor]]"), std::string::npos);
}

TEST(VerifyModel, LeavesTheRocksOwnStiffness) {
  std::string text = slab;
  text.replace(text.find("friction_angle"), 0, "kn = 1e10\n");
  const Result<Model> model =
      read_model_text(text + monitor + "[solver]\nduration = 0.01\n", "slab.toml", {});
  const Result<Verification> v = verify_model(model.value(), {});
  ASSERT_TRUE(v.ok());
  EXPECT_TRUE(v.value().own_stiffness);
}

}  // namespace
}  // namespace edda::verify_model_test
