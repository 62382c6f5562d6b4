#include "observe/model_warnings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "forces/mass_scaling.hpp"
#include "model/stage_names.hpp"
#include "observe/cannot_rest.hpp"
#include "observe/damping_report.hpp"
#include "observe/fracture_report.hpp"
#include "observe/initial_stress_report.hpp"
#include "observe/locked_toes.hpp"
#include "observe/locking.hpp"
#include "observe/observe.hpp"
#include "observe/sliver_report.hpp"
#include "step/faces_now.hpp"
#include "step/labels.hpp"

namespace edda {
namespace {

// Stiffness of a face over that of the blocks behind it. At 20 the strain of a joint adds 5 % to
// that of its blocks; at 0.2 it is five times that of the blocks.
constexpr double soft = 0.2, stiff = 600.0;
constexpr double sliver = 1e-3;  // of the median edge

/// Fixes a free block for as long as this exists: a copy of all blocks would take more memory than
/// the answer is worth.
class Held {
 public:
  Held(BlockSet& blocks, Id block) : fixed_(blocks.fixed[block]) { fixed_ = 1; }
  Held(const Held&) = delete;
  Held& operator=(const Held&) = delete;
  ~Held() { fixed_ = 0; }

 private:
  std::uint8_t& fixed_;
};

/// The critical step with the governing block fixed: that of the others (except for the factor of
/// their contacts with it).
double step_without(Simulation& sim, Id block) {
  const Held held(sim.scene.edit().blocks, block);
  StepCache known = sim.control.step_cache;  // that of its neighbours is another now
  return step_bound(stiffness_inputs(sim), &known).critical_step;
}

std::string by_how_much(Simulation& sim) {
  if (sim.control.bound.block == no_id) return {};
  const double others = step_without(sim, sim.control.bound.block);
  if (!std::isfinite(others)) return {};
  const double gain = others / sim.control.bound.critical_step;
  if (gain < 1.02) return "; other blocks need a time step as small";
  return fmt::format("; the other blocks alone would allow {:.3g} times the time step", gain);
}

bool free_block(const Simulation& sim, std::size_t i) {
  return sim.scene->blocks.fixed[i] == 0;
}

void warn_of_sudden_gravity(const Simulation& sim, std::vector<std::string>& warnings) {
  if (!gravity_acts_at_once(sim)) return;
  bool carried = sim.attached.springs.size() > 0;
  const FaceSet& f = sim.motion.contacts;
  for (std::size_t k = 0; k < f.size() && !carried; ++k) {
    carried =
        meets(face_row(sim, k)) && (free_block(sim, block_of_edge(sim.scene->blocks, f, k)) ||
                                    free_block(sim, block_of_facing(sim.scene->blocks, f, k)));
  }
  if (!carried || some_block_moves(sim)) return;
  warnings.emplace_back(
      "gravity acts at once on blocks without stress: forces will oscillate, up to about twice "
      "their values in equilibrium, until damping has removed the oscillation; where the "
      "equilibrium is wanted, begin with a [[stage]] with until = \"equilibrium\", or give "
      "[initial_stress]");
}

struct Extreme {
  double ratio = 0.0;
  std::size_t contact = 0;
};

/// Stiffness of a face over that of the blocks behind it.
double face_ratio(const Simulation& sim, std::size_t k) {
  const FaceSet& f = sim.motion.contacts;
  const BlockSet& b = sim.scene->blocks;
  return f.stiffness[k] / b.thickness * sides_of(b, f.edge[k], f.facing[k]).compliance;
}

void warn_of_springs(const Simulation& sim, std::vector<std::string>& warnings) {
  const FaceSet& f = sim.motion.contacts;
  Extreme low{std::numeric_limits<double>::infinity()}, high{0.0};
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (!meets(face_row(sim, k))) continue;
    const double ratio = face_ratio(sim, k);
    if (!(ratio > 0.0)) continue;
    // A given kn is taken as measured. The spring of a restitution is meant to be soft.
    const Law& law = sim.motion.laws.rows[f.law[k]];
    if (!(law.kn > 0.0) && !law.dashpots && ratio < low.ratio) low = {ratio, k};
    if (ratio > high.ratio) high = {ratio, k};
  }
  auto where = [&](const Extreme& e) {
    const std::size_t k = e.contact;
    return fmt::format(
        "k = {:.3g} Pa/m between {} and {} at {} is {:.2g} times the stiffness of the blocks "
        "behind "
        "it",
        f.stiffness[k] / sim.scene->blocks.thickness,
        block_label(sim.scene->blocks, block_of_facing(sim.scene->blocks, f, k)),
        block_label(sim.scene->blocks, block_of_edge(sim.scene->blocks, f, k)),
        place_label(middle_of(face_row(sim, k), sim.motion.pose) + sim.scene->blocks.origin),
        e.ratio);
  };
  if (low.ratio < soft) {
    warnings.push_back("contacts are so soft that the joints deform far more than the blocks: " +
                       where(low) + "; raise contact.normal_stiffness");
  }
  if (high.ratio > stiff) {
    warnings.push_back(
        "contacts are so stiff that the joints hardly deform and only reduce the time step: " +
        where(high) + "; contact.normal_stiffness of 10 times young is enough");
  }
}

void warn_of_boundary(const Simulation& sim, std::vector<std::string>& warnings) {
  if (!(sim.control.bound.boundary_part > 0.5)) return;
  warnings.push_back(
      fmt::format("boundary springs limit the time step: they are {:.0f} % of what governs it; "
                  "without a boundary.stiffness they are as stiff as the joints, which would allow "
                  "up to {:.2g} times the time step",
                  100.0 * sim.control.bound.boundary_part,
                  1.0 / std::sqrt(std::max(1.0 - sim.control.bound.boundary_part, 1e-12))));
}

/// Ground motion that acts in a stage until equilibrium, whose damping and masses are not those of
/// a motion. Stages until equilibrium count as if they took no time.
void warn_of_shaken_equilibrium(const Simulation& sim, std::vector<std::string>& warnings) {
  const Model& model = sim.scene->model;
  const auto names = [](const std::vector<std::string>& list, const std::string& name) {
    return std::find(list.begin(), list.end(), name) != list.end();
  };
  for (const Shaking& shaking : model.shakings) {
    if (shaking.scale == 0.0) continue;
    const std::vector<double>& times = shaking.record.time;
    const double length = times.empty() ? std::numeric_limits<double>::infinity() : times.back();
    bool acts = acts_at_first(model, shaking.name);
    double since = 0.0;  // s
    for (const Stage& stage : stages_of(model)) {
      if (names(stage.activate, shaking.name)) acts = true, since = 0.0;
      if (names(stage.deactivate, shaking.name)) acts = false;
      if (!acts) continue;
      if (!stage.to_equilibrium()) {
        since += stage.duration;
      } else if (since < length) {
        warnings.push_back(fmt::format(
            "{}: the ground motion acts in a stage until equilibrium{}, whose damping and masses "
            "are made for rest: activate it in a stage with a duration of its own",
            shaking.where.key, stage.name.empty() ? "" : fmt::format(" (\"{}\")", stage.name)));
        break;
      }
    }
  }
}

/// A step that is given stays for the whole run, however small it is.
void warn_of_small_step(const Simulation& sim, std::vector<std::string>& warnings) {
  constexpr double small = 0.01;
  const Solver& solver = sim.scene->model.solver;
  const double usual = solver.safety * sim.control.bound.critical_step;
  if (!solver.time_step || !std::isfinite(usual) || !(*solver.time_step < small * usual)) return;
  warnings.push_back(fmt::format(
      "solver.time_step: {:.3g} s is less than a hundredth of the {:.3g} s that "
      "time_step = \"auto\" would take, so that a run takes {:.2g} times as many steps: "
      "leave it out, unless that is meant",
      *solver.time_step, usual, usual / *solver.time_step));
}

/// Warns of a few small blocks that govern the step of all others, or reports their mass scaling.
void warn_of_few(const Simulation& sim, std::vector<std::string>& warnings) {
  const double all = ordered_sum(sim.scene->blocks.size(), [&](std::size_t i) {
    return free_block(sim, i) ? sim.scene->blocks.mass[i] : 0.0;
  });
  if (!sim.motion.masses.raised.empty() && sim.scene->model.solver.mass_scaling > 0.0) {
    const auto scaled = static_cast<std::size_t>(std::count_if(sim.motion.masses.raised.begin(),
                                                               sim.motion.masses.raised.end(),
                                                               [](double f) { return f > 1.0; }));
    const double added = added_mass(sim.scene->blocks, sim.motion.masses.raised);
    warnings.push_back(
        fmt::format("solver.mass_scaling: the inertia of {} is raised, by {:.3g} kg in all, {:.2g} "
                    "% of the total mass",
                    counted(scaled, "block"), added, 100.0 * added / all));
    return;
  }
  const std::vector<Stage> stages = stages_of(sim.scene->model);
  if (std::all_of(stages.begin(), stages.end(),
                  [](const Stage& s) { return s.masses == StageMasses::scaled; }))
    return;  // all blocks have the same step
  constexpr double few = 0.01, worth = 2.0;
  constexpr std::size_t least = 20;  // blocks; with fewer, "few" has no meaning
  StepCache known = sim.control.step_cache;
  std::vector<double> steps = steps_of_blocks(stiffness_inputs(sim), 0.0, &known);
  std::vector<double> sorted;
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(sorted),
               [](double h) { return std::isfinite(h); });
  if (sorted.size() < least) return;
  const std::size_t place = static_cast<std::size_t>(few * static_cast<double>(sorted.size())) + 1;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(place),
                   sorted.end());
  const double others =
      std::min(sorted[place], step_that_adds(sim.scene->blocks, steps, most_added * all));
  steps = steps_of_blocks(stiffness_inputs(sim), others, &known);  // estimates so far
  const double smallest = *std::min_element(steps.begin(), steps.end());
  if (!(others > worth * smallest)) return;
  std::size_t count = 0;
  double added = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] < others)) continue;
    ++count;
    added += (others * others / (steps[i] * steps[i]) - 1.0) * sim.scene->blocks.mass[i];
  }
  warnings.push_back(
      fmt::format("{} of {} {} the time step to 1/{:.2g} of what the others need: "
                  "solver.mass_scaling = {:.3g} raises {} inertia, by {:.3g} kg in all, {:.2g} % "
                  "of the total mass, and does not change the equilibrium",
                  counted(count, "block"), sorted.size(), count == 1 ? "limits" : "limit",
                  others / smallest, sim.scene->model.solver.safety * others,
                  count == 1 ? "its" : "their", added, 100.0 * added / all));
}

/// Warns of slivers of the cut: they govern the step and carry nothing.
void warn_of_slivers(const Simulation& sim, std::vector<std::string>& warnings) {
  const CutReport& report = sim.scene->polygons.report;
  std::vector<double> edges = sim.scene->blocks.edge_length;
  if (edges.empty()) return;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  if (!(report.smallest_edge > 0.0 && report.smallest_edge < sliver * *middle)) return;
  warnings.push_back(
      fmt::format("a very short edge of {:.3g} m at {} (half of all edges are longer than {:.3g} "
                  "m) causes a small time step: move a joint a little, or raise domain.snap",
                  report.smallest_edge, place_label(report.smallest_edge_at), *middle));
}

void warn_of_overlaps(const Simulation& sim, std::vector<std::string>& warnings) {
  const FaceSet& f = sim.motion.contacts;
  double energy = 0.0, lift = 0.0;
  Extreme deepest{0.0};
  for (std::size_t k = 0; k < f.size(); ++k) {
    const FaceRow row = face_row(sim, k);
    const double d = closure_of(row);
    if (!(row.state.energy > 0.0) || !(d > 0.0)) continue;
    energy += row.state.energy;
    if (d > deepest.ratio) deepest = {d, k};
  }
  const std::size_t k = deepest.contact;
  if (deepest.ratio == 0.0) return;
  const Id i = block_of_edge(sim.scene->blocks, f, k), j = block_of_facing(sim.scene->blocks, f, k);
  if (deepest.ratio <
      1e-9 * std::sqrt(std::min(sim.scene->blocks.area[i], sim.scene->blocks.area[j])))
    return;
  // Overlaps of rounded coordinates are no news where a stage brings the blocks to rest first, or
  // where they could lift the blocks by a thousandth of their size only.
  for (std::size_t q = 0; q < sim.scene->blocks.size(); ++q) {
    if (free_block(sim, q))
      lift += sim.scene->blocks.mass[q] * norm(sim.scene->model.gravity) *
              std::sqrt(sim.scene->blocks.area[q]);
  }
  const bool rounded = deepest.ratio <= sim.scene->polygons.report.rounding;
  if (rounded && (stages_of(sim.scene->model).front().to_equilibrium() || energy < 1e-3 * lift))
    return;
  warnings.push_back(fmt::format(
      "blocks overlap at the start, most {} and {} by {:.3g} m at {}: their contacts are "
      "compressed from the start and store {:.3g} J: draw the blocks so that they touch, or cut "
      "both from one [domain] with a [[trace]], or begin with a [[stage]] until = \"equilibrium\"",
      block_label(sim.scene->blocks, j), block_label(sim.scene->blocks, i), deepest.ratio,
      place_label(middle_of(face_row(sim, k), sim.motion.pose) + sim.scene->blocks.origin),
      energy));
}

/// A number is fitted to the impact of a square; other shapes differ where blocks strain in it.
void warn_of_stiff_restitution(const Simulation& sim, std::vector<std::string>& warnings) {
  constexpr double stiff_impact = 0.1;
  const BlockSet& b = sim.scene->blocks;
  for (const JointLaw& law : sim.scene->model.given_joints()) {
    if (!law.restitution || law.restitution->housner || !law.kn || law.restitution->part == 1.0)
      continue;
    double most = 0.0;
    for (std::size_t i = 0; i < b.size(); ++i) {
      if (!free_block(sim, i)) continue;
      const double young =
          sim.scene->model.materials[static_cast<std::size_t>(b.material[i])].young;
      most = std::max(most, 0.5 * *law.kn * std::sqrt(b.area[i]) / young);
    }
    if (!(most > stiff_impact)) continue;
    warnings.push_back(fmt::format(
        "the restitution of joint {} is right for squares that fall flat alone: its kn makes the "
        "ends of a contact {:.2g} times as stiff as the rock, so that blocks strain as they "
        "strike; "
        "leave out kn where the rebound matters, or give at most {:.2g} Pa/m",
        law.name, most, stiff_impact / most * *law.kn));
  }
}

/// Rock under ground motion has a damping of a few hundredths of critical.
void warn_of_strain_damping(const Simulation& sim, std::vector<std::string>& warnings) {
  constexpr double much = 0.05;
  for (const StrainDampingAt& at : strain_damping_at(sim)) {
    const std::string block = block_label(sim.scene->blocks, at.block);
    if (at.lost > much) {
      warnings.push_back(fmt::format(
          "about {:.0f} % of the motion that {} ({:.3g} Hz) sends over {:.3g} m through the blocks "
          "is lost to {} {} (up to {:.2g} of critical at this frequency, in {}): {}",
          100.0 * at.lost, at.of, at.frequency, at.length, at.rayleigh ? "the" : "their", at.what(),
          at.fraction, block,
          at.rayleigh
              ? fmt::format("give {} a lower fraction or a higher frequency", at.key)
              : fmt::format("multiply the damping of the materials by {:.1g}, or give 0 where "
                            "nothing slides, or smaller blocks",
                            0.02 / at.lost)));
    } else if (at.length == 0.0 && at.fraction > much) {
      warnings.push_back(fmt::format(
          "the {} is up to {:.2g} of critical at {:.3g} Hz, the frequency of {} ({}): {}",
          at.what(), at.fraction, at.frequency, at.of, block,
          at.rayleigh ? fmt::format("give {} a lower fraction or a higher frequency", at.key)
                      : std::string("give a lower damping of the material, or smaller blocks")));
    }
  }
}

}  // namespace

bool gravity_acts_at_once(const Simulation& sim) {
  const Model& model = sim.scene->model;
  const Stage first = stages_of(model).front();
  const Damping& d = first.damping;
  return !sim.accounts.initial && model.solver.duration > 0.0 && !first.to_equilibrium() &&
         model.gravity != Vec2{} && d.mass == 0.0 && d.local == 0.0 && d.contact == 0.0 &&
         d.adaptive == 0.0;
}

std::string governed_by(Simulation& sim) {
  if (!is_explicit(sim)) {
    return sim.scene->model.solver.time_step
               ? "time_step: the implicit method is stable at any step"
               : "the largest displacement in one step, and the interval of "
                 "rows: the implicit method is stable "
                 "at any";
  }
  const StepBound& bound = sim.control.bound;
  if (bound.block == no_id) return "nothing: no block is free to move";
  const Vec2 place = centroid(sim.motion.state.position, bound.block) + sim.scene->blocks.origin;
  std::string text = fmt::format("{} at {}: {:.0f} % contacts, {:.0f} % its own elasticity",
                                 block_label(sim.scene->blocks, bound.block), place_label(place),
                                 100.0 * bound.contact_part, 100.0 * bound.elastic_part);
  if (bound.boundary_part > 0.0) {
    text += fmt::format(", {:.0f} % boundary springs", 100.0 * bound.boundary_part);
  }
  if (bound.bolt_part > 0.0) text += fmt::format(", {:.0f} % bolts", 100.0 * bound.bolt_part);
  const FaceSet& f = sim.motion.contacts;
  if (bound.contact != no_id) {
    const Id k = bound.contact, i = block_of_edge(sim.scene->blocks, f, k),
             j = block_of_facing(sim.scene->blocks, f, k);
    text += fmt::format(
        "; most of it by the contact with {} at {}",
        block_label(sim.scene->blocks, i == bound.block ? j : i),
        place_label(middle_of(face_row(sim, k), sim.motion.pose) + sim.scene->blocks.origin));
  }
  return text + by_how_much(sim);
}

std::vector<std::string> model_warnings(const Simulation& sim) {
  std::vector<std::string> warnings;
  if (is_explicit(sim)) {
    warn_of_sudden_gravity(sim, warnings);
    warn_of_shaken_equilibrium(sim, warnings);
    warn_of_boundary(sim, warnings);
    warn_of_small_step(sim, warnings);
    warn_of_few(sim, warnings);
  }
  warn_of_strain_damping(sim, warnings);
  warn_of_locking(sim, warnings);
  warn_of_stiff_restitution(sim, warnings);
  warn_of_springs(sim, warnings);
  warn_of_coarse_cracks(sim, warnings);
  warn_of_slivers(sim, warnings);
  warn_of_kept_slivers(sim, warnings);
  warn_of_overlaps(sim, warnings);
  warn_of_locked_toes(sim, warnings);
  warn_of_initial_stress(sim, warnings);
  return warnings;
}

}  // namespace edda
