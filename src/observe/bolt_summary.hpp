// The bolts of a run, a row each.
#pragma once

#include <string>
#include <vector>

#include "step/simulation.hpp"

namespace edda {

/// The largest axial force of a bolt in the frames so far, and its largest dowel force.
struct BoltPeak {
  double force = 0.0;     ///< N, of one bolt, positive in tension
  double time = 0.0;      ///< s
  double distance = 0.0;  ///< m from its head
  Vec2 place;             ///< of the node then, m
  double dowel = 0.0;     ///< N
};

/// Raises the peaks ([Bolts::rows]) to the forces now.
void raise_peaks(const Simulation& sim, std::vector<BoltPeak>& peaks);

/// Rows of bolt_summary.csv (ResultFile::bolt_summary).
std::string bolt_summary_rows(const Simulation& sim, const std::vector<BoltPeak>& peaks);

}  // namespace edda
