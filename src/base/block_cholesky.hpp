// Sparse Cholesky factors of symmetric matrices that consist of dense blocks, as those of bodies
// that touch do: a block of rows for each body.
#pragma once

#include <cstddef>
#include <utility>
#include <vector>

namespace edda {

/// M = L L'. The rows of a block column of M and then of L are stored together, those of the
/// diagonal block first, column after column in the order of elimination; within a block column
/// scalar column after scalar column.
class BlockCholesky {
 public:
  using Pairs = std::vector<std::pair<int, int>>;  ///< rows and columns of blocks that are not 0

  BlockCholesky() = default;
  /// Chooses an order in which few blocks fill in. sides: the number of rows of each block row.
  /// couples: of different block rows, each once or more often, (r, c) or (c, r).
  BlockCholesky(const std::vector<int>& sides, const Pairs& couples);

  int size() const { return static_cast<int>(place_.size()); }
  /// The number of rows of all block rows.
  std::size_t lines() const { return line_.empty() ? 0 : line_.back(); }
  /// Whether block row r is eliminated no earlier than c, so that M has their block.
  bool is_lower(int r, int c) const { return place(r) >= place(c); }
  /// Where that block begins in `values`, and from one column of it to the next; it must be one of
  /// `couples` or on the diagonal.
  struct Block {
    std::size_t at, stride;
  };
  Block block_at(int r, int c) const;

  /// The lower triangle of M; of diagonal blocks all that is below the diagonal, too.
  std::vector<double> values;
  /// Replaces M by L. Rows that depend on others to all digits have a small diagonal instead, so
  /// that a right-hand side that they contradict makes the solution large there.
  void factorise();
  /// L L' x = b, in place, [lines()].
  void solve(double* x) const;
  /// Multiplications of these two.
  double making() const;
  double solving() const;

 private:
  struct Column;
  Column column(int k) const;
  void take(const Column& mine, const Column& other, std::size_t block,
            const std::vector<std::size_t>& at, std::vector<double>& room);
  int place(int r) const { return place_[static_cast<std::size_t>(r)]; }
  std::size_t side(int place) const {
    const auto p = static_cast<std::size_t>(place);
    return line_[p + 1] - line_[p];
  }
  void solve_in_order(double* x) const;

  std::vector<int> place_;          // [size] of each block row in the order of elimination
  std::vector<std::size_t> line_;   // [size + 1] the first line of each place
  std::vector<std::size_t> begin_;  // [size + 1] of the blocks of each column
  std::vector<int> row_;            // of each block
  std::vector<std::size_t> from_;   // its first row among those of its column
  std::vector<std::size_t> start_;  // [size + 1] of each column in values
};

}  // namespace edda
