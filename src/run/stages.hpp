// Stages of a run: how far from rest all is, and what is written at the end of each.
#pragma once

#include <string>
#include <vector>

#include "run/simulation.hpp"

namespace edda {

/// How far from equilibrium the forces of the last step are. Blocks that touch nothing do not
/// count: they fall, whatever the others do; nor do those that have come loose, nor pebbles.
struct Balance {
  double mean = 0.0;     ///< resultant of a block, mean, over the mean contact normal force (the
                         ///< mean weight where no contact carries)
  double of_most = 0.0;  ///< the same mean without the twentieth of the blocks furthest from rest
  double largest = 0.0;  ///< the same of the block furthest from rest
  Id block = no_id;      ///< that block
  std::size_t resting = 0;   ///< blocks that count
  std::size_t detached = 0;  ///< free blocks that touch nothing
  std::size_t loose = 0;     ///< blocks that slide or fall away for good (Simulation::aloof)
};

Balance balance_of(const Simulation& sim);

/// [nb] 1: a free block smaller (square root of the area) than a tenth of the mean of all free
/// ones. Its inertia raised for the sake of the step, it takes long to find its place, and nothing
/// hangs on that.
std::vector<std::uint8_t> pebbles(const Simulation& sim);

/// [nb] 1: touches something, or is held by a boundary or a bolt.
std::vector<std::uint8_t> touching(const Simulation& sim);

/// A row of stages.csv.
struct StageRecord {
  bool reached = true;            ///< its end; false: no equilibrium within its duration
  double start = 0.0, end = 0.0;  ///< s
  std::uint64_t steps = 0;
  Balance balance;
  Ledger ledger;                                    ///< at the end
  std::size_t closed = 0, sliding = 0, bonded = 0;  ///< contacts at the end
  std::size_t open = 0;                             ///< those near each other that have come apart
  std::uint64_t broken = 0;                         ///< bonds broken since the start of the run
  std::size_t yielded = 0;           ///< bolts of which any part has yielded, slipped or broken
  std::vector<double> convergences;  ///< at the end, m, by row of the model's
};

StageRecord stage_record(const Simulation& sim, const Ledger& ledger, double start,
                         std::uint64_t first_step, bool reached);

std::string stages_csv(const Model& model, const std::vector<StageRecord>& records);

/// The stages of the model, or the one that it is without any.
std::vector<Stage> stages_of(const Model& model);

/// The step that a stage with such masses begins with, s; that of an implicit method as usual.
double first_step(const Simulation& sim, StageMasses masses);

/// Those of `rows` that act now, or those that do not.
NamedRows rows_that(bool act, const Spells& spells, const NamedRows& rows);

/// Whether a bolt (row of all_bolts()) has been put in.
bool is_installed(const Bolts& bolts, Index row);

/// Whether no block of an opening (row of Model::openings) is left.
bool is_taken_out(const Simulation& sim, Index opening);

/// "stage 2 (heading)".
std::string stage_label(const Model& model, std::size_t stage);

/// The fastest blocks and how many move, for a stage that found no rest.
std::string still_moving(const Simulation& sim, const Balance& balance);

}  // namespace edda
