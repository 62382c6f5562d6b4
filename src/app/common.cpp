#include "app/common.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <csignal>
#include <cstdio>
#include <filesystem>

#include "app/json_lines.hpp"
#include "base/threads.hpp"
#include "model/read_model.hpp"
#include "results/machine.hpp"
#include "run/size_limits.hpp"

namespace edda {
namespace {

std::atomic<bool> asked_to_stop{false};
static_assert(std::atomic<bool>::is_always_lock_free);

int lost_for = 0;

void ask_to_stop(int signal) {
  // The end of a terminal may be signalled twice, by it and by its shell.
  if (asked_to_stop.exchange(true) && signal != SIGHUP) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);
  }
}

}  // namespace

const std::atomic<bool>& stop_on_signals() {
  std::signal(SIGINT, ask_to_stop);
  std::signal(SIGTERM, ask_to_stop);
  // Under nohup the end of the terminal does not stop the run.
  if (std::signal(SIGHUP, ask_to_stop) == SIG_IGN) std::signal(SIGHUP, SIG_IGN);
  std::signal(SIGPIPE, SIG_IGN);
  return asked_to_stop;
}

void output_was_lost(int error) {
  if (lost_for == 0) lost_for = error;
}

int why_output_was_lost() {
  return lost_for;
}

void print(const Faults& faults) {
  for (const Fault& f : faults) fmt::print(stderr, "{}\n", to_string(f));
}

void print_warnings(const std::vector<std::string>& warnings) {
  for (const std::string& w : warnings) fmt::print(stderr, "warning: {}\n", w);
}

void print(const Faults& faults, bool json) {
  if (json) return print_json(faults);
  print(faults);
}

Result<Model> read_within_memory(const std::string& path, const std::vector<std::string>& overrides,
                                 ReadFor what_for) {
  Result<Model> model = read_model(path, overrides, what_for);
  if (!model.ok()) return model;
  if (const std::optional<Fault> fault = beyond_memory(model.value(), memory_here())) return *fault;
  return model;
}

std::optional<Model> read_or_print(const std::string& path,
                                   const std::vector<std::string>& overrides, bool json,
                                   ReadFor what_for) {
  Result<Model> model = read_within_memory(path, overrides, what_for);
  if (model.ok()) return std::move(model.value());
  print(model.faults(), json);
  return {};
}

void add_json(CLI::App& command, bool& json, const std::string& description) {
  command.add_flag("--json", json, description);
}

void add_overrides(CLI::App& command, std::vector<std::string>& overrides) {
  command
      .add_option(
          "--set", overrides,
          "Change a key of the model, for instance --set solver.duration=0.2; may be given often")
      ->type_name("KEY=VALUE")
      ->allow_extra_args(false);
}

void add_threads(CLI::App& command) {
  command
      .add_option_function<int>("--threads", report_threads,
                                "Threads to use (default: up to all cores, as many as are "
                                "quickest); results do not depend on "
                                "it")
      ->type_name("N")
      ->check(CLI::Range(1, 4096));
}

std::string stem_of(const std::string& path) {
  std::filesystem::path p(path);
  if (!p.has_filename()) p = p.parent_path();
  return p.stem().string();
}

std::string name_of(const std::string& path) {
  if (!std::filesystem::is_directory(path)) return stem_of(path);
  std::filesystem::path p = std::filesystem::absolute(path).lexically_normal();
  if (!p.has_filename()) p = p.parent_path();
  return p.filename().string();
}

std::string ending_of(const std::string& path) {
  std::string ending = std::filesystem::path(path).extension().string();
  std::transform(ending.begin(), ending.end(), ending.begin(),
                 [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return ending;
}

bool is_picture(const std::string& ending) {
  return ending == ".png" || ending == ".svg" || ending == ".pdf";
}

std::string duration_text(double seconds) {
  if (!(seconds >= 0.0) || !std::isfinite(seconds)) return "unknown";
  if (seconds < 0.1) return "less than 0.1 s";
  if (seconds < 10.0) return fmt::format("{:.2g} s", seconds);
  if (seconds < 60.0) return fmt::format("{:.0f} s", seconds);
  const double minutes = std::floor(seconds / 60.0);
  if (minutes < 60.0)
    return fmt::format("{:.0f} min {:.0f} s", minutes, std::floor(seconds - 60.0 * minutes));
  const double hours = std::floor(minutes / 60.0);
  if (hours < 48.0) return fmt::format("{:.0f} h {:.0f} min", hours, minutes - 60.0 * hours);
  return fmt::format("{:.1f} days", hours / 24.0);
}

}  // namespace edda
