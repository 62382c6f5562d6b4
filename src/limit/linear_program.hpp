// Linear programs. The only header of limit/ that others need in order to have one solved.
#pragma once

#include <atomic>
#include <cstddef>
#include <functional>
#include <vector>

namespace edda {

/// No bound.
inline constexpr double no_bound = 1e300;

/// Maximise sum c_j x_j with lower <= x <= upper, subject to rows row_lower <= A x <= row_upper.
struct LinearProgram {
  std::vector<double> cost, lower, upper;    ///< [columns]
  std::vector<double> row_lower, row_upper;  ///< [rows]
  // Entries of A, column by column.
  std::vector<int> begin{0};  ///< [columns + 1]
  std::vector<int> row;
  std::vector<double> entry;

  std::size_t columns() const { return cost.size(); }
  std::size_t rows() const { return row_lower.size(); }
  /// Appends an entry of the column that add_column() will end.
  void add_entry(int at_row, double value) {
    if (value == 0.0) return;
    row.push_back(at_row);
    entry.push_back(value);
  }
  /// Ends the column of the entries so far and returns its number.
  std::size_t add_column(double from, double to, double worth = 0.0) {
    cost.push_back(worth);
    lower.push_back(from);
    upper.push_back(to);
    begin.push_back(static_cast<int>(row.size()));
    return columns() - 1;
  }
  /// A row without entries; returns its number.
  int add_row(double from, double to) {
    row_lower.push_back(from);
    row_upper.push_back(to);
    return static_cast<int>(rows()) - 1;
  }
};

enum class LinearEnd {
  optimal,
  infeasible,  ///< no x satisfies all rows and bounds
  unbounded,   ///< the objective has no maximum
  failed,      ///< the solver gave up
};

struct LinearAnswer {
  LinearEnd end = LinearEnd::failed;
  double objective = 0.0;     ///< infeasible: by how much the certificate differs
  std::vector<double> value;  ///< [columns]; optimal only
  /// [rows] y: optimal: the prices, by how much the objective grows with the bound of a row.
  /// Infeasible: a certificate, y'A x differs from what the rows allow for all x within bounds.
  std::vector<double> price;
};

/// Watches programs while they are solved.
struct ProgramWatch {
  const std::atomic<bool>* stop = nullptr;  ///< set from any thread: programs end as failed
  std::function<void()> after_round{};      ///< called from every thread that solves one

  bool stopped() const { return stop != nullptr && stop->load(std::memory_order_relaxed); }
};

/// watch: may be null.
LinearAnswer solve(const LinearProgram& program, const ProgramWatch* watch = nullptr);

/// An upper bound of the objective from any prices, by weak duality.
struct DualBound {
  double value = 0.0;
  double violation = 0.0;  ///< largest reduced cost of a variable that has no bound on that side: 0
                           ///< where `value` is a bound
};
/// unit: [columns] a violation counts by it: cost and entries are those of so many; empty: 1.
DualBound dual_bound(const LinearProgram& program, const std::vector<double>& price,
                     const std::vector<double>& unit = {});

}  // namespace edda
