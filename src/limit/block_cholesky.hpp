// Sparse Cholesky factors of symmetric matrices that consist of blocks of 3 x 3, as those of rigid
// bodies in the plane do.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace edda {

/// M = L L'. Blocks of M and then of L are stored row by row in `values`, column by column of the
/// order of elimination, the diagonal one first.
class BlockCholesky {
 public:
  static constexpr int side = 3;
  static constexpr int area = side * side;
  using Pairs = std::vector<std::pair<int, int>>;  ///< rows and columns of blocks that are not 0

  /// Chooses an order in which few blocks fill in. couples: of different rows, each once or more
  /// often, (r, c) or (c, r).
  BlockCholesky(int size, const Pairs& couples);

  int size() const { return static_cast<int>(place_.size()); }
  /// Row r in the order of elimination.
  int place(int r) const { return place_[static_cast<std::size_t>(r)]; }
  /// Where the block of two places, the first no less than the second, is in `values`; it must be
  /// one of `couples` or on the diagonal.
  std::size_t block_at(int row, int column) const;

  /// The lower triangle of M; of diagonal blocks all that is below the diagonal, too.
  std::vector<double> values;
  /// Replaces M by L. Rows that depend on others to all digits have a small diagonal instead, so
  /// that a right-hand side that they contradict makes the solution large there.
  void factorise();
  /// L L' x = b, in place; [side size()] in the order of elimination.
  void solve(double* x) const;

 private:
  void take_column(int j, int k, const std::vector<std::size_t>& at);
  void end_column(int k, const double* given);

  std::vector<int> place_;
  std::vector<std::size_t> begin_;  // [size + 1] of the blocks of each column
  std::vector<int> row_;            // of each block
};

}  // namespace edda
