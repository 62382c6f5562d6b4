// The messages of edda run, for people or for machines.
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
  /// The run was aborted.
  virtual void breaks(const std::string& why) = 0;
  virtual void ends(const Outcome& outcome, const std::string& folder, int code) = 0;
};

/// Progress, warnings and faults on stderr, the closing summary on stdout. Quiet: only faults.
std::unique_ptr<RunReport> report_to_people(bool quiet);

/// One JSON object per line on stdout (docs/command-line.md). Quiet: no progress.
std::unique_ptr<RunReport> report_to_machines(bool quiet);

}  // namespace edda
