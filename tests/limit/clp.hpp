// The same linear programs by CLP's simplex method: another method, written by others.
#pragma once

#include <ClpSimplex.hpp>
#include <algorithm>
#include <vector>

#include "limit/linear_program.hpp"

namespace edda::testing {

struct ByClp {
  LinearEnd end;
  double objective;
};

inline ByClp solved_by_clp(const LinearProgram& p) {
  const auto bounds = [](std::vector<double> values) {
    for (double& b : values) b = std::clamp(b, -COIN_DBL_MAX, COIN_DBL_MAX);
    for (double& b : values) {
      if (std::abs(b) >= no_bound) b = b > 0.0 ? COIN_DBL_MAX : -COIN_DBL_MAX;
    }
    return values;
  };
  const std::vector<double> lower = bounds(p.lower), upper = bounds(p.upper),
                            row_lower = bounds(p.row_lower), row_upper = bounds(p.row_upper);
  ClpSimplex model;
  model.setLogLevel(0);
  model.setPrimalTolerance(1e-10);
  model.setDualTolerance(1e-10);
  model.loadProblem(static_cast<int>(p.columns()), static_cast<int>(p.rows()), p.begin.data(),
                    p.row.data(), p.entry.data(), lower.data(), upper.data(), p.cost.data(),
                    row_lower.data(), row_upper.data());
  model.setOptimizationDirection(-1.0);
  model.primal();
  const LinearEnd end = model.isProvenOptimal()            ? LinearEnd::optimal
                        : model.isProvenPrimalInfeasible() ? LinearEnd::infeasible
                        : model.isProvenDualInfeasible()   ? LinearEnd::unbounded
                                                           : LinearEnd::failed;
  return {end, model.objectiveValue()};
}

}  // namespace edda::testing
