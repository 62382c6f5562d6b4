// edda check
#include <fmt/format.h>

#include <chrono>
#include <memory>

#include "app/common.hpp"
#include "run/initial_stress_report.hpp"
#include "run/labels.hpp"
#include "run/load_report.hpp"
#include "run/run_model.hpp"

namespace edda {
namespace {

struct CheckArguments {
  std::string model;
  std::vector<std::string> overrides;
};

/// Steps per second of wall time, from a few steps made and thrown away.
double step_rate(Simulation& sim, double seconds) {
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  double wall = 0.0;
  std::uint64_t steps = 0;
  while (steps < 2 || (wall < seconds && steps < 2000)) {
    if (sim.state.time >= sim.model.solver.duration) break;
    if (sim.step()) break;
    ++steps;
    wall = std::chrono::duration<double>(Clock::now() - start).count();
  }
  return wall > 0.0 ? static_cast<double>(steps) / wall : 0.0;
}

void print_blocks(const Simulation& sim) {
  const BlockSet& b = sim.blocks;
  std::size_t held = 0;
  for (const auto f : b.fixed) held += f != 0;
  const CutReport& r = sim.polygons.report;
  fmt::print("blocks          {} ({} held), {} vertices\n", b.size(), held, b.vertex_count());
  fmt::print(
      "smallest        area {:.4g} m2 at {}, edge {:.4g} m at {}, angle {:.3g} degrees at {}\n",
      r.smallest_area, place_label(r.smallest_area_at), r.smallest_edge,
      place_label(r.smallest_edge_at), r.smallest_angle, place_label(r.smallest_angle_at));
  for (const std::string& note : r.notes) fmt::print("lines           {}\n", note);
}

int check(const CheckArguments& args) {
  const std::optional<Model> model = read_or_print(args.model, args.overrides);
  if (!model) return exit_code::bad_input;
  Result<PreparedRun> prepared = prepare_run(*model);
  if (!prepared.ok()) {
    print(prepared.faults());
    return exit_code::bad_input;
  }
  PreparedRun& run = prepared.value();
  Simulation& sim = run.sim;
  print_blocks(sim);
  fmt::print("contacts        {} closed, {} within reach\n", closed_contacts(sim.contacts),
             sim.contacts.size());
  if (sim.explicit_method()) {
    fmt::print("critical step   {:.6g} s; {:.6g} s if every bare corner touched something\n",
               sim.bound.critical_step, sim.bound.likely_step);
  }
  fmt::print("governed by     {}\n", run.governed_by);
  for (const MonitorPoint& m : run.monitors) {
    fmt::print("monitor         {} in {}\n", m.name, block_label(sim.blocks, m.block));
  }
  for (const ConvergenceLine& line : run.convergences) {
    fmt::print("convergence     {} from {} to {}\n", line.name,
               block_label(sim.blocks, line.ends[0].block),
               block_label(sim.blocks, line.ends[1].block));
  }
  for (const std::string& line : load_report(sim)) fmt::print("load            {}\n", line);
  for (const std::string& line : initial_stress_report(sim)) {
    fmt::print("initial stress  {}\n", line);
  }
  sim.start(std::min(sim.model.output.history_every, sim.model.solver.duration));
  const double h = sim.state.step,
               steps = std::max(1.0, std::ceil(sim.model.solver.duration / h - 1e-9));
  const double rate = step_rate(sim, 0.5);
  const std::string of_what =
      sim.model.solver.time_step ? "as given"
      : !sim.explicit_method()
          ? "as long as nothing moves too far in it; it is cut where needed"
          : fmt::format("{:.2g} of the smaller, or a little less", sim.model.solver.safety);
  fmt::print("step            {:.6g} s ({}), so about {:.0f} steps for {:.6g} s\n", h, of_what,
             steps, sim.model.solver.duration);
  fmt::print("time to expect  {} at {:.3g} steps per second\n", duration_text(steps / rate), rate);
  fmt::print("warnings        {}\n",
             run.warnings.empty() ? "none" : fmt::format("{}", run.warnings.size()));
  for (const std::string& w : run.warnings) fmt::print("  - {}\n", w);
  return exit_code::done;
}

}  // namespace

void add_check(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "check",
      "Check a model without running it: blocks, contacts, step, time to expect, warnings");
  command->footer(
      "Example:\n  edda check slope.toml\n\n"
      "Faults of the model are printed one per line, as FILE:LINE:COLUMN: key: what is wrong: what "
      "to do.\n"
      "Nothing is written.");
  auto args = std::make_shared<CheckArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  add_threads(*command);
  add_overrides(*command, args->overrides);
  command->callback([args, &code] { code = check(*args); });
}

}  // namespace edda
