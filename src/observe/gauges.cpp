#include "observe/gauges.hpp"

#include <utility>

namespace edda {

Result<Gauges> place_gauges(const Simulation& sim) {
  Gauges gauges;
  Faults faults;
  const auto take = [&](auto placed, auto& rows) {
    if (placed.ok()) {
      rows = std::move(placed.value());
    } else {
      faults.insert(faults.end(), placed.faults().begin(), placed.faults().end());
    }
  };
  take(place_monitors(sim), gauges.monitors);
  take(place_convergences(sim), gauges.convergences);
  take(place_measurements(sim), gauges.measurements);
  if (!faults.empty()) return faults;
  return gauges;
}

}  // namespace edda
