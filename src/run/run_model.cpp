#include "run/run_model.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cmath>

#include "base/text.hpp"
#include "checkpoint/envelope.hpp"
#include "checkpoint/hdf5_image.hpp"
#include "forces/mass_scaling.hpp"
#include "model/completion/plausible.hpp"
#include "model/read_model.hpp"
#include "model/stage_names.hpp"
#include "observe/initial_stress_report.hpp"
#include "observe/linings_in_rock.hpp"
#include "observe/model_warnings.hpp"
#include "observe/resting.hpp"
#include "observe/unused_names.hpp"
#include "observe/wet_rock.hpp"
#include "run/driver.hpp"
#include "run/size_limits.hpp"
#include "run/stages.hpp"
#include "run/wall_clock.hpp"

namespace edda {
namespace {

Fault solver_fault(const Model& model, const char* key, std::string problem, std::string remedy) {
  Fault fault{model.solver.where, std::move(problem), std::move(remedy)};
  if (fault.where.file.empty()) fault.where.file = model.file;
  fault.where.key = std::string("solver.") + key;
  return fault;
}

std::optional<Fault> unstable_step(const Simulation& sim) {
  const Solver& solver = sim.scene->model.solver;
  if (!is_explicit(sim) || !solver.time_step || solver.allow_unstable) return {};
  if (*solver.time_step <= sim.control.bound.critical_step) return {};
  return solver_fault(
      sim.scene->model, "time_step",
      fmt::format("{:.6g} s is above the critical step of {:.6g} s", *solver.time_step,
                  sim.control.bound.critical_step),
      fmt::format("give at most that, or \"auto\" (now {:.6g} s); allow_unstable = true permits it",
                  solver.safety * sim.control.bound.critical_step));
}

/// A fault if so much mass is added that the motion is no longer that of the rock. Exempt are
/// models whose stages all seek an equilibrium, since the motion on the way there has no meaning.
std::optional<Fault> heavy_scaling(const Simulation& sim) {
  const std::vector<Stage> stages = stages_of(sim.scene->model);
  if (!is_explicit(sim) || sim.motion.masses.raised.empty() ||
      std::all_of(stages.begin(), stages.end(), [](const Stage& s) { return s.to_equilibrium(); }))
    return {};
  const double all = free_mass(sim.scene->blocks),
               added = added_mass(sim.scene->blocks, sim.motion.masses.raised);
  if (added <= most_added * all) return {};
  const Solver& solver = sim.scene->model.solver;
  // Before mass scaling each block needed a step smaller by the square root of its factor.
  StepCache known = sim.control.step_cache;
  std::vector<double> own = steps_of_blocks(stiffness_inputs(sim), 0.0, &known);
  for (std::size_t i = 0; i < own.size(); ++i) own[i] /= std::sqrt(sim.motion.masses.raised[i]);
  const double step = step_that_adds(sim.scene->blocks, own, most_added * all);
  const double largest = solver.time_step ? step : solver.safety * step;
  const double unit = std::pow(10.0, std::floor(std::log10(largest)) - 1.0);
  return solver_fault(
      sim.scene->model, "mass_scaling",
      fmt::format("{:.3g} s adds {:.3g} kg of inertia, {:.3g} % of the mass of all free blocks, "
                  "more than {:.0f} %, which would falsify the motion",
                  solver.mass_scaling, added, 100.0 * added / all, 100.0 * most_added),
      fmt::format("give at most {:.2g} s; where only the equilibrium is wanted, leave it out and "
                  "give a [[stage]] until = \"equilibrium\", which scales masses by itself",
                  std::floor(largest / unit) * unit));
}

/// What the cut has changed or left out of the model.
void add_cut_warnings(const CutReport& report, std::vector<std::string>& warnings) {
  if (report.quality_merged > 0) {
    warnings.push_back(
        fmt::format("{}, {:.3g} m2 in all, {} joined to a neighbour ([quality])",
                    counted(static_cast<std::size_t>(report.quality_merged), "sliver"),
                    report.quality_area, report.quality_merged == 1 ? "was" : "were"));
  }
  warnings.insert(warnings.end(), report.left_out.begin(), report.left_out.end());
  warnings.insert(warnings.end(), report.warnings.begin(), report.warnings.end());
}

/// Warns of material points that are excavated with their block.
void warn_of_lost_points(const PreparedRun& run, std::vector<std::string>& warnings) {
  const Model& model = run.sim.scene->model;
  const auto look = [&](const char* what, const std::string& name, std::size_t block) {
    const Index row =
        run.sim.scene->blocks.opening.empty() ? none : run.sim.scene->blocks.opening[block];
    if (row == none) return;
    const Owners owners(model);
    const std::string& opening =
        row < owners.openings ? model.openings[static_cast<std::size_t>(row)].name
                              : model.fills[static_cast<std::size_t>(row - owners.of_fill(0))].name;
    for (const Stage& stage : model.stages) {
      if (std::find(stage.excavate.begin(), stage.excavate.end(), opening) == stage.excavate.end())
        continue;
      warnings.push_back(
          fmt::format("{} {} lies in rock that stage \"{}\" excavates: from then on it keeps its "
                      "last values; move it into rock that stays, for instance at the wall",
                      what, name, stage.name));
    }
  };
  for (const MonitorPoint& m : run.gauges.monitors) look("monitor", m.name, m.block);
  for (const ConvergenceLine& line : run.gauges.convergences) {
    look("an end of convergence", line.name, line.ends[0].block);
    look("an end of convergence", line.name, line.ends[1].block);
    const std::size_t block = line.ends[0].block;
    if (block == line.ends[1].block && !run.sim.scene->blocks.is_meshed(block)) {
      warnings.push_back(
          fmt::format("both ends of convergence {} lie in one block: it shows no opening of joints",
                      line.name));
    }
  }
}

Result<PreparedRun> prepared(Model model, BlockOrder order, ReadFor what_for) {
  const auto start = std::chrono::steady_clock::now();
  const auto timeless = missing_duration(model);
  if (timeless && what_for == ReadFor::run) return *timeless;
  Result<Simulation> made = Simulation::create(std::move(model), order);
  if (!made.ok()) return made.faults();
  PreparedRun run{std::move(made.value()), {}, {}, {}, 0.0};
  judge_initial_stress(run.sim);
  run.cut_seconds = since(start);
  Faults faults;
  Result<Gauges> gauges = place_gauges(run.sim);
  if (!gauges.ok()) faults = gauges.faults();
  for (const Fault& fault : idle_changes(*run.sim.scene)) faults.push_back(fault);
  if (auto fault = unstable_step(run.sim)) faults.push_back(*fault);
  if (auto fault = heavy_scaling(run.sim)) faults.push_back(*fault);
  if (auto fault = beyond_disks(run.sim)) faults.push_back(*fault);
  if (!faults.empty()) return faults;
  run.gauges = std::move(gauges.value());
  std::vector<std::string> on_borders = border_points(run.sim);
  // The polygons are no longer needed: the blocks have their shapes, and all points have been
  // located.
  PolygonSet& polygons = run.sim.scene.edit().polygons;
  polygons.blocks = std::vector<BlockPolygon>();
  polygons.removed = std::vector<BlockPolygon>();
  run.governed_by = governed_by(run.sim);
  run.warnings = run.sim.scene->model.warnings;
  for (std::string& warning : implausible(run.sim.scene->model))
    run.warnings.push_back(std::move(warning));
  for (std::string& warning : unused_names(run.sim)) run.warnings.push_back(std::move(warning));
  for (std::string& warning : linings_in_rock(run.sim)) run.warnings.push_back(std::move(warning));
  warn_of_wet_rock(run.sim, run.warnings);
  for (std::string& warning : model_warnings(run.sim)) run.warnings.push_back(std::move(warning));
  for (std::string& warning : on_borders) run.warnings.push_back(std::move(warning));
  const std::vector<BlockGroup> falling = unsupported_blocks(run.sim);
  for (const BlockGroup& group : falling) run.on_nothing += group.size();
  for (std::string& warning : warnings_of(run.sim, falling))
    run.warnings.push_back(std::move(warning));
  add_cut_warnings(run.sim.scene->polygons.report, run.warnings);
  warn_of_lost_points(run, run.warnings);
  return run;
}

}  // namespace

Result<PreparedRun> prepare_run(Model model, BlockOrder order, ReadFor what_for) {
  const KeyPlaces places = model.key_places;
  Result<PreparedRun> made = prepared(std::move(model), order, what_for);
  if (!made.ok()) return at_their_keys(places, made.faults());
  return made;
}

Result<Outcome> run_model(PreparedRun& run, const RunOptions& options) {
  if (!options.folder.empty()) {
    const bool goes_on = options.resume || options.from_stage;
    const std::string input = goes_on ? "" : run.sim.scene->model.file;
    if (auto trouble = check_folder(options.folder, input)) return *trouble;
  }
  Driver driver(run, options);
  const Faults faults = take_up_folder(driver, options);
  if (!faults.empty()) return faults;
  return driver.run();
}

Faults take_up_folder(Driver& driver, const RunOptions& options) {
  if (!options.resume && !options.from_stage) return {};
  std::string warning;
  const Result<std::string> image = options.from_stage
                                        ? read_stage_checkpoint(options.folder, *options.from_stage)
                                        : read_checkpoint(options.folder, warning);
  if (!image.ok()) return image.faults();
  if (!warning.empty() && options.warn) options.warn(warning);
  const Result<Record> record = from_hdf5(image.value());
  if (!record.ok()) {
    return {{{{}, options.folder, 0, 0},
             "its checkpoint " + record.faults().front().problem,
             "run without --resume"}};
  }
  if (const Trouble trouble = driver.restore(record.value())) return {*trouble};
  return {};
}

}  // namespace edda
