#include "study/verify_model.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "run/driver.hpp"

namespace edda {
namespace {

constexpr double finer = 0.5;    // factor on the step
constexpr double stiffer = 3.0;  // factor on the penalty springs

/// Final displacements of the monitors of one run, or why it failed.
struct End {
  std::vector<MonitorPoint> monitors;
  std::vector<Vec2> displacement;
  double step = 0.0;  ///< s, initial step
  Outcome outcome;
};

Result<End> run_to_end(Model model, BlockOrder order, const std::vector<MonitorPoint>* monitors,
                       const VerifyOptions& options) {
  Result<PreparedRun> prepared = prepare_run(std::move(model), order);
  if (!prepared.ok()) return prepared.faults();
  PreparedRun& run = prepared.value();
  if (monitors != nullptr) {
    // Keeps each monitor in the same block, whatever its number: a point on an edge belongs to two.
    run.monitors = *monitors;
    if (order == BlockOrder::reversed) {
      for (MonitorPoint& m : run.monitors) m.block = run.sim.scene->blocks.size() - 1 - m.block;
    }
  }
  RunOptions how;
  how.progress = options.progress;
  how.stop = options.stop;
  End end;
  end.step = run.sim.control.limit;
  const Result<Outcome> outcome = run_model(run, how);
  if (!outcome.ok()) return outcome.faults();
  end.outcome = outcome.value();
  end.monitors = run.monitors;
  for (const MonitorPoint& m : run.monitors) {
    end.displacement.push_back(displacement_of(run.sim.motion.state, m.block, m.weight));
  }
  return end;
}

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
  model.contact.normal_stiffness *= stiffer;
  model.contact.shear_stiffness *= stiffer;
  for (Boundary& b : model.boundaries) {
    if (b.stiffness) *b.stiffness *= stiffer;
  }
  // A step given by hand may exceed the critical step of stiffer springs.
  if (model.solver.time_step) *model.solver.time_step *= finer;
  return model;
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
  auto run = [&](const char* name, Model m, BlockOrder order,
                 const std::vector<MonitorPoint>* monitors) {
    if (options.starts) options.starts(name);
    Result<End> end = run_to_end(std::move(m), order, monitors, options);
    if (end.ok()) {
      const Outcome& o = end.value().outcome;
      v.largest_energy_error = std::max(v.largest_energy_error, o.largest_energy_error);
      if (o.status != Status::completed && v.failed.empty()) {
        v.failed = std::string(name) + ": " + o.message;
      }
    }
    return end;
  };
  const Result<End> base = run("as it is", model, BlockOrder::as_cut, nullptr);
  if (!base.ok()) return base.faults();
  v.time = base.value().outcome.time;
  for (std::size_t k = 0; k < base.value().monitors.size(); ++k) {
    v.monitors.push_back({base.value().monitors[k].name, base.value().displacement[k]});
  }
  const std::vector<MonitorPoint>& points = base.value().monitors;
  // The stiffer springs are compared with the run that differs only in them: where the step is
  // given, it is halved in both.
  std::optional<End> fine;
  const bool given = model.solver.time_step.has_value();
  auto compare = [&](const char* name, Model m, BlockOrder order, double MonitorBar::*bar,
                     const End& with) -> std::optional<Faults> {
    if (!v.failed.empty()) return {};
    const Result<End> end = run(name, std::move(m), order, &points);
    if (!end.ok()) return end.faults();
    for (std::size_t k = 0; k < v.monitors.size(); ++k) {
      v.monitors[k].*bar = norm(end.value().displacement[k] - with.displacement[k]);
    }
    if (bar == &MonitorBar::step) fine = end.value();
    return {};
  };
  if (auto f = compare("half the step", with_finer_step(model, base.value().step),
                       BlockOrder::as_cut, &MonitorBar::step, base.value())) {
    return *f;
  }
  const End& reference = given && fine ? *fine : base.value();
  if (auto f = compare("springs three times as stiff", with_stiffer_springs(model),
                       BlockOrder::as_cut, &MonitorBar::stiffness, reference)) {
    return *f;
  }
  if (auto f = compare("blocks in the other order", model, BlockOrder::reversed, &MonitorBar::order,
                       base.value())) {
    return *f;
  }
  return v;
}

}  // namespace edda
