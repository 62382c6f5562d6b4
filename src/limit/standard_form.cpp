#include "limit/standard_form.hpp"

namespace edda {
namespace {

using Entry = Eigen::Triplet<double>;

class Writer {
 public:
  explicit Writer(const LinearProgram& p) : p_(p), b_(p.rows(), 0.0) {}

  StandardForm::Origin take(std::size_t j) {
    const double low = p_.lower[j], high = p_.upper[j];
    StandardForm::Origin from;
    const bool below = low > -no_bound, above = high < no_bound;
    if (below && above && low == high) {
      from.shift = low;
    } else if (below) {
      from = {add_column(false), low, 1.0};
    } else if (above) {
      from = {add_column(false), high, -1.0};
    } else {
      from = {add_column(true), 0.0, 1.0};
    }
    for (int q = p_.begin[j]; q < p_.begin[j + 1]; ++q) {
      const auto at = static_cast<std::size_t>(q);
      b_[static_cast<std::size_t>(p_.row[at])] -= p_.entry[at] * from.shift;
      if (from.column >= 0)
        entries_.emplace_back(p_.row[at], from.column, p_.entry[at] * from.sign);
    }
    if (from.column >= 0) c_[static_cast<std::size_t>(from.column)] = -p_.cost[j] * from.sign;
    if (below && above && low < high) bound(from.column, high - low);
    return from;
  }

  /// The sum of a row is its lower bound plus a variable, or its upper one less that.
  void close_row(std::size_t r) {
    const double low = p_.row_lower[r], high = p_.row_upper[r];
    const bool from_low = low > -no_bound;
    b_[r] += from_low ? low : high;
    if (low == high) return;
    const int slack = add_column(false);
    entries_.emplace_back(static_cast<int>(r), slack, from_low ? -1.0 : 1.0);
    if (from_low && high < no_bound) bound(slack, high - low);
  }

  void write(StandardForm& form) {
    const auto rows = static_cast<Eigen::Index>(b_.size());
    const auto columns = static_cast<Eigen::Index>(c_.size());
    form.a.resize(rows, columns);
    form.a.setFromTriplets(entries_.begin(), entries_.end());
    form.b = Eigen::Map<const Eigen::VectorXd>(b_.data(), rows);
    form.c = Eigen::Map<const Eigen::VectorXd>(c_.data(), columns);
    form.u = Eigen::Map<const Eigen::VectorXd>(u_.data(), columns);
    form.free = free_;
    form.bounded = bounded_;
  }

 private:
  int add_column(bool is_free) {
    c_.push_back(0.0);
    u_.push_back(0.0);
    bounded_.push_back(0);
    free_.push_back(is_free ? 1 : 0);
    return static_cast<int>(c_.size()) - 1;
  }
  void bound(int column, double most) {
    u_[static_cast<std::size_t>(column)] = most;
    bounded_[static_cast<std::size_t>(column)] = 1;
  }

  const LinearProgram& p_;
  std::vector<double> b_, c_, u_;
  std::vector<char> free_, bounded_;
  std::vector<Entry> entries_;
};

}  // namespace

StandardForm::StandardForm(const LinearProgram& program) {
  Writer writer(program);
  for (std::size_t j = 0; j < program.columns(); ++j) origin.push_back(writer.take(j));
  for (std::size_t r = 0; r < program.rows(); ++r) writer.close_row(r);
  writer.write(*this);
}

std::vector<double> StandardForm::variables(const Eigen::VectorXd& x) const {
  std::vector<double> values;
  values.reserve(origin.size());
  for (const Origin& from : origin)
    values.push_back(from.shift + (from.column < 0 ? 0.0 : from.sign * x[from.column]));
  return values;
}

Eigen::VectorXd StandardForm::sums(const Eigen::VectorXd& x) const {
  Eigen::VectorXd all = Eigen::VectorXd::Zero(a.rows());
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    for (Eigen::SparseMatrix<double>::InnerIterator e(a, j); e; ++e)
      all[e.row()] += e.value() * x[j];
  }
  return all;
}

Eigen::VectorXd StandardForm::worth(const Eigen::VectorXd& y) const {
  Eigen::VectorXd all(a.cols());
  for (Eigen::Index j = 0; j < a.cols(); ++j) {
    double sum = 0.0;
    for (Eigen::SparseMatrix<double>::InnerIterator e(a, j); e; ++e) sum += e.value() * y[e.row()];
    all[j] = sum;
  }
  return all;
}

}  // namespace edda
