#include "study/verify_model.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <mutex>
#include <optional>
#include <utility>

#include "results/json.hpp"
#include "results/machine.hpp"
#include "results/version.hpp"
#include "study/side_by_side.hpp"

namespace edda {
namespace {

constexpr double finer = 0.5;    // factor on the step
constexpr double stiffer = 3.0;  // factor on the penalty springs

/// How a run ended, and its monitors' displacements then.
struct End {
  std::vector<Vec2> displacement;
  Outcome outcome;
};

Result<End> run_to_end(PreparedRun& run, const RunOptions& how) {
  const Result<Outcome> outcome = run_model(run, how);
  if (!outcome.ok()) return outcome.faults();
  End end;
  end.outcome = outcome.value();
  for (const MonitorPoint& m : run.gauges.monitors) {
    end.displacement.push_back(displacement_of(run.sim.scene->blocks, run.sim.motion.state, m));
  }
  return end;
}

/// Prepares a run with its monitors in the same blocks as in the run with which it is compared,
/// whatever their numbers are: a point on an edge belongs to two.
Result<PreparedRun> prepare_like(const std::vector<MonitorPoint>& monitors, const Model& model,
                                 BlockOrder order) {
  Result<PreparedRun> run = prepare_run(model, order);
  if (!run.ok()) return run;
  run.value().gauges.monitors = monitors;
  if (order == BlockOrder::reversed) {
    const std::size_t blocks = run.value().sim.scene->blocks.size();
    for (MonitorPoint& m : run.value().gauges.monitors) m.block = blocks - 1 - m.block;
  }
  return run;
}

/// One of the runs, and what its displacements are compared with.
struct VerifyRun {
  std::string name;
  std::function<Result<End>(const RunOptions&)> make;
  double MonitorBar::*bar = nullptr;  ///< the difference; none for the run as it is
  std::size_t with = 0;               ///< of an earlier run
};

/// The runs, side by side as far as there are threads, reported one after the other.
class VerifyRuns {
 public:
  /// `options.starts` has been called for the first run.
  VerifyRuns(std::vector<VerifyRun> runs, const VerifyOptions& options, int at_once)
      : runs_(std::move(runs)),
        options_(options),
        ends_(runs_.size()),
        latest_(runs_.size()),
        tasks_(options.threads, at_once) {}

  const VerifyRun& operator[](std::size_t k) const { return runs_[k]; }
  std::size_t size() const { return runs_.size(); }

  /// Waits for the end of run `k` and reports its progress; call for one after the other.
  const Result<End>& end_of(std::size_t k) {
    if (k > 0) report(k);
    while (!has_ended_[k]) {
      while (begun_ < runs_.size() && tasks_.has_room()) begin(begun_++);
      has_ended_[tasks_.wait_for_one()] = true;
    }
    return *ends_[k];
  }
  /// The same of a run whose end has been waited for.
  const End& known_end_of(std::size_t k) const { return ends_[k]->value(); }

 private:
  void report(std::size_t k) {
    const std::lock_guard lock(reporting_);
    reported_ = k;
    if (options_.starts) options_.starts(runs_[k].name);
    if (options_.progress && latest_[k]) options_.progress(*latest_[k]);
  }

  /// Tasks are numbered as the runs are.
  void begin(std::size_t k) {
    tasks_.begin([this, k](const std::stop_token& stop) {
      RunOptions how;
      how.stop = options_.stop;
      how.after_step = [&] { return stop.stop_requested(); };
      if (options_.progress) how.progress = [this, k](const Progress& p) { progress(k, p); };
      ends_[k] = runs_[k].make(how);
    });
  }

  void progress(std::size_t k, const Progress& p) {
    const std::lock_guard lock(reporting_);
    latest_[k] = p;
    if (reported_ == k) options_.progress(p);
  }

  const std::vector<VerifyRun> runs_;
  const VerifyOptions& options_;
  std::vector<std::optional<Result<End>>> ends_;  ///< each belongs to its task until that has ended
  std::map<std::size_t, bool> has_ended_;
  std::size_t begun_ = 0;
  std::mutex reporting_;
  std::vector<std::optional<Progress>> latest_;
  std::size_t reported_ = 0;
  SideBySide tasks_;  ///< the last member: its tasks end before what they write to is gone
};

Model with_finer_step(Model model, double step) {
  if (model.solver.time_step) {
    *model.solver.time_step *= finer;
  } else if (model.solver.method == Method::dda) {
    model.solver.time_step = finer * step;
  } else {
    model.solver.safety *= finer;
  }
  return model;
}

Model with_stiffer_springs(Model model) {
  ContactDefaults& contact = model.contact;
  contact.stiffer *= stiffer;
  for (std::optional<double>* given : {&contact.normal_stiffness, &contact.shear_stiffness}) {
    if (*given) **given *= stiffer;
  }
  for (Boundary& b : model.boundaries) {
    if (b.stiffness) *b.stiffness *= stiffer;
  }
  // A step given by hand may exceed the critical step of stiffer springs.
  if (model.solver.time_step) *model.solver.time_step *= finer;
  return model;
}

constexpr const char* first_run = "as it is";

/// The four runs; `base` is the first of them, prepared.
std::vector<VerifyRun> runs_of(const Model& model, PreparedRun base) {
  const double step = base.sim.control.limit;
  const std::vector<MonitorPoint> monitors = base.gauges.monitors;
  const auto like_base = [monitors](const Model& changed, BlockOrder order) {
    return [=](const RunOptions& how) -> Result<End> {
      Result<PreparedRun> run = prepare_like(monitors, changed, order);
      if (!run.ok()) return run.faults();
      return run_to_end(run.value(), how);
    };
  };
  std::vector<VerifyRun> runs;
  runs.push_back({first_run, [run = std::make_shared<PreparedRun>(std::move(base))](
                                 const RunOptions& how) mutable {
                    const std::shared_ptr<PreparedRun> mine = std::move(run);  // frees its memory
                    return run_to_end(*mine, how);
                  }});
  runs.push_back({"half the step", like_base(with_finer_step(model, step), BlockOrder::as_cut),
                  &MonitorBar::step});
  // The stiffer springs are compared with the run that differs only in them: where the step is
  // given, it is halved in both.
  const std::size_t same_step = model.solver.time_step ? 1 : 0;
  runs.push_back({"springs three times as stiff",
                  like_base(with_stiffer_springs(model), BlockOrder::as_cut),
                  &MonitorBar::stiffness, same_step});
  runs.push_back(
      {"blocks in the other order", like_base(model, BlockOrder::reversed), &MonitorBar::order});
  return runs;
}

}  // namespace

Result<Verification> verify_model(const Model& model, const VerifyOptions& options) {
  if (model.monitors.empty()) {
    return Fault{{"monitor", model.file, 0, 0},
                 "there is none, so there is nothing to put an error bar on",
                 "add a [[monitor]] where the answer matters"};
  }
  Verification v;
  v.own_stiffness =
      !model.joints.empty() && std::all_of(model.joints.begin(), model.joints.end(),
                                           [](const JointLaw& j) { return j.kn.has_value(); });
  if (options.starts) options.starts(first_run);
  Result<PreparedRun> base = prepare_run(model);
  if (!base.ok()) return base.faults();
  for (const MonitorPoint& m : base.value().gauges.monitors) v.monitors.push_back({m.name, {}});
  const std::size_t blocks = base.value().sim.scene->blocks.size();
  std::vector<VerifyRun> planned = runs_of(model, std::move(base.value()));
  const int at_once = tasks_within(memory_here(), static_cast<int>(planned.size()), blocks);
  VerifyRuns runs(std::move(planned), options, at_once);
  for (std::size_t k = 0; k < runs.size(); ++k) {
    const Result<End>& end = runs.end_of(k);
    if (!end.ok()) return end.faults();
    const auto& [displacement, outcome] = end.value();
    v.largest_energy_error = std::max(v.largest_energy_error, outcome.largest_energy_error);
    if (k == 0) v.time = outcome.time;
    const VerifyRun& run = runs[k];
    for (std::size_t m = 0; m < v.monitors.size(); ++m) {
      MonitorBar& monitor = v.monitors[m];
      if (run.bar == nullptr) {
        monitor.displacement = displacement[m];
      } else {
        monitor.*run.bar = norm(displacement[m] - runs.known_end_of(run.with).displacement[m]);
      }
    }
    if (outcome.status != Status::completed && outcome.status != Status::equilibrium) {
      v.failed = run.name + ": " + outcome.message;
      return v;
    }
  }
  return v;
}

std::string verification_summary(const Model& model, const Verification& v) {
  Json j;
  j.open_object().pair("version", version).pair("title", model.title);
  j.pair("failed", v.failed).pair("time", v.time);
  j.pair("energy_error", v.largest_energy_error).pair("own_stiffness", v.own_stiffness);
  j.key("monitors").open_list();
  for (const MonitorBar& m : v.monitors) {
    j.open_object().pair("name", m.name).pair("ux", m.displacement.x).pair("uy", m.displacement.y);
    j.pair("step", m.step).pair("stiffness", m.stiffness).pair("order", m.order).close();
  }
  j.close();
  j.close();
  return j.text() + "\n";
}

}  // namespace edda
