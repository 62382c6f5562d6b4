// What edda spectra finds in the history of a run.
#pragma once

#include <array>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "report/response.hpp"

namespace edda {

struct SpectraArguments {
  std::string source, output;                     ///< folders; no output: nothing is written
  std::vector<std::string> between;               ///< two monitors, or none
  double damping = 5.0;                           ///< percent of critical
  std::vector<double> periods{0.02, 5.0, 100.0};  ///< shortest, longest (s), and how many
};

/// One component of the motion of a monitor; of one relative to another without a spectrum.
struct MonitorMotion {
  std::string monitor;
  std::string direction;  ///< "x" or "y"
  MotionRecord record;
  MotionMeasures measures;
  ResponseSpectrum spectrum;
};

/// A stage in which a ground motion acts, or the whole run.
struct ShakenStage {
  std::size_t number = 0;  ///< from 1; 0: the whole run
  std::string name;
  double start = 0.0, end = 0.0;        ///< s
  bool resets = false;                  ///< whether displacements count from its start
  std::vector<MonitorMotion> motions;   ///< x and y of each monitor in turn
  std::vector<MonitorMotion> relative;  ///< x and y of the second of `between` less the first
  std::vector<std::vector<double>> amplification;  ///< of x and y, [periods] second over first, nan
                                                   ///< where the first does not move
};

struct Spectra {
  std::string title;  ///< of the model
  std::vector<double> periods;
  std::vector<ShakenStage> stages;
  std::vector<std::string> notes;
};

Result<Spectra> find_spectra(const SpectraArguments& args);

}  // namespace edda
