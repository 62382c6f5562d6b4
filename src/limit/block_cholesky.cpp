#include "limit/block_cholesky.hpp"

#include <Eigen/OrderingMethods>
#include <Eigen/SparseCore>
#include <algorithm>
#include <cmath>

namespace edda {
namespace {

std::vector<int> few_fill_ins(int size, const BlockCholesky::Pairs& couples) {
  std::vector<Eigen::Triplet<double>> entries;
  for (int r = 0; r < size; ++r) entries.emplace_back(r, r, 1.0);
  for (const auto& [r, c] : couples) {
    entries.emplace_back(r, c, 1.0);
    entries.emplace_back(c, r, 1.0);
  }
  Eigen::SparseMatrix<double> pattern(size, size);
  pattern.setFromTriplets(entries.begin(), entries.end());
  Eigen::PermutationMatrix<Eigen::Dynamic, Eigen::Dynamic, int> order;
  Eigen::AMDOrdering<int>()(pattern.selfadjointView<Eigen::Lower>(), order);
  std::vector<int> place(static_cast<std::size_t>(size));
  for (int p = 0; p < size; ++p) place[static_cast<std::size_t>(order.indices()[p])] = p;
  return place;
}

}  // namespace

BlockCholesky::BlockCholesky(int size, const Pairs& couples) : place_(few_fill_ins(size, couples)) {
  const auto n = static_cast<std::size_t>(size);
  std::vector<std::vector<int>> rows(n);  // below the diagonal
  for (const auto& [r, c] : couples) {
    const auto [low, high] = std::minmax({place(r), place(c)});
    if (low != high) rows[static_cast<std::size_t>(low)].push_back(high);
  }
  begin_.push_back(0);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<int>& mine = rows[k];
    std::sort(mine.begin(), mine.end());
    mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
    row_.push_back(static_cast<int>(k));
    row_.insert(row_.end(), mine.begin(), mine.end());
    begin_.push_back(row_.size());
    // What is below the first of them fills in there: its parent in the tree of elimination.
    if (mine.empty()) continue;
    std::vector<int>& parent = rows[static_cast<std::size_t>(mine.front())];
    parent.insert(parent.end(), mine.begin() + 1, mine.end());
    mine = {};
  }
  values.assign(row_.size() * area, 0.0);
}

std::size_t BlockCholesky::block_at(int row, int column) const {
  const auto c = static_cast<std::size_t>(column);
  const auto first = row_.begin() + static_cast<std::ptrdiff_t>(begin_[c]);
  const auto last = row_.begin() + static_cast<std::ptrdiff_t>(begin_[c + 1]);
  return static_cast<std::size_t>(std::lower_bound(first, last, row) - row_.begin()) * area;
}

/// Column k less the part of column j, of which blocks from q on are at or below row k.
void BlockCholesky::take_column(int j, int q, const std::vector<std::size_t>& at) {
  const auto first = static_cast<std::size_t>(q);
  const double* const of_k = &values[first * area];
  for (std::size_t b = first; b < begin_[static_cast<std::size_t>(j) + 1]; ++b) {
    double* const to = &values[at[static_cast<std::size_t>(row_[b])] * area];
    const double* const from = &values[b * area];
    for (int r = 0; r < side; ++r) {
      for (int c = 0; c < side; ++c)
        to[side * r + c] -= from[side * r] * of_k[side * c] +
                            from[side * r + 1] * of_k[side * c + 1] +
                            from[side * r + 2] * of_k[side * c + 2];
    }
  }
}

/// The diagonal block's own factor, and the blocks below it behind that.
void BlockCholesky::end_column(int k, const double* given) {
  constexpr double no_digit = 1e-14, instead = 1e-10;
  const auto column = static_cast<std::size_t>(k);
  double* const d = &values[begin_[column] * area];
  double inverse[side];
  for (int c = 0; c < side; ++c) {
    double pivot = d[side * c + c];
    for (int q = 0; q < c; ++q) pivot -= d[side * c + q] * d[side * c + q];
    if (!(pivot > no_digit * given[c])) pivot = instead * (given[c] > 0.0 ? given[c] : 1.0);
    const double root = std::sqrt(pivot);
    d[side * c + c] = root;
    inverse[c] = 1.0 / root;
    for (int r = c + 1; r < side; ++r) {
      double sum = d[side * r + c];
      for (int q = 0; q < c; ++q) sum -= d[side * r + q] * d[side * c + q];
      d[side * r + c] = sum * inverse[c];
    }
  }
  for (std::size_t b = begin_[column] + 1; b < begin_[column + 1]; ++b) {
    double* const l = &values[b * area];
    for (int r = 0; r < side; ++r) {
      double* const row = l + side * r;
      row[0] *= inverse[0];
      row[1] = (row[1] - row[0] * d[3]) * inverse[1];
      row[2] = (row[2] - row[0] * d[6] - row[1] * d[7]) * inverse[2];
    }
  }
}

void BlockCholesky::factorise() {
  const auto n = place_.size();
  constexpr int nothing = -1;
  // Columns whose next block is in the row of a column, linked from there.
  std::vector<int> first_waiting(n, nothing), next_waiting(n, nothing), block_of(n, 0);
  std::vector<std::size_t> at(n, 0);
  const auto wait = [&](int j, std::size_t block) {
    if (block == begin_[static_cast<std::size_t>(j) + 1]) return;
    const auto row = static_cast<std::size_t>(row_[block]);
    block_of[static_cast<std::size_t>(j)] = static_cast<int>(block);
    next_waiting[static_cast<std::size_t>(j)] = first_waiting[row];
    first_waiting[row] = j;
  };
  for (std::size_t k = 0; k < n; ++k) {
    for (std::size_t b = begin_[k]; b < begin_[k + 1]; ++b)
      at[static_cast<std::size_t>(row_[b])] = b;
    const double* const d = &values[begin_[k] * area];
    const double given[side] = {d[0], d[4], d[8]};
    for (int j = first_waiting[k]; j != nothing;) {
      const auto column = static_cast<std::size_t>(j);
      const int next = next_waiting[column];
      take_column(j, block_of[column], at);
      wait(j, static_cast<std::size_t>(block_of[column]) + 1);
      j = next;
    }
    end_column(static_cast<int>(k), given);
    wait(static_cast<int>(k), begin_[k] + 1);
  }
}

void BlockCholesky::solve(double* x) const {
  for (std::size_t k = 0; k < place_.size(); ++k) {
    const double* const d = &values[begin_[k] * area];
    double* const y = x + side * k;
    y[0] /= d[0];
    y[1] = (y[1] - d[3] * y[0]) / d[4];
    y[2] = (y[2] - d[6] * y[0] - d[7] * y[1]) / d[8];
    for (std::size_t b = begin_[k] + 1; b < begin_[k + 1]; ++b) {
      const double* const l = &values[b * area];
      double* const z = x + side * row_[b];
      for (int r = 0; r < side; ++r)
        z[r] -= l[side * r] * y[0] + l[side * r + 1] * y[1] + l[side * r + 2] * y[2];
    }
  }
  for (std::size_t k = place_.size(); k-- > 0;) {
    const double* const d = &values[begin_[k] * area];
    double* const y = x + side * k;
    for (std::size_t b = begin_[k] + 1; b < begin_[k + 1]; ++b) {
      const double* const l = &values[b * area];
      const double* const z = x + side * row_[b];
      for (int c = 0; c < side; ++c)
        y[c] -= l[c] * z[0] + l[side + c] * z[1] + l[2 * side + c] * z[2];
    }
    y[2] /= d[8];
    y[1] = (y[1] - d[7] * y[2]) / d[4];
    y[0] = (y[0] - d[3] * y[1] - d[6] * y[2]) / d[0];
  }
}

}  // namespace edda
