// The data that edda plot draws, read from a results folder or made from a model.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "model/model.hpp"
#include "report/history_plot.hpp"
#include "report/plot.hpp"
#include "results/read_table.hpp"

namespace edda {

struct PlotArguments {
  std::string source, output, field, vectors, lining, title, relative_to, nm;
  std::vector<std::string> overrides, history;
  std::vector<double> compare;        ///< s
  std::vector<double> range, window;  ///< low, high; x0, y0, x1, y1
  std::vector<double> along;          ///< x0, y0, x1, y1 of a line, m
  std::vector<double> times;          ///< s, first and last of a history
  std::optional<double> time, scale, dpi;
  double width = 0.0;  ///< mm; 0: not given
  int width_pixels = 0;
  double font = 8.0;
  bool forces = false, principal = false, bolts = false, cracks = false, before = false,
       no_marks = false;
  bool whole_range = false, curve = false, is_nm = false;
};

/// All data of a picture.
struct PlotSource {
  std::vector<Snapshot> shots;
  PlotOptions options;
  std::vector<std::string> notes;  ///< deviations of the picture from what was requested
};

Result<PlotSource> from_folder(const PlotArguments& args);
Result<PlotSource> from_model(const PlotArguments& args);

/// What --history draws; its panels point into `table`.
struct HistorySource {
  Table table;
  HistoryPicture picture;
};
/// The stages that have ended.
std::vector<StageSpan> stages_of(const std::string& folder);
/// Fills `source`, which must stay where it is.
Trouble read_histories(const PlotArguments& args, HistorySource& source);

Paper paper_of(const PlotArguments& args);

/// Stresses below it are rounding of the strains, Pa.
double least_stress_of(const Model& model);

}  // namespace edda
