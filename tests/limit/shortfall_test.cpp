// How far loads are from an equilibrium, beside other bodies of any weight.
#include <gtest/gtest.h>

#include <random>

#include "limit/force_program.hpp"
#include "limit/rigid_model.hpp"

namespace edda::shortfall_test {
namespace {

using testing::Rigid;
using testing::stone;

/// Places and rectangles on a plane of 30 degrees.
std::string at(double along, double up) {
  const double s = 0.5, c = std::sqrt(0.75);
  return fmt::format("[{:.15g}, {:.15g}]", along * c - up * s, along * s + up * c);
}
std::string rectangle(double x0, double y0, double x1, double y1) {
  return fmt::format("[[block]]\npolygon = [{}, {}, {}, {}]\n", at(x0, y0), at(x1, y0), at(x1, y1),
                     at(x0, y1));
}
std::string plane(double size) {
  return "[[block]]\nfixed = true\npolygon = [" + at(-size, -size) + ", " + at(size, -size) + ", " +
         at(size, 0) + ", " + at(-size, 0) + "]\n";
}

Shortfall shortfall_of(const Rigid& model) {
  return shortfall(model.problem, std::vector<char>(model.blocks.joints.size(), 1));
}

/// Along the plane W sin(a) = mu (W cos(a) + 2 m W) with the tension m W of each end; the mechanism
/// slides by 1 and rises by mu, on which the loads do the work W (sin(a) - mu cos(a)).
TEST(Shortfall, OfABlockOnAPlane) {
  const double s = 0.5, c = std::sqrt(0.75);
  for (const double mu : {0.2, 0.4, 0.57, 0.58, 0.7}) {
    Rigid model(stone(mu) + plane(20) + rectangle(-4, 0, 4, 1));
    model.problem.live = model.problem.dead;
    const Shortfall found = shortfall_of(model);
    ASSERT_TRUE(found.solved);
    EXPECT_EQ(found.holds(), mu > s / c) << mu;
    EXPECT_NEAR(found.tension, (s - mu * c) / (2.0 * mu), 1e-8) << mu;
    if (found.holds()) {
      EXPECT_LT(model.out_of_balance(found.state, 0.0), 1e-7 * model.blocks.force);
    } else {
      EXPECT_NEAR(found.excess, (s - mu * c) / std::hypot(1.0, mu), 1e-7) << mu;
      EXPECT_LT(found.state.violation, 1e-7);
      EXPECT_LT(found.state.motion[0].velocity.x, 0.0);
    }
  }
}

/// Without friction |T| <= s + 2 m W, and with neither of them the tension is the same.
TEST(Shortfall, WithoutFriction) {
  const double weight = 2000.0 * 9.81 * 8.0;
  for (const double cohesion : {0.0, 2e3, 1e5}) {
    const Rigid model(stone(0.0, fmt::format("cohesion = {}\n", cohesion)) + plane(20) +
                      rectangle(-4, 0, 4, 1));
    const Shortfall found = shortfall_of(model);
    ASSERT_TRUE(found.solved);
    const double missing = (0.5 * weight - 8.0 * cohesion) / (2.0 * weight);
    if (missing > 0.0) {
      EXPECT_NEAR(found.tension, missing, 1e-8);
    }
    EXPECT_EQ(found.holds(), missing <= 0.0);
  }
}

/// A block that overhangs its one corner turns about it whatever the joints carry.
TEST(Shortfall, IsHopelessWhereNoStrengthHelps) {
  const Rigid model(stone(0.9) + testing::table + "[[block]]\npolygon = [[4,0],[5,1],[4.5,2]]\n");
  const Shortfall found = shortfall_of(model);
  ASSERT_TRUE(found.solved);
  EXPECT_TRUE(found.hopeless);
  EXPECT_FALSE(found.holds());
  ASSERT_EQ(found.state.motion.size(), 1u);
  EXPECT_LT(found.state.motion[0].spin, 0.0);
  EXPECT_GT(found.excess, 0.01);
}

TEST(Shortfall, OfNothingAtAll) {
  const Rigid model(stone(0.9) + testing::table);
  EXPECT_EQ(model.blocks.bodies(), 0u);
  EXPECT_TRUE(shortfall_of(model).holds());
}

/// A block of 1 m on, below or above one of up to 1e9 times its weight, and one as heavy without
/// anything between: what fails and at which factor does not depend on what else there is.
TEST(Shortfall, ABlockIsJudgedByItsOwnWeight) {
  const double exact = 0.7 / std::tan(std::numbers::pi / 6.0);
  for (const double ratio : {1.0, 1e3, 1e6, 1e9}) {
    const double big = std::sqrt(ratio);
    const std::string ground = stone(0.7) + plane(20 * big) + rectangle(-big, 0, big, big);
    for (const std::string& small :
         {rectangle(-1, big, 1, big + 1), rectangle(-big - 2, 0, -big, 1),
          rectangle(big, 0, big + 2, 1), rectangle(3 * big, 0, 3 * big + 2, 1)}) {
      const StrengthFactor f = Rigid(ground + small).factor_of_strength();
      ASSERT_EQ(f.end, LimitEnd::found) << ratio;
      EXPECT_NEAR(f.holds, exact, 2e-6 * exact) << ratio << small;
      EXPECT_LE(f.fails - f.holds, 1e-6 * f.fails) << ratio;
    }
  }
}

/// Columns of blocks of random height and density, 1 to 1e4 kg/m3, on each other and between walls.
std::string random_pile(std::mt19937& rng) {
  std::uniform_real_distribution<double> u(0.0, 1.0);
  std::string text = "[solver]\nduration = 1\n";
  for (int k = 0; k < 5; ++k)
    text += fmt::format("[materials.m{}]\ndensity = {}\nyoung = 1e10\npoisson = 0.2\n", k,
                        std::pow(10.0, k));
  text += fmt::format("[joints.dry]\nfriction_angle = {}\ncohesion = {}\n", 10.0 + 40.0 * u(rng),
                      u(rng) < 0.5 ? 0.0 : 1e4 * u(rng));
  text += "[[block]]\nmaterial = \"m0\"\nfixed = true\npolygon = [[-9,-1],[9,-1],[9,0],[-9,0]]\n";
  for (int x = 0; x < 4; ++x) {
    double y = 0.0;
    for (int row = 0; row < 4; ++row) {
      const double h = 0.3 + u(rng);
      text += fmt::format(
          "[[block]]\nmaterial = \"m{}\"\npolygon = [[{x},{y}],[{r},{y}],[{r},{t}],[{x},{t}]]\n",
          rng() % 5, fmt::arg("x", x), fmt::arg("r", x + 1), fmt::arg("y", y),
          fmt::arg("t", y + h));
      y += h;
    }
  }
  return text;
}

/// Largest force by which a solution leaves its rows and bounds, in units of the program.
double out_of_bounds(const LinearProgram& p, const std::vector<double>& x) {
  std::vector<double> sum(p.rows(), 0.0);
  double worst = 0.0;
  for (std::size_t j = 0; j < p.columns(); ++j) {
    worst = std::max({worst, p.lower[j] - x[j], x[j] - p.upper[j]});
    for (int q = p.begin[j]; q < p.begin[j + 1]; ++q) {
      const auto at = static_cast<std::size_t>(q);
      sum[static_cast<std::size_t>(p.row[at])] += p.entry[at] * x[j];
    }
  }
  for (std::size_t r = 0; r < sum.size(); ++r)
    worst = std::max({worst, p.row_lower[r] - sum[r], sum[r] - p.row_upper[r]});
  return worst;
}

/// Forces that are within their bounds and a mechanism with the same value prove each other, by
/// weak duality, whatever the solver has done. (CLP's simplex method claims larger tensions to be
/// the least of some of these programs; the forces found here show that they are not.)
TEST(Shortfall, ForcesAndMechanismProveEachOther) {
  std::mt19937 rng(11);
  int holding = 0;
  for (int n = 0; n < 30; ++n) {
    Rigid model(random_pile(rng));
    const double kh = 0.02 * n;
    model.problem.dead =
        weights_under(model.blocks, model.sim(), model.gravity() + kh * perp(model.gravity()));
    ForceProgram program(model.problem, {}, ForceProgram::Asks::tension);
    program.add_asked(-1.0);
    const LinearAnswer answer = solve(program.program);
    ASSERT_EQ(answer.end, LinearEnd::optimal) << n;
    EXPECT_LT(out_of_bounds(program.program, answer.value), 1e-5) << n;
    const DualBound bound = dual_bound(program.program, answer.price);
    EXPECT_NEAR(bound.value, answer.objective, 1e-6) << n;
    EXPECT_LT(bound.violation, 1e-9) << n;
    const Shortfall found = shortfall_of(model);
    EXPECT_NEAR(found.tension, -answer.objective, 1e-12) << n;
    holding += found.holds() ? 1 : 0;
    EXPECT_EQ(found.excess > 0.0, !found.holds()) << n;
  }
  EXPECT_GT(holding, 10);
  EXPECT_LT(holding, 29);
}

}  // namespace
}  // namespace edda::shortfall_test
