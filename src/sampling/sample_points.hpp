// The values of what varies, sample by sample.
#pragma once

#include <nlohmann/json_fwd.hpp>
#include <string>
#include <vector>

#include "model/study/study_plan.hpp"
#include "sampling/sampler_process.hpp"

namespace edda {

using Points = std::vector<std::vector<double>>;  ///< [samples][quantities]

/// Of a design whose points are known before, those from number `first` on. Monte Carlo and Sobol
/// continue where a shorter study ended; a Latin hypercube is followed by another one. Faults: a
/// table that lacks a column, distributions that do not exist.
Result<Points> points_of(const StudyPlan& plan, std::size_t first, SamplerProcess& sampler);

/// The variables that are drawn, as edda-sampler takes them: `drawn` has the rows of plan.vary.
nlohmann::json variables_of(const StudyPlan& plan, std::vector<std::size_t>& drawn);
nlohmann::json dependence_of(const StudyPlan& plan, const std::vector<std::size_t>& drawn);

/// The value as --set takes it, a line for each key.
std::vector<std::string> overrides_of(const StudyPlan& plan, const std::vector<double>& point);

/// points.csv and back.
std::string points_csv(const StudyPlan& plan, const Points& points);
Result<Points> read_points(const StudyPlan& plan, const std::string& path);

}  // namespace edda
