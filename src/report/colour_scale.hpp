// Values to colours.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "report/colours.hpp"
#include "report/drawn_range.hpp"
#include "report/plot.hpp"

namespace edda {

class ColourScale {
 public:
  /// One scale for all snapshots, over the values of all free blocks, except a few outliers, unless
  /// `whole` (drawn_range.hpp; of contacts all values count, but stresses weighted by the lengths
  /// of their faces). `range`: over this range instead. Values beyond have the colours of its ends.
  /// Where it has both signs it is two-sided: blue below zero, red above, equally dark at the same
  /// distance on either side.
  ColourScale(std::span<const Snapshot> shots, std::optional<std::pair<double, double>> range,
              bool whole);
  Colour of(double value) const;

  ScaleKind kind() const { return kind_; }
  double low() const { return low_; }
  double high() const { return high_; }
  bool values_below() const { return values_below_; }
  bool values_above() const { return values_above_; }
  /// Smallest and largest value.
  const Ends& all() const { return all_; }
  const std::vector<std::size_t>& kinds() const { return kinds_; }
  bool has_legend() const;

 private:
  void take_values(std::span<const Snapshot> shots, bool whole);
  void take_range(double low, double high);
  void judge_values();
  ScaleKind kind_;
  bool of_contacts_;
  bool two_sided_ = false;
  double low_ = 0.0, high_ = 0.0;
  Ends all_;
  bool values_below_ = false, values_above_ = false;
  std::vector<std::size_t> kinds_;  ///< that occur
};

}  // namespace edda
