// Pictures of a study of many samples: how its numbers are distributed, and what they depend on.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "results/files.hpp"

namespace edda {

/// One number of every sample.
struct SampledColumn {
  std::string name;
  std::string unit;            ///< empty: none is known
  std::vector<double> values;  ///< [samples]
  std::string label() const { return unit.empty() ? name : name + " (" + unit + ")"; }
};

/// Histogram and cumulative curve.
struct HistogramPicture {
  SampledColumn column;
  std::optional<double> threshold{};  ///< values on one side of it fail
  bool fails_below = true;
};
Trouble plot_histogram(const HistogramPicture& picture, const std::string& path);

/// Every column against every other; histograms on the diagonal, Spearman's coefficients above it.
struct ScatterPicture {
  std::vector<SampledColumn> columns;
  std::vector<char> failed;  ///< [samples]
};
Trouble plot_scatter(const ScatterPicture& picture, const std::string& path);

/// Horizontal bars, the longest above.
struct TornadoPicture {
  std::string axis;  ///< what the bars mean
  std::vector<std::string> names;
  std::vector<double> values;     ///< [names]
  std::vector<double> low, high;  ///< [names] their confidence intervals; may be empty
};
Trouble plot_tornado(const TornadoPicture& picture, const std::string& path);

/// The probability of failure as samples were added, with its interval.
struct ConvergencePicture {
  std::string axis;                            ///< of the probability
  std::vector<double> samples;                 ///< numbers of samples, increasing
  std::vector<double> probability, low, high;  ///< [samples]
};
Trouble plot_convergence(const ConvergencePicture& picture, const std::string& path);

/// Spearman's coefficient of rank correlation of two columns; ties share their mean rank.
double rank_correlation(const std::vector<double>& a, const std::vector<double>& b);

}  // namespace edda
