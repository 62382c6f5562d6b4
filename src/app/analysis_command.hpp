// The frame of the commands that find something of a model and say what: fos, limit, keyblocks,
// verify. They have the same options and print their answer in the same ways.
#pragma once

#include <atomic>
#include <functional>
#include <string>
#include <vector>

#include "app/common.hpp"

namespace edda {

/// What an analysis is given beside its model.
struct AnalysisRun {
  int threads;
  const std::atomic<bool>& (*stop)();           ///< the flag that a signal sets from now on
  std::function<void(const std::string&)> say;  ///< a line of progress; empty: none is wanted
};

/// What it has found.
struct AnalysisResult {
  std::string message;                ///< the answer by itself, all that --quiet prints
  std::string summary;                ///< JSON, all that --json prints
  std::vector<std::string> warnings;  ///< printed before the answer
  std::function<void(const std::string& folder)> print{};  ///< the whole answer; empty: the message
  /// Its files, beside model.toml, columns.csv and summary.json; empty: nothing is written.
  std::function<Trouble(const std::string& folder)> write{};
  std::string failure{};  ///< printed on stderr in place of an answer; empty: there is one
  int code = exit_code::done;
};

struct AnalysisCommand {
  const char *name, *what, *footer;
  const char* quiet;   ///< what --quiet does
  bool writes = true;  ///< whether it has a folder
  ReadFor reads = ReadFor::no_run;
  std::function<Result<AnalysisResult>(const Model&, const AnalysisRun&)> find{};
};

/// Adds it, with its model, its folder, --threads, --set, --quiet and --json.
CLI::App& add_analysis(CLI::App& app, int& code, AnalysisCommand command);

}  // namespace edda
