// The folder of a study: every sample is taken once, and none is lost.
#include "sampling/sample_folder.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <fstream>
#include <set>
#include <thread>

#include "sampling/lead_study.hpp"
#include "scratch_folder.hpp"

namespace edda {
namespace {

const std::string model =
    "[materials.rock]\ndensity = 2500\nyoung = 1e9\npoisson = 0.2\n"
    "[joints.a]\nfriction_angle = 30\n[[block]]\npolygon = [[0, 0], [1, 0], [1, 1]]\n";

StudyPlan grid_of(int values) {
  std::string text =
      "model = \"m.toml\"\n[sampling]\nmethod = \"grid\"\n[vary.x]\nkey = "
      "\"materials.rock.density\"\nvalues = [1000";
  for (int i = 1; i < values; ++i) text += ", " + std::to_string(1000 + i);
  const Result<StudyPlan> plan =
      read_study_text(text + "]\n[ask.f]\nof = \"limit\"\n[failure]\nbelow = 1\n", "s.toml", {});
  EXPECT_TRUE(plan.ok());
  return plan.value();
}

SampleAnswer answer_of(std::size_t sample) {
  return {{std::to_string(sample) + ".5"}, sample % 3 == 0 ? "a \"word\", and more" : ""};
}

class StudyFolder : public ::testing::Test {
 protected:
  ScratchFolder scratch_;
  SampleFolder folder_{scratch_.at("study")};
  SamplerProcess sampler_;
};

TEST_F(StudyFolder, EverySampleIsTakenOnce) {
  const StudyPlan plan = grid_of(300);
  ASSERT_FALSE(folder_.open(plan, model, {}, sampler_));
  std::vector<std::vector<std::size_t>> taken(4);
  std::vector<std::thread> threads;
  for (std::vector<std::size_t>& mine : taken) {
    threads.emplace_back([&] {
      Worker worker;
      ASSERT_FALSE(worker.join(folder_));
      while (const auto sample = worker.take({})) {
        mine.push_back(*sample);
        ASSERT_FALSE(worker.finish(*sample, answer_of(*sample)));
      }
    });
  }
  for (std::thread& t : threads) t.join();
  std::multiset<std::size_t> all;
  for (const auto& mine : taken) all.insert(mine.begin(), mine.end());
  EXPECT_EQ(all.size(), 300u);
  EXPECT_EQ(std::set<std::size_t>(all.begin(), all.end()).size(), 300u);
  const Rows rows = folder_.rows(plan);
  ASSERT_EQ(rows.size(), 300u);
  EXPECT_EQ(rows.at(17).cells, answer_of(17).cells);
  EXPECT_EQ(rows.at(18).message, answer_of(18).message);
}

TEST_F(StudyFolder, WhatAWorkerHadBegunIsFreeOnceItHasEnded) {
  const StudyPlan plan = grid_of(3);
  ASSERT_FALSE(folder_.open(plan, model, {}, sampler_));
  auto worker = std::make_unique<Worker>();
  ASSERT_FALSE(worker->join(folder_));
  EXPECT_EQ(worker->take({}), 0u);
  ASSERT_FALSE(folder_.recover());
  EXPECT_EQ(folder_.free_samples(), (std::vector<std::size_t>{1, 2}));  // it is at work
  ASSERT_FALSE(worker->finish(0, answer_of(0)));
  EXPECT_EQ(worker->take({}), 1u);
  worker.reset();
  ASSERT_FALSE(folder_.recover());
  EXPECT_EQ(folder_.free_samples(), (std::vector<std::size_t>{1, 2}));
  EXPECT_EQ(folder_.rows(plan).size(), 1u);
}

TEST_F(StudyFolder, ARowThatWasNotWrittenToItsEndDoesNotCount) {
  const StudyPlan plan = grid_of(2);
  ASSERT_FALSE(folder_.open(plan, model, {}, sampler_));
  {
    Worker worker;
    ASSERT_FALSE(worker.join(folder_));
    ASSERT_EQ(worker.take({}), 0u);
    ASSERT_FALSE(worker.finish(0, answer_of(0)));
    std::ofstream(worker.scratch() + "/../rows.csv", std::ios::app) << "1,1.";
  }
  EXPECT_EQ(folder_.rows(plan).size(), 1u);
}

TEST_F(StudyFolder, ShardsShareTheSamples) {
  const StudyPlan plan = grid_of(10);
  ASSERT_FALSE(folder_.open(plan, model, {1, 3}, sampler_));
  EXPECT_EQ(folder_.free_samples(), (std::vector<std::size_t>{1, 4, 7}));
  ASSERT_FALSE(folder_.open(plan, model, {0, 3}, sampler_));
  EXPECT_EQ(folder_.free_samples(), (std::vector<std::size_t>{0, 1, 3, 4, 6, 7, 9}));
}

TEST_F(StudyFolder, AnotherStudyIsRefused) {
  ASSERT_FALSE(folder_.open(grid_of(3), model, {}, sampler_));
  EXPECT_FALSE(folder_.open(grid_of(3), model, {}, sampler_));
  const Trouble plan = folder_.open(grid_of(4), model, {}, sampler_);
  ASSERT_TRUE(plan);
  EXPECT_NE(plan->problem.find("another plan"), std::string::npos);
  const Trouble other = folder_.open(grid_of(3), model + "# other", {}, sampler_);
  ASSERT_TRUE(other);
  EXPECT_NE(other->problem.find("another model"), std::string::npos);
  std::ofstream(scratch_.at("notes.txt")) << "mine";
  SampleFolder taken(scratch_.path().string());
  EXPECT_TRUE(taken.open(grid_of(3), model, {}, sampler_));
}

TEST(RunSample, ValuesAreFoundByTheirNames) {
  const std::string json = R"({"limit": {"lower": 1.25}, "status": "found", "checks":
    [{"name": "drift, of all", "value": 0.5, "pass": true}, {"name": "b", "value": 2}], "a.b": {"c": 3}})";
  EXPECT_EQ(value_in(json, "limit.lower"), "1.25");
  EXPECT_EQ(value_in(json, "status"), "found");
  EXPECT_EQ(value_in(json, "checks.drift, of all.value"), "0.5");
  EXPECT_EQ(value_in(json, "checks.drift, of all.pass"), "1");
  EXPECT_EQ(value_in(json, "checks.1.value"), "2");
  EXPECT_EQ(value_in(json, "a.b.c"), "3");
  EXPECT_EQ(value_in(json, "limit.upper"), "");
  EXPECT_EQ(value_in(json, "limit"), "");
  EXPECT_EQ(value_in("no json", "limit"), "");
}

TEST(HasFailed, CountsWhatHasNoNumber) {
  StudyPlan plan = grid_of(2);
  const auto failed = [&](const char* cell) { return has_failed(plan, {{cell}, ""}); };
  EXPECT_EQ(failed("0.99"), true);
  EXPECT_EQ(failed("1.0"), false);
  EXPECT_EQ(failed("unstable"), true);
  EXPECT_EQ(failed("unlimited"), false);
  EXPECT_EQ(failed(""), std::nullopt);
  plan.failure->below.reset();
  plan.failure->above = 2.0;
  EXPECT_EQ(failed("2.5"), true);
  EXPECT_EQ(failed("unstable"), std::nullopt);
  EXPECT_EQ(failed("unlimited"), true);
  plan.failure.reset();
  EXPECT_EQ(failed("0.5"), std::nullopt);
}

// Of 14 in 200: Clopper and Pearson (1934), as any table has it.
TEST(Interval, IsThatOfClopperAndPearson) {
  SamplerProcess sampler;
  const Result<Interval> i = interval_of(14, 200, 0.95, sampler);
  ASSERT_TRUE(i.ok());
  EXPECT_NEAR(i.value().low, 0.0387956, 1e-7);
  EXPECT_NEAR(i.value().high, 0.1146597, 1e-7);
  const Result<Interval> none = interval_of(0, 100, 0.95, sampler);
  EXPECT_EQ(none.value().low, 0.0);
  EXPECT_NEAR(none.value().high, 1.0 - std::pow(0.025, 0.01), 1e-12);
}

}  // namespace
}  // namespace edda
