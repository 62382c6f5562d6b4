// Lines over time: one panel above another for each kind of quantity, stages marked.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/vec2.hpp"
#include "report/history_panels.hpp"
#include "report/layout.hpp"
#include "results/files.hpp"

namespace edda {

struct StageSpan {
  std::string name;
  double start = 0.0, end = 0.0;  ///< s
};

struct HistoryPicture {
  std::string title;
  std::vector<double> time;         ///< s, of the rows; or what `across` says
  std::string across = "time (s)";  ///< the axis of all panels
  bool ratios = false;  ///< whether that axis is logarithmic, which needs values above 0
  std::vector<HistoryPanel> panels;
  std::vector<StageSpan> stages;  ///< may be empty
  std::optional<Vec2> span{};     ///< s, first and last that are shown; empty: all
  std::optional<Vec2> range{};    ///< values that are shown, lowest and highest; empty: all
  Paper paper{};
};

/// Draws into `path` (.png, .svg or .pdf). Names stand at the ends of their lines. A ratio that is
/// positive and spans more than three powers of ten has a logarithmic axis.
Trouble plot_history(const HistoryPicture& picture, const std::string& path);

}  // namespace edda
