#include "observe/summary.hpp"

#include <fmt/format.h>
#include <omp.h>

#include <algorithm>
#include <cmath>

#include "forces/mass_scaling.hpp"
#include "model/stage_names.hpp"
#include "observe/damping_report.hpp"
#include "observe/initial_stress_report.hpp"
#include "observe/model_warnings.hpp"
#include "observe/motion.hpp"
#include "observe/overstress.hpp"
#include "observe/sliver_report.hpp"
#include "results/json.hpp"
#include "results/version.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

constexpr std::string_view fall_check = "number of blocks that fell freely under local damping";
constexpr std::string_view loose_check = "number of blocks that have come loose";
constexpr std::string_view aside_check = "number of blocks that were set aside";
constexpr std::string_view injection_check = "times that no joint took the water of an injection";
constexpr std::string_view stage_check = "number of stages that found no equilibrium";
constexpr std::string_view broken_check = "number of joints that broke where gravity acted at once";
constexpr std::string_view overlap_check = "largest overlap over half width of a block";
constexpr std::string_view rigid_check =
    "part of its strength that the model lacks as rigid blocks";
constexpr std::string_view chatter_check =
    "number of times that contacts opened or closed while they chattered";
/// Impacts and ground motion cause some events: a limit for the model, and one per free block.
constexpr double chatter_limit = 100.0, chatter_limit_of_block = 2.0;
/// A penetration displaces contact forces by its own amount. An impact on soft ground may reach
/// this limit for a moment; at more, the shape of the block no longer determines the direction of
/// the force.
constexpr double overlap_limit = 0.2;
/// The same at the end of the run.
constexpr double overlap_limit_at_end = 0.02;

Check limited(std::string name, double value, double limit) {
  return {std::move(name), value, limit, value <= limit};
}

Check informed(std::string name, double value) {
  return {std::move(name), value, {}, true};
}

constexpr std::string_view name_of(Method m) {
  return m == Method::edda ? "edda" : "dda";
}

constexpr std::string_view name_of(MassKind m) {
  return m == MassKind::matched ? "matched" : m == MassKind::covering ? "covering" : "consistent";
}

void add_steps(Json& j, const Simulation& sim, const Outcome& o) {
  const StepStatistics& s = sim.accounts.steps;
  const auto n = static_cast<double>(std::max<std::uint64_t>(o.steps, 1));
  j.pair("steps", o.steps).key("time_step").open_object();
  j.pair("min", s.smallest)
      .pair("max", s.largest)
      .pair("mean", std::clamp(s.sum / n, s.smallest, s.largest))
      .close();
}

void add_open_close(Json& j, const Simulation& sim) {
  const OpenCloseCounts& c = sim.accounts.open_close;
  const auto steps = static_cast<double>(std::max<std::uint64_t>(c.steps, 1));
  j.key("open_close").open_object().pair("mean", static_cast<double>(c.passes) / steps);
  j.pair("max", c.most).pair("switched", c.switched).pair("unsettled", c.not_converged).close();
}

void add_energy(Json& j, const EnergyBalance& l) {
  j.key("energy").open_object();
  for (const EnergyTerm& term : energy_terms) j.pair(term.name, l.*term.value);
  j.close();
}

void add_overlap(Json& j, const Overlap& o) {
  j.key("largest_overlap");
  if (o.block_i == no_id) {
    j.null();
    return;
  }
  j.open_object().pair("over_half_width", o.ratio).pair("depth", o.depth);
  j.key("at").open_list().value(o.place.x).value(o.place.y).close();
  j.key("blocks").open_list().value(std::size_t{o.block_i}).value(std::size_t{o.block_j}).close();
  j.pair("time", o.time).close();
}

void add_wall(Json& j, const WallSeconds& w) {
  j.key("wall_seconds").open_object().pair("total", w.total).pair("cut", w.cut);
  j.pair("search", w.search).pair("forces", w.forces).pair("integrate", w.integrate);
  j.pair("output", w.output).close();
}

void add_checks(Json& j, const std::vector<Check>& checks) {
  j.key("checks").open_list();
  for (const Check& c : checks) {
    j.open_object().pair("name", c.name).pair("value", c.value).key("limit");
    if (c.limit) {
      j.value(*c.limit);
    } else {
      j.null();
    }
    j.pair("pass", c.pass).close();
  }
  j.close();
}

/// The ramps by the names or numbers of their stages.
void add_ramps(Json& j, const Model& model, const std::vector<RampOutcome>& ramps) {
  if (ramps.empty()) return;
  j.key("ramps").open_object();
  for (const RampOutcome& r : ramps) {
    const std::string& name = model.stages[r.stage].name;
    j.key(name.empty() ? std::to_string(r.stage + 1) : name).open_object();
    j.pair("vary", r.vary).pair("holds", r.holds).pair("fails", r.fails).close();
  }
  j.close();
}

}  // namespace

/// Ramps until collapse that have ended in equilibrium at their last value.
static double without_collapse(const Model& model, const std::vector<RampOutcome>& ramps) {
  return static_cast<double>(std::count_if(ramps.begin(), ramps.end(), [&](const RampOutcome& r) {
    const Stage& stage = model.stages[r.stage];
    return stage.until == StageEnd::collapse && !r.fails && r.holds == stage.ramp->what.range->y;
  }));
}

/// Blocks whose material gives a strength: the largest utilisation, and the number of blocks above
/// 1.
static void add_overstress(const Simulation& sim, std::vector<Check>& checks) {
  const auto& materials = sim.scene->model.materials;
  if (std::none_of(materials.begin(), materials.end(),
                   [](const Material& m) { return m.strength.has_value(); }))
    return;
  double largest = 0.0;
  std::size_t over = 0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    const double used = overstress(sim, sim.motion.state, i);
    largest = std::max(largest, used);
    over += used > 1.0;
  }
  checks.push_back(limited("largest part of the rock's strength used in a block", largest, 1.0));
  checks.push_back(informed("blocks over-stressed", static_cast<double>(over)));
}

static void add_rigid_check(const Outcome& o, std::vector<Check>& checks) {
  constexpr double deforms = 0.01;  // joints and blocks do so before they fail
  if (!o.rigid_factor) return;
  checks.push_back(
      limited(std::string(rigid_check), std::max(0.0, 1.0 - *o.rigid_factor), deforms));
}

static void add_flow_check(const Simulation& sim, std::vector<Check>& checks) {
  if (!sim.scene->model.flow) return;
  const JointWater& water = sim.attached.joint_water;
  checks.push_back(limited("times that the free surface of the flow was not found",
                           static_cast<double>(water.not_found), 0.0));
  const auto& waters = sim.scene->model.waters;
  if (std::any_of(waters.begin(), waters.end(), [](const Water& w) { return w.injection; }))
    checks.push_back(
        limited(std::string(injection_check), static_cast<double>(water.not_taken), 0.0));
}

std::vector<Check> checks_of(const Simulation& sim, const Outcome& o) {
  std::vector<Check> checks{
      limited(std::string(overlap_check), o.overlap.ratio, overlap_limit),
      limited("overlap over half width at the end", o.overlap_now, overlap_limit_at_end),
      limited("largest drift of the energy", o.largest_energy_error, 0.05),
      limited("numerical energy error / largest energy", o.largest_transfer, 1e-3),
      limited("number of blocks that rest on nothing at the start",
              static_cast<double>(o.on_nothing), 0.0),
  };
  add_flow_check(sim, checks);
  if (is_explicit(sim)) {
    const auto free = static_cast<double>(std::count(
        sim.scene->blocks.fixed.begin(), sim.scene->blocks.fixed.end(), std::uint8_t{0}));
    checks.push_back(limited(std::string(chatter_check), static_cast<double>(o.chatter.count),
                             chatter_limit + chatter_limit_of_block * free));
  }
  if (const std::size_t aside = sim.accounts.set_aside.size(); aside > 0)
    checks.push_back(limited(std::string(aside_check), static_cast<double>(aside), 0.0));
  if (o.slowed_in_fall > 0) {
    checks.push_back(limited(std::string(fall_check), static_cast<double>(o.slowed_in_fall), 0.0));
  }
  if (gravity_acts_at_once(sim)) {
    checks.push_back(
        limited(std::string(broken_check), static_cast<double>(sim.motion.contacts.broken), 0.0));
  }
  const std::vector<Stage> stages = stages_of(sim.scene->model);
  if (std::any_of(stages.begin(), stages.end(),
                  [](const Stage& s) { return s.to_equilibrium(); })) {
    checks.push_back(limited(std::string(loose_check), static_cast<double>(o.loose), 0.0));
    checks.push_back(limited(std::string(stage_check), static_cast<double>(o.unsettled), 0.0));
  }
  if (std::any_of(stages.begin(), stages.end(),
                  [](const Stage& s) { return s.until == StageEnd::collapse; })) {
    checks.push_back(limited("number of ramps until collapse without one",
                             without_collapse(sim.scene->model, o.ramps), 0.0));
  }
  if (is_explicit(sim)) {
    checks.insert(checks.begin() + 2,
                  limited("largest step over critical step", o.step_over_critical, 1.0));
  }
  add_rigid_check(o, checks);
  const bool rest = o.unbalanced <= equilibrium_limit;
  // While blocks still move, reactions also carry their inertia forces and are not judged.
  checks.push_back(
      rest ? limited("boundary reactions against weight", o.reaction_error, equilibrium_limit)
           : informed("boundary reactions against weight (still moving)", o.reaction_error));
  checks.push_back(
      rest ? limited("unbalanced contact forces at rest", o.unbalanced, equilibrium_limit)
           : informed("unbalanced contact forces (still moving)", o.unbalanced));
  checks.push_back(informed("faces merged by the cut", sim.scene->polygons.report.merged));
  checks.push_back(
      informed("slivers joined by [quality]", sim.scene->polygons.report.quality_merged));
  checks.push_back(
      informed("slivers that stay", static_cast<double>(sim.scene->polygons.report.kept.size())));
  checks.push_back(informed("mass added by scaling (kg)",
                            added_mass(sim.scene->blocks, sim.motion.masses.raised)));
  add_initial_checks(sim, checks);
  add_overstress(sim, checks);
  return checks;
}

/// Whether the block has no strain damping, and could have: it is not meshed.
static bool is_undamped(const Simulation& sim, Id block) {
  const BlockSet& b = sim.scene->blocks;
  return b.fixed[block] == 0 && !b.is_meshed(block) &&
         viscosity_of(sim.motion.masses, block) == 0.0;
}

static std::string chatter_text(const Check& check, const Simulation& sim, const Chatter& chatter) {
  std::string text =
      fmt::format("contacts are chattering ({:.0f} openings and closings, limit {:.0f})",
                  check.value, check.limit.value_or(0.0));
  if (chatter.block_i == no_id) return text;
  return text + fmt::format(
                    ", mostly between {} and {} at {:.3g} s. Blocks may creep; {}try "
                    "solver.damping.contact = 0.1",
                    block_label(sim.scene->blocks, chatter.block_i),
                    block_label(sim.scene->blocks, chatter.block_j), chatter.time,
                    is_undamped(sim, chatter.block_i) || is_undamped(sim, chatter.block_j)
                        ? "give the rock its damping (materials.NAME.damping = 0.5), or "
                        : "");
}

std::string message_of(const Check& check, const Simulation& sim, const Outcome& o) {
  if (check.name == chatter_check) return chatter_text(check, sim, o.chatter);
  std::string text = fmt::format("{} is {:.3g}, more than {:.3g}", check.name, check.value,
                                 check.limit.value_or(0.0));
  if (check.name == overlap_check && o.overlap.block_i != no_id) {
    text += fmt::format(": {:.3g} m between {} and {} at {}, t = {:.6g} s", o.overlap.depth,
                        block_label(sim.scene->blocks, o.overlap.block_i),
                        block_label(sim.scene->blocks, o.overlap.block_j),
                        place_label(o.overlap.place), o.overlap.time);
  }
  if (check.name == rigid_check) {
    text += fmt::format(
        ": rigid blocks of the same geometry have a factor of safety of {:.4g} and no equilibrium. "
        "The blocks are held by a geometric detail: a sharp tip, a ledge, or a joint that has "
        "closed; see edda limit",
        *o.rigid_factor);
  }
  if (check.name == aside_check) {
    const SetAside& first = sim.accounts.set_aside.front();
    text += fmt::format(
        ": {} at {}, t = {:.6g} s, sank into others by more than half its size and was taken out, "
        "so that the others go on; for blocks as small the contacts are too soft: raise "
        "contact.normal_stiffness (or the joint's kn), or join slivers to their neighbours with "
        "[quality]",
        block_label(sim.scene->blocks, first.block), place_label(first.place), first.time);
  }
  if (check.name == loose_check) {
    text += ": the given strength is not enough to hold them; edda fos finds the factor of safety";
  }
  if (check.name == stage_check) {
    text +=
        ": its blocks still move, or slide away; edda fos finds the factor of safety, and a longer "
        "duration of the stage shows whether they come to rest";
  }
  if (check.name == broken_check) {
    text +=
        ": forces reach up to about twice their values in equilibrium then, so that joints may "
        "break "
        "which would hold; begin with a [[stage]] with until = \"equilibrium\"";
  }
  if (check.name == injection_check) {
    text +=
        ": none conducts water inside the rock, or the flow is steady and the water can leave "
        "nowhere; check apertures and sides, or let the flow take its time by a ramp of flow";
  }
  if (check.name == fall_check) {
    text +=
        ": local damping slows down their fall; leave it out, or end with a [[stage]] with "
        "until = \"equilibrium\"";
  }
  return text;
}

std::string summary_json(const Simulation& sim, const Outcome& o, const std::string& governed_by,
                         const std::vector<InputFile>& inputs) {
  Json j;
  j.open_object().pair("version", version).pair("title", sim.scene->model.title);
  j.pair("method", name_of(sim.scene->model.solver.method))
      .pair("mass", name_of(sim.scene->model.solver.mass));
  j.pair("status", status_name(o.status)).pair("message", o.message);
  j.pair("blocks", sim.scene->blocks.size()).pair("contacts", o.contacts).pair("time", o.time);
  add_steps(j, sim, o);
  add_ramps(j, sim.scene->model, o.ramps);
  j.pair("critical_time_step", o.critical_step).pair("governed_by", governed_by);
  add_open_close(j, sim);
  j.pair("step_changes", sim.accounts.steps.changes)
      .pair("step_cuts", sim.accounts.steps.redone)
      .pair("max_penetration", sim.accounts.max_penetration);
  add_overlap(j, o.overlap);
  add_energy(j, o.energy);
  add_wall(j, o.wall);
  j.key("set_aside").open_list();
  for (const SetAside& s : sim.accounts.set_aside) {
    j.open_object().pair("block", std::size_t{s.block}).pair("time", s.time);
    j.key("at").open_list().value(s.place.x).value(s.place.y).close();
    j.pair("area", sim.scene->blocks.area[s.block]).close();
  }
  j.close();
  const double work = static_cast<double>(sim.scene->blocks.size()) * static_cast<double>(o.steps);
  j.pair("block_steps_per_second", o.wall.stepping > 0.0 ? work / o.wall.stepping : 0.0);
  j.pair("threads", omp_get_max_threads());
  add_checks(j, checks_of(sim, o));
  add_slivers(j, sim.scene->polygons.report);
  add_strain_damping(j, sim);
  j.key("inputs").open_list();
  for (const InputFile& input : inputs) {
    j.open_object().pair("file", input.file).pair("sha256", input.sha256).close();
  }
  return j.close().close().text();
}

}  // namespace edda
