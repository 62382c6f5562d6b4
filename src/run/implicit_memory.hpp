// Checkpoint data of the implicit method.
#pragma once

#include <algorithm>
#include <functional>
#include <utility>
#include <vector>

#include "implicit/assemble.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Restores the matrix and its factor. False where rows, columns or values do not fit the model or
/// each other.
inline bool restore(Simulation& s, const std::vector<Id>& column, const std::vector<Id>& ends,
                    SolverMemory memory) {
  ImplicitSolver& solver = s.implicit;
  const std::size_t rows = solver.block_of.size();
  if (ends.size() != rows) return false;
  if (rows == 0) return !memory.made;  // no step has been made yet
  std::vector<std::vector<Id>> columns(rows);
  solver.row_of.assign(s.scene->blocks.size(), no_id);
  std::size_t begin = 0;
  for (std::size_t r = 0; r < rows; ++r) {
    const Id i = solver.block_of[r];
    if (i >= s.scene->blocks.size() || s.scene->blocks.fixed[i] || solver.row_of[i] != no_id)
      return false;
    if (ends[r] < begin || ends[r] > column.size()) return false;
    solver.row_of[i] = static_cast<Id>(r);
    std::vector<Id>& row = columns[r];
    row.assign(column.begin() + static_cast<std::ptrdiff_t>(begin),
               column.begin() + static_cast<std::ptrdiff_t>(ends[r]));
    begin = ends[r];
    const bool rising =
        std::adjacent_find(row.begin(), row.end(), std::greater_equal<>()) == row.end();
    if (!rising || !std::binary_search(row.begin(), row.end(), static_cast<Id>(r))) return false;
    if (row.back() >= rows) return false;
  }
  // The pattern must be symmetric; otherwise the factor would be that of another matrix.
  for (std::size_t r = 0; r < rows; ++r) {
    for (const Id c : columns[r]) {
      if (!std::binary_search(columns[c].begin(), columns[c].end(), static_cast<Id>(r)))
        return false;
    }
  }
  lay_out(
      solver,
      {s.scene->blocks, s.motion.masses, s.motion.laws, s.attached.springs, s.scene->model.gravity},
      columns);
  if (memory.made && memory.values.size() != solver.matrix.entries()) return false;
  solver.linear.recall(solver.matrix, std::move(memory));
  return true;
}

/// Data of the implicit method: its first guess, and the factor of its solver.
template <class Archive>
void list_implicit(Archive& a, Simulation& s) {
  ImplicitSolver& solver = s.implicit;
  list_vectors(a, "implicit.mean_velocity", solver.mean_velocity);
  a("implicit.block_of", solver.block_of);
  a("implicit.pattern_of", solver.pattern_of);
  std::vector<double> stiffest = solver.stiffest;
  a("implicit.stiffest", stiffest);
  std::vector<Id> column, ends;
  for (std::size_t r = 0; r < solver.matrix.rows(); ++r) {
    const std::span<const Id> row = solver.matrix.columns(r);
    column.insert(column.end(), row.begin(), row.end());
    ends.push_back(static_cast<Id>(column.size()));
  }
  a("implicit.column", column);
  a("implicit.ends", ends);
  SolverMemory m = solver.linear.memory();
  a("solver.made", m.made);
  a("solver.with_factor", m.with_factor);
  a("solver.rent", m.rent);
  a("solver.excess", m.excess);
  a("solver.life", m.life);
  a("solver.solved", m.solved);
  a("solver.by_diagonal", m.by_diagonal);
  a("solver.per_solve", m.per_solve);
  a("solver.values", m.values);
  if constexpr (Archive::loads) {
    const bool good = is_empty(solver.mean_velocity) || fits(s.scene->blocks, solver.mean_velocity);
    if (!good || stiffest.size() != solver.block_of.size() ||
        !restore(s, column, ends, std::move(m))) {
      a.refuse("implicit does not fit the model");
    }
    solver.stiffest = std::move(stiffest);
  }
}

}  // namespace edda
