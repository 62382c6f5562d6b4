// Points of samples: their distributions, their dependence, and that a longer study begins with the
// samples of a shorter one.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "sampling/sample_points.hpp"

namespace edda {
namespace {

StudyPlan plan_of(const std::string& text) {
  Result<StudyPlan> plan = read_study_text(text, "study.toml", {});
  EXPECT_TRUE(plan.ok()) << (plan.ok() ? "" : to_string(plan.faults().front()));
  return plan.ok() ? plan.value() : StudyPlan{};
}

std::string study_of(const std::string& vary, const std::string& method, int samples,
                     const std::string& more = "") {
  return "model = \"m.toml\"\n[sampling]\nmethod = \"" + method +
         "\"\nsamples = " + std::to_string(samples) + "\n[vary.x]\nkey = \"a.b\"\n" + vary + more +
         "\n[ask.f]\nof = \"limit\"\n[failure]\nbelow = 1\n";
}

Points points_or_fail(const StudyPlan& plan, std::size_t first = 0) {
  SamplerProcess sampler;
  Result<Points> points = points_of(plan, first, sampler);
  EXPECT_TRUE(points.ok()) << (points.ok() ? "" : to_string(points.faults().front()));
  return points.ok() ? points.value() : Points{};
}

struct Moments {
  double mean = 0.0, sd = 0.0, least = 1e300, most = -1e300;
};

Moments moments_of(const Points& points, std::size_t column = 0) {
  Moments m;
  const auto n = static_cast<double>(points.size());
  for (const auto& p : points) {
    m.mean += p[column] / n;
    m.least = std::min(m.least, p[column]);
    m.most = std::max(m.most, p[column]);
  }
  for (const auto& p : points) m.sd += (p[column] - m.mean) * (p[column] - m.mean) / n;
  m.sd = std::sqrt(m.sd);
  return m;
}

struct Case {
  const char* vary;
  double mean, sd;
};

class Distributions : public ::testing::TestWithParam<Case> {};

// A Latin hypercube of 4,000 has the moments of its distribution to a few parts in a thousand.
TEST_P(Distributions, HaveTheirMoments) {
  const Case& c = GetParam();
  const Moments m = moments_of(points_or_fail(plan_of(study_of(c.vary, "latin-hypercube", 4000))));
  EXPECT_NEAR(m.mean, c.mean, 0.005 * c.sd) << c.vary;
  EXPECT_NEAR(m.sd, c.sd, 0.02 * c.sd) << c.vary;
}

INSTANTIATE_TEST_SUITE_P(
    All, Distributions,
    ::testing::Values(
        Case{"distribution = \"normal\"\nmean = 30\nsd = 4", 30, 4},
        Case{"distribution = \"lognormal\"\nmean = 20\nsd = 5", 20, 5},
        Case{"distribution = \"lognormal\"\nmean = 20\nsd = 5\nlow = 10", 20, 5},
        Case{"distribution = \"uniform\"\nlow = 2\nhigh = 8", 5, 6 / std::sqrt(12.0)},
        Case{"distribution = \"triangular\"\nlow = 0\nmode = 0\nhigh = 3", 1, std::sqrt(0.5)},
        Case{"distribution = \"exponential\"\nmean = 3\nlow = 1", 3, 2},
        Case{"distribution = \"weibull\"\nmean = 10\nsd = 3", 10, 3},
        Case{"distribution = \"beta\"\nmean = 4\nsd = 1\nlow = 1\nhigh = 9", 4, 1},
        // Standard deviation of a von Mises angle: nearly 1/sqrt(kappa) radians.
        Case{"distribution = \"von-mises\"\nmean = 60\nconcentration = 400", 60, 2.8666},
        Case{"distribution = \"choice\"\nvalues = [1, 5]\nweights = [3, 1]", 2, std::sqrt(3.0)},
        // Half a normal distribution.
        Case{"distribution = \"normal\"\nmean = 0\nsd = 1\nat_least = 0", std::sqrt(2 / M_PI),
             std::sqrt(1 - 2 / M_PI)}));

TEST(SamplePoints, TruncationCutsOffBothEnds) {
  const Moments m = moments_of(points_or_fail(plan_of(study_of(
      "distribution = \"von-mises\"\nmean = 60\nconcentration = 50\nat_least = 55\nat_most = 63",
      "monte-carlo", 2000))));
  EXPECT_GE(m.least, 55.0);
  EXPECT_LE(m.most, 63.0);
  EXPECT_LT(m.least, 55.1);
  EXPECT_GT(m.most, 62.9);
}

// Fisher: the mean of cos(t), t from the mean pole, is coth(k) - 1/k, and no direction around it is
// better than another. Near the vertical the dip direction may be any.
TEST(SamplePoints, PolesLieAroundTheirMean) {
  for (const double mean_dip : {40.0, 3.0, 88.0}) {
    const double k = 60.0, degree = M_PI / 180.0, azimuth = 135.0;
    const Points points = points_or_fail(plan_of(study_of(
        "distribution = \"fisher\"\nmean = " + std::to_string(mean_dip) +
            "\nconcentration = 60\n[vary.y]\nkey = \"a.c\"\ndistribution = \"fisher\"\nmean = " +
            "135\nwith = \"x\"",
        "latin-hypercube", 4000)));
    double cosines = 0.0, up = 0.0, side = 0.0;
    for (const auto& p : points) {
      ASSERT_TRUE(p[0] >= 0.0 && p[0] <= 90.0 && p[1] >= 0.0 && p[1] < 360.0);
      const double dip = p[0] * degree, turn = (p[1] - azimuth) * degree;
      double out = std::sin(dip) * std::cos(turn), strike = std::sin(dip) * std::sin(turn),
             above = std::cos(dip);
      const double d = mean_dip * degree;
      double c = out * std::sin(d) + above * std::cos(d);
      if (c < 0.0) {  // the pole was turned upwards
        c = -c;
        out = -out;
        strike = -strike;
        above = -above;
      }
      cosines += c / 4000.0;
      up += (out * std::cos(d) - above * std::sin(d)) / 4000.0;
      side += strike / 4000.0;
    }
    EXPECT_NEAR(cosines, 1.0 / std::tanh(k) - 1.0 / k, 3e-4) << mean_dip;
    EXPECT_NEAR(up, 0.0, 4e-3) << mean_dip;
    EXPECT_NEAR(side, 0.0, 4e-3) << mean_dip;
  }
}

/// Spearman's coefficient of two columns without ties.
double rank_of(const Points& points) {
  const auto ranks = [&](std::size_t column) {
    std::vector<double> sorted, found;
    for (const auto& p : points) sorted.push_back(p[column]);
    std::sort(sorted.begin(), sorted.end());
    for (const auto& p : points)
      found.push_back(static_cast<double>(
          std::lower_bound(sorted.begin(), sorted.end(), p[column]) - sorted.begin()));
    return found;
  };
  const std::vector<double> a = ranks(0), b = ranks(1);
  const auto n = static_cast<double>(points.size());
  double d = 0.0;
  for (std::size_t i = 0; i < a.size(); ++i) d += (a[i] - b[i]) * (a[i] - b[i]);
  return 1.0 - 6.0 * d / (n * (n * n - 1.0));
}

TEST(SamplePoints, DependenceIsThatOfTheFile) {
  const std::string two =
      "distribution = \"lognormal\"\nmean = 20\nsd = 10\n[vary.y]\nkey = \"a.c\"\ndistribution = "
      "\"uniform\"\nlow = 0\nhigh = 1\n[[correlated]]\nbetween = [\"x\", \"y\"]\n";
  const auto rank = [&](const std::string& how) {
    return rank_of(points_or_fail(plan_of(study_of(two + how, "monte-carlo", 4000))));
  };
  EXPECT_NEAR(rank("rank = -0.6"), -0.6, 0.03);
  // Kendall's tau of Clayton's copula is theta/(theta + 2) = 1/2; Spearman's coefficient then
  // 0.683.
  EXPECT_NEAR(rank("copula = \"clayton\"\ntheta = 2"), 0.683, 0.03);
  EXPECT_NEAR(rank("copula = \"frank\"\ntheta = -5.736"), -0.695, 0.03);
}

TEST(SamplePoints, OtherSeedsAreOtherDraws) {
  const std::string vary = "distribution = \"normal\"\nmean = 0\nsd = 1";
  StudyPlan plan = plan_of(study_of(vary, "monte-carlo", 50));
  const Points first = points_or_fail(plan);
  EXPECT_EQ(points_or_fail(plan), first);
  plan.sampling.seed = 2;
  EXPECT_NE(points_or_fail(plan), first);
}

TEST(SamplePoints, ALongerStudyBeginsWithTheShorterOne) {
  const std::string vary =
      "distribution = \"normal\"\nmean = 0\nsd = 1\n[vary.s]\nkey = \"q.seed\"\ndistribution = "
      "\"seed\"\nlow = 100";
  for (const char* method : {"monte-carlo", "sobol"}) {
    const Points all = points_or_fail(plan_of(study_of(vary, method, 90)));
    const StudyPlan shorter = plan_of(study_of(vary, method, 40));
    Points joined = points_or_fail(shorter);
    const Points rest = points_or_fail(plan_of(study_of(vary, method, 90)), 40);
    joined.insert(joined.end(), rest.begin(), rest.end());
    EXPECT_EQ(joined, all) << method;
    EXPECT_EQ(all[89][1], 189.0);
  }
}

TEST(SamplePoints, AGridHasEveryCombination) {
  const StudyPlan plan = plan_of(
      "model = \"m.toml\"\n[sampling]\nmethod = \"grid\"\n[vary.x]\nkey = \"a\"\nvalues = [1, "
      "2]\n[vary.y]\nkey = \"b\"\nvalues = [3, 4, 5]\n[ask.f]\nof = \"limit\"\n");
  EXPECT_EQ(points_or_fail(plan), (Points{{1, 3}, {1, 4}, {1, 5}, {2, 3}, {2, 4}, {2, 5}}));
}

TEST(SamplePoints, OverridesHaveTheUnitOfTheFile) {
  StudyPlan plan;
  plan.vary.resize(2);
  plan.vary[0].keys = {"joints.a.cohesion", "joints.b.cohesion"};
  plan.vary[0].unit = "kPa";
  plan.vary[1].keys = {"joint_set.0.seed"};
  EXPECT_EQ(overrides_of(plan, {12.5, 7.0}),
            (std::vector<std::string>{"joints.a.cohesion=\"12.5 kPa\"",
                                      "joints.b.cohesion=\"12.5 kPa\"", "joint_set.0.seed=7"}));
}

TEST(SamplePoints, PointsComeBackFromTheirFile) {
  const StudyPlan plan =
      plan_of(study_of("distribution = \"normal\"\nmean = 0\nsd = 1", "monte-carlo", 20));
  const Points points = points_or_fail(plan);
  EXPECT_NE(points_csv(plan, points).find("x\n"), std::string::npos);
}

}  // namespace
}  // namespace edda
