// A study's file: what it may say, and the message where it is wrong.
#include <gtest/gtest.h>

#include "model/study/study_keys.hpp"

namespace edda {
namespace {

const std::string whole = R"(
title = "Bench"
model = "bench.toml"
[sampling]
method = "latin-hypercube"
samples = 200
[vary.cohesion]
key = "joints.bedding.cohesion"
distribution = "lognormal"
mean = 20
cv = 0.25
unit = "kPa"
[vary.friction]
keys = ["joints.bedding.friction_angle", "joints.cross.friction_angle"]
distribution = "normal"
mean = 32
sd = 3
at_least = 20
[vary.pattern]
key = "joint_set.bedding.seed"
distribution = "seed"
[[correlated]]
between = ["cohesion", "friction"]
rank = -0.4
[ask.factor]
of = "limit"
[failure]
below = 1.0
)";

const std::string map = "[map]\nspacing = \"50 cm\"\nregion = [[0, 0], [2, 0], [2, 1], [0, 1]]\n";

std::string with(const std::string& from, const std::string& to) {
  std::string text = whole;
  const std::size_t at = text.find(from);
  EXPECT_NE(at, std::string::npos) << from;
  return text.replace(at, from.size(), to);
}

std::string faults_of(const std::string& text) {
  const Result<StudyPlan> plan = read_study_text(text, "study.toml", {});
  std::string all;
  if (!plan.ok()) {
    for (const Fault& fault : plan.faults()) all += to_string(fault) + '\n';
  }
  return all;
}

TEST(ReadStudy, FillsInWhatFollows) {
  const Result<StudyPlan> read = read_study_text(whole, "study.toml", {"sampling.seed=7"});
  ASSERT_TRUE(read.ok()) << to_string(read.faults().front());
  const StudyPlan& plan = read.value();
  EXPECT_EQ(plan.sampling.method, SamplingMethod::latin_hypercube);
  EXPECT_EQ(plan.sampling.seed, 7);
  EXPECT_EQ(plan.vary[0].sd, 5.0);
  EXPECT_EQ(plan.vary[0].keys, std::vector<std::string>{"joints.bedding.cohesion"});
  EXPECT_EQ(plan.vary[1].keys.size(), 2u);
  EXPECT_EQ(plan.ask[0].value, "limit.lower");
  EXPECT_EQ(plan.failure->ask, "factor");
}

TEST(ReadStudy, ComesBackAsItWasWritten) {
  const Result<StudyPlan> first = read_study_text(whole, "study.toml", {});
  ASSERT_TRUE(first.ok());
  const std::string written = to_toml(first.value());
  const Result<StudyPlan> second = read_study_text(written, "elsewhere/study.toml", {});
  ASSERT_TRUE(second.ok()) << to_string(second.faults().front());
  EXPECT_EQ(to_toml(second.value()), written);
}

TEST(ReadStudy, PlacesOfAMapFillItsRegionFromBelow) {
  const std::string text = with("of = \"limit\"\n", "of = \"keyblocks\"\n" + map);
  const Result<StudyPlan> plan = read_study_text(text, "study.toml", {});
  ASSERT_TRUE(plan.ok()) << to_string(plan.faults().front());
  const std::vector<Vec2> wanted{{0.25, 0.25}, {0.75, 0.25}, {1.25, 0.25}, {1.75, 0.25},
                                 {0.25, 0.75}, {0.75, 0.75}, {1.25, 0.75}, {1.75, 0.75}};
  EXPECT_EQ(places_of(*plan.value().map), wanted);
  StudyMap corner{1.0, {{0, 0}, {3, 0}, {0, 3}}, 1, {}};
  EXPECT_EQ(places_of(corner).size(), 6u);  // on the hypotenuse, too
  const std::string written = to_toml(plan.value());
  const Result<StudyPlan> again = read_study_text(written, "study.toml", {});
  ASSERT_TRUE(again.ok()) << written;
  EXPECT_EQ(places_of(*again.value().map), wanted);
}

TEST(ReadStudy, SaysWhatIsWrongAndWhere) {
  const std::pair<std::string, std::string> cases[] = {
      {with("mean = 20\n", ""), "vary.cohesion.distribution: \"lognormal\" needs mean"},
      {with("cv = 0.25\n", ""),
       "study.toml:9:16: vary.cohesion.distribution: \"lognormal\" needs sd: give sd, or cv"},
      {with("cv = 0.25", "cv = 0.25\nsd = 5"), "vary.cohesion.cv: is given beside sd"},
      {with("sd = 3", "sd = 3\nmode = 2"),
       "vary.friction.mode: is nothing of a distribution \"normal\""},
      {with("mean = 20\n", "mean = -20\n"),
       "vary.cohesion.mean: is not above the smallest value, 0"},
      {with("at_least = 20", "at_least = 20\nat_most = 10"),
       "vary.friction.at_least: is not below at_most"},
      {with("distribution = \"normal\"", "distribution = \"gauss\""),
       "vary.friction.distribution: \"gauss\" is not known"},
      {with("samples = 200\n", ""), "sampling.samples: is missing: give the number of samples"},
      {with("\"latin-hypercube\"", "\"form\""), "sampling.samples: is nothing of method form"},
      {with("samples = 200", "samples = 200\nhalf_width = 0.01"),
       "sampling.half_width: is nothing of method latin-hypercube"},
      {with("\"latin-hypercube\"", "\"subset\""),
       "vary.pattern.distribution: method subset needs quantities that vary continuously"},
      {with("[\"cohesion\", \"friction\"]", "[\"cohesion\", \"frictoin\"]"),
       "correlated.0.between: no [vary] is called \"frictoin\": did you mean \"friction\"?"},
      {with("[\"cohesion\", \"friction\"]", "[\"cohesion\", \"pattern\"]"),
       "correlated.0.between: \"pattern\" does not vary continuously"},
      {with("rank = -0.4", "rank = -0.4\ncopula = \"clayton\""),
       "correlated.0.rank: belongs to copula normal"},
      {with("of = \"limit\"", "of = \"run\""), "ask.factor.value: is missing"},
      {with("of = \"limit\"", "of = \"limit\"\ntake = \"largest\""),
       "ask.factor.take: is nothing of a single value"},
      {with("of = \"limit\"", "of = \"limit\"\nat = \"2 s\""),
       "ask.factor.at: is nothing of a single value"},
      {with("of = \"limit\"",
            "of = \"run\"\nvalue = \"reactions.base.fy\"\ntake = \"largest\"\nat = 2"),
       "ask.factor.at: is given beside take: give one of the two"},
      {with("of = \"limit\"", "of = \"limit\"\nvalue = \"reactions.base.fy\""),
       "ask.factor.value: limit has no reactions: ask of = \"run\""},
      {with("below = 1.0", "below = 1.0\nabove = 2.0"), "failure"},
      {with("below = 1.0", "below = 1.0\nask = \"factr\""),
       "failure.ask: no [ask] is called \"factr\": did you mean \"factor\"?"},
      {with("[ask.factor]", "[ask.cohesion]"), "ask.cohesion"},
      {with("[failure]", map + "[failure]"),
       "map.spacing: makes a map of key blocks, and no [ask] is of them"},
      {with("of = \"limit\"",
            "of = \"keyblocks\"\n[map]\nspacing = 0.01\nregion = [[0, 0], [10, 0], "
            "[10, 10], [0, 10]]"),
       "map.spacing: makes 1000000 places: choose a larger one"},
      {with("of = \"limit\"",
            "of = \"keyblocks\"\n[map]\nspacing = 30\nregion = [[0, 0], [10, 0], [0, "
            "10]]"),
       "map.spacing: leaves no place in the region"},
      {with("of = \"limit\"", "of = \"keyblocks\"\n[map]\nspacing = 1"), "map.region: is missing"},
      {with("model = \"bench.toml\"", "modle = \"bench.toml\""),
       "modle: unknown key: did you mean \"model\"?"},
      {with("[vary.cohesion]\nkey", "[vary.cohesion]\nkye"), "vary.cohesion.kye: unknown key"},
      {"", "is empty"},
  };
  for (const auto& [text, says] : cases)
    EXPECT_NE(faults_of(text).find(says), std::string::npos) << says << "\nbut:\n"
                                                             << faults_of(text);
}

TEST(ReadStudy, KeysAreWellFormed) {
  for (const Section& section : study_sections()) {
    EXPECT_TRUE(section.meaning.ends_with('.')) << section.name;
    for (const Key& key : section.keys) {
      EXPECT_TRUE(key.meaning.ends_with('.')) << section.name << '.' << key.name;
      EXPECT_FALSE(key.otherwise.required && !key.otherwise.text.empty()) << key.name;
    }
  }
  EXPECT_NE(study_key_reference().find("| `half_width` |"), std::string::npos);
}

}  // namespace
}  // namespace edda
