#include "study/verify_model.hpp"

#include <gtest/gtest.h>

#include <atomic>
#include <string>
#include <vector>

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

/// Also of a model that ends in equilibrium.
TEST(VerifyModel, PutsBarsOnEquilibria) {
  const Result<Verification> v =
      verified(monitor + "[[stage]]\nuntil = 'equilibrium'\nratio = 1e-7\n");
  ASSERT_TRUE(v.ok());
  EXPECT_EQ(v.value().failed, "");
  EXPECT_LT(v.value().monitors[0].displacement.y, 0.0);
  EXPECT_GT(v.value().monitors[0].stiffness, 0.0);
}

const std::string short_run =
    "[solver]\nduration = 0.02\n[output]\nhistory_every = 0.005\nevery = 0.01\n";

/// All numbers, to the last digit.
std::vector<double> numbers(const Verification& v) {
  std::vector<double> all{v.time, v.largest_energy_error};
  for (const MonitorBar& m : v.monitors)
    all.insert(all.end(), {m.displacement.x, m.displacement.y, m.step, m.stiffness, m.order});
  return all;
}

TEST(VerifyModel, DoesNotDependOnThreads) {
  for (const std::string solver : {"", "time_step = 2e-5\n", "method = 'dda'\n"}) {
    std::string text = slab + monitor + short_run;
    text.insert(text.find("duration"), solver);
    const Result<Model> model = read_model_text(text, "slab.toml", {});
    ASSERT_TRUE(model.ok());
    std::vector<double> of_one;
    for (const int threads : {1, 2, 3, 4, 9}) {
      VerifyOptions options;
      options.threads = threads;
      const Result<Verification> v = verify_model(model.value(), options);
      ASSERT_TRUE(v.ok());
      EXPECT_EQ(v.value().failed, "");
      if (of_one.empty()) of_one = numbers(v.value());
      EXPECT_EQ(numbers(v.value()), of_one) << solver << threads;
    }
  }
}

/// The runs are reported in one order, the progress of each after its name, to its end.
TEST(VerifyModel, ReportsOneRunAfterTheOther) {
  const Result<Model> model = read_model_text(slab + monitor + short_run, "slab.toml", {});
  ASSERT_TRUE(model.ok());
  for (const int threads : {1, 2, 4}) {
    std::vector<std::string> runs;
    std::vector<double> done;
    VerifyOptions options;
    options.threads = threads;
    options.starts = [&](const std::string& run) {
      runs.push_back(run);
      done.push_back(0.0);
    };
    options.progress = [&](const Progress& p) { done.back() = p.fraction; };
    ASSERT_TRUE(verify_model(model.value(), options).ok());
    EXPECT_EQ(runs,
              (std::vector<std::string>{"as it is", "half the step", "springs three times as stiff",
                                        "blocks in the other order"}));
    EXPECT_EQ(done, std::vector<double>(4, 1.0)) << threads;
  }
}

/// The first run that fails is named, and no other is reported.
TEST(VerifyModel, EndsWithTheRunThatFails) {
  const Result<Model> model =
      read_model_text(slab + monitor + "[solver]\nduration = 0.5\ntime_step = 6e-4\n" +
                          "allow_unstable = true\n[output]\nhistory_every = 0.01\n",
                      "slab.toml", {"materials.rock.damping=0"});
  ASSERT_TRUE(model.ok());
  std::string of_one;
  for (const int threads : {1, 2, 4}) {
    std::size_t runs = 0;
    VerifyOptions options;
    options.threads = threads;
    options.starts = [&](const std::string&) { ++runs; };
    const Result<Verification> v = verify_model(model.value(), options);
    ASSERT_TRUE(v.ok());
    if (threads == 1) of_one = v.value().failed;
    EXPECT_NE(v.value().failed.find("diverged"), std::string::npos);
    EXPECT_EQ(v.value().failed, of_one) << threads;
    EXPECT_EQ(runs, 1u);
  }
}

TEST(VerifyModel, StopsWhenAsked) {
  const Result<Model> model =
      read_model_text(slab + monitor + "[solver]\nduration = 1e6\n[output]\nhistory_every = 1e3\n",
                      "slab.toml", {});
  ASSERT_TRUE(model.ok());
  for (const int threads : {1, 4}) {
    std::atomic<bool> stop{false};
    VerifyOptions options;
    options.threads = threads;
    options.stop = &stop;
    options.progress = [&](const Progress&) { stop = true; };
    const Result<Verification> v = verify_model(model.value(), options);
    ASSERT_TRUE(v.ok());
    EXPECT_TRUE(v.value().failed.starts_with("as it is: stopped at ")) << v.value().failed;
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
