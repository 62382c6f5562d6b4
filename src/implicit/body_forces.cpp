#include "implicit/body_forces.hpp"

#include "blocks/bent_state.hpp"
#include "blocks/strain_rate.hpp"
#include "forces/bending_forces.hpp"
#include "forces/elastic.hpp"

namespace edda {
namespace {

/// Adds the forces of block i where its modes have the stresses g, N in its own frame, and of the
/// couple that goes with them (bent_state.hpp).
void add_stress_of_modes(BodyColumn& on, const BlockSet& b, const BentState& at,
                         const ModesOfBlock& g, std::size_t i) {
  on.head<degrees_of_freedom>() +=
      nodal(couple_on_nodes(b, at.r, couple_of(g, at.s, at.modes.count), i));
  for (std::size_t a = 0; a < at.modes.count; ++a) {
    const Vec2 force = turned(at.r, g[a]);
    on.segment<2>(row_of_node(nodes_per_block + a)) -= Eigen::Vector2d(force.x, force.y);
  }
}

BentState bent_at(const BlockSet& b, const BodyVectors& position, std::size_t i) {
  return bent_state(b, position.modes, rotation(deformation(b, position, i)), i);
}

/// Stresses of the damping of modes at the rates p.
void damp(const BlockSet& b, const Masses& masses, const BlockModes& modes, std::size_t i,
          ModesOfBlock& p) {
  const auto& rate = masses.mode_damping;
  const double mass = 1.0 / masses.mode_inverse[i], rest = rate[bendings][i];
  BentParts<double> along = bent_parts(view_of(b.bending), modes, p);
  for (std::size_t k = 0; k < bendings; ++k) along.along[k] *= mass * (rate[k][i] - rest);
  for (std::size_t a = 0; a < modes.count; ++a) p.set(a, mass * rest * p[a]);
  add_bendings(view_of(b.bending), modes, along, p);
}

}  // namespace

BodyColumn elastic_force(const ImplicitScene& scene, const State& s, std::size_t i) {
  const BlockSet& b = scene.blocks;
  BodyColumn on = BodyColumn::Zero(components_of(b, i));
  on.head<degrees_of_freedom>() =
      nodal(elastic_forces(b, stress_in(b, i, deformation(b, s.position, i)), i));
  const BentState at = bent_at(b, s.position, i);
  if (at.modes.count == 0) return on;
  ModesOfBlock g = elastic_stress(b, at, i);
  for (std::size_t a = 0; scene.locked.size() > 0 && a < at.modes.count; ++a)
    g.set(a, g[a] + scene.locked[at.modes[a]]);
  add_stress_of_modes(on, b, at, g, i);
  return on;
}

BodyColumn viscous_force(const ImplicitSolver& s, const ImplicitScene& scene,
                         const ImplicitSettings& settings, const State& state, std::size_t row) {
  const BlockSet& b = scene.blocks;
  const Id i = s.block_of[row];
  BodyColumn on = BodyColumn::Zero(components_of(b, i));
  if (!settings.dynamic || scene.masses.viscosity.empty()) return on;
  const double h = settings.step;
  const NodeVectors rate =
      (1.0 / h) * vectors_of(s.matrix.part(s.moved, row).head<degrees_of_freedom>());
  const StrainFrame before = strain_frame(deformation(b, s.start, i));
  const PiolaStress p = viscous_stress(b, scene.masses.viscosity[i], i,
                                       strain_frame(deformation(b, state.position, i)),
                                       strain_rate_over(before, gradient_of(b, rate, i), h));
  on.head<degrees_of_freedom>() = nodal(elastic_forces(b, p, i));
  const BentState now = bent_at(b, state.position, i);
  if (now.modes.count == 0) return on;
  const BentState then = bent_at(b, s.start, i);
  ModesOfBlock g;
  for (std::size_t a = 0; a < now.modes.count; ++a) g.set(a, (now.s[a] - then.s[a]) / h);
  damp(b, scene.masses, now.modes, i, g);
  add_stress_of_modes(on, b, now, g, i);
  return on;
}

}  // namespace edda
