// One sample of a study: the model with its values, analysed.
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "model/study/study_plan.hpp"

namespace edda {

/// What was asked of a sample.
struct SampleAnswer {
  std::vector<std::string> cells;  ///< [plan.ask] a number, or a word: "unstable" (there is no
                                   ///< equilibrium), "unlimited" (no limit); empty: no answer. Then
                                   ///< what is at the places of plan.map (sampling/place_map.hpp)
  std::string message;             ///< why there is no answer; empty where there is one
};

/// model_text: the model file, which lies at plan.model; `scratch`: a folder for a run's results,
/// made and removed.
SampleAnswer run_sample(const StudyPlan& plan, std::string_view model_text,
                        const std::vector<double>& point, const std::string& scratch);

/// A fault of the model, or of the keys that vary: where none of the first samples can be read. A
/// few that cannot are answers of the study.
std::optional<Fault> no_sample_can_be_read(const StudyPlan& plan, std::string_view model_text,
                                           const std::vector<std::vector<double>>& points);

/// The number or the word at a path of names in JSON ("limit.lower"); elements of lists are named
/// by their "name" or their number. Empty where there is none.
std::string value_in(std::string_view json_text, std::string_view path);

}  // namespace edda
