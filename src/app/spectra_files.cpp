#include "app/spectra_files.hpp"

#include <fmt/format.h>

#include <cmath>
#include <filesystem>

#include "report/history_plot.hpp"
#include "results/columns.hpp"
#include "results/csv.hpp"
#include "results/read_table.hpp"

namespace edda {
namespace {

void add_measures(Csv& csv, const MonitorMotion& m, const ShakenStage& stage) {
  const MotionMeasures& of = m.measures;
  csv.add(m.monitor).add(m.direction).add(stage.number).add(stage.start).add(stage.end);
  csv.add(of.peak_acceleration).add(of.peak_velocity).add(of.peak_displacement);
  csv.add(of.permanent_displacement).add(of.arias).add(of.arias_duration).end();
}

std::string motions_csv(const Spectra& spectra) {
  Csv csv = begin_table(ResultFile::motions);
  for (const ShakenStage& stage : spectra.stages) {
    for (const MonitorMotion& m : stage.motions) add_measures(csv, m, stage);
    for (const MonitorMotion& m : stage.relative) add_measures(csv, m, stage);
  }
  return csv.text();
}

std::string spectra_csv(const Spectra& spectra) {
  Csv csv = begin_table(ResultFile::spectra);
  for (const ShakenStage& stage : spectra.stages) {
    for (const MonitorMotion& m : stage.motions) {
      for (std::size_t k = 0; k < spectra.periods.size(); ++k) {
        csv.add(m.monitor).add(m.direction).add(stage.number).add(spectra.periods[k]);
        csv.add(m.spectrum.pseudo_acceleration[k]).add(m.spectrum.relative_velocity[k]);
        csv.add(m.spectrum.relative_displacement[k]).end();
      }
    }
  }
  return csv.text();
}

std::string amplification_csv(const Spectra& spectra) {
  Csv csv = begin_table(ResultFile::amplification);
  for (const ShakenStage& stage : spectra.stages) {
    for (std::size_t d = 0; d < stage.amplification.size(); ++d) {
      for (std::size_t k = 0; k < spectra.periods.size(); ++k) {
        csv.add(stage.relative[d].direction).add(stage.number).add(spectra.periods[k]);
        const double ratio = stage.amplification[d][k];
        (std::isfinite(ratio) ? csv.add(ratio) : csv.add("")).end();
      }
    }
  }
  return csv.text();
}

std::string relative_csv(const Spectra& spectra) {
  Csv csv = begin_table(ResultFile::relative);
  for (const ShakenStage& stage : spectra.stages) {
    const MotionRecord &x = stage.relative[0].record, &y = stage.relative[1].record;
    for (std::size_t r = 0; r < x.time.size(); ++r)
      csv.add(stage.number).add(x.time[r]).add(x.displacement[r]).add(y.displacement[r]).end();
  }
  return csv.text();
}

Trouble draw_in_both_forms(const HistoryPicture& picture, const std::string& folder,
                           const char* name) {
  for (const char* ending : {".png", ".svg"}) {
    if (Trouble t = plot_history(picture, folder + '/' + name + ending)) return t;
  }
  return {};
}

/// Names a line, where there are several stages with its stage.
std::string line_name(const Spectra& spectra, const ShakenStage& stage, const std::string& name) {
  return spectra.stages.size() < 2 ? name : fmt::format("{}, stage {}", name, stage.number);
}

std::string titled(const Spectra& spectra, const std::string& what) {
  return spectra.title.empty() ? what : spectra.title + ": " + what;
}

/// A panel of spectral acceleration for each direction; with --between one of amplification.
Trouble draw_spectra(const Spectra& spectra, const SpectraArguments& args) {
  Table lines;
  std::vector<std::vector<std::size_t>> panels(3);
  const auto add = [&](std::size_t panel, std::string name, const std::vector<double>& values) {
    panels[panel].push_back(lines.columns.size());
    lines.columns.push_back({std::move(name), values});
  };
  for (const ShakenStage& stage : spectra.stages) {
    for (const MonitorMotion& m : stage.motions)
      add(m.direction == "x" ? 0 : 1, line_name(spectra, stage, m.monitor),
          m.spectrum.pseudo_acceleration);
    for (std::size_t d = 0; d < stage.amplification.size(); ++d)
      add(2,
          line_name(spectra, stage, stage.relative[d].monitor + '.' + stage.relative[d].direction),
          stage.amplification[d]);
  }
  HistoryPicture picture;
  picture.title =
      titled(spectra, fmt::format("pseudo-acceleration (PSA), damping {:g} %", args.damping));
  picture.across = "period (s)";
  picture.ratios = true;
  picture.time = spectra.periods;
  picture.panels = {{"PSA x", "m/s2", {}}, {"PSA y", "m/s2", {}}};
  if (!args.between.empty()) picture.panels.push_back({"amplification", "", {}});
  for (std::size_t p = 0; p < picture.panels.size(); ++p) {
    for (const std::size_t c : panels[p]) picture.panels[p].lines.push_back(&lines.columns[c]);
  }
  return draw_in_both_forms(picture, args.output, "spectra");
}

Trouble draw_relative(const Spectra& spectra, const SpectraArguments& args) {
  Table lines{{{"x", {}}, {"y", {}}}};
  HistoryPicture picture;
  for (const ShakenStage& stage : spectra.stages) {
    for (std::size_t d = 0; d < lines.columns.size(); ++d) {
      const MotionRecord& record = stage.relative[d].record;
      if (d == 0) picture.time.insert(picture.time.end(), record.time.begin(), record.time.end());
      std::vector<double>& values = lines.columns[d].values;
      values.insert(values.end(), record.displacement.begin(), record.displacement.end());
    }
  }
  picture.title =
      titled(spectra, fmt::format("{} relative to {}", args.between[1], args.between[0]));
  picture.panels = {{"displacement", "m", {&lines.columns[0], &lines.columns[1]}}};
  return draw_in_both_forms(picture, args.output, "relative");
}

/// The folder may hold tables of an earlier call, but no run.
Trouble prepare_folder(const std::string& folder) {
  if (std::filesystem::exists(folder + "/history.csv"))
    return Fault{{"-o", {}, 0, 0},
                 folder + " holds the results of a run",
                 "name another folder, which is made"};
  if (Trouble t = check_folder(folder, {})) return t;
  if (Trouble t = make_folder(folder)) return t;
  std::error_code error;
  for (const char* name : {"amplification.csv", "relative.csv", "relative.png", "relative.svg"})
    std::filesystem::remove(folder + '/' + name, error);
  return {};
}

}  // namespace

Trouble write_spectra(const Spectra& spectra, const SpectraArguments& args) {
  const std::string& folder = args.output;
  if (Trouble t = prepare_folder(folder)) return t;
  if (Trouble t = write_file(folder + "/motions.csv", motions_csv(spectra))) return t;
  if (Trouble t = write_file(folder + "/spectra.csv", spectra_csv(spectra))) return t;
  if (Trouble t = draw_spectra(spectra, args)) return t;
  if (!args.between.empty()) {
    if (Trouble t = write_file(folder + "/amplification.csv", amplification_csv(spectra))) return t;
    if (Trouble t = write_file(folder + "/relative.csv", relative_csv(spectra))) return t;
    if (Trouble t = draw_relative(spectra, args)) return t;
  }
  return write_columns_csv(folder);
}

}  // namespace edda
