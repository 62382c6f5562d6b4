#include "base/block_cholesky.hpp"

#include <Eigen/Dense>
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

using Rows = Eigen::Map<Eigen::MatrixXd>;
using ConstRows = Eigen::Map<const Eigen::MatrixXd>;
using Line = Eigen::Map<Eigen::VectorXd>;

Eigen::Index index(std::size_t k) {
  return static_cast<Eigen::Index>(k);
}

std::vector<double> diagonal_of(const Rows& rows) {
  std::vector<double> diagonal;
  for (Eigen::Index c = 0; c < rows.cols(); ++c) diagonal.push_back(rows(c, c));
  return diagonal;
}

/// The factor of a diagonal block in place, and what it leaves of the rows below it.
void end_column(Rows rows, const std::vector<double>& given) {
  constexpr double no_digit = 1e-14, instead = 1e-10;
  const Eigen::Index side = rows.cols();
  for (Eigen::Index c = 0; c < side; ++c) {
    auto below = rows.col(c).tail(rows.rows() - c);
    for (Eigen::Index q = 0; q < c; ++q) below -= rows(c, q) * rows.col(q).tail(below.size());
    double pivot = below[0];
    const double whole = given[static_cast<std::size_t>(c)];
    if (!(pivot > no_digit * whole)) pivot = instead * (whole > 0.0 ? whole : 1.0);
    below *= 1.0 / std::sqrt(pivot);
    below[0] = std::sqrt(pivot);
  }
}

/// Columns whose next block is in the row of a column, linked from there.
struct Waiting {
  static constexpr int nothing = -1;
  std::vector<int> first, next;    // [size] of each row; of each column
  std::vector<std::size_t> block;  // [size] that next block
  explicit Waiting(std::size_t n) : first(n, nothing), next(n, nothing), block(n, 0) {}
  void add(int column, int row, std::size_t b) {
    block[static_cast<std::size_t>(column)] = b;
    next[static_cast<std::size_t>(column)] = first[static_cast<std::size_t>(row)];
    first[static_cast<std::size_t>(row)] = column;
  }
};

}  // namespace

/// A block column: its blocks, and the height of all their rows.
struct BlockCholesky::Column {
  std::size_t begin, end, start, height, side;
};
BlockCholesky::Column BlockCholesky::column(int k) const {
  const auto c = static_cast<std::size_t>(k);
  const std::size_t wide = side(k), size = start_[c + 1] - start_[c];
  return {begin_[c], begin_[c + 1], start_[c], size / wide, wide};
}

BlockCholesky::BlockCholesky(const std::vector<int>& sides, const Pairs& couples)
    : place_(few_fill_ins(static_cast<int>(sides.size()), couples)) {
  const std::size_t n = sides.size();
  line_.assign(n + 1, 0);
  for (std::size_t r = 0; r < n; ++r)
    line_[static_cast<std::size_t>(place_[r]) + 1] = static_cast<std::size_t>(sides[r]);
  for (std::size_t p = 0; p < n; ++p) line_[p + 1] += line_[p];
  std::vector<std::vector<int>> rows(n);  // below the diagonal
  for (const auto& [r, c] : couples) {
    const auto [low, high] = std::minmax({place(r), place(c)});
    if (low != high) rows[static_cast<std::size_t>(low)].push_back(high);
  }
  begin_.push_back(0);
  start_.push_back(0);
  for (std::size_t k = 0; k < n; ++k) {
    std::vector<int>& mine = rows[k];
    std::sort(mine.begin(), mine.end());
    mine.erase(std::unique(mine.begin(), mine.end()), mine.end());
    row_.push_back(static_cast<int>(k));
    row_.insert(row_.end(), mine.begin(), mine.end());
    begin_.push_back(row_.size());
    std::size_t height = 0;
    for (std::size_t b = begin_[k]; b < begin_[k + 1]; ++b) {
      from_.push_back(height);
      height += side(row_[b]);
    }
    start_.push_back(start_.back() + height * side(static_cast<int>(k)));
    // What is below the first of them fills in there: its parent in the tree of elimination.
    if (mine.empty()) continue;
    std::vector<int>& parent = rows[static_cast<std::size_t>(mine.front())];
    parent.insert(parent.end(), mine.begin() + 1, mine.end());
    mine = {};
  }
  values.assign(start_.back(), 0.0);
}

BlockCholesky::Block BlockCholesky::block_at(int r, int of) const {
  const int row = place(r);
  const Column c = column(place(of));
  const auto first = row_.begin() + static_cast<std::ptrdiff_t>(c.begin);
  const auto last = row_.begin() + static_cast<std::ptrdiff_t>(c.end);
  const auto b = static_cast<std::size_t>(std::lower_bound(first, last, row) - row_.begin());
  return {c.start + from_[b], c.height};
}

void BlockCholesky::factorise() {
  Waiting waiting(place_.size());
  std::vector<std::size_t> at(place_.size(), 0);
  std::vector<double> room;
  for (int k = 0; k < size(); ++k) {
    const Column mine = column(k);
    Rows rows(&values[mine.start], index(mine.height), index(mine.side));
    const std::vector<double> given = diagonal_of(rows);
    for (std::size_t b = mine.begin; b < mine.end; ++b)
      at[static_cast<std::size_t>(row_[b])] = from_[b];
    const auto wait = [&](int j, std::size_t b, std::size_t end) {
      if (b < end) waiting.add(j, row_[b], b);
    };
    for (int j = waiting.first[static_cast<std::size_t>(k)]; j != Waiting::nothing;) {
      const int next = waiting.next[static_cast<std::size_t>(j)];
      const Column other = column(j);
      const std::size_t block = waiting.block[static_cast<std::size_t>(j)];
      take(mine, other, block, at, room);
      wait(j, block + 1, other.end);
      j = next;
    }
    end_column(rows, given);
    wait(k, mine.begin + 1, mine.end);
  }
}

/// Column `mine` less the part of another, whose blocks from `block` on are at or below its first
/// row. at: where rows are in `mine`.
void BlockCholesky::take(const Column& mine, const Column& other, std::size_t block,
                         const std::vector<std::size_t>& at, std::vector<double>& room) {
  Rows rows(&values[mine.start], index(mine.height), index(mine.side));
  const std::size_t above = from_[block], left = other.height - above;
  const ConstRows all(&values[other.start], index(other.height), index(other.side));
  const auto lower = all.bottomRows(index(left));
  room.resize(std::max(room.size(), left * mine.side));
  Rows product(room.data(), index(left), index(mine.side));
  product.noalias() = lower.lazyProduct(lower.topRows(index(mine.side)).transpose());
  for (std::size_t b = block; b < other.end; ++b) {
    const Eigen::Index high = index(side(row_[b]));
    rows.middleRows(index(at[static_cast<std::size_t>(row_[b])]), high) -=
        product.middleRows(index(from_[b] - above), high);
  }
}

void BlockCholesky::solve_in_order(double* x) const {
  std::vector<double> room;
  const auto of_rows = [&](const Column& c) {
    room.resize(std::max(room.size(), c.height));
    return Line(room.data(), index(c.height - c.side));
  };
  const auto rows_of = [&](const Column& c) {
    return ConstRows(&values[c.start], index(c.height), index(c.side));
  };
  for (int k = 0; k < size(); ++k) {
    const Column c = column(k);
    const ConstRows rows = rows_of(c);
    Line y(x + line_[static_cast<std::size_t>(k)], index(c.side));
    rows.topRows(y.size()).triangularView<Eigen::Lower>().solveInPlace(y);
    Line below = of_rows(c);
    below.noalias() = rows.bottomRows(below.size()) * y;
    for (std::size_t b = c.begin + 1; b < c.end; ++b) {
      const Eigen::Index high = index(side(row_[b]));
      Line(x + line_[static_cast<std::size_t>(row_[b])], high) -=
          below.segment(index(from_[b] - c.side), high);
    }
  }
  for (int k = size(); k-- > 0;) {
    const Column c = column(k);
    const ConstRows rows = rows_of(c);
    Line y(x + line_[static_cast<std::size_t>(k)], index(c.side));
    Line below = of_rows(c);
    for (std::size_t b = c.begin + 1; b < c.end; ++b) {
      const Eigen::Index high = index(side(row_[b]));
      below.segment(index(from_[b] - c.side), high) =
          Line(x + line_[static_cast<std::size_t>(row_[b])], high);
    }
    y.noalias() -= rows.bottomRows(below.size()).transpose() * below;
    rows.topRows(y.size()).triangularView<Eigen::Lower>().transpose().solveInPlace(y);
  }
}

void BlockCholesky::solve(double* x) const {
  std::vector<double> in_order(lines());
  const auto each = [&](auto body) {  // body(line in x, line in order, how many)
    std::size_t line = 0;
    for (const int p : place_) {
      body(line, line_[static_cast<std::size_t>(p)], side(p));
      line += side(p);
    }
  };
  each([&](std::size_t from, std::size_t to, std::size_t n) {
    std::copy_n(x + from, n, &in_order[to]);
  });
  solve_in_order(in_order.data());
  each([&](std::size_t to, std::size_t from, std::size_t n) {
    std::copy_n(&in_order[from], n, x + to);
  });
}

double BlockCholesky::making() const {
  double sum = 0.0;
  for (int k = 0; k < size(); ++k) {
    const Column c = column(k);
    sum +=
        static_cast<double>(c.side) * static_cast<double>(c.height) * static_cast<double>(c.height);
  }
  return sum;
}

double BlockCholesky::solving() const {
  return 2.0 * static_cast<double>(values.size());
}

}  // namespace edda
