#include "step/relaxation.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <utility>

#include "base/parallel.hpp"
#include "contacts/approach.hpp"
#include "contacts/face_bonds.hpp"
#include "step/changes.hpp"
#include "step/contact_search.hpp"
#include "step/force_jumps.hpp"
#include "step/simulation.hpp"
#include "step/tile_step.hpp"
#include "step/touching.hpp"

namespace edda {
namespace {

/// Upper limit of what one value may count, so that none is more than a quarter of the sum (with
/// few values, more than four times their mean). Otherwise one block that slides alone would
/// dominate the motion of all blocks that are to reach equilibrium.
double largest_part(const std::vector<double>& values) {
  constexpr double part = 1.0 / 4.0, few = 4.0;
  constexpr int rounds = 30;
  const auto counting =
      std::count_if(values.begin(), values.end(), [](double v) { return v > 0.0; });
  const double share = std::max(part, few / std::max(1.0, static_cast<double>(counting)));
  double most = std::numeric_limits<double>::infinity();
  if (share >= 1.0) return most;
  for (int round = 0; round < rounds; ++round) {
    double sum = 0.0;
    for (const double v : values) sum += std::min(v, most);
    if (share * sum >= most) break;
    most = share * sum;
  }
  return most;
}

/// Frequency of a wave across a square arrangement of all blocks, 1/s.
double wave_frequency(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  return 0.5 /
         (sim.motion.state.step * std::sqrt(static_cast<double>(b.size() + b.meshes.nodes())));
}

/// By which factor inertia is raised, the mean of the free blocks; 1 where there are none.
double raised_inertia(const Simulation& sim) {
  const std::vector<double>& raised = sim.motion.masses.raised;
  double mass = 0.0, inertia = 0.0;
  for (std::size_t i = 0; i < sim.scene->blocks.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) continue;
    mass += sim.scene->blocks.mass[i];
    inertia += sim.scene->blocks.mass[i] * (raised.empty() ? 1.0 : raised[i]);
  }
  return mass > 0.0 ? inertia / mass : 1.0;
}

/// Slower than this no supported block moves, 1/s: a hundredth of the wave's frequency, or the
/// rocking and falling over of a block of mean size, which weight alone drives.
double slowest_frequency(const Simulation& sim) {
  const double by_stiffness = 0.01 * wave_frequency(sim);
  const double g = norm(sim.scene->model.gravity);
  if (g == 0.0) return by_stiffness;
  const double size = mean_width(sim.scene->blocks, sim.motion.state);
  return std::min(by_stiffness, std::sqrt(g / (raised_inertia(sim) * size)));
}

/// Steps from one estimate to the next: a quarter of a radian of the motion.
std::uint64_t steps_between_looks(const FrequencyEstimate& estimate, double h) {
  constexpr double radians = 0.25, least = 8.0, most = 512.0;
  const double wanted = estimate.frequency > 0.0 ? radians / (estimate.frequency * h) : 0.0;
  return static_cast<std::uint64_t>(std::clamp(wanted, least, most));
}

/// [nb] 1: counts in the frequency estimate, of the blocks `supported` by a contact, spring or
/// bolt. A block that falls or slides away has no stiffness and moves further than all others
/// together.
std::vector<std::uint8_t> counts_in_frequency(const Simulation& sim,
                                              std::vector<std::uint8_t> supported) {
  const std::vector<std::uint8_t>& loose = sim.relaxation.loose;
  for (std::size_t i = 0; i < supported.size(); ++i) {
    if (!is_free(sim.scene->blocks, sim.motion.state, i)) supported[i] = 0;
    if (!loose.empty() && loose[i] != 0) supported[i] = 0;
  }
  return supported;
}

/// [nb] Rayleigh quotient by block: -dx . df and dx . M dx.
struct Quotient {
  std::vector<double> stiffness, inertia;
};

/// Records the position of the block and the forces on it without loads, whose changes are no
/// response to motion. Where the block `counts`, adds its changes since the last estimate to the
/// quotient.
void look_at_block(Simulation& sim, const LoadsNow& at_work, std::size_t i, bool counts,
                   Quotient& sum) {
  const BlockSet& blocks = sim.scene->blocks;
  const State& state = sim.motion.state;
  const BodyVectors& forces = sim.motion.forces;
  FrequencyEstimate& estimate = sim.relaxation.estimate;
  const double h = state.step;
  const Vec2 gravity = sim.scene->model.gravity - at_work.gravity_reduction();
  BlockForces load{blocks, i};
  if (at_work.loads != nullptr && at_work.loads->place[i] != no_id)
    add_loads(load, at_work, sim.motion.pose.x1, sim.motion.pose.y1);
  const Vec2 weight = (blocks.mass[i] / nodes_per_block) * gravity;
  // The forces are those of the positions before the step.
  const BodyVector x =
      vector_of(blocks, state.position, i) - h * vector_of(blocks, state.velocity, i);
  BodyVector f = vector_of(blocks, forces, i);
  f.nodes = f.nodes - at_every_node(weight);
  f -= load.sum;
  if (counts) {
    const BodyVector dx = x - vector_of(blocks, estimate.position, i);
    sum.stiffness[i] -= dot(dx, f - vector_of(blocks, estimate.force, i));
    sum.inertia[i] += mass_product(sim.motion.masses, sim.scene->blocks, i, dx, dx);
  }
  store(x, blocks, estimate.position, i);
  store(f, blocks, estimate.force, i);
}

/// w^2 of the whole model, 1/s2; nothing where nothing has moved. No block counts with an inertia
/// above `most_of_one`.
std::optional<double> square_of_frequency(const Quotient& sum, double most_of_one) {
  double stiffness = 0.0, inertia = 0.0;
  for (std::size_t i = 0; i < sum.inertia.size(); ++i) {
    const double part = sum.inertia[i] > most_of_one ? most_of_one / sum.inertia[i] : 1.0;
    stiffness += part * sum.stiffness[i];
    inertia += part * sum.inertia[i];
  }
  if (!(inertia > 0.0)) return {};
  return std::max(stiffness / inertia, 0.0);
}

/// Updates w of each block, from -dx . df/dx . M dx of its own motion: in a mode of vibration it is
/// that of the mode for every block; a block that slides or falls has none, whatever the others do,
/// and damping does not hold it. Half of the previous square remains. Unsupported blocks are not
/// damped.
void update_frequencies_of_blocks(Simulation& sim, const Quotient& sum,
                                  const std::vector<std::uint8_t>& touch) {
  std::vector<double>& w = sim.relaxation.estimate.of_block;
  const bool first = w.empty();
  w.resize(touch.size(), 0.0);
  for (std::size_t i = 0; i < w.size(); ++i) {
    if (touch[i] == 0) {
      w[i] = 0.0;
    } else if (sum.inertia[i] > 0.0) {
      const double now = std::max(sum.stiffness[i] / sum.inertia[i], 0.0);
      w[i] = first ? std::sqrt(now) : std::sqrt(0.5 * (w[i] * w[i] + now));
    }
  }
}

/// Updates the frequency estimate where that is due.
void update_estimate(Simulation& sim, const LoadsNow& at_work) {
  const std::size_t nb = sim.scene->blocks.size();
  const State& state = sim.motion.state;
  FrequencyEstimate& estimate = sim.relaxation.estimate;
  const bool first = is_empty(estimate.position);
  if (!first && state.steps < estimate.since + steps_between_looks(estimate, state.step)) return;
  if (first) estimate.position = estimate.force = zero_vectors(sim.scene->blocks);
  const std::vector<std::uint8_t> touch = touching(sim);
  const std::vector<std::uint8_t> stays = counts_in_frequency(sim, touch);
  const bool none_stays =
      std::none_of(stays.begin(), stays.end(), [](std::uint8_t stay) { return stay != 0; });
  Quotient sum{std::vector<double>(nb, 0.0), std::vector<double>(nb, 0.0)};
  parallel_for(nb, [&](std::size_t i) {
    look_at_block(sim, at_work, i, is_free(sim.scene->blocks, state, i), sum);
  });
  estimate.since = state.steps;
  if (first) return;
  update_frequencies_of_blocks(sim, sum, touch);
  for (std::size_t i = 0; i < nb && !none_stays; ++i) {
    if (stays[i] == 0) sum.stiffness[i] = sum.inertia[i] = 0.0;
  }
  // Once all else is in balance, the blocks that still move determine the frequency.
  const double most_of_one =
      sim.relaxation.balanced ? std::numeric_limits<double>::infinity() : largest_part(sum.inertia);
  const std::optional<double> now = square_of_frequency(sum, most_of_one);
  if (!now) return;
  // Where the motion has no stiffness, since all that moves slides, half of the previous square
  // remains.
  const double slowest = none_stays ? 0.0 : slowest_frequency(sim), was = estimate.frequency;
  estimate.frequency =
      std::max(was > 0.0 ? std::sqrt(0.5 * (was * was + *now)) : std::sqrt(*now), slowest);
}

/// Reciprocal factor of the strength during the elastic initialisation (Relaxation::Hold).
constexpr double holding = 1e-3;

/// Puts strength in force as it is at this part of its gradual change.
void change_strength(Simulation& sim, double part) {
  const Relaxation& relaxation = sim.relaxation;
  double& bonds = sim.motion.contacts.bond_strength;
  if (bonds > 1.0) bonds = 1.0 / (holding + part * (1.0 - holding));
  std::vector<double> now = relaxation.strength_to;
  for (std::size_t r = 0; r < now.size(); ++r) {
    now[r] = relaxation.strength_from[r] + part * (now[r] - relaxation.strength_from[r]);
  }
  take_strength_factors(sim, now);
}

/// Unglues the joints that were glued for the elastic initialisation.
void let_open(Simulation& sim) {
  if (!sim.relaxation.holds_together) return;
  sim.relaxation.holds_together = false;
  const BodyVectors before = forces_now(sim);
  change_faces(sim, [&](FaceSet& faces, FaceStates&) {
    unglue_faces(faces, sim.scene->blocks, sim.motion.pose);
  });
  reevaluate_faces(sim);
  note_jump(sim, before);
}

/// Increases what is applied gradually, in proportion to the frequency estimate: all of it within
/// one period, more slowly where inertia has been raised, since such blocks follow more slowly than
/// their neighbours. Between the loads and the reduction of strength of an elastic initialisation
/// the model settles: for one period after the first loads; until it is in balance where joints are
/// bonded, since blocks that have parted fall slowly, against the damping.
void advance_gradual_change(Simulation& sim) {
  Relaxation& relaxation = sim.relaxation;
  if (gradual_change_complete(sim)) return;
  constexpr double settling = 1.0, at_most = 5.0, increments = 100.0;
  constexpr double slower_with_bonds = 4.0;  // bounds the rate at which bonds release energy
  // Before anything has moved, the frequency of the wave is used.
  const double frequency =
      relaxation.estimate.frequency > 0.0 ? relaxation.estimate.clock() : wave_frequency(sim);
  GradualChange& gradual = sim.attached.loads.gradual;
  const double before = gradual.part;
  const bool settled = gradual.settling == 0.0;
  const bool loading = relaxation.hold == Relaxation::Hold::loading;
  const double raised = gradual.periods > 0.0 ? raised_inertia(sim) : 1.0;
  const double periods = raised > 1.0 ? gradual.periods * std::sqrt(raised) : 1.0;
  const double period = 2.0 * std::numbers::pi * periods / frequency;
  const bool with_bonds = sim.motion.contacts.bond_strength > 1.0;
  const double slower = with_bonds && settled && !loading ? slower_with_bonds : 1.0;
  const double more = sim.motion.state.step / std::max(slower * period, gradual.least);
  if (settled) {
    gradual.part += more;
  } else {
    const bool may_end = (with_bonds || relaxation.holds_together) && relaxation.balanced;
    gradual.settling -= more;
    if (may_end) gradual.settling = std::min(gradual.settling, 0.0);
    if (gradual.settling > 0.0) return;
    if (relaxation.holds_together) {
      let_open(sim);
      relaxation.balanced = false;
      gradual.settling = with_bonds ? at_most : settling;
      return;
    }
    gradual.part = 0.0 - gradual.settling;
    gradual.settling = 0.0;
    relaxation.estimate.least = 0.5 * frequency;
  }
  const bool strength = !relaxation.strength_to.empty() && !loading;
  if (gradual.part >= 1.0 && loading) {
    gradual = {};
    gradual.part = 0.0;
    gradual.settling = with_bonds || relaxation.holds_together ? at_most : settling;
    relaxation.balanced = false;
    relaxation.hold = Relaxation::Hold::settling;
    relaxation.estimate.least = 0.05 * frequency;  // also where all that moves falls
  } else if (gradual.part >= 1.0) {
    gradual = {};
    relaxation.hold = Relaxation::Hold::over;
    if (strength) change_strength(sim, 1.0);
    sim.motion.contacts.bond_strength = 1.0;
  } else if (strength && gradual.part > 0.0 &&
             (!settled ||
              std::floor(increments * gradual.part) > std::floor(increments * before))) {
    change_strength(sim, gradual.part);
  }
}

/// The time within which the displacements that change now are to be applied, s: so slowly that
/// supports accelerate by a small part of gravity, by which blocks follow them; 0 where none does.
/// A way d covered as 3 s^2 - 2 s^3 of the time t has the acceleration 6 d/t^2 at most.
double time_of_displacements(const Simulation& sim) {
  constexpr double part_of_gravity = 0.0025, without_gravity = 9.81;
  const Model& model = sim.scene->model;
  const SlowLoading& slow = sim.attached.loads.slow;
  const double time = sim.motion.state.time;
  double way = 0.0;
  for (std::size_t q = 0; q < model.boundaries.size(); ++q) {
    const SteppedValue& v = slow.boundaries[q];
    const ActiveInterval& interval = sim.attached.loads.intervals.boundaries[q];
    if (model.boundaries[q].type != BoundaryType::displacement || v.changed != time ||
        time < interval.since || time > interval.until)
      continue;
    const double history = model.boundaries[q].factor.at(time - interval.since, 1.0);
    way = std::max(
        way, std::abs((v.value - v.before) * history) * norm(*model.boundaries[q].displacement));
  }
  if (way == 0.0) return 0.0;
  const double g = model.gravity == Vec2{} ? without_gravity : norm(model.gravity);
  // Blocks whose inertia is raised follow the more slowly.
  return std::sqrt(6.0 * way * raised_inertia(sim) / (part_of_gravity * g));
}

/// What follows is loading on joints that hold, by their strength factors or, where these are left
/// as they are, by their bonds alone.
void hold_joints(Simulation& sim) {
  sim.relaxation.hold = Relaxation::Hold::loading;
  if (has_bonds(sim.motion.contacts)) sim.motion.contacts.bond_strength = 1.0 / holding;
}

}  // namespace

void begin_gradually(Simulation& sim, const std::vector<double>& strength_factors, bool more) {
  Loads& loads = sim.attached.loads;
  const State& state = sim.motion.state;
  const LawTable& laws = sim.motion.laws;
  Relaxation& relaxation = sim.relaxation;
  // The initial stress is in equilibrium with the weight already, but not at the walls of openings.
  const bool weight = state.steps == 0 && !sim.scene->model.initial_stress;
  const double least = time_of_displacements(sim);
  const bool walls = state.steps == 0 && hold_walls_of_openings(sim);
  if (state.steps == 0 && !weight && least == 0.0 && !walls)
    return set_strength_factors(sim, strength_factors);
  if (weight || (state.steps == 0 && least > 0.0)) {
    const FaceSet& faces = sim.motion.contacts;
    if (faces.size() > 0 || sim.scene->blocks.meshes.any()) hold_joints(sim);
    // Supports that are displaced meanwhile would pull apart what holds together.
    relaxation.holds_together = weight && least == 0.0 && faces.size() > 0 && !faces.gluing;
    if (relaxation.holds_together) {
      change_faces(sim,
                   [](FaceSet& of, const FaceStates& states) { glue_faces(of, states, false); });
      reevaluate_faces(sim);
    }
    constexpr double periods = 1.0;  // on joints that hold
    loads.gradual = {state.time, 0.0, weight, weight ? 2.0 * least : least, periods};
    relaxation.strength_from = relaxation.strength_to = strength_factors;
    for (double& factor : relaxation.strength_from) factor *= holding;
    return set_strength_factors(sim, relaxation.strength_from);
  }
  const ActiveIntervals& intervals = loads.intervals;
  const auto now = [&](double time) { return time == state.time; };
  bool changes = more || least > 0.0 || strength_factors != laws.divided_by ||
                 std::any_of(loads.remaining.begin(), loads.remaining.end(),
                             [&](const SteppedValue& fraction) { return now(fraction.changed); });
  for (const auto* of : {&intervals.loads, &intervals.waters, &intervals.boundaries}) {
    changes = changes || std::any_of(of->begin(), of->end(), [&](const ActiveInterval& interval) {
                return now(interval.since) || now(interval.until);
              });
  }
  constexpr double periods = 2.0;  // of what does not come in increments
  changes = changes || sim.scene->model.flow.has_value();
  if (changes) loads.gradual = {state.time, 0.0, false, least, more ? 0.0 : periods};
  if (changes && loads.flow == JointFlow::steady)
    keep_water(sim.attached.joint_water, sim.scene->blocks,
               static_cast<Index>(sim.scene->model.waters.size()), loads);
  if (changes && !more && has_bonds(sim.motion.contacts)) hold_joints(sim);
  relaxation.estimate.least = 0.5 * relaxation.estimate.frequency;
  relaxation.strength_from = laws.divided_by;
  relaxation.strength_to = strength_factors;
}

void end_hold(Simulation& sim) {
  if (sim.relaxation.hold == Relaxation::Hold::over) return;
  sim.relaxation.hold = Relaxation::Hold::over;
  let_open(sim);
  sim.motion.contacts.bond_strength = 1.0;
  if (sim.attached.loads.gradual.settling > 0.0) sim.attached.loads.gradual = {};
  set_strength_factors(sim, sim.relaxation.strength_to);
  sim.relaxation.strength_from.clear();
  sim.relaxation.strength_to.clear();
}

void stop_gradual_change(Simulation& sim) {
  end_hold(sim);
  Loads& loads = sim.attached.loads;
  SlowLoading& slow = loads.slow;
  const double time = sim.motion.state.time;
  for (SteppedValue* v : {&slow.kh, &slow.kv, &slow.tilt, &slow.kh_back, &slow.kv_back,
                          &slow.tilt_back, &slow.gravity, &slow.change, &slow.time})
    v->stop(time, loads.gradual);
  for (auto* of : {&slow.loads, &slow.waters}) {
    for (SteppedValue& v : *of) v.stop(time, loads.gradual);
  }
  // Of the time of the flow less has passed.
  slow.flow.value = slow.flow.at(time, loads.gradual);
  for (std::size_t q = 0; q < slow.boundaries.size(); ++q) {
    const bool moves = sim.scene->model.boundaries[q].type == BoundaryType::displacement;
    slow.boundaries[q].stop(time, moves ? loads.gradual.of_supports() : loads.gradual);
  }
  loads.gradual = {};
  sim.relaxation.strength_to.clear();
}

bool gradual_change_complete(const Simulation& sim) {
  return sim.attached.loads.gradual.part >= 1.0;
}

void update_relaxation(Simulation& sim, const LoadsNow& at_work) {
  if (!sim.relaxation.seeks_equilibrium) return;
  update_estimate(sim, at_work);
  advance_gradual_change(sim);
}

}  // namespace edda
