// edda check
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/common.hpp"
#include "base/text.hpp"
#include "observe/sliver_report.hpp"
#include "results/json.hpp"
#include "run/check_model.hpp"
#include "run/run_model.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

struct CheckArguments {
  std::string model;
  std::vector<std::string> overrides;
  bool json = false;
};

void print_blocks(const Simulation& sim, const ModelCheck& found) {
  const BlockSet& b = sim.scene->blocks;
  const CutReport& r = sim.scene->polygons.report;
  fmt::print("blocks          {} ({} fixed), {} vertices\n", b.size(), found.fixed,
             b.vertex_count());
  fmt::print(
      "smallest        area {:.4g} m2 at {}, edge {:.4g} m at {}, angle {:.3g} degrees at {}\n",
      r.smallest_area, place_label(r.smallest_area_at), r.smallest_edge,
      place_label(r.smallest_edge_at), r.smallest_angle, place_label(r.smallest_angle_at));
  for (const std::string& line : sliver_lines(r)) fmt::print("sliver          {}\n", line);
  for (const std::string& note : r.notes) fmt::print("lines           {}\n", note);
}

void print_places(const PreparedRun& run) {
  const BlockSet& blocks = run.sim.scene->blocks;
  for (const MonitorPoint& m : run.gauges.monitors) {
    fmt::print("monitor         {} in {}\n", m.name, block_label(blocks, m.block));
  }
  for (const ConvergenceLine& line : run.gauges.convergences) {
    fmt::print("convergence     {} from {} to {}\n", line.name,
               block_label(blocks, line.ends[0].block), block_label(blocks, line.ends[1].block));
  }
  for (const MeasuredRegion& region : run.gauges.measurements)
    fmt::print("measurement     {} over {:.4g} m2\n", region.name, region.area);
}

void print_step(const Simulation& sim, const ModelCheck& found) {
  const std::string of_what =
      sim.scene->model.solver.time_step ? "as given"
      : !is_explicit(sim)
          ? "limited by the largest displacement in a step; reduced where needed"
          : fmt::format("{:.2g} of the critical step, or less", sim.scene->model.solver.safety);
  if (found.scaled_step > 0.0) {
    fmt::print(
        "step            about {:.3g} s in stages with scaled masses, stable for all blocks{}\n",
        found.scaled_step,
        found.step_as_given > 0.0 ? fmt::format("; {:.3g} s in others", found.step_as_given)
                                  : std::string{});
  } else {
    fmt::print("step            {:.6g} s ({})\n", found.step, of_what);
  }
  if (found.steps == 0.0) {
    fmt::print(
        "duration        no solver.duration is given: edda run needs one, edda fos does not\n");
    return fmt::print("speed           {:.3g} steps per second\n", found.rate);
  }
  if (found.increments > 0) {
    fmt::print("steps           as many as the {} of ramps need, some thousand each\n",
               counted(static_cast<std::size_t>(found.increments), "increment"));
    return fmt::print("speed           {:.3g} steps per second\n", found.rate);
  }
  fmt::print("steps           {} {:.0f} for {:.6g} s{}\n", found.at_most ? "at most" : "about",
             found.steps, sim.scene->model.solver.duration,
             found.at_most ? ": stages end as soon as the model is in equilibrium" : "");
  fmt::print("time to expect  {}{} at {:.3g} steps per second\n",
             found.at_most && found.steps > found.rate ? "at most " : "",
             duration_text(found.steps / found.rate), found.rate);
}

void print_text(const PreparedRun& run, const ModelCheck& found) {
  const Simulation& sim = run.sim;
  print_blocks(sim, found);
  fmt::print("contacts        {} closed, {} within reach\n", found.closed, found.within_reach);
  if (is_explicit(sim)) {
    fmt::print("critical step   {:.6g} s\n", found.critical_step);
  }
  fmt::print("governed by     {}\n", run.governed_by);
  print_places(run);
  for (const std::string& line : found.loads) fmt::print("load            {}\n", line);
  for (const std::string& line : found.initial_stress) fmt::print("initial stress  {}\n", line);
  for (const std::string& line : found.strain_damping) fmt::print("strain damping  {}\n", line);
  print_step(sim, found);
  fmt::print("warnings        {}\n",
             run.warnings.empty() ? "none" : fmt::format("{}", run.warnings.size()));
  for (const std::string& w : run.warnings) fmt::print("  - {}\n", w);
}

void add_texts(Json& json, const char* name, const std::vector<std::string>& texts) {
  json.key(name).open_list();
  for (const std::string& text : texts) json.value(text);
  json.close();
}

void add_place(Json& json, const char* name, double value, Vec2 at) {
  json.key(name).open_object().pair("value", value).key("at").open_list();
  json.value(at.x).value(at.y).close().close();
}

void print_object(const PreparedRun& run, const ModelCheck& found) {
  const Simulation& sim = run.sim;
  const CutReport& r = sim.scene->polygons.report;
  Json json;
  json.open_object().pair("model", sim.scene->model.file).pair("title", sim.scene->model.title);
  json.pair("blocks", sim.scene->blocks.size()).pair("held", found.fixed);
  json.pair("vertices", sim.scene->blocks.vertex_count());
  if (sim.scene->blocks.meshes.any()) json.pair("zones", sim.scene->blocks.meshes.zone.size());
  json.key("smallest").open_object();
  add_place(json, "area", r.smallest_area, r.smallest_area_at);
  add_place(json, "edge", r.smallest_edge, r.smallest_edge_at);
  add_place(json, "angle", r.smallest_angle, r.smallest_angle_at);
  json.close();
  json.pair("contacts", found.closed).pair("contacts_within_reach", found.within_reach);
  if (is_explicit(sim)) {
    json.pair("critical_time_step", found.critical_step);
    json.pair("likely_time_step", found.critical_step);
  }
  json.pair("governed_by", run.governed_by);
  json.key("monitors").open_object();
  for (const MonitorPoint& m : run.gauges.monitors) {
    json.pair(m.name, block_label(sim.scene->blocks, m.block));
  }
  json.close();
  add_slivers(json, r);
  add_texts(json, "lines", r.notes);
  add_texts(json, "loads", found.loads);
  add_texts(json, "initial_stress", found.initial_stress);
  add_texts(json, "strain_damping", found.strain_damping);
  const bool known = found.steps > 0.0 && found.increments == 0;
  const auto add_if_known = [&](const char* name, double value) {
    json.key(name);
    known ? json.value(value) : json.null();
  };
  add_if_known("duration", sim.scene->model.solver.duration);
  json.pair("time_step", found.step);
  if (found.scaled_step > 0.0) json.pair("static_time_step", found.scaled_step);
  json.pair("at_most", found.at_most);
  add_if_known("steps", found.steps);
  json.pair("steps_per_second", found.rate);
  add_if_known("seconds", found.steps / found.rate);
  if (found.increments > 0) json.pair("increments", found.increments);
  add_texts(json, "warnings", run.warnings);
  fmt::print("{}\n", json.close().line());
}

int check(const CheckArguments& args) {
  const std::optional<Model> model =
      read_or_print(args.model, args.overrides, args.json, ReadFor::no_run);
  if (!model) return exit_code::bad_input;
  Result<PreparedRun> prepared = prepare_run(*model, BlockOrder::as_cut, ReadFor::no_run);
  if (!prepared.ok()) {
    print(prepared.faults(), args.json);
    return exit_code::bad_input;
  }
  PreparedRun& run = prepared.value();
  const ModelCheck found = check_model(run.sim);
  args.json ? print_object(run, found) : print_text(run, found);
  return exit_code::done;
}

}  // namespace

void add_check(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "check",
      "Check a model without running it: blocks, contacts, time step, time to expect, warnings");
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
  add_json(*command, args->json, "Print what it finds as one JSON object on stdout, faults too");
  command->callback([args, &code] { code = check(*args); });
}

}  // namespace edda
