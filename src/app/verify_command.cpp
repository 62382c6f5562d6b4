// edda verify
#include <fmt/format.h>

#include <cmath>
#include <memory>
#include <utility>

#include "app/analysis_command.hpp"
#include "app/progress.hpp"
#include "study/verify_model.hpp"

namespace edda {
namespace {

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

std::string bars_text(const Verification& v, const Model& model) {
  std::string text = fmt::format(
      "after {:.6g} s; each number is the distance between the ends of this run and of one that "
      "differs in one respect\n",
      v.time);
  for (const MonitorBar& m : v.monitors) {
    text += fmt::format("{:16} {} ({}, {}), {} step, {} stiffness, {} order\n", m.name,
                        length_text(norm(m.displacement)), length_text(m.displacement.x),
                        length_text(m.displacement.y), bar_text(m.step), bar_text(m.stiffness),
                        bar_text(m.order));
  }
  text += fmt::format("energy error     {:.2g} at most", v.largest_energy_error);
  if (v.own_stiffness && model.boundaries.empty())
    text += "\nevery joint gives its kn, a property of the rock, which was not changed";
  return text;
}

Result<AnalysisResult> verify(const Model& model, const AnalysisRun& run) {
  VerifyOptions options;
  options.threads = run.threads;
  options.stop = &run.stop();
  std::unique_ptr<ProgressBar> bar;
  if (run.say) {
    print_warnings(model.warnings);
    options.starts = [&](const std::string& name) {
      if (bar) bar->finish();
      fmt::print(stderr, "run: {}\n", name);
      bar = std::make_unique<ProgressBar>();
    };
    options.progress = [&](const Progress& p) { bar->show(p); };
  }
  const Result<Verification> result = verify_model(model, options);
  if (bar) bar->finish();
  if (!result.ok()) return result.faults();
  const Verification& v = result.value();
  AnalysisResult analysis{bars_text(v, model), verification_summary(model, v), {}};
  analysis.failure = v.failed;
  if (!v.failed.empty()) analysis.code = run.stop() ? exit_code::interrupted : exit_code::failed;
  return analysis;
}

}  // namespace

void add_verify(CLI::App& app, int& code) {
  AnalysisCommand command{
      "verify",
      "Put error bars on a model's monitors, by running it four times",
      "Example:\n"
      "  edda verify cavern.toml\n"
      "  edda verify slope.toml --set solver.duration=0.5\n"
      "\n"
      "Runs the model as it is, at half the step, with penalty springs three times as stiff, and\n"
      "with its blocks numbered the other way round, and prints the change of each monitor's end.\n"
      "Nothing is written. Where a heap of blocks falls, small changes have large effects,\n"
      "and the numbers show it.",
      "No progress",
      false,
      ReadFor::run};
  command.find = verify;
  add_analysis(app, code, std::move(command));
}

}  // namespace edda
