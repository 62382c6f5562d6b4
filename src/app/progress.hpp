// The progress of a run, on stderr.
#pragma once

#include <chrono>
#include <string>

#include "run/run_model.hpp"

namespace edda {

/// A bar that redraws itself on a terminal; elsewhere a line every ten seconds, then every minute.
class ProgressBar {
 public:
  ProgressBar();
  void show(const Progress& progress);
  /// The same of a study: samples in place of steps; `of`: all of them, 0: not known.
  void show_samples(const Progress& progress, std::size_t done, std::size_t of);
  /// Ends the bar's line.
  void finish();

 private:
  bool is_due();
  void draw(const std::string& line);
  bool terminal_;
  bool drawn_ = false;
  std::chrono::steady_clock::time_point start_;
  double next_line_ = 10.0;  ///< s after the start
};

/// The progress in at most `columns` characters, with a bar where there is room: the most
/// important first (part done, time left, stage), the others as far as they fit.
std::string progress_line(const Progress& progress, std::size_t columns);

}  // namespace edda
