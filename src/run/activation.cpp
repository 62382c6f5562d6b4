// What acts on the blocks only during some stages: loads, waters, boundaries, shakings, bolts.
#include <algorithm>
#include <cmath>
#include <limits>

#include "attachments/boundary_lines.hpp"
#include "blocks/point_mass.hpp"
#include "contacts/face_bonds.hpp"
#include "model/accelerogram.hpp"
#include "run/simulation.hpp"

namespace edda {
namespace {

constexpr double never = std::numeric_limits<double>::infinity();

void set_all(std::vector<Spell>& spells, const std::vector<Index>& off,
             const std::vector<Index>& on, double time) {
  for (const Index q : off) spells[static_cast<std::size_t>(q)].until = time;
  for (const Index q : on) spells[static_cast<std::size_t>(q)] = {time, never};
}

bool names_row(const std::vector<Index>& rows, Index row) {
  return std::find(rows.begin(), rows.end(), row) != rows.end();
}

/// The keeper of what a boundary has taken over (KeptForce).
Index keeper_of(const Model& model, Index boundary) {
  return static_cast<Index>(model.openings.size()) + boundary;
}

/// What a boundary can bear of a force on the vertex, 0 where the vertex does not lie on it. A
/// roller bears what is across its lines.
Vec2 borne_by(const Model& model, const BlockSet& b, const Boundary& boundary, Id v, Vec2 force) {
  const double snap = boundary_snap(model, b);
  Vec2 first;
  bool on = false;
  for (const Line& line : boundary_lines(model, b, boundary)) {
    if (distance_to_segment(b.vertex(v), line.a, line.b) > snap) continue;
    if (boundary.type != BoundaryType::roller) return force;
    const Vec2 n = perp(unit(line.b - line.a));
    if (on && std::abs(cross(n, first)) > 1e-9) return force;  // a corner holds both ways
    first = n;
    on = true;
  }
  return on ? dot(force, first) * first : Vec2{};
}

}  // namespace

void Simulation::keep(const std::vector<KeptForce>& more) {
  kept.insert(kept.end(), more.begin(), more.end());
  keep_forces(model, blocks, more, loads);
}

/// Forces that these boundaries have on vertices, static ones alone; they have none any more.
std::vector<KeptForce> Simulation::release_boundaries(const std::vector<Index>& rows) {
  std::vector<KeptForce> borne;
  const LoadsNow now = acting();
  const auto first = static_cast<Index>(model.loads.size());
  for (const EdgeLoad& e : loads.edges) {
    if (!names_row(rows, e.load - first)) continue;
    const double part = now.factor[static_cast<std::size_t>(e.load)] * (e.to - e.from);
    const double middle = 0.5 * (e.from + e.to);
    const Vec2 whole = (part * blocks.edge_length[e.edge]) * e.traction;
    const double factor = now.factor[static_cast<std::size_t>(e.load)];
    const EndForces ends = on_vertices(e.from, e.to, e.ends);
    borne.push_back({e.edge, (1.0 - middle) * whole + factor * ends.at_from, none});
    borne.push_back({blocks.next[e.edge], middle * whole + factor * ends.at_to, none});
  }
  for (std::size_t q = 0; q < springs.size(); ++q) {
    if (!names_row(rows, springs.boundary[q])) continue;
    borne.push_back({springs.vertex[q], spring_force(springs, q, pose.x, pose.y), none});
  }
  for (const Index row : rows) {
    const Index keeper = keeper_of(model, row);
    for (const KeptForce& f : kept) {
      if (f.keeper == keeper) borne.push_back(f);
    }
    std::erase_if(kept, [&](const KeptForce& f) { return f.keeper == keeper; });
    drop_forces(model, blocks, keeper, loads);
    springs.release(row);
  }
  return borne;
}

std::optional<Fault> Simulation::install(const std::vector<Index>& which) {
  // Walls have moved since the bolts were drawn.
  constexpr double slack = 0.05;
  const double energy = ledger_now().balance(), power = bolt_power();
  Result<Bolts> fresh = attach_bolts(model, blocks, state, pose.x, pose.y, which, slack);
  if (!fresh.ok()) return fresh.faults().front();
  add_bolts(bolts, fresh.value(), model, blocks.size());
  // They pull for the whole of the step in hand, and had not been stretched in the one behind.
  if (explicit_method()) bolts.owed += 0.5 * step_before_ * (bolt_power() - power);
  external_work += ledger_now().balance() - energy;
  return {};
}

void Simulation::switch_over(const NamedRows& off, const NamedRows& on) {
  const double energy = ledger_now().balance();
  const NodalForces before_it = off.boundaries.empty() ? NodalForces{} : forces_now();
  std::vector<KeptForce> borne = release_boundaries(off.boundaries);
  for (const Index q : off.shakings) {
    const auto row = static_cast<std::size_t>(q);
    const Shaking& shaking = model.shakings[row];
    if (shaking.apply != ShakingKind::base) continue;
    ground.velocity -= velocity_at(shaking, state.time - loads.spells.shakings[row].since);
  }
  Spells& spells = loads.spells;
  set_all(spells.boundaries, off.boundaries, on.boundaries, state.time);
  // Springs and what is kept go and come at once; so does a traction that takes over or is taken
  // over from, or half of it would be there twice, or not at all, in this step.
  const double before = std::nextafter(state.time, -never);
  for (const Index q : off.boundaries) {
    spells.boundaries[static_cast<std::size_t>(q)].until = before;
  }
  for (const Index q : on.boundaries) {
    if (!off.boundaries.empty()) spells.boundaries[static_cast<std::size_t>(q)].since = before;
  }
  std::vector<KeptForce> inherited;
  for (const Index row : on.boundaries) {
    const Boundary& boundary = model.boundaries[static_cast<std::size_t>(row)];
    springs.engage(row, pose.x, pose.y);
    if (boundary.type == BoundaryType::stress) continue;
    const Index keeper = keeper_of(model, row);
    for (KeptForce& f : borne) {
      const Vec2 part = borne_by(model, blocks, boundary, f.vertex, f.force);
      if (part == Vec2{}) continue;
      inherited.push_back({f.vertex, part, keeper});
      f.force -= part;  // where two boundaries meet, one bears it
    }
    loads.held[static_cast<std::size_t>(keeper)] = {1.0, 1.0, state.time};
  }
  keep(inherited);
  dashpots.set_acting(spells.boundaries);
  note_jump(before_it);
  set_all(spells.loads, off.loads, on.loads, state.time);
  set_all(spells.waters, off.waters, on.waters, state.time);
  set_all(spells.shakings, off.shakings, on.shakings, state.time);
  const bool shakes = std::any_of(spells.shakings.begin(), spells.shakings.end(),
                                  [](const Spell& spell) { return spell.acts(); });
  if (!shakes) ground.velocity = {};
  external_work += ledger_now().balance() - energy;
}

void Simulation::glue_joints(bool glued) {
  if (glued == contacts.gluing) return;
  const NodalForces before = forces_now();
  if (glued) {
    glue_faces(contacts);
  } else {
    unglue_faces(contacts, blocks, pose);
  }
  place_again();
  note_jump(before);
}

double Simulation::uniform_step() const {
  double longest = 0.0;
  for (const double own :
       steps_of_blocks(blocks, state, contacts, springs, laws, damping, never, &bolts)) {
    if (std::isfinite(own)) longest = std::max(longest, own);
  }
  return longest;
}

void Simulation::scale_masses(StageMasses masses) {
  const bool uniform = masses == StageMasses::uniform_step;
  if (!uniform && scaled_step_ == 0.0) return;
  const double energy = ledger_now().balance();
  blocks.node_mass = given_mass_.node_mass;
  blocks.inverse_mass = given_mass_.inverse_mass;
  fill_point_masses(blocks);
  set_viscosity();
  inertia.clear();
  scaled_step_ = 0.0;
  if (uniform) scaled_step_ = uniform_step();
  step_change_energy += ledger_now().balance() - energy;
}

}  // namespace edda
