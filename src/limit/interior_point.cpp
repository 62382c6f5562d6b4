// Linear programs by an interior-point method: the homogeneous self-dual embedding (Xu, Hung and Ye
// 1996) with Mehrotra's predictor and corrector (1992) and Gondzio's corrections (1996), which ends
// with a solution or with a certificate that there is none.
//
// Notation: x, z variables and their reduced costs, y prices; the embedding asks for x, z, tau,
// kappa >= 0 (x and z of free variables: any, 0) with
//
//   A x = b tau,   A'y + z = c tau,   b'y - c'x = kappa.
//
// tau > 0: x/tau and y/tau are optimal. kappa > 0: b'y > 0 shows that nothing is feasible, or
// c'x < 0 that the objective has no bound. Each round solves for two right-hand sides with
//
//   K = [ -Z/X  A' ]
//       [  A    0  ]
//
// as L D L' with small numbers on the diagonal, which refinement takes out of the solution again.
#include <Eigen/SparseCholesky>
#include <algorithm>
#include <cmath>

#include "limit/standard_form.hpp"

namespace edda {
namespace {

using Vector = Eigen::VectorXd;
using Matrix = Eigen::SparseMatrix<double>;

/// K and its factors.
class NewtonMatrix {
 public:
  NewtonMatrix(const StandardForm& p, const Matrix& transposed)
      : p_(p), transposed_(transposed), n_(p.a.cols()), m_(p.a.rows()) {
    std::vector<Eigen::Triplet<double>> entries;
    for (Eigen::Index j = 0; j < n_; ++j) {
      entries.emplace_back(j, j, -1.0);
      for (Matrix::InnerIterator e(p.a, j); e; ++e)
        entries.emplace_back(n_ + e.row(), j, e.value());
    }
    for (Eigen::Index i = 0; i < m_; ++i) entries.emplace_back(n_ + i, n_ + i, 1.0);
    k_.resize(n_ + m_, n_ + m_);
    k_.setFromTriplets(entries.begin(), entries.end());
    factors_.analyzePattern(k_);
  }

  /// ratio: [columns] z/x. False: it could not be factorised.
  bool factorise(const Vector& ratio) {
    ratio_ = ratio;
    constexpr double little = 1e-10, much = 1e-4;
    for (double small = little; small <= much; small *= 100.0) {
      for (Eigen::Index j = 0; j < n_; ++j) k_.coeffRef(j, j) = -(ratio[j] + small);
      for (Eigen::Index i = n_; i < n_ + m_; ++i) k_.coeffRef(i, i) = small;
      factors_.factorize(k_);
      if (factors_.info() == Eigen::Success) return true;
    }
    return false;
  }

  /// Solves K (x, y) = (p, q).
  void solve(const Vector& p, const Vector& q, Vector& x, Vector& y) const {
    Vector right(n_ + m_), left = Vector::Zero(n_ + m_);
    right << p, q;
    Vector rest = right;
    double before = INFINITY;
    constexpr int most = 8;
    for (int round = 0; round < most; ++round) {
      const Vector better = left + factors_.solve(rest);
      x = better.head(n_);
      y = better.tail(m_);
      Vector now(n_ + m_);
      now << p - (transposed_ * y - ratio_.cwiseProduct(x)), q - p_.a * x;
      const double size = now.lpNorm<Eigen::Infinity>();
      if (!(size < before)) break;
      left = better;
      rest = now;
      if (size > 0.5 * before) break;
      before = size;
    }
    x = left.head(n_);
    y = left.tail(m_);
  }

 private:
  const StandardForm& p_;
  const Matrix& transposed_;
  Eigen::Index n_, m_;
  Matrix k_;
  Vector ratio_;
  Eigen::SimplicialLDLT<Matrix, Eigen::Lower, Eigen::AMDOrdering<int>> factors_;
};

struct Point {
  Vector x, y, z;
  double tau = 1.0, kappa = 1.0;
};

class Embedding {
 public:
  explicit Embedding(const StandardForm& p)
      : p_(p),
        transposed_(p.a.transpose()),
        n_(p.a.cols()),
        m_(p.a.rows()),
        newton_(p, transposed_) {
    at_.x = Vector::Ones(n_);
    at_.z = Vector::Ones(n_);
    at_.y = Vector::Zero(m_);
    for (Eigen::Index j = 0; j < n_; ++j) {
      if (is_free(j)) at_.x[j] = at_.z[j] = 0.0;
      count_ += is_free(j) ? 0.0 : 1.0;
    }
  }

  LinearEnd run() {
    constexpr int most_rounds = 200;
    for (int round = 0; round < most_rounds; ++round) {
      find_residuals();
      if (const LinearEnd end = judge(); end != LinearEnd::failed) return end;
      if (!step()) break;
    }
    return best_ < acceptable ? restore() : LinearEnd::failed;
  }
  const Point& point() const { return at_; }

 private:
  bool is_free(Eigen::Index j) const { return p_.free[static_cast<std::size_t>(j)] != 0; }

  void find_residuals() {
    rp_ = p_.b * at_.tau - p_.a * at_.x;
    rd_ = p_.c * at_.tau - transposed_ * at_.y - at_.z;
    cx_ = p_.c.dot(at_.x);
    by_ = p_.b.dot(at_.y);
    rg_ = at_.kappa + cx_ - by_;
    mu_ = (at_.x.dot(at_.z) + at_.tau * at_.kappa) / (count_ + 1.0);
  }

  /// Largest relative error of the solution x/tau, y/tau.
  double error() const {
    const double primal =
        rp_.lpNorm<Eigen::Infinity>() / (at_.tau * (1.0 + p_.b.lpNorm<Eigen::Infinity>()));
    const double dual =
        rd_.lpNorm<Eigen::Infinity>() / (at_.tau * (1.0 + p_.c.lpNorm<Eigen::Infinity>()));
    const double gap = at_.x.dot(at_.z) / (at_.tau * (at_.tau + std::abs(by_)));
    return std::max({primal, dual, gap});
  }

  LinearEnd judge() {
    const double now = error();
    constexpr int patience = 4;
    const bool gains = now < 0.5 * best_;
    if (now < best_) {
      best_ = now;
      best_point_ = at_;
    }
    idle_ = gains ? 0 : idle_ + 1;
    if (best_ <= wanted || (best_ <= acceptable && idle_ >= patience)) return restore();
    constexpr double vanishing = 1e-8;
    if (at_.tau > vanishing * std::max(1.0, at_.kappa)) return LinearEnd::failed;
    // By what the certificates fail to hold, for one of unit strength.
    if (by_ > 0.0 && (transposed_ * at_.y + at_.z).lpNorm<Eigen::Infinity>() < vanishing * by_)
      return LinearEnd::infeasible;
    if (cx_ < 0.0 && (p_.a * at_.x).lpNorm<Eigen::Infinity>() < -vanishing * cx_)
      return LinearEnd::unbounded;
    return LinearEnd::failed;
  }

  LinearEnd restore() {
    at_ = best_point_;
    return LinearEnd::optimal;
  }

  struct Direction {
    Vector x, y, z;
    double tau = 0.0, kappa = 0.0;
  };

  /// What the products x z and tau kappa are to become.
  struct Products {
    Vector of_pairs;
    double of_tau = 0.0;
  };

  /// Newton's direction that takes away the part eta of the residuals and changes the products, to
  /// first order, by so much.
  Direction direction(double eta, const Products& change) const {
    Vector by_x = Vector::Zero(n_);
    for (Eigen::Index j = 0; j < n_; ++j) {
      if (!is_free(j)) by_x[j] = change.of_pairs[j] / at_.x[j];
    }
    Direction d;
    newton_.solve(eta * rd_ - by_x, eta * rp_, d.x, d.y);
    d.tau = (eta * rg_ + change.of_tau / at_.tau - p_.b.dot(d.y) + p_.c.dot(d.x)) /
            (p_.b.dot(uy_) - p_.c.dot(ux_) + at_.kappa / at_.tau);
    d.x += d.tau * ux_;
    d.y += d.tau * uy_;
    d.kappa = (change.of_tau - at_.kappa * d.tau) / at_.tau;
    d.z = Vector::Zero(n_);
    for (Eigen::Index j = 0; j < n_; ++j) {
      if (!is_free(j)) d.z[j] = by_x[j] - at_.z[j] / at_.x[j] * d.x[j];
    }
    return d;
  }

  Products affine_change() const { return {-at_.x.cwiseProduct(at_.z), -at_.tau * at_.kappa}; }

  /// Towards the point of the central path with sigma mu, with the second-order part of the affine
  /// direction.
  Direction centred(double sigma, const Direction& affine) const {
    Products change = affine_change();
    change.of_pairs -= affine.x.cwiseProduct(affine.z);
    change.of_pairs.array() += sigma * mu_;
    change.of_tau += sigma * mu_ - affine.tau * affine.kappa;
    return direction(1.0 - sigma, change);
  }

  /// What brings the products a longer step away back to between a tenth and ten times sigma mu
  /// (Gondzio 1996).
  Products correction(double sigma, const Direction& d, double length) const {
    constexpr double least = 0.1, most = 10.0;
    const double target = sigma * mu_;
    const auto change = [&](double product) {
      return std::max(std::clamp(product, least * target, most * target) - product, -most * target);
    };
    Products made{Vector::Zero(n_), 0.0};
    for (Eigen::Index j = 0; j < n_; ++j) {
      if (is_free(j)) continue;
      made.of_pairs[j] = change((at_.x[j] + length * d.x[j]) * (at_.z[j] + length * d.z[j]));
    }
    made.of_tau = change((at_.tau + length * d.tau) * (at_.kappa + length * d.kappa));
    return made;
  }

  /// Corrects a direction as long as a longer step becomes possible.
  Direction corrected(double sigma, Direction d) const {
    constexpr int most_corrections = 4;
    constexpr double further = 0.3, worth = 0.03;
    double length = reach(d);
    for (int k = 0; k < most_corrections && length < 1.0; ++k) {
      const Direction change =
          direction(0.0, correction(sigma, d, std::min(1.0, length + further)));
      Direction next = d;
      next.x += change.x;
      next.y += change.y;
      next.z += change.z;
      next.tau += change.tau;
      next.kappa += change.kappa;
      const double reached = reach(next);
      if (reached < length + worth) break;
      d = std::move(next);
      length = reached;
    }
    return d;
  }

  /// The largest step in a direction, at most 1, that keeps everything at least 0.
  double reach(const Direction& d) const {
    double most = 1.0;
    const auto limit = [&](double value, double change) {
      if (change < 0.0) most = std::min(most, -value / change);
    };
    for (Eigen::Index j = 0; j < n_; ++j) {
      if (is_free(j)) continue;
      limit(at_.x[j], d.x[j]);
      limit(at_.z[j], d.z[j]);
    }
    limit(at_.tau, d.tau);
    limit(at_.kappa, d.kappa);
    return most;
  }

  bool step() {
    // Of free variables those nearest to the present ones: they may depend on each other.
    Vector ratio = Vector::Constant(n_, 1e-8);
    for (Eigen::Index j = 0; j < n_; ++j) {
      if (!is_free(j)) ratio[j] = at_.z[j] / at_.x[j];
    }
    if (!newton_.factorise(ratio)) return false;
    newton_.solve(p_.c, p_.b, ux_, uy_);
    const Direction affine = direction(1.0, affine_change());
    const double far = reach(affine);
    const double sigma = std::max(1e-6, (1.0 - far) * (1.0 - far) * std::min(1.0 - far, 0.5));
    const Direction d = corrected(sigma, centred(sigma, affine));
    constexpr double back = 0.995, least = 1e-8;
    const double length = back * reach(d);
    if (!(length > least)) return false;
    at_.x += length * d.x;
    at_.y += length * d.y;
    at_.z += length * d.z;
    at_.tau += length * d.tau;
    at_.kappa += length * d.kappa;
    return std::isfinite(at_.x.sum() + at_.y.sum() + at_.tau);
  }

  /// Relative errors of an objective that is as good as it need be, and of one that is of use.
  static constexpr double wanted = 1e-9, acceptable = 1e-6;
  const StandardForm& p_;
  const Matrix transposed_;
  Eigen::Index n_, m_;
  NewtonMatrix newton_;
  double count_ = 0.0;
  Point at_, best_point_;
  double best_ = INFINITY;
  int idle_ = 0;  // rounds without a gain
  Vector rp_, rd_, ux_, uy_;
  double cx_ = 0.0, by_ = 0.0, rg_ = 0.0, mu_ = 1.0;
};

}  // namespace

LinearAnswer solve(const LinearProgram& program) {
  const StandardForm form(program);
  Embedding embedding(form);
  LinearAnswer answer;
  answer.end = embedding.run();
  const Point& at = embedding.point();
  const auto rows = static_cast<Eigen::Index>(form.program_rows);
  // The form minimises the negative of what is to be maximised.
  const double scale = answer.end == LinearEnd::optimal ? -1.0 / at.tau : 1.0;
  if (answer.end == LinearEnd::optimal) {
    answer.value = form.variables(at.x / at.tau);
    for (std::size_t j = 0; j < program.columns(); ++j)
      answer.objective += program.cost[j] * answer.value[j];
  }
  if (answer.end == LinearEnd::optimal || answer.end == LinearEnd::infeasible) {
    const Vector y = scale * at.y.head(rows);
    answer.price.assign(y.data(), y.data() + y.size());
  }
  return answer;
}

DualBound dual_bound(const LinearProgram& p, const std::vector<double>& price) {
  DualBound bound;
  const auto add = [&](double by, double low, double high) {
    const double at = by > 0.0 ? high : low;
    if (std::abs(at) < no_bound) {
      bound.value += by * at;
    } else {
      bound.violation = std::max(bound.violation, std::abs(by));
    }
  };
  for (std::size_t r = 0; r < p.rows(); ++r) add(price[r], p.row_lower[r], p.row_upper[r]);
  for (std::size_t j = 0; j < p.columns(); ++j) {
    double reduced = p.cost[j];
    for (int q = p.begin[j]; q < p.begin[j + 1]; ++q) {
      const auto at = static_cast<std::size_t>(q);
      reduced -= price[static_cast<std::size_t>(p.row[at])] * p.entry[at];
    }
    add(reduced, p.lower[j], p.upper[j]);
  }
  return bound;
}

}  // namespace edda
