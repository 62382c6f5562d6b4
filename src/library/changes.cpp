// Changing a Simulation between two steps.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "library/impl.hpp"
#include "model/stage_names.hpp"
#include "model/table/nearest.hpp"
#include "run/stages.hpp"
#include "step/changes.hpp"
#include "step/relaxation.hpp"

namespace edda::api {
namespace {

template <class Items>
void add_names(const Items& items, std::vector<std::string_view>& names) {
  for (const auto& item : items) {
    if (!item.name.empty()) names.push_back(item.name);
  }
}

void check_known(const char* function, const std::string& name, const char* what,
                 const std::vector<std::string_view>& known) {
  if (std::find(known.begin(), known.end(), name) != known.end()) return;
  raise(function, '"' + name + "\" is no " + what + " of the model", suggestion(name, known));
}

void check_number(const char* function, const char* what, double value, double least,
                  double most = std::numeric_limits<double>::infinity()) {
  if (std::isfinite(value) && value >= least && value <= most) return;
  raise(function, std::string(what) + " is " + std::to_string(value),
        "give a number from " + std::to_string(least) +
            (std::isfinite(most) ? " to " + std::to_string(most) : " on"));
}

/// Openings whose rock is in the model.
Index row_of_opening(const char* function, const edda::Simulation& sim, const std::string& name) {
  std::vector<std::string_view> known;
  add_names(sim.scene->model.openings, known);
  check_known(function, name, "opening", known);
  for (std::size_t q = 0; q < sim.scene->model.openings.size(); ++q) {
    const Opening& opening = sim.scene->model.openings[q];
    if (opening.name == name && opening.staged) return static_cast<Index>(q);
  }
  raise(function, "the rock of \"" + name + "\" was excavated before the start",
        "name the opening in a stage's excavate");
}

std::vector<double> strength_factors(const LawTable& laws) {
  return laws.divided_by.empty() ? std::vector<double>(laws.rows.size(), 1.0) : laws.divided_by;
}

constexpr double smallest_factor = 1e-6;
/// A node with local damping of 1 never moves.
const double below_one = std::nextafter(1.0, 0.0);

// The following faults have the wording of model/completion/complete_stages.cpp, which refuses the
// same in stages.

void check_excavation(const edda::Simulation& sim, const std::vector<std::string>& names,
                      const std::vector<Index>& rows) {
  const auto& of_block = sim.scene->blocks.opening;
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto here = rows.begin() + static_cast<std::ptrdiff_t>(q);
    const bool has_rock = std::find(of_block.begin(), of_block.end(), rows[q]) != of_block.end();
    const bool again = std::find(rows.begin(), here, rows[q]) != here;
    if (!again && !(has_rock && is_excavated(sim, rows[q]))) continue;
    raise("excavate", '"' + names[q] + "\" has been excavated before",
          "excavate each opening once");
  }
}

void check_relaxation(const edda::Simulation& sim, Index row, const std::string& name,
                      double part) {
  if (!is_excavated(sim, row)) {
    raise("relax", '"' + name + "\" has not been excavated yet", "excavate() it before");
  }
  const SteppedValue& fraction = sim.attached.loads.remaining[static_cast<std::size_t>(row)];
  // Several changes at the same time count as one, and the last of them applies.
  const double still = fraction.changed == sim.motion.state.time ? fraction.before : fraction.value;
  if (1.0 - part <= still) return;
  raise("relax", "is less than the " + fmt::format("{:.6g}", 1.0 - still) + " released so far",
        "give the part released by then, all changes together");
}

void check_switches(const edda::Simulation& sim, const std::vector<std::string>& deactivate,
                    const std::vector<std::string>& activate) {
  for (const std::string& name : activate) {
    if (std::find(deactivate.begin(), deactivate.end(), name) == deactivate.end()) continue;
    raise("switch_over", '"' + name + "\" is in deactivate, too", "name it in one of them");
  }
  const auto check = [&](const std::vector<std::string>& names, bool act, const char* problem) {
    for (const std::string& name : names) {
      const NamedRows rows = rows_called(sim.scene->model, {name});
      if (rows_that(act, sim.attached.loads.intervals, rows).empty()) continue;
      raise("switch_over", '"' + name + problem, "leave it out here");
    }
  };
  check(deactivate, false, "\" does not act");
  check(activate, true, "\" acts already");
}

}  // namespace

void Simulation::set_velocity(std::size_t block, Point velocity, double omega) {
  const bool begun = impl_->begun;
  if (begun) {
    impl_->begin_change("set_velocity");
  } else {
    impl_->take_back();
  }
  edda::Simulation& sim = impl_->sim();
  if (block >= sim.scene->blocks.size() || !is_free(sim.scene->blocks, sim.motion.state, block)) {
    raise("set_velocity", "block " + std::to_string(block) + " is not free to move",
          "name a block that is neither fixed nor excavated");
  }
  check_number("set_velocity", "velocity",
               std::abs(velocity.x) + std::abs(velocity.y) + std::abs(omega), 0.0);
  const BlockSet& blocks = sim.scene->blocks;
  const State& state = sim.motion.state;
  BodyVectors velocities = state.velocity;
  store(rigid_velocities(vector_of(blocks, state.position, block), centroid(state.position, block),
                         {velocity.x, velocity.y}, omega),
        blocks, velocities, block);
  impl_->change_velocities(velocities);
  if (begun) impl_->end_change();
}

void Simulation::set_damping(double mass, double local, double contact) {
  check_number("set_damping", "mass", mass, 0.0);
  check_number("set_damping", "local", local, 0.0, below_one);
  check_number("set_damping", "contact", contact, 0.0, 10.0);
  impl_->begin_change("set_damping");
  Damping damping = impl_->sim().motion.damping;  // adaptive and Rayleigh damping remain
  damping.mass = mass;
  damping.local = local;
  damping.contact = contact;
  change_damping(impl_->sim(), damping, impl_->sim().motion.dynamic);
  impl_->end_change();
}

void Simulation::set_strength_factor(double factor) {
  check_number("set_strength_factor", "factor", factor, smallest_factor);
  impl_->begin_change("set_strength_factor");
  end_hold(impl_->sim());
  edda::set_strength_factor(impl_->sim(), factor);
  impl_->end_change();
}

void Simulation::set_strength_factor(const std::string& joint, double factor) {
  check_number("set_strength_factor", "factor", factor, smallest_factor);
  edda::Simulation& sim = impl_->sim();
  std::vector<std::string_view> known;
  add_names(sim.scene->model.given_joints(), known);
  check_known("set_strength_factor", joint, "joint", known);
  impl_->begin_change("set_strength_factor");
  end_hold(sim);
  std::vector<double> factors = strength_factors(sim.motion.laws);
  for (std::size_t r = 0; r < sim.scene->model.joints.size(); ++r) {
    if (sim.scene->model.joints[r].name == joint) factors[r] = factor;
  }
  set_strength_factors(sim, factors);
  impl_->end_change();
}

void Simulation::excavate(const std::vector<std::string>& openings) {
  std::vector<Index> rows;
  rows.reserve(openings.size());
  for (const std::string& name : openings) {
    rows.push_back(row_of_opening("excavate", impl_->sim(), name));
  }
  if (rows.empty()) return;
  impl_->begin_change("excavate");
  check_excavation(impl_->sim(), openings, rows);
  edda::excavate(impl_->sim(), rows);
  impl_->end_change();
}

void Simulation::relax(const std::string& opening, double part) {
  const Index row = row_of_opening("relax", impl_->sim(), opening);
  check_number("relax", "part", part, 0.0, 1.0);
  impl_->begin_change("relax");
  check_relaxation(impl_->sim(), row, opening, part);
  edda::relax(impl_->sim(), row, part);
  impl_->end_change();
}

void Simulation::switch_over(const std::vector<std::string>& deactivate,
                             const std::vector<std::string>& activate) {
  const edda::Model& model = impl_->sim().scene->model;
  std::vector<std::string_view> known;
  add_names(model.loads, known);
  add_names(model.waters, known);
  add_names(model.boundaries, known);
  add_names(model.shakings, known);
  for (const auto* names : {&deactivate, &activate}) {
    for (const std::string& name : *names) {
      check_known("switch_over", name, "load, water, boundary or shaking", known);
    }
  }
  impl_->begin_change("switch_over");
  check_switches(impl_->sim(), deactivate, activate);
  edda::switch_over(impl_->sim(), rows_called(model, deactivate), rows_called(model, activate));
  impl_->end_change();
}

void Simulation::install(const std::vector<std::string>& bolts) {
  const edda::Model& model = impl_->sim().scene->model;
  std::vector<std::string_view> known;
  add_names(model.bolts, known);
  add_names(model.bolt_patterns, known);
  for (const std::string& name : bolts) check_known("install", name, "bolt", known);
  const std::vector<Index> rows = bolts_called(model, bolts);
  if (rows.empty()) return;
  impl_->begin_change("install");
  for (const std::string& name : bolts) {
    for (const Index row : bolts_called(model, {name})) {
      if (!is_installed(impl_->sim().attached.bolts, row)) continue;
      raise("install", '"' + name + "\" has been installed before", "install each once");
    }
  }
  if (const auto fault = edda::install(impl_->sim(), rows)) raise(Faults{*fault});
  impl_->end_change();
}

void Simulation::reset_displacements() {
  impl_->begin_change("reset_displacements");
  edda::reset_displacements(impl_->sim());
  impl_->end_change();
}

}  // namespace edda::api
