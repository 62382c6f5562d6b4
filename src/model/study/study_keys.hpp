// The tables of a study's file.
#pragma once

#include <array>

#include "model/study/study_plan.hpp"
#include "model/table/keys.hpp"

namespace edda {

// Names of the values of each enumeration, in the order of the enumeration.
inline constexpr std::array<std::string_view, 10> method_words{
    "monte-carlo", "latin-hypercube", "sobol",         "grid", "table", "form",
    "sorm",        "subset",          "sobol-indices", "fit"};
inline constexpr std::array<std::string_view, 11> distribution_words{
    "normal", "lognormal", "uniform", "triangular", "exponential", "weibull",
    "beta",   "von-mises", "fisher",  "choice",     "seed"};
inline constexpr std::array<std::string_view, 4> copula_words{"normal", "clayton", "gumbel",
                                                              "frank"};
inline constexpr std::array<std::string_view, 4> analysis_words{"run", "fos", "limit", "keyblocks"};
inline constexpr std::array<std::string_view, 2> scale_words{"linear", "log"};
inline constexpr std::array<std::string_view, 3> taken_words{"last", "largest", "smallest"};

constexpr std::span<const std::string_view> names_of(SamplingMethod) {
  return method_words;
}
constexpr std::span<const std::string_view> names_of(Distribution) {
  return distribution_words;
}
constexpr std::span<const std::string_view> names_of(Copula) {
  return copula_words;
}
constexpr std::span<const std::string_view> names_of(Analysis) {
  return analysis_words;
}
constexpr std::span<const std::string_view> names_of(Taken) {
  return taken_words;
}
constexpr std::span<const std::string_view> names_of(Scale) {
  return scale_words;
}

/// The word of a value in the file.
template <class Enum>
constexpr std::string_view word_of(Enum value) {
  return names_of(value)[static_cast<std::size_t>(value)];
}

/// As sections() of a model file; their root is a StudyPlan.
std::span<const Section> study_sections();

}  // namespace edda
