#include "app/nm_picture.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <optional>

#include "app/common.hpp"
#include "model/read_model.hpp"
#include "observe/lining_strength.hpp"
#include "report/nm_plot.hpp"
#include "results/csv_file.hpp"
#include "results/read_table.hpp"

namespace edda {
namespace {

/// A time that is drawn, and what it is called.
struct NmTime {
  std::string name;
  double time = 0.0;  ///< s
};

struct Columns {
  const Column *time, *lining, *thrust, *moment, *material;
  bool complete() const {
    const auto all = {time, lining, thrust, moment, material};
    return std::all_of(all.begin(), all.end(), [](const Column* c) { return c != nullptr; });
  }
};
Columns columns_of(const Table& t) {
  return {t.column("time"), t.column("lining"), t.column("thrust"), t.column("moment"),
          t.column("material")};
}

/// The times asked for, or the ends of stages, or the last one.
std::vector<NmTime> times_of(const PlotArguments& args, const Columns& c) {
  const std::vector<double>& recorded = c.time->values;
  const auto nearest = [&](double time) {
    return *std::min_element(recorded.begin(), recorded.end(), [&](double a, double b) {
      return std::abs(a - time) < std::abs(b - time);
    });
  };
  const auto named = [](double time) { return NmTime{fmt::format("t = {:.6g} s", time), time}; };
  std::vector<NmTime> times;
  for (const double time : args.compare) times.push_back(named(nearest(time)));
  if (args.time) times.push_back(named(nearest(*args.time)));
  if (!times.empty()) return times;
  for (const StageSpan& stage : stages_of(args.source)) {
    const std::string number = std::to_string(times.size() + 1);
    times.push_back({stage.name.empty() ? "stage " + number : stage.name, stage.end});
  }
  if (times.empty()) times.push_back(named(recorded.back()));
  return times;
}

/// The sections of a lining at a time; none before it has been installed.
NmPoints points_at(const Columns& c, const std::string& lining, const NmTime& at,
                   const Model& model) {
  NmPoints points{at.name, {}, {}, {}};
  std::string material;
  for (std::size_t r = 0; r < c.time->values.size(); ++r) {
    const bool now = std::abs(c.time->values[r] - at.time) <= 1e-9 * std::max(1.0, at.time);
    if (!now || c.lining->text(r) != lining) continue;
    points.sections.push_back({c.thrust->values[r], c.moment->values[r]});
    material = c.material->text(r);
  }
  points.strength = strength_outline(model, lining, material);
  points.residual = strength_outline(model, lining, material, true);
  return points;
}

std::vector<std::string> linings_in(const Columns& c) {
  std::vector<std::string> names;
  for (std::size_t r = 0; r < c.time->values.size(); ++r) {
    const std::string name = c.lining->text(r);
    if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
  }
  return names;
}

std::vector<NmPanel> panels_of(const PlotArguments& args, const Columns& c,
                               const std::vector<std::string>& names, const Model& model) {
  std::vector<NmPanel> panels;
  for (const std::string& name : names) {
    NmPanel panel{name, {}};
    for (const NmTime& at : times_of(args, c)) {
      NmPoints points = points_at(c, name, at, model);
      if (!points.sections.empty()) panel.times.push_back(std::move(points));
    }
    if (!panel.times.empty()) panels.push_back(std::move(panel));
  }
  return panels;
}

/// A row for each section, and for each corner of its strength.
Trouble write_points(const std::vector<NmPanel>& panels, const std::string& path) {
  Csv csv;
  for (const char* name : {"lining", "at", "of", "thrust", "moment"}) csv.add(name);
  csv.end();
  for (const NmPanel& panel : panels) {
    for (const NmPoints& at : panel.times) {
      for (const auto& [what, points] :
           {std::pair{"section", &at.sections}, std::pair{"strength", &at.strength},
            std::pair{"residual", &at.residual}}) {
        for (const Vec2 p : *points)
          csv.add(panel.lining).add(at.name).add(what).add(p.x).add(p.y).end();
      }
    }
  }
  return write_rows(path, csv, 0, [](std::size_t) {});
}

}  // namespace

Trouble draw_nm(const PlotArguments& args, const std::string& path) {
  const Result<Table> table = read_table(args.source + "/linings.csv");
  const auto fault = [](const std::string& problem, const std::string& remedy) {
    return Fault{{"--nm", {}, 0, 0}, problem, remedy};
  };
  if (!table.ok())
    return fault(args.source + " holds no linings.csv", "leave it out: the model has no linings");
  const Columns c = columns_of(table.value());
  if (!c.complete() || c.time->values.empty())
    return fault("linings.csv has no forces of linings yet",
                 "run the model until one is installed");
  const Result<Model> model = read_model(args.source + "/model.toml", {}, ReadFor::no_run);
  if (!model.ok()) return model.faults().front();
  std::vector<std::string> names = linings_in(c);
  if (!args.nm.empty()) {
    if (std::find(names.begin(), names.end(), args.nm) == names.end())
      return fault(fmt::format("no lining \"{}\" has been installed", args.nm),
                   fmt::format("give one of {}", fmt::join(names, ", ")));
    names = {args.nm};
  }
  const std::vector<NmPanel> panels = panels_of(args, c, names, model.value());
  if (panels.empty())
    return fault("no lining is there at the end of a stage", "give a time with --time");
  if (ending_of(path) == ".csv") return write_points(panels, path);
  return plot_nm({args.title.empty() ? options_of(model.value(), 0).title : args.title, panels,
                  paper_of(args)},
                 path);
}

}  // namespace edda
