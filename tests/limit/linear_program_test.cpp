#include "limit/linear_program.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#ifdef EDDA_HAS_CLP
#include "limit/clp.hpp"
#endif

namespace edda::linear_program_test {
namespace {

/// Largest by which a solution leaves its bounds and rows.
double violation(const LinearProgram& p, const std::vector<double>& x) {
  double worst = 0.0;
  std::vector<double> sum(p.rows(), 0.0);
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

/// max 3 x + 2 y, x + y <= 4, x + 3 y <= 7, 0 <= x <= 3, y free but for y >= 0.
LinearProgram small() {
  LinearProgram p;
  p.add_row(-no_bound, 4.0);
  p.add_row(-no_bound, 7.0);
  p.add_entry(0, 1.0);
  p.add_entry(1, 1.0);
  p.add_column(0.0, 3.0, 3.0);
  p.add_entry(0, 1.0);
  p.add_entry(1, 3.0);
  p.add_column(0.0, no_bound, 2.0);
  return p;
}

TEST(LinearProgram, OfTwoVariables) {
  const LinearAnswer a = solve(small());
  ASSERT_EQ(a.end, LinearEnd::optimal);
  EXPECT_NEAR(a.objective, 11.0, 1e-7);
  EXPECT_NEAR(a.value[0], 3.0, 1e-7);
  EXPECT_NEAR(a.value[1], 1.0, 1e-7);
  EXPECT_NEAR(a.price[0], 2.0, 1e-7);
  EXPECT_NEAR(a.price[1], 0.0, 1e-7);
}

TEST(LinearProgram, FreeFixedAndUpperBoundedVariables) {
  LinearProgram p;
  p.add_row(1.0, 2.0);  // 1 <= x + y + z <= 2
  p.add_row(5.0, 5.0);  // x - y = 5
  p.add_entry(0, 1.0);
  p.add_entry(1, 1.0);
  p.add_column(-no_bound, no_bound, 1.0);  // x
  p.add_entry(0, 1.0);
  p.add_entry(1, -1.0);
  p.add_column(-no_bound, -1.0, 0.0);  // y <= -1
  p.add_entry(0, 1.0);
  p.add_column(0.5, 0.5, 7.0);  // z = 0.5
  const LinearAnswer a = solve(p);
  ASSERT_EQ(a.end, LinearEnd::optimal);
  // x = y + 5 and 2 y + 5.5 <= 2: y = -1.75, x = 3.25.
  EXPECT_NEAR(a.value[0], 3.25, 1e-7);
  EXPECT_NEAR(a.value[1], -1.75, 1e-7);
  EXPECT_NEAR(a.value[2], 0.5, 1e-12);
  EXPECT_NEAR(a.objective, 3.25 + 3.5, 1e-7);
  const DualBound bound = dual_bound(p, a.price);
  EXPECT_NEAR(bound.value, a.objective, 1e-6);
  EXPECT_LT(bound.violation, 1e-7);
}

TEST(LinearProgram, SaysThatNothingIsFeasible) {
  LinearProgram p = small();
  p.row_lower[0] = 3.5;
  p.row_upper[1] = 3.0;  // x + 3 y <= 3, x + y >= 3.5, x <= 3
  EXPECT_EQ(solve(p).end, LinearEnd::infeasible);
}
TEST(LinearProgram, SaysThatThereIsNoMaximum) {
  LinearProgram p = small();
  p.row_upper = {no_bound, no_bound};
  p.row_lower = {0.0, 0.0};
  EXPECT_EQ(solve(p).end, LinearEnd::unbounded);
}

/// Sparse rows of equilibrium with free, bounded and one-sided variables, feasible by construction.
LinearProgram random_program(std::mt19937& rng, int rows, int columns) {
  std::uniform_real_distribution<double> u(-1.0, 1.0);
  LinearProgram p;
  std::vector<double> sum(static_cast<std::size_t>(rows), 0.0);
  for (int r = 0; r < rows; ++r) p.add_row(0.0, 0.0);
  for (int j = 0; j < columns; ++j) {
    const double at = u(rng);
    const int kind = j % 5;
    for (int q = 0; q < 4; ++q) {
      const int r = static_cast<int>(rng() % static_cast<unsigned>(rows));
      if (!p.row.empty() && p.begin.back() < static_cast<int>(p.row.size()) && p.row.back() == r)
        continue;
      const double entry = u(rng);
      p.add_entry(r, entry);
      sum[static_cast<std::size_t>(r)] += entry * at;
    }
    const double low = kind == 0 ? -no_bound : at - std::abs(u(rng));
    const double high = kind == 1 ? at + std::abs(u(rng)) : kind == 0 ? no_bound : at + 2.0;
    p.add_column(low, high, kind == 0 ? 0.0 : u(rng));
  }
  for (std::size_t r = 0; r < sum.size(); ++r) {
    p.row_lower[r] = r % 3 == 1 ? sum[r] - 0.1 : sum[r];
    p.row_upper[r] = r % 3 == 2 ? no_bound : sum[r];
  }
  return p;
}

TEST(LinearProgram, SolutionsAreFeasibleAndTheirPricesBoundThem) {
  std::mt19937 rng(5);
  int solved = 0;
  for (int n = 0; n < 200; ++n) {
    const LinearProgram p = random_program(rng, 3 + n % 20, 8 + n % 60);
    const LinearAnswer a = solve(p);
#ifdef EDDA_HAS_CLP
    const testing::ByClp other = testing::solved_by_clp(p);
    EXPECT_EQ(a.end, other.end) << n;
    if (other.end == LinearEnd::optimal) {
      EXPECT_NEAR(a.objective, other.objective, 1e-7 * (1.0 + std::abs(other.objective))) << n;
    }
#endif
    if (a.end != LinearEnd::optimal) continue;
    ++solved;
    EXPECT_LT(violation(p, a.value), 1e-7) << n;
    const DualBound bound = dual_bound(p, a.price);
    EXPECT_NEAR(bound.value, a.objective, 1e-6 * (1.0 + std::abs(a.objective))) << n;
    EXPECT_LT(bound.violation, 1e-6) << n;
  }
  EXPECT_GT(solved, 150);
}

}  // namespace
}  // namespace edda::linear_program_test
