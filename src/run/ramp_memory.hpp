// Checkpoint data of ramps.
#pragma once

#include <fmt/format.h>

#include <string>
#include <vector>

#include "checkpoint/archive.hpp"
#include "run/ramp.hpp"

namespace edda {

/// The present increment; `expected`: the present stage has a ramp.
template <class Archive>
void list_ramp(Archive& a, RampProgress& ramp, bool expected) {
  a("ramp.increment", ramp.increment);
  a("ramp.since", ramp.since);
  a("ramp.part", ramp.part);
  a("ramp.moved", ramp.moved);
  bool searches = ramp.search.has_value();
  a("ramp.searches", searches);
  if constexpr (Archive::loads) {
    if (searches && !expected) return a.refuse("ramps do not fit the model");
    if (searches) ramp.search.emplace();
  }
  if (searches) ramp.search->list(a, "ramp.");
}

/// The rows of curve.csv; `monitors`: their number.
template <class Archive>
void list_curve(Archive& a, std::vector<CurveRow>& curve, const Model& model,
                std::size_t monitors) {
  std::size_t rows = curve.size();
  a("curve.rows", rows);
  if constexpr (Archive::loads) curve.resize(rows);
  for (std::size_t q = 0; q < curve.size(); ++q) {
    const std::string of = fmt::format("curve.{}.", q);
    CurveRow& r = curve[q];
    a(of + "stage", r.stage);
    a(of + "value", r.value);
    a(of + "holds", r.holds);
    a(of + "time", r.time);
    a(of + "steps", r.steps);
    a(of + "moved", r.moved);
    a(of + "fx", r.force.x);
    a(of + "fy", r.force.y);
    a(of + "reason", r.reason);
    list_points(a, of + "monitors", r.monitors);
    if constexpr (Archive::loads) {
      if (r.stage >= model.stages.size() || !model.stages[r.stage].ramp ||
          r.monitors.size() != monitors)
        return a.refuse("ramps do not fit the model");
    }
  }
}

}  // namespace edda
