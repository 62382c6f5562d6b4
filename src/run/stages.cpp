#include "run/stages.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include "contacts/face_reading.hpp"
#include "results/csv.hpp"
#include "run/labels.hpp"
#include "run/observe.hpp"

namespace edda {
namespace {

std::size_t yielded_bolts(const Bolts& b) {
  std::size_t count = 0;
  for (std::size_t r = 0; r < b.rows.size(); ++r) {
    bool any = false;
    for (std::size_t k = b.begin[r]; k < b.begin[r + 1]; ++k) {
      for (const BoltSprings* s : {&b.bonds, &b.bars, &b.dowels}) {
        any = any || s->yielded[k] != 0 || s->broken[k] != 0;
      }
    }
    count += any;
  }
  return count;
}

}  // namespace

NamedRows rows_that(bool act, const Spells& spells, const NamedRows& rows) {
  const auto some = [act](const std::vector<Spell>& of, std::vector<Index> among) {
    std::erase_if(among, [&](Index q) { return of[static_cast<std::size_t>(q)].acts() != act; });
    return among;
  };
  return {some(spells.loads, rows.loads), some(spells.waters, rows.waters),
          some(spells.boundaries, rows.boundaries), some(spells.shakings, rows.shakings)};
}

bool is_installed(const Bolts& bolts, Index row) {
  return std::any_of(bolts.rows.begin(), bolts.rows.end(),
                     [row](const BoltData& bolt) { return bolt.row == row; });
}

bool is_taken_out(const Simulation& sim, Index opening) {
  for (std::size_t i = 0; i < sim.blocks.opening.size(); ++i) {
    if (sim.blocks.opening[i] == opening && sim.state.alive[i] != 0) return false;
  }
  return true;
}

std::vector<std::uint8_t> touching(const Simulation& sim) {
  std::vector<std::uint8_t> touches(sim.blocks.size(), 0);
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    for (Id q = sim.springs.block_begin[i]; q < sim.springs.block_begin[i + 1]; ++q) {
      if (sim.springs.kxx[q] + sim.springs.kyy[q] > 0.0) touches[i] = 1;
    }
  }
  const Bolts& bolts = sim.bolts;
  for (std::size_t r = 0; r < bolts.rows.size(); ++r) {
    if (!bolts.rows[r].grouted && bolts.bars.broken[bolts.begin[r]] != 0) continue;
    for (Id k = bolts.begin[r]; k < bolts.begin[r + 1]; ++k) touches[bolts.host[k]] = 1;
  }
  const FaceSet& f = sim.contacts;
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (!is_closed(f, k)) continue;
    touches[block_of_edge(sim.blocks, f, k)] = touches[block_of_facing(sim.blocks, f, k)] = 1;
  }
  return touches;
}

std::vector<std::uint8_t> pebbles(const Simulation& sim) {
  constexpr double small = 0.1;  // of the mean
  std::vector<std::uint8_t> are(sim.blocks.size(), 0);
  double size = 0.0, count = 0.0;
  for (std::size_t i = 0; i < are.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i)) continue;
    size += std::sqrt(sim.blocks.area[i]);
    count += 1.0;
  }
  for (std::size_t i = 0; i < are.size(); ++i) {
    are[i] =
        is_free(sim.blocks, sim.state, i) && std::sqrt(sim.blocks.area[i]) * count < small * size;
  }
  return are;
}

Balance balance_of(const Simulation& sim) {
  Balance balance;
  const std::vector<std::uint8_t> touches = touching(sim), small = pebbles(sim);
  double sum = 0.0;
  std::vector<Id> resting;
  std::vector<double> all;
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i) || small[i] != 0) continue;
    if (!touches[i]) {
      ++balance.detached;
      continue;
    }
    if (!sim.aloof.empty() && sim.aloof[i] != 0) {
      ++balance.loose;
      continue;
    }
    resting.push_back(static_cast<Id>(i));
    const double force = 3.0 * norm(centroid(sim.forces.x, sim.forces.y, i));
    sum += force;
    all.push_back(force);
    if (balance.block == no_id || force > balance.largest) {
      balance.largest = force;
      balance.block = static_cast<Id>(i);
    }
  }
  balance.resting = resting.size();
  if (sum == 0.0) return balance;
  const double scale = force_scale(sim, sim.contacts, resting);
  constexpr std::size_t parts = 20;
  const auto most = all.end() - static_cast<std::ptrdiff_t>(all.size() / parts);
  std::nth_element(all.begin(), most - 1, all.end());
  const double sum_of_most = std::accumulate(all.begin(), most, 0.0);
  balance.of_most =
      scale > 0.0 ? sum_of_most / static_cast<double>(most - all.begin()) / scale : 1.0;
  balance.mean = scale > 0.0 ? sum / static_cast<double>(resting.size()) / scale : 1.0;
  balance.largest = scale > 0.0 ? balance.largest / scale : 1.0;
  return balance;
}

StageRecord stage_record(const Simulation& sim, const Ledger& ledger, double start,
                         std::uint64_t first_step, bool reached) {
  StageRecord r;
  r.reached = reached;
  r.start = start;
  r.end = sim.state.time;
  r.steps = sim.state.steps - first_step;
  r.balance = balance_of(sim);
  r.ledger = ledger;
  r.broken = sim.contacts.broken;
  r.yielded = yielded_bolts(sim.bolts);
  const FaceSet& f = sim.contacts;
  for (std::size_t k = 0; k < f.size(); ++k) {
    const bool closed = is_closed(f, k);
    r.open += f.opened[k] > 0.0 && !closed;
    if (!closed) continue;
    ++r.closed;
    r.sliding += slides(f, k);
    r.bonded += f.bonded[k] > 0.0;
  }
  return r;
}

std::string stages_csv(const Model& model, const std::vector<StageRecord>& records) {
  Csv csv;
  for (const char* name :
       {"stage",   "name",          "until",         "reached",       "start",    "end",
        "steps",   "ratio",         "largest_ratio", "largest_block", "kinetic",  "strain",
        "contact", "gravity",       "friction",      "damping",       "fracture", "external",
        "drift",   "contacts",      "sliding",       "bonded",        "detached", "open",
        "broken",  "yielded_bolts", "loose",         "transfer"}) {
    csv.add(name);
  }
  for (const Convergence& c : model.convergences) csv.add(c.name + ".convergence");
  csv.end();
  const std::vector<Stage> stages = stages_of(model);
  for (std::size_t q = 0; q < records.size(); ++q) {
    const StageRecord& r = records[q];
    const Ledger& l = r.ledger;
    csv.add(q).add(stages[q].name);
    csv.add(stages[q].until == StageEnd::time ? "time" : "equilibrium").add(r.reached ? 1 : 0);
    csv.add(r.start).add(r.end).add(r.steps).add(r.balance.mean).add(r.balance.largest);
    if (r.balance.block == no_id) {
      csv.add("");
    } else {
      csv.add(r.balance.block);
    }
    for (const double v : {l.kinetic, l.strain, l.contact, l.gravity, l.friction, l.damping,
                           l.fracture, l.external, l.drift}) {
      csv.add(v);
    }
    csv.add(r.closed).add(r.sliding).add(r.bonded).add(r.balance.detached);
    csv.add(r.open).add(r.broken).add(r.yielded).add(r.balance.loose).add(l.transfer);
    for (const double closed : r.convergences) csv.add(closed);
    csv.end();
  }
  return csv.text();
}

std::vector<Stage> stages_of(const Model& model) {
  if (!model.stages.empty()) return model.stages;
  Stage only;
  only.duration = model.solver.duration;
  only.damping = model.solver.damping;
  return {only};
}

double first_step(const Simulation& sim, StageMasses masses) {
  if (masses != StageMasses::uniform_step || !sim.explicit_method()) return sim.usual_step();
  const Solver& solver = sim.model.solver;
  return std::min(solver.safety * sim.uniform_step(),
                  solver.time_step.value_or(std::numeric_limits<double>::infinity()));
}

std::string stage_label(const Model& model, std::size_t stage) {
  const std::string name = stages_of(model)[stage].name;
  return name.empty() ? fmt::format("stage {}", stage) : fmt::format("stage {} ({})", stage, name);
}

std::string still_moving(const Simulation& sim, const Balance& balance) {
  std::vector<std::pair<double, Id>> speeds;
  const std::vector<std::uint8_t> touches = touching(sim);
  for (std::size_t i = 0; i < sim.blocks.size(); ++i) {
    if (!is_free(sim.blocks, sim.state, i) || !touches[i]) continue;
    speeds.emplace_back(norm(centroid(sim.state.vx, sim.state.vy, i)), static_cast<Id>(i));
  }
  constexpr std::size_t named = 3;
  const std::size_t count = std::min(named, speeds.size());
  std::partial_sort(speeds.begin(), speeds.begin() + static_cast<std::ptrdiff_t>(count),
                    speeds.end(), [](const auto& a, const auto& b) {
                      return a.first != b.first ? a.first > b.first : a.second < b.second;
                    });
  std::string text = fmt::format("the mean unbalanced ratio is {:.3g}", balance.mean);
  if (balance.block != no_id) {
    text += fmt::format(", the largest {:.3g} at {}", balance.largest,
                        block_label(sim.blocks, balance.block));
  }
  for (std::size_t q = 0; q < count; ++q) {
    text += fmt::format("{}{} at {:.3g} m/s", q == 0 ? "; fastest are " : ", ",
                        block_label(sim.blocks, speeds[q].second), speeds[q].first);
  }
  if (balance.detached > 0) text += fmt::format("; {} fall freely", balance.detached);
  return text;
}

}  // namespace edda
