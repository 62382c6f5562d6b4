#include "app/spectra_source.hpp"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <set>

#include "model/read_model.hpp"
#include "model/stage_names.hpp"
#include "results/read_table.hpp"

namespace edda {
namespace {

constexpr std::array<const char*, 2> directions{"x", "y"};

/// Of the stages of the model those in which a ground motion acts, without their times.
std::vector<ShakenStage> shaken_stages(const Model& model) {
  std::set<std::string> acting;
  for (const Shaking& s : model.shakings) {
    if (acts_at_first(model, s.name)) acting.insert(s.name);
  }
  std::vector<ShakenStage> found;
  for (std::size_t q = 0; q < model.stages.size(); ++q) {
    const Stage& stage = model.stages[q];
    for (const std::string& name : stage.deactivate) acting.erase(name);
    for (const Shaking& s : model.shakings) {
      if (std::find(stage.activate.begin(), stage.activate.end(), s.name) != stage.activate.end())
        acting.insert(s.name);
    }
    if (acting.empty() || stage.to_equilibrium()) continue;
    ShakenStage shaken;
    shaken.number = q + 1;
    shaken.name = stage.name;
    shaken.resets = stage.reset_displacements;
    found.push_back(shaken);
  }
  return found;
}

/// Start and end of each stage so far, s: those of stages.csv, and up to the last row.
std::vector<std::array<double, 2>> times_of_stages(const std::string& folder,
                                                   const std::vector<double>& time) {
  std::vector<std::array<double, 2>> times;
  const Result<Table> table = read_table(folder + "/stages.csv");
  if (table.ok()) {
    const Column *start = table.value().column("start"), *end = table.value().column("end");
    for (std::size_t r = 0; start != nullptr && end != nullptr && r < table.value().rows(); ++r)
      times.push_back({start->values[r], end->values[r]});
  }
  const double last = times.empty() ? time.front() : times.back()[1];
  if (time.back() > last) times.push_back({last, time.back()});
  return times;
}

/// With their times; the whole run where no stage is shaken.
std::vector<ShakenStage> stages_in(const std::string& folder, const Result<Model>& model,
                                   const std::vector<double>& time) {
  std::vector<ShakenStage> stages;
  if (model.ok()) stages = shaken_stages(model.value());
  const std::vector<std::array<double, 2>> times = times_of_stages(folder, time);
  std::erase_if(stages, [&](const ShakenStage& s) { return s.number > times.size(); });
  for (ShakenStage& s : stages) {
    s.start = times[s.number - 1][0];
    s.end = times[s.number - 1][1];
  }
  if (!stages.empty()) return stages;
  ShakenStage whole;
  whole.start = time.front();
  whole.end = time.back();
  return {whole};
}

std::vector<std::string> monitors_in(const Table& history, std::string_view ending) {
  std::vector<std::string> names;
  for (const Column& c : history.columns) {
    if (c.name.ends_with(ending)) names.push_back(c.name.substr(0, c.name.size() - ending.size()));
  }
  return names;
}

/// The rows of the stage. That at its start is still without a reset of displacements and, where
/// velocities are `absolute`, without the ground's velocity that a stage takes off them.
MotionRecord record_of(const Table& history, const std::string& monitor,
                       const std::string& direction, const ShakenStage& stage, bool absolute) {
  const auto values = [&](const char* of) {
    return history.column(monitor + '.' + of + direction)->values;
  };
  const std::vector<double>& time = history.column("time")->values;
  const std::vector<double> a = values("a"), v = values("v"), u = values("u");
  MotionRecord record;
  double origin = 0.0;
  const double rounding = 1e-9 * (stage.end - stage.start);
  for (std::size_t r = 0; r < time.size(); ++r) {
    if (time[r] < stage.start - rounding || time[r] > stage.end + rounding) continue;
    const bool first = record.time.empty();
    if (first && !stage.resets) origin = u[r];
    record.time.push_back(time[r]);
    record.acceleration.push_back(first ? 0.0 : a[r]);
    record.velocity.push_back(v[r]);
    record.displacement.push_back(first ? 0.0 : u[r] - origin);
  }
  if (absolute && record.time.size() > 1)
    record.velocity[0] =
        record.velocity[1] - record.acceleration[1] * (record.time[1] - record.time[0]);
  return record;
}

std::vector<double> less(std::vector<double> of, const std::vector<double>& that) {
  for (std::size_t r = 0; r < of.size(); ++r) of[r] -= that[r];
  return of;
}

const MonitorMotion& motion_in(const ShakenStage& stage, const std::string& monitor,
                               const std::string& direction) {
  return *std::find_if(stage.motions.begin(), stage.motions.end(), [&](const MonitorMotion& m) {
    return m.monitor == monitor && m.direction == direction;
  });
}

/// Fills in the motion of the second monitor relative to the first, and its amplification.
void compare(ShakenStage& stage, const std::vector<std::string>& between) {
  for (const char* direction : directions) {
    const MonitorMotion& low = motion_in(stage, between[0], direction);
    const MonitorMotion& high = motion_in(stage, between[1], direction);
    MonitorMotion relative{
        between[1] + '/' + between[0],
        direction,
        {high.record.time, less(high.record.acceleration, low.record.acceleration),
         less(high.record.velocity, low.record.velocity),
         less(high.record.displacement, low.record.displacement)},
        {},
        {}};
    relative.measures = measures_of(relative.record);
    stage.relative.push_back(std::move(relative));
    std::vector<double> ratio;
    for (std::size_t k = 0; k < low.spectrum.pseudo_acceleration.size(); ++k) {
      const double of = low.spectrum.pseudo_acceleration[k];
      ratio.push_back(of > 0.0 ? high.spectrum.pseudo_acceleration[k] / of
                               : std::numeric_limits<double>::quiet_NaN());
    }
    stage.amplification.push_back(std::move(ratio));
  }
}

/// How far apart rows are against the shortest period.
void note_coarse_rows(const ShakenStage& stage, const SpectraArguments& args,
                      std::vector<std::string>& notes) {
  const std::vector<double>& time = stage.motions.front().record.time;
  double widest = 0.0;
  for (std::size_t r = 1; r < time.size(); ++r) widest = std::max(widest, time[r] - time[r - 1]);
  constexpr double rows = 5.0;  // in a period that they resolve
  if (rows * widest <= args.periods[0] * (1.0 + 1e-9)) return;
  notes.push_back(fmt::format(
      "rows up to {:.3g} s apart: what swings in less than {:.3g} s is not resolved; set "
      "output.history_every for shorter periods, or raise the first of --periods",
      widest, rows * widest));
}

Fault fault_of_arguments(const char* key, std::string problem, std::string remedy) {
  return {{key, {}, 0, 0}, std::move(problem), std::move(remedy)};
}

std::optional<Fault> check_numbers(const SpectraArguments& args) {
  if (!(args.damping >= 0.0 && args.damping < 100.0))
    return fault_of_arguments("--damping", "is not from 0 to below 100",
                              "give percent of critical, as 5");
  const std::vector<double>& p = args.periods;
  constexpr double most = 10000.0;
  if (!(p.size() == 3 && p[0] > 0.0 && p[0] < p[1] && std::isfinite(p[1])))
    return fault_of_arguments("--periods", "holds no range of periods",
                              "give the shortest, the longest (s) and how many, as 0.02,5,100");
  if (!(p[2] >= 2.0 && p[2] <= most && p[2] == std::floor(p[2])))
    return fault_of_arguments("--periods", "has no number of periods as its third value",
                              fmt::format("give one from 2 to {:.0f}", most));
  if (!args.between.empty() && (args.between.size() != 2 || args.between[0] == args.between[1]))
    return fault_of_arguments("--between", "names no two monitors",
                              "give the lower and the upper one, as base,crest");
  return {};
}

std::optional<Fault> check_monitors(const Table& history, const SpectraArguments& args) {
  const std::vector<std::string> with = monitors_in(history, ".ax");
  const auto fault = [&](const char* problem, const char* remedy) {
    return Fault{{{}, args.source + "/history.csv", 0, 0}, problem, remedy};
  };
  if (with.empty() && !monitors_in(history, ".ux").empty())
    return fault("holds no accelerations", "run the model again with this version");
  if (with.empty())
    return fault("holds no monitor",
                 "give the model a [[monitor]] where the motion is asked for, and run it");
  for (const std::string& name : args.between) {
    if (std::find(with.begin(), with.end(), name) != with.end()) continue;
    return fault_of_arguments("--between", "there is no monitor \"" + name + '"',
                              fmt::format("name two of {}", fmt::join(with, ", ")));
  }
  if (history.rows() < 2) return fault("holds less than two rows", "let the run go on");
  return {};
}

/// `absolute`: whether velocities are in the frame of the accelerations.
void fill(ShakenStage& stage, const Table& history, const SpectraArguments& args, bool absolute,
          const std::vector<double>& periods) {
  for (const std::string& monitor : monitors_in(history, ".ax")) {
    for (const char* direction : directions) {
      MonitorMotion m{
          monitor, direction, record_of(history, monitor, direction, stage, absolute), {}, {}};
      m.measures = measures_of(m.record);
      m.spectrum = response_spectrum(pieces_of(m.record), 0.01 * args.damping, periods);
      stage.motions.push_back(std::move(m));
    }
  }
  if (!args.between.empty()) compare(stage, args.between);
}

}  // namespace

Result<Spectra> find_spectra(const SpectraArguments& args) {
  if (const auto fault = check_numbers(args)) return *fault;
  const Result<Table> read = read_table(args.source + "/history.csv");
  if (!read.ok() || read.value().column("time") == nullptr)
    return Fault{{{}, args.source, 0, 0},
                 "holds no history.csv",
                 "run the model, and give the folder of its results"};
  const Table& history = read.value();
  if (const auto fault = check_monitors(history, args)) return *fault;
  Spectra found;
  found.periods =
      in_equal_ratios(args.periods[0], args.periods[1], static_cast<std::size_t>(args.periods[2]));
  const Result<Model> model = read_model(args.source + "/model.toml", {}, ReadFor::no_run);
  bool absolute = false;
  if (model.ok()) {
    found.title = model.value().title;
    const auto& shakings = model.value().shakings;
    absolute = std::none_of(shakings.begin(), shakings.end(),
                            [](const Shaking& s) { return s.apply == ShakingKind::inertia; });
  } else {
    found.notes.push_back("model.toml cannot be read: the whole run is taken as one ground motion");
  }
  found.stages = stages_in(args.source, model, history.column("time")->values);
  for (ShakenStage& stage : found.stages) {
    fill(stage, history, args, absolute, found.periods);
    note_coarse_rows(stage, args, found.notes);
  }
  return found;
}

}  // namespace edda
