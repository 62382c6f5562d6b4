#include "run/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "contacts/face_reading.hpp"
#include "observe/observe.hpp"
#include "results/columns.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

/// Bolts that have yielded or broken, not only been cut off with excavated rock.
std::size_t yielded_bolts(const Bolts& b, const State& state) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    bool any = false;
    for (std::size_t k = b.begin[r]; k < b.begin[r + 1]; ++k) {
      for (const BoltSprings* s : {&b.bonds, &b.bars, &b.dowels}) {
        const bool cut = is_cut_off(b, state, k) ||
                         (k + 1 < b.begin[r + 1] && s != &b.bonds && is_cut_off(b, state, k + 1));
        any = any || s->yielded[k] != 0 || (s->broken[k] != 0 && !cut);
      }
    }
    count += any;
  }
  return count;
}

}  // namespace

NamedRows rows_that(bool act, const ActiveIntervals& intervals, const NamedRows& rows) {
  const auto some = [act](const std::vector<ActiveInterval>& of, std::vector<Index> among) {
    std::erase_if(among, [&](Index q) { return of[static_cast<std::size_t>(q)].acts() != act; });
    return among;
  };
  return {some(intervals.loads, rows.loads), some(intervals.waters, rows.waters),
          some(intervals.boundaries, rows.boundaries), some(intervals.shakings, rows.shakings)};
}

bool is_installed(const Bolts& bolts, Index row) {
  return std::any_of(bolts.rows.begin(), bolts.rows.end(),
                     [row](const BoltData& bolt) { return bolt.row == row; });
}

bool is_excavated(const Simulation& sim, Index opening) {
  for (std::size_t i = 0; i < sim.scene->blocks.opening.size(); ++i) {
    if (sim.scene->blocks.opening[i] == opening && sim.motion.state.alive[i] != 0) return false;
  }
  return true;
}

void seek_equilibrium(Simulation& sim, const Stage& stage) {
  Relaxation& r = sim.relaxation;
  r.loose.clear();
  r.balanced = false;
  r.seeks_equilibrium = stage.to_equilibrium();
  r.equilibrium_ratio = stage.ratio;
  if (r.seeks_equilibrium) return;
  r.estimate = {};
}

StageRecord stage_record(const Simulation& sim, const EnergyBalance& energy, double start,
                         std::uint64_t first_step, bool reached) {
  StageRecord r;
  r.reached = reached;
  r.start = start;
  r.end = sim.motion.state.time;
  r.steps = sim.motion.state.steps - first_step;
  r.balance = balance_of(sim);
  r.energy = energy;
  r.broken = sim.motion.contacts.broken;
  r.yielded = yielded_bolts(sim.attached.bolts, sim.motion.state);
  const FaceSet& f = sim.motion.contacts;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const bool closed = is_closed_now(sim, k);
    r.open += has_opened(sim, k) && !closed;
    if (!closed) continue;
    ++r.closed;
    r.sliding += slides(face_row(sim, k));
    r.bonded += f.bonded(k);
  }
  return r;
}

std::string stages_csv(const Model& model, const std::vector<StageRecord>& records) {
  Csv csv = begin_table(ResultFile::stages, {.convergences = names_in(model.convergences)});
  const std::vector<Stage> stages = stages_of(model);
  for (std::size_t q = 0; q < records.size(); ++q) {
    const StageRecord& r = records[q];
    const EnergyBalance& l = r.energy;
    csv.add(q + 1).add(stages[q].name);
    csv.add(stage_end_name(stages[q].until)).add(r.reached ? 1 : 0);
    csv.add(r.start).add(r.end).add(r.steps).add(r.balance.mean).add(r.balance.largest);
    if (r.balance.block == no_id) {
      csv.add("");
    } else {
      csv.add(r.balance.block);
    }
    for (const double v : {l.kinetic, l.strain, l.contact, l.gravity, l.friction, l.damping,
                           l.fracture, l.external, l.error}) {
      csv.add(v);
    }
    csv.add(r.closed).add(r.sliding).add(r.bonded).add(r.balance.detached);
    csv.add(r.open).add(r.broken).add(r.yielded).add(r.balance.loose).add(l.transfer);
    for (const double closed : r.convergences) csv.add(closed);
    csv.end();
  }
  return csv.text();
}

double first_step(const Simulation& sim, StageMasses masses) {
  if (masses != StageMasses::scaled || !is_explicit(sim)) return usual_step(sim);
  const Solver& solver = sim.scene->model.solver;
  return std::min(solver.safety * uniform_step(sim),
                  solver.time_step.value_or(std::numeric_limits<double>::infinity()));
}

}  // namespace edda
