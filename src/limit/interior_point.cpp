// Linear programs by an interior-point method: the homogeneous self-dual embedding (Xu, Hung and Ye
// 1996) with Mehrotra's predictor and corrector (1992) and Gondzio's corrections (1996), which ends
// with a solution or with a certificate that there is none.
//
// Notation: x, z variables and their reduced costs, w what a bounded variable is below its bound u,
// v its price, y prices of the rows; the embedding asks for x, z, w, v, tau, kappa >= 0 (x and z of
// free variables: any, 0) with
//
//   A x = b tau,   x + w = u tau,   A'y + z - v = c tau,   b'y - u'v - c'x = kappa.
//
// tau > 0: x/tau and y/tau are optimal. kappa > 0: b'y - u'v > 0 shows that nothing is feasible, or
// c'x < 0 that the objective has no bound. Each round solves the equations of normal_equations.hpp
// for several right-hand sides, with theta = z/x + v/w.
#include <algorithm>
#include <cmath>

#include "limit/normal_equations.hpp"

namespace edda {
namespace {

using Vector = Eigen::VectorXd;

struct Point {
  Vector x, z, w, v, y;
  double tau = 1.0, kappa = 1.0;
};

class Embedding {
 public:
  explicit Embedding(const StandardForm& p) : p_(p), n_(p.a.cols()), newton_(p) {
    at_.x = at_.z = at_.w = Vector::Ones(n_);
    at_.v = Vector::Zero(n_);
    at_.y = Vector::Zero(p.a.rows());
    signed_ = bounded_ = Vector::Ones(n_);
    for (Eigen::Index j = 0; j < n_; ++j) {
      const auto k = static_cast<std::size_t>(j);
      if (p.free[k] != 0) at_.x[j] = at_.z[j] = signed_[j] = 0.0;
      if (p.bounded[k] != 0) at_.v[j] = 1.0;
      if (p.bounded[k] == 0) bounded_[j] = 0.0;
    }
    count_ = signed_.sum() + bounded_.sum();
  }

  LinearEnd run(const ProgramWatch* watch) {
    constexpr int most_rounds = 200;
    for (int round = 0; round < most_rounds; ++round) {
      find_residuals();
      if (const LinearEnd end = judge(); end != LinearEnd::failed) return end;
      if (!step()) break;
      if (watch != nullptr && watch->stopped()) return LinearEnd::failed;
      if (watch != nullptr && watch->after_round) watch->after_round();
    }
    return best_ < usable ? restore() : LinearEnd::failed;
  }
  const Point& point() const { return at_; }
  /// By which a certificate that nothing is feasible shows it.
  double by_which() const { return by_; }

 private:
  void find_residuals() {
    rp_ = p_.b * at_.tau - p_.sums(at_.x);
    ru_ = bounded_.cwiseProduct(p_.u * at_.tau - at_.x - at_.w);
    rd_ = p_.c * at_.tau - p_.worth(at_.y) - at_.z + at_.v;
    cx_ = p_.c.dot(at_.x);
    by_ = p_.b.dot(at_.y) - p_.u.dot(at_.v);
    rg_ = at_.kappa + cx_ - by_;
    pairs_ = at_.x.dot(at_.z) + at_.w.dot(at_.v);
    mu_ = (pairs_ + at_.tau * at_.kappa) / (count_ + 1.0);
  }

  /// Largest of these numbers, each relative to 1 or its own size.
  static double largest(const Vector& of, const Vector& own) {
    return of.size() == 0 ? 0.0 : (of.array().abs() / (1.0 + own.array().abs())).maxCoeff();
  }

  /// Largest relative error of the solution x/tau, y/tau.
  double error() const {
    const double primal = std::max(largest(rp_, p_.b), largest(ru_, p_.u)) / at_.tau;
    const double dual = largest(rd_, p_.c) / at_.tau;
    const double gap = pairs_ / (at_.tau * (at_.tau + std::abs(by_)));
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
    if (by_ > 0.0 && (p_.worth(at_.y) + at_.z - at_.v).lpNorm<Eigen::Infinity>() < vanishing * by_)
      return LinearEnd::infeasible;
    const Vector above = bounded_.cwiseProduct(at_.x + at_.w);
    if (cx_ < 0.0 && std::max(p_.sums(at_.x).lpNorm<Eigen::Infinity>(),
                              above.lpNorm<Eigen::Infinity>()) < -vanishing * cx_)
      return LinearEnd::unbounded;
    return LinearEnd::failed;
  }

  LinearEnd restore() {
    at_ = best_point_;
    return LinearEnd::optimal;
  }

  /// What the products x z, w v and tau kappa are to change by, to first order.
  struct Products {
    Vector xz, wv;
    double of_tau = 0.0;
  };

  /// Newton's direction that takes away the part eta of the residuals and changes the products by
  /// so much.
  Point direction(double eta, const Products& change) const {
    const Vector by_x = change.xz.cwiseProduct(over_x_);
    const Vector by_w = (change.wv - eta * at_.v.cwiseProduct(ru_)).cwiseProduct(over_w_);
    Point d;
    newton_.solve(eta * rd_ - by_x + by_w, eta * rp_, d.x, d.y);
    const double drop =
        eta * rg_ + change.of_tau / at_.tau + cg_.dot(d.x) - p_.b.dot(d.y) + p_.u.dot(by_w);
    d.tau = drop / slope_;
    d.x += d.tau * ux_;
    d.y += d.tau * uy_;
    d.kappa = (change.of_tau - at_.kappa * d.tau) / at_.tau;
    d.z = by_x - at_.z.cwiseProduct(over_x_).cwiseProduct(d.x);
    d.w = bounded_.cwiseProduct(eta * ru_ + d.tau * p_.u - d.x);
    d.v = (change.wv - at_.v.cwiseProduct(d.w)).cwiseProduct(over_w_);
    return d;
  }

  Products affine_change() const {
    return {-at_.x.cwiseProduct(at_.z), -at_.w.cwiseProduct(at_.v), -at_.tau * at_.kappa};
  }

  /// Towards the point of the central path with sigma mu, with the second-order part of the affine
  /// direction.
  Point centred(double sigma, const Point& affine) const {
    Products change = affine_change();
    change.xz += sigma * mu_ * signed_ - affine.x.cwiseProduct(affine.z);
    change.wv += sigma * mu_ * bounded_ - affine.w.cwiseProduct(affine.v);
    change.of_tau += sigma * mu_ - affine.tau * affine.kappa;
    return direction(1.0 - sigma, change);
  }

  /// What brings the products a longer step away back to between a tenth and ten times sigma mu
  /// (Gondzio 1996).
  Products correction(double sigma, const Point& d, double length) const {
    constexpr double least = 0.1, most = 10.0;
    const double target = sigma * mu_;
    const auto change = [&](double product) {
      return std::max(std::clamp(product, least * target, most * target) - product, -most * target);
    };
    const auto both = [&](const Vector& a, const Vector& da, const Vector& b, const Vector& db) {
      return (a + length * da).cwiseProduct(b + length * db).unaryExpr(change).eval();
    };
    return {signed_.cwiseProduct(both(at_.x, d.x, at_.z, d.z)),
            bounded_.cwiseProduct(both(at_.w, d.w, at_.v, d.v)),
            change((at_.tau + length * d.tau) * (at_.kappa + length * d.kappa))};
  }

  static void add(Point& to, double times, const Point& d) {
    to.x += times * d.x;
    to.z += times * d.z;
    to.w += times * d.w;
    to.v += times * d.v;
    to.y += times * d.y;
    to.tau += times * d.tau;
    to.kappa += times * d.kappa;
  }

  /// Corrects a direction as long as a longer step becomes possible.
  Point corrected(double sigma, Point d) const {
    constexpr int most_corrections = 2;
    constexpr double further = 0.3, worth = 0.03;
    double length = reach(d);
    for (int k = 0; k < most_corrections && length < 1.0; ++k) {
      Point next = d;
      add(next, 1.0, direction(0.0, correction(sigma, d, std::min(1.0, length + further))));
      const double reached = reach(next);
      if (reached < length + worth) break;
      d = std::move(next);
      length = reached;
    }
    return d;
  }

  /// The largest step in a direction, at most 1, that keeps everything at least 0.
  double reach(const Point& d) const {
    double most = 1.0;
    const auto limit = [&](double value, double change) {
      if (change < 0.0) most = std::min(most, -value / change);
    };
    for (Eigen::Index j = 0; j < n_; ++j) {
      if (signed_[j] == 0.0) continue;
      limit(at_.x[j], d.x[j]);
      limit(at_.z[j], d.z[j]);
      if (bounded_[j] == 0.0) continue;
      limit(at_.w[j], d.w[j]);
      limit(at_.v[j], d.v[j]);
    }
    limit(at_.tau, d.tau);
    limit(at_.kappa, d.kappa);
    return most;
  }

  /// What all directions of a round have in common.
  void prepare() {
    over_x_ = signed_.cwiseQuotient(at_.x + (Vector::Ones(n_) - signed_));
    over_w_ = bounded_.cwiseQuotient(at_.w);
    const Vector of_bound = at_.v.cwiseProduct(over_w_);
    newton_.factorise(at_.z.cwiseProduct(over_x_) + of_bound);
    const Vector g = p_.u.cwiseProduct(of_bound);
    newton_.solve(p_.c - g, p_.b, ux_, uy_);
    cg_ = p_.c + g;
    slope_ = at_.kappa / at_.tau + p_.u.dot(g) + p_.b.dot(uy_) - cg_.dot(ux_);
  }

  bool step() {
    prepare();
    const Point affine = direction(1.0, affine_change());
    const double far = reach(affine);
    const double sigma = std::max(1e-6, (1.0 - far) * (1.0 - far) * std::min(1.0 - far, 0.5));
    const Point d = corrected(sigma, centred(sigma, affine));
    constexpr double back = 0.995, least = 1e-8;
    const double length = back * reach(d);
    if (!(length > least)) return false;
    add(at_, length, d);
    return std::isfinite(at_.x.sum() + at_.y.sum() + at_.tau);
  }

  /// Relative errors of an objective that is as good as it need be, of one that is good enough
  /// where rounds no longer gain anything, and of one that is of use where they cannot go on.
  static constexpr double wanted = 1e-9, acceptable = 1e-6, usable = 1e-5;
  const StandardForm& p_;
  Eigen::Index n_;
  NormalEquations newton_;
  Vector signed_, bounded_;  // 1: not free; with an upper bound
  double count_ = 0.0;
  Point at_, best_point_;
  double best_ = INFINITY;
  int idle_ = 0;  // rounds without a gain
  Vector rp_, ru_, rd_, ux_, uy_, over_x_, over_w_, cg_;
  double cx_ = 0.0, by_ = 0.0, rg_ = 0.0, mu_ = 1.0, pairs_ = 0.0, slope_ = 1.0;
};

}  // namespace

LinearAnswer solve(const LinearProgram& program, const ProgramWatch* watch) {
  const StandardForm form(program);
  Embedding embedding(form);
  LinearAnswer answer;
  answer.end = embedding.run(watch);
  const Point& at = embedding.point();
  // The form minimises the negative of what is to be maximised.
  const double scale = answer.end == LinearEnd::optimal ? -1.0 / at.tau : 1.0;
  if (answer.end == LinearEnd::optimal) {
    answer.value = form.variables(at.x / at.tau);
    for (std::size_t j = 0; j < program.columns(); ++j)
      answer.objective += program.cost[j] * answer.value[j];
  }
  if (answer.end == LinearEnd::infeasible) answer.objective = embedding.by_which();
  if (answer.end == LinearEnd::optimal || answer.end == LinearEnd::infeasible) {
    const Vector y = scale * at.y;
    answer.price.assign(y.data(), y.data() + y.size());
  }
  return answer;
}

DualBound dual_bound(const LinearProgram& p, const std::vector<double>& price,
                     const std::vector<double>& unit) {
  DualBound bound;
  const auto add = [&](double by, double low, double high, double in_unit) {
    const double at = by > 0.0 ? high : low;
    if (std::abs(at) < no_bound) {
      bound.value += by * at;
    } else {
      bound.violation = std::max(bound.violation, std::abs(by) / in_unit);
    }
  };
  for (std::size_t r = 0; r < p.rows(); ++r) add(price[r], p.row_lower[r], p.row_upper[r], 1.0);
  for (std::size_t j = 0; j < p.columns(); ++j) {
    double reduced = p.cost[j];
    for (int q = p.begin[j]; q < p.begin[j + 1]; ++q) {
      const auto at = static_cast<std::size_t>(q);
      reduced -= price[static_cast<std::size_t>(p.row[at])] * p.entry[at];
    }
    add(reduced, p.lower[j], p.upper[j], unit.empty() ? 1.0 : unit[j]);
  }
  return bound;
}

}  // namespace edda
