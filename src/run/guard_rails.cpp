#include "run/guard_rails.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>

#include "base/parallel.hpp"
#include "base/text.hpp"
#include "blocks/point_mass.hpp"
#include "contacts/face_reading.hpp"
#include "forces/mass_scaling.hpp"
#include "run/damping_report.hpp"
#include "run/initial_stress_report.hpp"
#include "run/labels.hpp"
#include "run/locked_toes.hpp"
#include "run/observe.hpp"
#include "run/sliver_report.hpp"
#include "run/stages.hpp"

namespace edda {
namespace {

// Spring of a contact over young times thickness. An edge has two such springs, so at 10 a joint
// gives about 5 % of what its blocks give; at 0.1 five times as much.
constexpr double soft = 0.1, stiff = 300.0;
constexpr double sliver = 1e-3;  // of the median edge

/// The governing block held, so that the bound is that of the others (but for the factor of
/// contacts with it).
double step_without(const Simulation& sim, Id block) {
  BlockSet others = sim.blocks;
  others.fixed[block] = 1;
  fill_point_masses(others);
  return step_bound(others, sim.state, sim.contacts, sim.springs, sim.laws, sim.damping, &sim.bolts)
      .critical_step;
}

std::string by_how_much(const Simulation& sim) {
  if (sim.bound.block == no_id) return {};
  const double others = step_without(sim, sim.bound.block);
  if (!std::isfinite(others)) return {};
  const double gain = others / sim.bound.critical_step;
  if (gain < 1.02) return "; other blocks need as small a step";
  return fmt::format("; the other blocks alone could take {:.3g} times the step", gain);
}

bool free_block(const Simulation& sim, std::size_t i) {
  return sim.blocks.fixed[i] == 0;
}

void warn_of_sudden_gravity(const Simulation& sim, std::vector<std::string>& warnings) {
  if (sim.initial || sim.model.solver.duration == 0.0) return;
  const Stage first = stages_of(sim.model).front();
  const Damping& d = first.damping;
  if (first.until == StageEnd::equilibrium || sim.model.gravity == Vec2{} || d.mass > 0.0 ||
      d.local > 0.0 || d.contact > 0.0 || d.adaptive > 0.0)
    return;
  bool carried = sim.springs.size() > 0;
  const FaceSet& f = sim.contacts;
  for (std::size_t k = 0; k < f.size() && !carried; ++k) {
    carried = meets(f, k) && (free_block(sim, block_of_edge(sim.blocks, f, k)) ||
                              free_block(sim, block_of_facing(sim.blocks, f, k)));
  }
  if (!carried) return;
  warnings.emplace_back(
      "gravity acts at once on blocks that carry no stress yet: forces will swing to about twice "
      "their value at rest before damping calms them; where the state at rest is wanted, begin "
      "with a [[stage]] with until = \"equilibrium\", or give [initial_stress]");
}

struct Extreme {
  double ratio = 0.0;
  std::size_t contact = 0;
};

double young_of(const Simulation& sim, std::size_t i) {
  const Index m = sim.blocks.material[i];
  return m == none ? 0.0 : sim.model.materials[static_cast<std::size_t>(m)].young;
}

/// What two corners of a face have of its stiffness, over that of the softer block.
double face_ratio(const Simulation& sim, std::size_t k) {
  const FaceSet& f = sim.contacts;
  double young = std::numeric_limits<double>::infinity();
  for (const Id i : {block_of_edge(sim.blocks, f, k), block_of_facing(sim.blocks, f, k)}) {
    if (free_block(sim, i)) young = std::min(young, young_of(sim, i));
  }
  const double shorter =
      std::min(sim.blocks.edge_length[f.edge[k]], sim.blocks.edge_length[f.facing[k]]);
  return 0.5 * f.stiffness[k] * shorter / (young * sim.blocks.thickness);
}

void warn_of_springs(const Simulation& sim, std::vector<std::string>& warnings) {
  const FaceSet& f = sim.contacts;
  Extreme low{std::numeric_limits<double>::infinity()}, high{0.0};
  for (std::size_t k = 0; k < f.size(); ++k) {
    if (!meets(f, k)) continue;
    const double ratio = face_ratio(sim, k);
    if (!(ratio > 0.0)) continue;
    // A stiffness that was given for the joint has been measured, and is what it is; one that
    // belongs to a restitution is meant to be soft.
    const Law& law = sim.laws.rows[f.law[k]];
    if (!(law.kn > 0.0) && !law.dashpots && ratio < low.ratio) low = {ratio, k};
    if (ratio > high.ratio) high = {ratio, k};
  }
  auto where = [&](const Extreme& e) {
    const std::size_t k = e.contact;
    return fmt::format(
        "k = {:.3g} Pa/m between {} and {} at {}, half of which times the length of the joint is "
        "{:.2g} times young of the rock",
        f.stiffness[k] / sim.blocks.thickness,
        block_label(sim.blocks, block_of_facing(sim.blocks, f, k)),
        block_label(sim.blocks, block_of_edge(sim.blocks, f, k)),
        place_label(middle_of(f, sim.pose, k) + sim.blocks.origin), e.ratio);
  };
  if (low.ratio < soft) {
    warnings.push_back("contacts so soft that the joints give far more than the blocks: " +
                       where(low) + "; raise contact.normal_stiffness");
  }
  if (high.ratio > stiff) {
    warnings.push_back(
        "contacts so stiff that the joints give nothing and only shorten the step: " + where(high) +
        "; contact.normal_stiffness of 10 times young is enough");
  }
}

void warn_of_boundary(const Simulation& sim, std::vector<std::string>& warnings) {
  if (!(sim.bound.boundary_part > 0.5)) return;
  warnings.push_back(
      fmt::format("boundary springs hold the step: {:.0f} % of what governs it; without a "
                  "boundary.stiffness of their own they are as stiff as the joints, which would "
                  "allow up to {:.2g} times the step",
                  100.0 * sim.bound.boundary_part,
                  1.0 / std::sqrt(std::max(1.0 - sim.bound.boundary_part, 1e-12))));
}

/// A few small blocks that hold back all the others; or what was done about it.
void warn_of_few(const Simulation& sim, std::vector<std::string>& warnings) {
  const double all = ordered_sum(sim.blocks.size(), [&](std::size_t i) {
    return free_block(sim, i) ? sim.blocks.mass[i] : 0.0;
  });
  if (!sim.inertia.empty() && sim.model.solver.mass_scaling > 0.0) {
    const auto scaled = static_cast<std::size_t>(
        std::count_if(sim.inertia.begin(), sim.inertia.end(), [](double f) { return f > 1.0; }));
    const double added = added_mass(sim.blocks, sim.inertia);
    warnings.push_back(fmt::format(
        "solver.mass_scaling: {} heavier to move, by {:.3g} kg together, {:.2g} % of all mass",
        counted(scaled, "block"), added, 100.0 * added / all));
    return;
  }
  const std::vector<Stage> stages = stages_of(sim.model);
  if (std::all_of(stages.begin(), stages.end(),
                  [](const Stage& s) { return s.masses == StageMasses::uniform_step; }))
    return;  // all blocks are
  constexpr double few = 0.01, worth = 2.0;
  constexpr std::size_t least = 20;  // blocks, for "few" to mean something
  std::vector<double> steps = steps_of_blocks(sim.blocks, sim.state, sim.contacts, sim.springs,
                                              sim.laws, sim.damping, 0.0, &sim.bolts);
  std::vector<double> sorted;
  std::copy_if(steps.begin(), steps.end(), std::back_inserter(sorted),
               [](double h) { return std::isfinite(h); });
  if (sorted.size() < least) return;
  const std::size_t place = static_cast<std::size_t>(few * static_cast<double>(sorted.size())) + 1;
  std::nth_element(sorted.begin(), sorted.begin() + static_cast<std::ptrdiff_t>(place),
                   sorted.end());
  const double others =
      std::min(sorted[place], step_that_adds(sim.blocks, steps, most_added * all));
  const double smallest = *std::min_element(sorted.begin(), sorted.end());
  if (!(others > worth * smallest)) return;
  std::size_t count = 0;
  double added = 0.0;
  for (std::size_t i = 0; i < steps.size(); ++i) {
    if (!(steps[i] < others)) continue;
    ++count;
    added += (others * others / (steps[i] * steps[i]) - 1.0) * sim.blocks.mass[i];
  }
  warnings.push_back(fmt::format(
      "{} of {} {} the step to 1/{:.2g} of what the others need: solver.mass_scaling = {:.3g} "
      "makes {} slower to move, by {:.3g} kg together, {:.2g} % of all mass, and changes "
      "nothing at rest",
      counted(count, "block"), sorted.size(), count == 1 ? "holds" : "hold", others / smallest,
      sim.model.solver.safety * others, count == 1 ? "it" : "them", added, 100.0 * added / all));
}

/// Slivers of the cut: they hold the step and carry nothing.
void warn_of_slivers(const Simulation& sim, std::vector<std::string>& warnings) {
  const CutReport& report = sim.polygons.report;
  std::vector<double> edges = sim.blocks.edge_length;
  if (edges.empty()) return;
  const auto middle = edges.begin() + static_cast<std::ptrdiff_t>(edges.size() / 2);
  std::nth_element(edges.begin(), middle, edges.end());
  if (!(report.smallest_edge < sliver * *middle)) return;
  warnings.push_back(
      fmt::format("a very short edge of {:.3g} m at {} (half of all edges are longer than {:.3g} "
                  "m) makes for a small "
                  "step: move a joint a little, or raise domain.snap",
                  report.smallest_edge, place_label(report.smallest_edge_at), *middle));
}

void warn_of_overlaps(const Simulation& sim, std::vector<std::string>& warnings) {
  const FaceSet& f = sim.contacts;
  double energy = 0.0;
  Extreme deepest{0.0};
  for (std::size_t k = 0; k < f.size(); ++k) {
    const double d = closure_of(f, k);
    if (!(f.now.energy[k] > 0.0) || !(d > 0.0)) continue;
    energy += f.now.energy[k];
    if (d > deepest.ratio) deepest = {d, k};
  }
  const std::size_t k = deepest.contact;
  if (deepest.ratio == 0.0) return;
  const Id i = block_of_edge(sim.blocks, f, k), j = block_of_facing(sim.blocks, f, k);
  if (deepest.ratio < 1e-9 * std::sqrt(std::min(sim.blocks.area[i], sim.blocks.area[j]))) return;
  warnings.push_back(fmt::format(
      "blocks overlap at the start, most {} and {} by {:.3g} m at {}: their contacts "
      "start out pressed and store {:.3g} J: draw the block so that it touches, or cut both "
      "from one [domain] with a [[trace]], or begin with a [[stage]] "
      "until = \"equilibrium\"",
      block_label(sim.blocks, j), block_label(sim.blocks, i), deepest.ratio,
      place_label(middle_of(f, sim.pose, k) + sim.blocks.origin), energy));
}

/// Rock in an earthquake loses a few hundredths of critical.
void warn_of_strain_damping(const Simulation& sim, std::vector<std::string>& warnings) {
  constexpr double much = 0.05;
  for (const StrainDampingAt& at : strain_damping_at(sim)) {
    if (!(at.fraction > much)) continue;
    warnings.push_back(fmt::format(
        "the damping of the blocks' strain takes up to {:.2g} of critical at {:.3g} Hz, the "
        "frequency of {} ({}): give a lower damping of the material, or smaller blocks",
        at.fraction, at.frequency, at.of, block_label(sim.blocks, at.block)));
  }
}

}  // namespace

std::string governed_by(const Simulation& sim) {
  if (!sim.explicit_method()) {
    return sim.model.solver.time_step ? "time_step: the implicit method is stable at any step"
                                      : "the largest displacement in one step, and the interval of "
                                        "rows: the implicit method is stable "
                                        "at any";
  }
  const StepBound& bound = sim.bound;
  if (bound.block == no_id) return "nothing: no block is free to move";
  const Vec2 place = centroid(sim.state.x, sim.state.y, bound.block) + sim.blocks.origin;
  std::string text = fmt::format("{} at {}: {:.0f} % contacts, {:.0f} % its own elasticity",
                                 block_label(sim.blocks, bound.block), place_label(place),
                                 100.0 * bound.contact_part, 100.0 * bound.elastic_part);
  if (bound.boundary_part > 0.0) {
    text += fmt::format(", {:.0f} % boundary springs", 100.0 * bound.boundary_part);
  }
  if (bound.bolt_part > 0.0) text += fmt::format(", {:.0f} % bolts", 100.0 * bound.bolt_part);
  const FaceSet& f = sim.contacts;
  if (bound.contact != no_id) {
    const Id k = bound.contact, i = block_of_edge(sim.blocks, f, k),
             j = block_of_facing(sim.blocks, f, k);
    text += fmt::format("; most of it by the contact with {} at {}",
                        block_label(sim.blocks, i == bound.block ? j : i),
                        place_label(middle_of(f, sim.pose, k) + sim.blocks.origin));
  }
  return text + by_how_much(sim);
}

std::vector<std::string> guard_rails(const Simulation& sim) {
  std::vector<std::string> warnings;
  if (sim.explicit_method()) {
    warn_of_sudden_gravity(sim, warnings);
    warn_of_boundary(sim, warnings);
    warn_of_few(sim, warnings);
  }
  warn_of_strain_damping(sim, warnings);
  warn_of_springs(sim, warnings);
  warn_of_slivers(sim, warnings);
  warn_of_kept_slivers(sim, warnings);
  warn_of_overlaps(sim, warnings);
  warn_of_locked_toes(sim, warnings);
  warn_of_initial_stress(sim, warnings);
  return warnings;
}

}  // namespace edda
