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
    form.free = free_;
  }

 private:
  int add_column(bool is_free) {
    c_.push_back(0.0);
    free_.push_back(is_free ? 1 : 0);
    return static_cast<int>(c_.size()) - 1;
  }
  /// A column is at most this: with another one it adds up to it.
  void bound(int column, double most) {
    const int row = static_cast<int>(b_.size());
    b_.push_back(most);
    entries_.emplace_back(row, column, 1.0);
    entries_.emplace_back(row, add_column(false), 1.0);
  }

  const LinearProgram& p_;
  std::vector<double> b_, c_;
  std::vector<char> free_;
  std::vector<Entry> entries_;
};

}  // namespace

StandardForm::StandardForm(const LinearProgram& program) : program_rows(program.rows()) {
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

}  // namespace edda
