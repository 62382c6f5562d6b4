// Stages of a run: the record that is written at the end of each.
#pragma once

#include <string>
#include <vector>

#include "model/stage_names.hpp"
#include "observe/balance.hpp"
#include "step/energy_balance.hpp"
#include "step/simulation.hpp"

namespace edda {

/// A row of stages.csv.
struct StageRecord {
  bool reached = true;            ///< its end; false: no equilibrium within its duration
  double start = 0.0, end = 0.0;  ///< s
  std::uint64_t steps = 0;
  Balance balance;
  EnergyBalance energy;                             ///< at the end
  std::size_t closed = 0, sliding = 0, bonded = 0;  ///< number of contacts at the end
  std::size_t open = 0;      ///< number of contacts that have opened and are still in the list
  std::uint64_t broken = 0;  ///< bonds broken since the start of the run
  std::size_t yielded = 0;   ///< bolts of which any part has yielded, slipped or broken
  std::vector<double> convergences;  ///< m at the end, by row of the model's convergences
};

/// At the start of a stage: no block is loose. In one until equilibrium, adaptive damping is
/// updated from now on.
void seek_equilibrium(Simulation& sim, const Stage& stage);

StageRecord stage_record(const Simulation& sim, const EnergyBalance& energy, double start,
                         std::uint64_t first_step, bool reached);

std::string stages_csv(const Model& model, const std::vector<StageRecord>& records);

/// The first step of a stage with such masses, s; for the implicit method its usual step.
double first_step(const Simulation& sim, StageMasses masses);

/// Those of `rows` that are active now, or those that are not.
NamedRows rows_that(bool act, const ActiveIntervals& intervals, const NamedRows& rows);

/// Whether a bolt (row of all_bolts()) has been installed.
bool is_installed(const Bolts& bolts, Index row);

/// Whether all blocks of an opening (row of Model::openings) have been excavated.
bool is_excavated(const Simulation& sim, Index opening);

}  // namespace edda
