#include "app/run_report.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <filesystem>
#include <string>
#include <vector>

#include "app/common.hpp"
#include "app/json_lines.hpp"
#include "app/progress.hpp"
#include "base/text.hpp"
#include "model/stage_names.hpp"
#include "observe/initial_stress_report.hpp"
#include "results/version.hpp"
#include "run/stages.hpp"

namespace edda {
namespace {

class ForPeople : public RunReport {
 public:
  explicit ForPeople(bool quiet) : quiet_(quiet) {}

  void refused(const Faults& faults) override {
    bar_.finish();
    print(faults);
  }

  void starts(const PreparedRun& run, const std::string&) override {
    if (quiet_) return;
    const Simulation& sim = run.sim;
    for (std::size_t q = 0; q < sim.scene->model.stages.size(); ++q)
      stages_.push_back(stage_label(sim.scene->model, q));
    const StageMasses masses = stages_of(sim.scene->model).front().masses;
    const double step = first_step(sim, masses);
    if (is_explicit(sim)) {
      const std::string begins =
          masses == StageMasses::scaled
              ? fmt::format("step about {:.3g} s with scaled masses; with masses as given", step)
              : fmt::format("step at most {:.4g} s;", step);
      fmt::print(stderr, "{}; {} critical step {:.4g} s, governed by {}\n",
                 counted(sim.scene->blocks.size(), "block"), begins,
                 sim.control.bound.critical_step, run.governed_by);
    } else {
      fmt::print(stderr, "{}; step {:.4g} s, governed by {}\n",
                 counted(sim.scene->blocks.size(), "block"), step, run.governed_by);
    }
    for (const std::string& line : initial_stress_report(sim)) {
      fmt::print(stderr, "initial stress: {}\n", line);
    }
    print_warnings(run.warnings);
  }

  void goes_on(const Progress& progress) override {
    if (!quiet_) bar_.show(progress);
  }

  void stage_ended(const StageReport&) override {}

  void warns(const std::string& message) override {
    bar_.finish();
    fmt::print(stderr, "edda: {}\n", message);
  }

  void breaks(const std::string& why) override { warns(why); }

  void ends(const Outcome& o, const std::string& folder, int) override {
    bar_.finish();
    if (o.status == Status::failed) fmt::print(stderr, "edda: {}\n", o.message);
    if (quiet_) return;
    fmt::print("{}: {}\n", status_name(o.status), o.message);
    fmt::print("  {:.6g} s in {}, {} of wall time; {} closed at the end\n", o.time,
               counted(o.steps, "step"), duration_text(o.wall.total),
               counted(o.contacts, "contact"));
    for (const RampOutcome& r : o.ramps) {
      const std::string& stage = stages_[r.stage];
      if (o.message.starts_with(stage + " holds") || o.message.starts_with(stage + " is in"))
        continue;
      fmt::print("  {}: {}{}{}\n", stage, r.vary,
                 r.holds ? fmt::format(" holds at {:.6g}", *r.holds) : "",
                 r.fails ? fmt::format("{} fails at {:.6g}", r.holds ? " and" : "", *r.fails) : "");
    }
    for (const std::string& check : o.failed_checks) {
      fmt::print("  a check does not hold: {}\n", check);
    }
    fmt::print("  energy balance error {:.2g}{}\n", o.energy.error,
               std::filesystem::is_directory(folder)
                   ? fmt::format("; results in {}/ (see summary.json)", folder)
                   : std::string{});
  }

 private:
  bool quiet_;
  ProgressBar bar_;
  std::vector<std::string> stages_;  ///< their labels
};

class ForMachines : public RunReport {
 public:
  explicit ForMachines(bool quiet) : quiet_(quiet) {}

  void refused(const Faults& faults) override {
    print_json(faults);
    Json json = event("end");
    json.pair("status", "refused").pair("exit_code", exit_code::bad_input);
    print_line(json);
  }

  void starts(const PreparedRun& run, const std::string& folder) override {
    const Simulation& sim = run.sim;
    Json json = event("start");
    json.pair("version", version)
        .pair("model", sim.scene->model.file)
        .pair("title", sim.scene->model.title);
    json.pair("folder", folder).pair("blocks", sim.scene->blocks.size());
    json.pair("duration", sim.scene->model.solver.duration).key("stages").open_list();
    for (const Stage& stage : sim.scene->model.stages) json.value(stage.name);
    json.close().pair("step", first_step(sim, stages_of(sim.scene->model).front().masses));
    json.pair("governed_by", run.governed_by);
    json.pair("threads", omp_get_max_threads());
    print_line(json);
    for (const std::string& warning : run.warnings) warns(warning);
  }

  void goes_on(const Progress& p) override {
    if (quiet_) return;
    Json json = event("progress");
    json.pair("time", p.time).pair("fraction", p.fraction).pair("steps", p.steps);
    json.pair("steps_per_second", p.rate).key("seconds_left");
    if (p.seconds_left >= 0.0) {
      json.value(p.seconds_left);
    } else {
      json.null();
    }
    json.pair("stage", p.stage + 1).pair("stages", p.stages).pair("stage_name", p.stage_name);
    json.pair("at_most", p.at_most)
        .pair("kinetic", p.kinetic)
        .pair("largest_velocity", p.largest_velocity);
    json.pair("largest_overlap", p.largest_overlap);
    print_line(json);
  }

  void stage_ended(const StageReport& s) override {
    Json json = event("stage_end");
    json.pair("stage", s.stage + 1).pair("name", s.name).pair("reached", s.reached);
    json.pair("start", s.start).pair("end", s.end).pair("steps", s.steps).pair("ratio", s.ratio);
    if (!s.ramp.empty()) json.pair("ramp", s.ramp);
    print_line(json);
  }

  void warns(const std::string& message) override { print_json_warning(message); }

  void breaks(const std::string& why) override {
    Json json = event("end");
    json.pair("status", "failed").pair("exit_code", exit_code::failed).pair("message", why);
    print_line(json);
  }

  void ends(const Outcome& o, const std::string& folder, int code) override {
    Json json = event("end");
    json.pair("status", status_name(o.status)).pair("exit_code", code).pair("message", o.message);
    json.pair("folder", folder).pair("time", o.time).pair("steps", o.steps);
    json.pair("contacts", o.contacts)
        .pair("drift", o.energy.error)
        .key("failed_checks")
        .open_list();
    for (const std::string& check : o.failed_checks) json.value(check);
    json.close();
    json.pair("wall_seconds", o.wall.total);
    print_line(json);
  }

 private:
  bool quiet_;
};

}  // namespace

std::unique_ptr<RunReport> report_to_people(bool quiet) {
  return std::make_unique<ForPeople>(quiet);
}

std::unique_ptr<RunReport> report_to_machines(bool quiet) {
  return std::make_unique<ForMachines>(quiet);
}

}  // namespace edda
