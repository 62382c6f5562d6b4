// edda verify
#include <fmt/format.h>
#include <omp.h>

#include <atomic>
#include <cmath>
#include <memory>

#include "app/common.hpp"
#include "app/progress.hpp"
#include "study/verify_model.hpp"

namespace edda {
namespace {

struct VerifyArguments {
  std::string model;
  std::vector<std::string> overrides;
  bool quiet = false;
};

/// "11.8 mm": a length in the unit that suits it.
std::string length_text(double metres) {
  const double size = std::abs(metres);
  if (size >= 1.0 || size == 0.0) return fmt::format("{:.4g} m", metres);
  if (size >= 1e-3) return fmt::format("{:.4g} mm", 1e3 * metres);
  return fmt::format("{:.4g} um", 1e6 * metres);
}

std::string bar_text(double metres) {
  return "+- " + (metres == 0.0 ? std::string("0") : length_text(metres));
}

void print_bars(const Verification& v, const Model& model) {
  fmt::print(
      "after {:.6g} s; each number is the distance between the ends of this run and of one that "
      "differs in one respect\n",
      v.time);
  for (const MonitorBar& m : v.monitors) {
    fmt::print("{:16} {} ({}, {}), {} step, {} stiffness, {} order\n", m.name,
               length_text(norm(m.displacement)), length_text(m.displacement.x),
               length_text(m.displacement.y), bar_text(m.step), bar_text(m.stiffness),
               bar_text(m.order));
  }
  fmt::print("energy error     {:.2g} at most\n", v.largest_energy_error);
  if (v.own_stiffness && model.boundaries.empty()) {
    fmt::print("every joint gives its kn, a property of the rock, which was not changed\n");
  }
}

int verify(const VerifyArguments& args) {
  const std::optional<Model> model = read_or_print(args.model, args.overrides);
  if (!model) return exit_code::bad_input;
  const std::atomic<bool>& stop_asked = stop_on_signals();
  VerifyOptions options;
  options.threads = omp_get_max_threads();
  options.stop = &stop_asked;
  std::unique_ptr<ProgressBar> bar;
  if (!args.quiet) {
    print_warnings(model->warnings);
    options.starts = [&](const std::string& run) {
      if (bar) bar->finish();
      fmt::print(stderr, "run: {}\n", run);
      bar = std::make_unique<ProgressBar>();
    };
    options.progress = [&](const Progress& p) { bar->show(p); };
  }
  const Result<Verification> result = verify_model(*model, options);
  if (bar) bar->finish();
  if (!result.ok()) {
    print(result.faults());
    return exit_code::bad_input;
  }
  const Verification& v = result.value();
  if (!v.failed.empty()) {
    fmt::print(stderr, "edda: {}\n", v.failed);
    return stop_asked ? exit_code::interrupted : exit_code::failed;
  }
  print_bars(v, *model);
  return exit_code::done;
}

}  // namespace

void add_verify(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "verify", "Put error bars on a model's monitors, by running it four times");
  command->footer(
      "Example:\n"
      "  edda verify cavern.toml\n"
      "  edda verify slope.toml --set solver.duration=0.5\n"
      "\n"
      "Runs the model as it is, at half the step, with penalty springs three times as stiff, and\n"
      "with its blocks numbered the other way round, and prints the change of each monitor's end.\n"
      "Nothing is written. Where a heap of blocks falls, small changes have large effects,\n"
      "and the numbers show it.");
  auto args = std::make_shared<VerifyArguments>();
  command->add_option("MODEL", args->model, "The model, a TOML file")
      ->required()
      ->type_name("FILE");
  add_threads(*command);
  add_overrides(*command, args->overrides);
  command->add_flag("-q,--quiet", args->quiet, "No progress");
  command->callback([args, &code] { code = verify(*args); });
}

}  // namespace edda
