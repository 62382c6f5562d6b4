// edda spectra
#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <memory>

#include "app/commands.hpp"
#include "app/common.hpp"
#include "app/spectra_files.hpp"

namespace edda {
namespace {

/// Where the largest of the values is.
std::size_t place_of_largest(const std::vector<double>& values) {
  std::size_t at = 0;
  for (std::size_t k = 0; k < values.size(); ++k) {
    if (std::isfinite(values[k]) && !(values[k] <= values[at])) at = k;
  }
  return at;
}

void print_stage(const ShakenStage& stage, const std::vector<double>& periods) {
  const std::string of =
      stage.number == 0
          ? std::string("the whole run")
          : fmt::format("stage {}{}{}", stage.number, stage.name.empty() ? "" : ", ", stage.name);
  fmt::print("{}, {:.4g} to {:.4g} s\n", of, stage.start, stage.end);
  std::size_t wide = 7;
  for (const auto* list : {&stage.motions, &stage.relative}) {
    for (const MonitorMotion& m : *list) wide = std::max(wide, m.monitor.size());
  }
  fmt::print("  {:<{}}     {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>7}  {:>9}  {:>7}\n", "", wide,
             "peak a", "peak v", "peak u", "permanent", "Arias", "5-95 %", "largest S", "at T");
  fmt::print("  {:<{}}     {:>9}  {:>9}  {:>9}  {:>9}  {:>9}  {:>7}  {:>9}  {:>7}\n", "monitor",
             wide, "m/s2", "m/s", "m", "m", "m/s", "s", "m/s2", "s");
  for (const auto* list : {&stage.motions, &stage.relative}) {
    for (const MonitorMotion& m : *list) {
      const MotionMeasures& is = m.measures;
      fmt::print("  {:<{}}  {}  {:>9.4g}  {:>9.4g}  {:>9.4g}  {:>9.4g}  {:>9.4g}  {:>7.4g}",
                 m.monitor, wide, m.direction, is.peak_acceleration, is.peak_velocity,
                 is.peak_displacement, is.permanent_displacement, is.arias, is.arias_duration);
      const std::vector<double>& s = m.spectrum.pseudo_acceleration;
      const std::size_t k = place_of_largest(s);
      if (!s.empty()) fmt::print("  {:>9.4g}  {:>7.3g}", s[k], periods[k]);
      fmt::print("\n");
    }
  }
}

void print_amplification(const ShakenStage& stage, const SpectraArguments& args,
                         const std::vector<double>& periods) {
  const auto peak = [&](const std::string& monitor, const std::string& direction) {
    const auto at = std::find_if(stage.motions.begin(), stage.motions.end(), [&](const auto& m) {
      return m.monitor == monitor && m.direction == direction;
    });
    return at->measures.peak_acceleration;
  };
  for (std::size_t d = 0; d < stage.amplification.size(); ++d) {
    const std::string& direction = stage.relative[d].direction;
    const double low = peak(args.between[0], direction), high = peak(args.between[1], direction);
    const std::vector<double>& ratio = stage.amplification[d];
    const std::size_t k = place_of_largest(ratio);
    if (!(low > 0.0) || !std::isfinite(ratio[k])) {
      fmt::print("  amplification {}: none, {} does not move\n", direction, args.between[0]);
      continue;
    }
    fmt::print("  amplification {}, {} over {}: {:.3g} of the peak, at most {:.3g} (at {:.3g} s)\n",
               direction, args.between[1], args.between[0], high / low, ratio[k], periods[k]);
  }
}

int print_spectra(const SpectraArguments& args) {
  const Result<Spectra> found = find_spectra(args);
  if (!found.ok()) {
    print(found.faults());
    return exit_code::bad_input;
  }
  const Spectra& spectra = found.value();
  if (!args.output.empty()) {
    if (const Trouble trouble = write_spectra(spectra, args)) {
      print({*trouble});
      return exit_code::bad_input;
    }
  }
  for (const std::string& note : spectra.notes) fmt::print(stderr, "note: {}\n", note);
  for (const ShakenStage& stage : spectra.stages) {
    print_stage(stage, spectra.periods);
    print_amplification(stage, args, spectra.periods);
  }
  if (!args.output.empty()) {
    fmt::print("results in {}/ (motions.csv, spectra.csv{}, spectra.png{})\n", args.output,
               args.between.empty() ? "" : ", amplification.csv, relative.csv",
               args.between.empty() ? "" : ", relative.png");
  }
  return exit_code::done;
}

}  // namespace

void add_spectra(CLI::App& app, int& code) {
  CLI::App* command = app.add_subcommand(
      "spectra",
      "Print peaks, Arias intensity and response spectra of monitors under ground motion");
  command->footer(
      "Examples:\n"
      "  edda spectra quake-cavern\n"
      "  edda spectra quake-cavern --between base,surface -o quake-cavern-spectra\n\n"
      "Of each monitor in history.csv and each stage in which a ground motion acts, or else of the "
      "whole run. The folder given by -o then holds\n"
      "  motions.csv      peaks, permanent displacement, Arias intensity and its duration\n"
      "  spectra.csv      pseudo-acceleration, relative velocity and displacement over the period\n"
      "  spectra.png, spectra.svg\n"
      "  amplification.csv, relative.csv, relative.png, relative.svg  with --between");
  auto args = std::make_shared<SpectraArguments>();
  command->add_option("DIR", args->source, "A folder of results")->required()->type_name("DIR");
  command
      ->add_option("-o,--output", args->output,
                   "Folder for tables and pictures (default: none are written)")
      ->type_name("DIR");
  command
      ->add_option("--between", args->between,
                   "Motion of the second monitor relative to the first, and its amplification")
      ->type_name("LOWER,UPPER")
      ->delimiter(',')
      ->allow_extra_args(false);
  command
      ->add_option("--damping", args->damping,
                   "Of the oscillators, percent of critical (default: 5)")
      ->type_name("PERCENT");
  command
      ->add_option("--periods", args->periods,
                   "Shortest and longest period (s), and how many (default: 0.02,5,100)")
      ->type_name("T0,T1,N")
      ->delimiter(',')
      ->expected(3);
  command->callback([args, &code] { code = print_spectra(*args); });
}

}  // namespace edda
