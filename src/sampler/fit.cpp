// Least squares: parameters of a model from what was measured, by Ceres.
#include <ceres/ceres.h>

#include <Eigen/Dense>
#include <cmath>
#include <map>
#include <vector>

#include "sampler/conversation.hpp"

namespace edda::sampler {
namespace {

using nlohmann::json;

/// A parameter between its bounds, as x in [0, 1], linear or logarithmic.
struct Parameter {
  double low = 0.0, high = 1.0;
  bool logarithmic = false;

  double value(double x) const {
    return logarithmic ? low * std::pow(high / low, x) : low + x * (high - low);
  }
  double place(double v) const {
    return logarithmic ? std::log(v / low) / std::log(high / low) : (v - low) / (high - low);
  }
  /// dv/dx
  double slope(double x) const {
    return logarithmic ? value(x) * std::log(high / low) : high - low;
  }
};

/// Differences between computed and measured values, in standard deviations of the measurements.
/// All points that a derivative needs are asked at once, so that they may run side by side.
class Differences : public ceres::CostFunction {
 public:
  explicit Differences(const json& request) : step_(request.at("difference")) {
    for (const json& p : request.at("parameters"))
      parameters_.push_back({p.at("low"), p.at("high"), p.at("log")});
    for (const json& m : request.at("measured")) {
      measured_.push_back(m.at("value"));
      error_.push_back(m.at("error"));
    }
    mutable_parameter_block_sizes()->push_back(static_cast<int>(parameters_.size()));
    set_num_residuals(static_cast<int>(measured_.size()));
  }

  bool Evaluate(double const* const* at, double* residuals, double** jacobians) const override {
    const std::size_t d = parameters_.size(), m = measured_.size();
    const std::vector<double> x(at[0], at[0] + d);
    std::vector<std::vector<double>> points{x};
    if (jacobians != nullptr && jacobians[0] != nullptr) {
      for (std::size_t k = 0; k < d; ++k) {
        points.push_back(x);
        points.back()[k] += step_at(x[k]);
      }
    }
    if (!ask_for(points)) return false;
    const std::vector<double>& here = known_.at(x);
    for (std::size_t i = 0; i < m; ++i) residuals[i] = (here[i] - measured_[i]) / error_[i];
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
      const std::vector<double>& there = known_.at(points[k + 1]);
      for (std::size_t i = 0; i < m; ++i)
        jacobians[0][i * d + k] = (there[i] - here[i]) / error_[i] / step_at(x[k]);
    }
    return true;
  }

  const std::vector<Parameter>& parameters() const { return parameters_; }

 private:
  /// Towards the middle where the other side is a bound.
  double step_at(double x) const { return x + step_ > 1.0 ? -step_ : step_; }

  bool ask_for(const std::vector<std::vector<double>>& points) const {
    json rows = json::array();
    std::vector<const std::vector<double>*> unknown;
    for (const std::vector<double>& x : points) {
      if (known_.contains(x)) continue;
      json row = json::array();
      for (std::size_t k = 0; k < x.size(); ++k) row.push_back(parameters_[k].value(x[k]));
      rows.push_back(row);
      unknown.push_back(&x);
    }
    if (unknown.empty()) return true;
    answer({{"ask", rows}});
    const json reply = next_line();
    if (!reply.contains("values")) return false;
    for (std::size_t i = 0; i < unknown.size(); ++i)
      known_[*unknown[i]] = reply["values"][i].get<std::vector<double>>();
    return true;
  }

  double step_;
  std::vector<Parameter> parameters_;
  std::vector<double> measured_, error_;
  mutable std::map<std::vector<double>, std::vector<double>> known_;
};

/// Covariance of the parameters in [0, 1], s^2 (J^T J)^-1 with the reduced sum of squares s^2,
/// which is not taken below 1: errors given are not made smaller by a lucky fit. Directions that
/// the data do not tell get the largest spread that there can be, that of the whole range.
Eigen::MatrixXd covariance(const Eigen::MatrixXd& j, double scale) {
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(j.transpose() * j);
  Eigen::VectorXd inverse = eigen.eigenvalues();
  for (double& e : inverse) e = e > scale ? scale / e : 1.0;
  return eigen.eigenvectors() * inverse.asDiagonal() * eigen.eigenvectors().transpose();
}

}  // namespace

/// Levenberg and Marquardt's method with bounds. Answers with the values, their standard errors and
/// their correlation, and what is left of the differences.
json fit(const json& request) {
  auto* differences = new Differences(request);  // which the problem then owns
  ceres::Problem problem;
  const std::size_t d = differences->parameters().size();
  std::vector<double> x(d);
  for (std::size_t k = 0; k < d; ++k)
    x[k] = differences->parameters()[k].place(request.at("parameters")[k].at("start"));
  problem.AddResidualBlock(differences, nullptr, x.data());
  for (std::size_t k = 0; k < d; ++k) {
    problem.SetParameterLowerBound(x.data(), static_cast<int>(k), 0.0);
    problem.SetParameterUpperBound(x.data(), static_cast<int>(k), 1.0);
  }
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = request.at("iterations");
  options.function_tolerance = 1e-6;
  options.parameter_tolerance = 1e-5;
  options.logging_type = ceres::SILENT;
  options.num_threads = 1;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &problem, &summary);
  if (!summary.IsSolutionUsable()) return {{"fault", summary.message}};
  const auto m = static_cast<Eigen::Index>(request.at("measured").size());
  const auto n = static_cast<Eigen::Index>(d);
  Eigen::VectorXd rest(m);
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> jacobian(m, n);
  const double* at = x.data();
  double* rows = jacobian.data();
  differences->Evaluate(&at, rest.data(), &rows);
  const double squares = rest.squaredNorm();
  const double reduced = m > n ? squares / static_cast<double>(m - n) : 1.0;
  const Eigen::MatrixXd spread = covariance(jacobian, std::max(1.0, reduced));
  Eigen::VectorXd values(n), errors(n);
  json correlation = json::array();
  for (Eigen::Index k = 0; k < n; ++k) {
    const auto i = static_cast<std::size_t>(k);
    values[k] = differences->parameters()[i].value(x[i]);
    errors[k] = differences->parameters()[i].slope(x[i]) * std::sqrt(spread(k, k));
    json row = json::array();
    for (Eigen::Index l = 0; l < n; ++l)
      row.push_back(spread(k, l) / std::sqrt(spread(k, k) * spread(l, l)));
    correlation.push_back(row);
  }
  return {{"answer",
           {{"values", list_of(values)},
            {"errors", list_of(errors)},
            {"correlation", correlation},
            {"differences", list_of(rest)},
            {"sum_of_squares", squares},
            {"converged", summary.termination_type == ceres::CONVERGENCE}}}};
}

}  // namespace edda::sampler
