#include "limit/normal_equations.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace edda {
namespace {

constexpr int block_side = 3;  // of the equations of a body
/// delta.
constexpr double inertia = 1e-5;
using Matrix = Eigen::SparseMatrix<double>;

int blocks_of(const StandardForm& p) {
  return (static_cast<int>(p.a.rows()) + block_side - 1) / block_side;
}

bool has_few_entries(const StandardForm& p, Eigen::Index j) {
  constexpr int few = 12;
  return p.a.col(j).nonZeros() <= few;
}

bool is_free(const StandardForm& p, Eigen::Index j) {
  return p.free[static_cast<std::size_t>(j)] != 0;
}

/// Blocks of rows that have a column of M in common.
BlockCholesky::Pairs couples_of(const StandardForm& p) {
  BlockCholesky::Pairs pairs;
  std::vector<int> rows;
  for (Eigen::Index j = 0; j < p.a.cols(); ++j) {
    if (!has_few_entries(p, j)) continue;
    rows.clear();
    for (Matrix::InnerIterator e(p.a, j); e; ++e)
      rows.push_back(static_cast<int>(e.row()) / block_side);
    rows.erase(std::unique(rows.begin(), rows.end()), rows.end());
    for (std::size_t a = 0; a < rows.size(); ++a) {
      for (std::size_t b = a + 1; b < rows.size(); ++b) pairs.emplace_back(rows[b], rows[a]);
    }
  }
  std::sort(pairs.begin(), pairs.end());
  pairs.erase(std::unique(pairs.begin(), pairs.end()), pairs.end());
  return pairs;
}

}  // namespace

NormalEquations::NormalEquations(const StandardForm& p)
    : p_(p),
      factors_(std::vector<int>(static_cast<std::size_t>(blocks_of(p)), block_side),
               couples_of(p)) {
  for (Eigen::Index j = 0; j < p.a.cols(); ++j) {
    if (is_free(p, j) || !has_few_entries(p, j)) beside_columns_.push_back(j);
  }
  inverse_ = Vector::Zero(p.a.cols());
  find_places();
}

void NormalEquations::find_places() {
  const auto entry = [&](Eigen::Index e, Eigen::Index f) {  // in the lower triangle
    const int r = static_cast<int>(e), c = static_cast<int>(f);
    const auto [at, stride] = factors_.block_at(r / block_side, c / block_side);
    return at + static_cast<std::size_t>(r % block_side) +
           stride * static_cast<std::size_t>(c % block_side);
  };
  for (Eigen::Index j = 0; j < p_.a.cols(); ++j) {
    if (!has_few_entries(p_, j)) continue;
    for (Matrix::InnerIterator e(p_.a, j); e; ++e) {
      for (Matrix::InnerIterator f(p_.a, j); f && f.row() <= e.row(); ++f) {
        const bool lower = factors_.is_lower(static_cast<int>(e.row()) / block_side,
                                             static_cast<int>(f.row()) / block_side);
        target_.push_back(lower ? entry(e.row(), f.row()) : entry(f.row(), e.row()));
      }
    }
  }
}

void NormalEquations::factorise(const Vector& theta) {
  std::fill(factors_.values.begin(), factors_.values.end(), 0.0);
  std::size_t next = 0;
  for (Eigen::Index j = 0; j < p_.a.cols(); ++j) {
    if (!has_few_entries(p_, j)) continue;
    if (!is_free(p_, j)) inverse_[j] = 1.0 / theta[j];
    const double weight = is_free(p_, j) ? 1.0 : inverse_[j];
    for (Matrix::InnerIterator e(p_.a, j); e; ++e) {
      const double scaled = e.value() * weight;
      for (Matrix::InnerIterator f(p_.a, j); f && f.row() <= e.row(); ++f)
        factors_.values[target_[next++]] += scaled * f.value();
    }
  }
  for (int r = 0; r < factors_.size(); ++r) {
    const auto [at, stride] = factors_.block_at(r, r);
    for (std::size_t c = 0; c < block_side; ++c) factors_.values[at + (stride + 1) * c] += inertia;
  }
  factors_.factorise();
  if (beside_columns_.empty()) return;
  const auto count = static_cast<Eigen::Index>(beside_columns_.size());
  beside_.resize(p_.a.rows(), count);
  theta_.resize(count);
  Eigen::MatrixXd small(count, count);
  for (Eigen::Index f = 0; f < count; ++f) {
    const Eigen::Index j = beside_columns_[static_cast<std::size_t>(f)];
    beside_.col(f) = by_factors(p_.a.col(j));
    theta_[f] = is_free(p_, j) ? 0.0 : theta[j];
  }
  // A column without entries is as large as may be.
  constexpr double little = 1e-8;
  for (Eigen::Index f = 0; f < count; ++f) {
    small.row(f) = p_.a.col(beside_columns_[static_cast<std::size_t>(f)]).transpose() * beside_;
    small(f, f) += theta_[f];
    if (!(small(f, f) > 0.0)) small(f, f) = little;
  }
  small_.compute(small);
}

Eigen::VectorXd NormalEquations::by_factors(const Vector& right) const {
  Vector all = Vector::Zero(static_cast<Eigen::Index>(factors_.lines()));
  all.head(right.size()) = right;
  factors_.solve(all.data());
  return all.head(right.size());
}

NormalEquations::Step NormalEquations::solve_once(const Vector& of_rows,
                                                  const Vector& of_beside) const {
  Vector right = of_rows;
  for (std::size_t f = 0; f < beside_columns_.size(); ++f) {
    const Eigen::Index j = beside_columns_[f];
    if (is_free(p_, j) && has_few_entries(p_, j))
      right += of_beside[static_cast<Eigen::Index>(f)] * p_.a.col(j);
  }
  Step s{by_factors(right), Vector::Zero(of_beside.size())};
  if (beside_columns_.empty()) return s;
  Vector rest = -of_beside;
  for (std::size_t f = 0; f < beside_columns_.size(); ++f)
    rest[static_cast<Eigen::Index>(f)] += p_.a.col(beside_columns_[f]).dot(s.y);
  s.beside = small_.solve(rest);
  s.y -= beside_ * s.beside;
  return s;
}

void NormalEquations::solve(const Vector& p, const Vector& q, Vector& x, Vector& y) const {
  const auto count = static_cast<Eigen::Index>(beside_columns_.size());
  Vector of_beside(count), beside = Vector::Zero(count);
  for (Eigen::Index f = 0; f < count; ++f)
    of_beside[f] = p[beside_columns_[static_cast<std::size_t>(f)]];
  Vector rest = q + p_.sums(inverse_.cwiseProduct(p));
  y = Vector::Zero(q.size());
  constexpr int most_rounds = 6;
  constexpr double exact = 1e-10;
  double before = INFINITY;
  for (int round = 0; round < most_rounds; ++round) {
    const Step step = solve_once(rest, of_beside);
    Vector next_y = y + step.y;
    const Vector next_beside = beside + step.beside;
    const Vector of_y = p_.worth(next_y);
    Vector next = inverse_.cwiseProduct(of_y - p);
    for (Eigen::Index f = 0; f < count; ++f) {
      const Eigen::Index j = beside_columns_[static_cast<std::size_t>(f)];
      next[j] = next_beside[f];
      of_beside[f] = p[j] - of_y[j] + theta_[f] * next[j];
    }
    rest = q - p_.sums(next) - inertia * next_y;
    const double size = rest.lpNorm<Eigen::Infinity>();
    if (round > 0 && !(size < before)) break;
    x = std::move(next);
    y = std::move(next_y);
    beside = next_beside;
    if (size > 0.5 * before || size <= exact * (1.0 + q.lpNorm<Eigen::Infinity>())) break;
    before = size;
  }
}

}  // namespace edda
