#include "run/ramp.hpp"

#include <algorithm>
#include <cmath>

#include "observe/attachment_rows.hpp"
#include "results/columns.hpp"
#include "run/stage_plan.hpp"

namespace edda {

double ramp_value(const Ramp& ramp, int increment) {
  const auto [from, to] = *ramp.what.range;
  if (increment >= ramp.steps) return to;
  return from + (to - from) * increment / ramp.steps;
}

bool is_displaced(const Model& model, Varied varied, Index target) {
  return varied == Varied::boundary &&
         model.boundaries[static_cast<std::size_t>(target)].type == BoundaryType::displacement;
}

int parts_of_change(const Simulation& sim, Varied varied, Index target, double from, double to) {
  constexpr double at_a_time = 0.0025;  // of the size of a block
  const Model& model = sim.scene->model;
  if (!is_displaced(model, varied, target)) return 1;
  double size = 0.0, count = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    size += std::sqrt(sim.scene->blocks.area[i]);
    count += 1.0;
  }
  const Vec2 whole = *model.boundaries[static_cast<std::size_t>(target)].displacement;
  const double way = norm(whole) * std::abs(to - from);
  return count > 0.0 ? std::max(1, static_cast<int>(std::ceil(way * count / (at_a_time * size))))
                     : 1;
}

namespace {

int parts_of(const RampProgress& now, const Simulation& sim, const Ramp& ramp) {
  return parts_of_change(sim, ramp.varied, ramp.target, ramp_value(ramp, now.increment - 1),
                         ramp_value(ramp, now.increment));
}

void begin_part(RampProgress& ramp, Simulation& sim, const Stage& stage) {
  const double from = ramp_value(*stage.ramp, ramp.increment - 1),
               to = ramp_value(*stage.ramp, ramp.increment);
  ramp.search.emplace(sim, Criterion{});
  const int parts = parts_of(ramp, sim, *stage.ramp);
  set_ramp(sim, stage, ramp.part >= parts ? to : from + (to - from) * ramp.part / parts);
  ramp.search->begin(sim);
}

}  // namespace

double moved_in_increment(const RampProgress& ramp, const Simulation& sim) {
  return ramp.moved + (ramp.search ? ramp.search->judge().furthest(sim).value : 0.0);
}

void begin_increment(RampProgress& ramp, Simulation& sim, const Stage& stage) {
  ++ramp.increment;
  ramp.since = sim.motion.state.steps;
  ramp.part = 1;
  ramp.moved = 0.0;
  begin_part(ramp, sim, stage);
}

Verdict look_at_increment(RampProgress& ramp, Simulation& sim, const Stage& stage) {
  const int parts = parts_of(ramp, sim, *stage.ramp);
  Verdict found = ramp.search->look(sim);
  const auto made = static_cast<double>(sim.motion.state.steps - ramp.since);
  if (found == Verdict::not_yet && made >= most_steps * parts) found = ramp.search->at_end(sim);
  if (found != Verdict::holds || ramp.part >= parts) return found;
  ramp.moved = moved_in_increment(ramp, sim);
  ++ramp.part;
  begin_part(ramp, sim, stage);
  return Verdict::not_yet;
}

void begin_ramps_after(Simulation& sim, std::size_t stage) {
  const std::vector<Stage>& stages = sim.scene->model.stages;
  const auto varies = [](const Stage& one, const Ramp& ramp) {
    return one.ramp && one.ramp->varied == ramp.varied && one.ramp->target == ramp.target;
  };
  for (std::size_t q = stage + 1; q < stages.size(); ++q) {
    if (!stages[q].ramp || stages[q].ramp->target == none) continue;
    const Ramp& ramp = *stages[q].ramp;
    const auto before = stages.begin() + static_cast<std::ptrdiff_t>(q);
    if (std::any_of(stages.begin(), before, [&](const Stage& s) { return varies(s, ramp); }))
      continue;
    SteppedValue& v = *slow_value(sim.attached.loads.slow, ramp.varied, ramp.target);
    if (v.value != ramp.what.range->x) v.change(ramp.what.range->x, sim.motion.state.time);
  }
}

Vec2 ramped_force(const Simulation& sim, const Instant& at, const Ramp& ramp) {
  const Model& model = sim.scene->model;
  const BlockSet& b = sim.scene->blocks;
  const Loads& loads = sim.attached.loads;
  const double time = sim.motion.state.time;
  Vec2 sum;
  constexpr Varied no_loads[] = {Varied::strength, Varied::flow, Varied::change, Varied::time};
  if (std::find(std::begin(no_loads), std::end(no_loads), ramp.varied) != std::end(no_loads))
    return sum;
  if (ramp.varied == Varied::boundary)
    return reactions(sim, at)[static_cast<std::size_t>(ramp.target)];
  const bool weight = ramp.target == none;
  const Vec2 gravity = gravity_at(model.gravity, loads.slow, time, loads.gradual);
  LoadsNow now = loads_at(model, loads, time);
  const auto keep = [&](std::vector<double>& factors, Varied varied) {
    for (std::size_t q = 0; q < factors.size(); ++q) {
      if (ramp.varied != varied || q != static_cast<std::size_t>(ramp.target)) factors[q] = 0.0;
    }
  };
  keep(now.factor, Varied::load);
  keep(now.weight, Varied::water);
  for (std::size_t i = 0; i < b.size(); ++i) {
    if (!is_free(b, sim.motion.state, i)) continue;
    sum += weight ? b.mass[i] * gravity : load_on(b, now, sim.motion.pose, i);
  }
  return sum;
}

std::vector<RampOutcome> ramp_outcomes(const Model& model, const std::vector<CurveRow>& rows) {
  std::vector<RampOutcome> ramps;
  for (const CurveRow& r : rows) {
    if (ramps.empty() || ramps.back().stage != r.stage)
      ramps.push_back({r.stage, model.stages[r.stage].ramp->what.vary, {}, {}});
    (r.holds ? ramps.back().holds : ramps.back().fails) = r.value;
  }
  return ramps;
}

std::string curve_csv(const Model& model, const std::vector<CurveRow>& rows) {
  Csv csv = begin_table(ResultFile::curve, {.monitors = names_in(model.monitors)});
  for (const CurveRow& r : rows) {
    csv.add(r.stage + 1).add(model.stages[r.stage].ramp->what.vary).add(r.value);
    csv.add(r.holds ? 1 : 0).add(r.time).add(r.steps).add(r.moved).add(r.force.x).add(r.force.y);
    csv.add(r.reason);
    for (const Vec2 u : r.monitors) csv.add(u.x).add(u.y);
    csv.end();
  }
  return csv.text();
}

}  // namespace edda
