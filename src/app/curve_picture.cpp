#include "app/curve_picture.hpp"

#include <algorithm>
#include <optional>

#include "model/read_model.hpp"
#include "report/curve_plot.hpp"
#include "results/read_table.hpp"

namespace edda {
namespace {

std::string axis_of(const std::string& vary) {
  if (vary == "tilt") return "tilt (degrees)";
  if (vary == "kh" || vary == "kv") return "seismic coefficient " + vary;
  if (vary == "strength") return "strength divided by";
  if (vary == "flow") return "time of the flow (s)";
  if (vary == "time") return "time of the joints (s)";
  if (vary == "change") return "part of the change (-)";
  return "multiplier of " + (vary == "gravity" ? vary : vary.substr(vary.find(':') + 1));
}

/// The displacements of monitors in a table since the row `first`.
std::vector<CurveLine> lines_of(const Table& table, std::size_t first, std::size_t end) {
  const std::vector<double>& value = table.column("value")->values;
  std::vector<CurveLine> lines;
  for (const Column& c : table.columns) {
    if (!c.name.ends_with(".ux")) continue;
    const std::string name = c.name.substr(0, c.name.size() - 3);
    const Column* const up = table.column(name + ".uy");
    if (up == nullptr) continue;
    CurveLine line{name, {}};
    const Vec2 start{c.values[first], up->values[first]};
    for (std::size_t r = first; r < end; ++r)
      line.points.push_back({norm(Vec2{c.values[r], up->values[r]} - start), value[r]});
    lines.push_back(std::move(line));
  }
  if (!lines.empty()) return lines;
  // Without monitors: the corner that moves most in each increment.
  CurveLine line{"largest", {}};
  double sum = 0.0;
  for (std::size_t r = first; r < end; ++r) {
    sum += r == first ? 0.0 : table.column("moved")->values[r];
    line.points.push_back({sum, value[r]});
  }
  return {line};
}

/// The picture of the last ramp; none where fewer than two of its increments hold.
std::optional<CurvePicture> picture_of(const std::string& folder) {
  const Result<Table> read = read_table(folder + "/curve.csv");
  if (!read.ok() || read.value().rows() == 0) return {};
  const Table& table = read.value();
  for (const char* name : {"stage", "vary", "value", "holds", "moved"}) {
    if (table.column(name) == nullptr) return {};
  }
  const std::vector<double>& stage = table.column("stage")->values;
  const std::size_t rows = table.rows();
  std::size_t first = rows - 1;
  while (first > 0 && stage[first - 1] == stage.back()) --first;
  const bool fails = table.column("holds")->values.back() == 0.0;
  const std::size_t end = fails ? rows - 1 : rows;
  if (end < first + 2) return {};
  CurvePicture picture;
  picture.axis = axis_of(table.column("vary")->text(first));
  picture.lines = lines_of(table, first, end);
  if (fails) picture.fails = table.column("value")->values.back();
  return picture;
}

}  // namespace

bool has_curve(const std::string& folder) {
  return picture_of(folder).has_value();
}

Trouble draw_curve(const std::string& folder, const std::string& path, const std::string& title) {
  std::optional<CurvePicture> picture = picture_of(folder);
  if (!picture) {
    return Fault{{{}, folder, 0, 0},
                 "holds no curve of a ramp with two increments that hold",
                 "run a model with a [[stage]] that has a ramp"};
  }
  picture->title = title;
  if (title.empty()) {
    const Result<Model> model = read_model(folder + "/model.toml", {}, ReadFor::no_run);
    if (model.ok()) picture->title = model.value().title;
  }
  return plot_curve(*picture, path);
}

}  // namespace edda
