#include "base/columns.hpp"

#include <gtest/gtest.h>

namespace edda {
namespace {

template <class C>
struct Pair {
  C first, second;
};
template <class C>
struct PairField {
  C Pair<C>::*values;
};
template <class C>
inline constexpr PairField<C> pair_fields[] = {{&Pair<C>::first}, {&Pair<C>::second}};
using Pairs = RowTable<Pair<RowColumn>, pair_fields<RowColumn>>;

Pairs counted(std::size_t rows) {
  Pairs pairs;
  pairs.clear_rows(rows);
  for (std::size_t row = 0; row < rows; ++row) {
    pairs.first[row] = static_cast<double>(row);
    pairs.second[row] = 0.5 + static_cast<double>(row);
  }
  return pairs;
}

TEST(RowTable, HasEveryRowOfEveryColumnOnce) {
  const Pairs pairs = counted(37);
  ASSERT_EQ(pairs.rows(), 37u);
  for (std::size_t row = 0; row < 37; ++row) {
    EXPECT_EQ(pairs.first[row], static_cast<double>(row));
    EXPECT_EQ(pairs.second[row], 0.5 + static_cast<double>(row));
  }
}

TEST(RowTable, CopiesARowOfAnother) {
  Pairs a = counted(37);
  const Pairs b = counted(40);
  a.copy_row(3, b, 38);
  for (std::size_t row = 0; row < 37; ++row) {
    const auto was = static_cast<double>(row);
    EXPECT_EQ(a.first[row], row == 3 ? 38.0 : was);
    EXPECT_EQ(a.second[row], 0.5 + (row == 3 ? 38.0 : was));
  }
}

/// A copy's columns are its own.
TEST(RowTable, IsCopiedMovedAndSwappedWithItsColumns) {
  Pairs a = counted(20), b = counted(3);
  Pairs copy = a;
  copy.first[19] = -1.0;
  EXPECT_EQ(a.first[19], 19.0);
  EXPECT_EQ(copy.first[19], -1.0);
  std::swap(a, b);
  EXPECT_EQ(a.rows(), 3u);
  EXPECT_EQ(b.second[19], 19.5);
  b.second[19] = 7.0;
  const Pairs moved = std::move(b);
  EXPECT_EQ(moved.second[19], 7.0);
  a = moved;
  a.second[19] = 8.0;
  EXPECT_EQ(moved.second[19], 7.0);
}

TEST(RowColumn, IsTakenAndFilledAsAWhole) {
  Pairs pairs = counted(18);
  std::vector<double> values = pairs.first.values();
  ASSERT_EQ(values.size(), 18u);
  values[17] = 3.0;
  pairs.second.take(values);
  EXPECT_EQ(pairs.second.values(), values);
  pairs.first.fill(2.0);
  EXPECT_EQ(pairs.first.values(), std::vector<double>(18, 2.0));
  EXPECT_EQ(pairs.second[17], 3.0);
}

}  // namespace
}  // namespace edda
