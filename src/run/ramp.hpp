// Ramps of stages: something is varied in increments, and each is held until the model is in
// equilibrium or fails (docs/stages.md; theory, section 11.5).
#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "judge/holding.hpp"
#include "observe/monitors.hpp"
#include "observe/outcome.hpp"

namespace edda {

/// The present increment of a ramp.
struct RampProgress {
  int increment = 0;        ///< 0: the equilibrium at the first value
  std::uint64_t since = 0;  ///< step at which it began
  int part = 1;             ///< of a displaced support: the present part of it (parts_of_change())
  double moved = 0.0;       ///< m, largest displacements of a vertex in its earlier parts together
  std::optional<Holding> search;  ///< from the first increment on
};

/// A row of curve.csv: the end of an increment.
struct CurveRow {
  std::size_t stage = 0;  ///< row of Model::stages
  double value = 0.0;     ///< of what is varied
  bool holds = true;
  double time = 0.0;           ///< s
  std::uint64_t steps = 0;     ///< of this increment
  double moved = 0.0;          ///< m, largest displacement of a vertex in this increment
  Vec2 force;                  ///< N, ramped_force()
  std::string reason;          ///< of the verdict
  std::vector<Vec2> monitors;  ///< m, displacements [monitors]
};

/// Whether what is varied (target: as slow_value()) displaces a support.
bool is_displaced(const Model& model, Varied varied, Index target);

/// Parts in which a change of what is varied is applied, each held in turn: a support is displaced
/// by no more at a time than a small part of the mean size of the blocks, so that they follow it;
/// of everything else one.
int parts_of_change(const Simulation& sim, Varied varied, Index target, double from, double to);

/// Value of increment k: from the first to the last value in equal parts.
double ramp_value(const Ramp& ramp, int increment);

/// Largest displacement of a vertex in this increment so far, m.
double moved_in_increment(const RampProgress& ramp, const Simulation& sim);

/// Gives what the ramps after a stage vary, and none up to it does, the value with which its first
/// ramp begins, since those stages may be new.
void begin_ramps_after(Simulation& sim, std::size_t stage);

/// Brings the ramp to its next value.
void begin_increment(RampProgress& ramp, Simulation& sim, const Stage& stage);
/// Call after every step of an increment but the first.
Verdict look_at_increment(RampProgress& ramp, Simulation& sim, const Stage& stage);

/// Sum of what is varied on all free blocks at that instant, N: the load, the pressure of the
/// water, the reaction at the boundary, or the weight; zero for what is no load.
Vec2 ramped_force(const Simulation& sim, const Instant& at, const Ramp& ramp);

/// Of each ramp so far.
std::vector<RampOutcome> ramp_outcomes(const Model& model, const std::vector<CurveRow>& rows);

std::string curve_csv(const Model& model, const std::vector<CurveRow>& rows);

}  // namespace edda
