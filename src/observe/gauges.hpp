// What a model records beside its blocks and contacts.
#pragma once

#include <vector>

#include "observe/measured_regions.hpp"
#include "observe/monitors.hpp"

namespace edda {

struct Gauges {
  std::vector<MonitorPoint> monitors;
  std::vector<ConvergenceLine> convergences;
  std::vector<MeasuredRegion> measurements;
};

/// Those of the model. Faults: points in no block.
Result<Gauges> place_gauges(const Simulation& sim);

}  // namespace edda
