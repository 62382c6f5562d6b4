// Values to colours.
#pragma once

#include <optional>
#include <span>
#include <utility>
#include <vector>

#include "report/colours.hpp"
#include "report/plot.hpp"

namespace edda {

class ColourScale {
 public:
  /// One scale for all snapshots, over the values of all blocks that are not held. `range`: over
  /// that instead; values beyond take the colours of its ends. It is two-sided, blue over white to
  /// red, where values have both signs (a range: where its ends are each other's negatives).
  ColourScale(std::span<const Snapshot> shots, std::optional<std::pair<double, double>> range);
  Colour of(double value) const;

  ScaleKind kind() const { return kind_; }
  double low() const { return low_; }
  double high() const { return high_; }
  bool values_below() const { return values_below_; }
  bool values_above() const { return values_above_; }
  const std::vector<std::size_t>& kinds() const { return kinds_; }
  bool has_legend() const;

 private:
  void take_values(std::span<const Snapshot> shots);
  void take_range(double low, double high);
  void round_up();
  ScaleKind kind_;
  bool two_sided_ = false;
  double low_ = 0.0, high_ = 0.0;
  bool values_below_ = false, values_above_ = false;  ///< of a range given
  std::vector<std::size_t> kinds_;                    ///< that occur
};

}  // namespace edda
