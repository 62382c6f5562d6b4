// What edda run says while it runs: to people, or to machines.
#pragma once

#include <memory>
#include <string>

#include "base/fault.hpp"
#include "run/run_model.hpp"

namespace edda {

class RunReport {
 public:
  virtual ~RunReport() = default;
  /// The model or the folder cannot be used.
  virtual void refused(const Faults& faults) = 0;
  virtual void starts(const PreparedRun& run, const std::string& folder) = 0;
  virtual void goes_on(const Progress& progress) = 0;
  virtual void stage_ended(const StageReport& stage) = 0;
  virtual void warns(const std::string& message) = 0;
  /// The run broke off before it could end.
  virtual void breaks(const std::string& why) = 0;
  virtual void ends(const Outcome& outcome, const std::string& folder, int code) = 0;
};

/// Progress, warnings and faults on stderr, closing words on stdout. Quiet: faults alone.
std::unique_ptr<RunReport> report_to_people(bool quiet);

/// One JSON object per line on stdout (docs/command-line.md). Quiet: no progress.
std::unique_ptr<RunReport> report_to_machines(bool quiet);

}  // namespace edda
