// edda-sampler as a process.
#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <nlohmann/json.hpp>

#include "sampling/sampler_process.hpp"

namespace edda {
namespace {

using nlohmann::json;

/// The tests do not lie beside it.
[[maybe_unused]] const int told = setenv("EDDA_SAMPLER", EDDA_SAMPLER_PROGRAM, 1);

/// The answer of a method on the value x, standard normal.
json reliability_of(const char* method, double threshold, int seed) {
  SamplerProcess sampler;
  json line{{"task", "reliability"},
            {"variables", {{{"distribution", "normal"}, {"mean", 0}, {"sd", 1}}}},
            {"dependence", json::array()},
            {"method", method},
            {"threshold", threshold},
            {"fails", "below"},
            {"difference", 0.1},
            {"tolerance", 1e-6},
            {"scale", 1.0},
            {"seed", seed},
            {"count", 400},
            {"block", 40},
            {"confidence", 0.95}};
  while (true) {
    const Result<json> answer = sampler.ask(line);
    EXPECT_TRUE(answer.ok()) << to_string(answer.faults().front());
    if (!answer.ok()) return {};
    if (!answer.value().contains("ask")) return answer.value()["answer"];
    json values = json::array();
    for (const json& point : answer.value()["ask"]) values.push_back(point[0]);
    line = {{"values", values}};
  }
}

TEST(Sampler, FindsTheMostLikelyFailure) {
  const json form = reliability_of("form", -2.5, 1);
  EXPECT_NEAR(form["reliability_index"].get<double>(), 2.5, 1e-6);
  EXPECT_NEAR(form["probability"].get<double>(), 0.5 * std::erfc(2.5 / std::sqrt(2.0)), 1e-8);
  EXPECT_NEAR(form["design_point"][0].get<double>(), -2.5, 1e-6);
  EXPECT_NEAR(reliability_of("sorm", -2.5, 1)["probability"].get<double>(),
              0.5 * std::erfc(2.5 / std::sqrt(2.0)), 1e-6);
}

// OpenTURNS's own interval has the truth in it six times in ten where it lies just below a level.
TEST(Sampler, SubsetsHaveTheTruthInTheirInterval) {
  for (const double threshold : {-1.0, -1.37, -2.5}) {
    const double exact = 0.5 * std::erfc(-threshold / std::sqrt(2.0));
    int inside = 0;
    constexpr int studies = 60;
    for (int seed = 1; seed <= studies; ++seed) {
      const json found = reliability_of("subset", threshold, seed);
      inside += found["low"].get<double>() <= exact && exact <= found["high"].get<double>();
    }
    EXPECT_GE(inside, 52) << threshold;  // of 60: 0.95 less two standard deviations, and its chains
  }
}

TEST(Sampler, SaysWhatItCannotDo) {
  SamplerProcess sampler;
  const Result<json> none = sampler.ask({{"task", "x"}});
  ASSERT_FALSE(none.ok());
  EXPECT_NE(to_string(none.faults().front()).find("there is no task x"), std::string::npos);
  EXPECT_TRUE(
      sampler.ask({{"task", "interval"}, {"failures", 1}, {"count", 9}, {"confidence", 0.9}}).ok());
}

}  // namespace
}  // namespace edda
