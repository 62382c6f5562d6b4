#include "integrate/mesh_step.hpp"

#include <algorithm>

#include "blocks/bent_state.hpp"

namespace edda {
namespace {

/// The mesh of block i: its nodes begin at `node` of all meshes and at the place `mode`.
struct MeshOf {
  const Meshes& all;
  std::size_t block, node, mode, count;
};
MeshOf mesh_of(const BlockSet& b, std::size_t i) {
  const std::size_t node = b.meshes.begin[i];
  return {b.meshes, i, node, b.bending.modes() + node, b.meshes.nodes_of(i)};
}

/// (G/mass)^-1 sum_j P_j f_j of the forces f(j).
template <class Force>
AffinePart common_part(const MeshOf& m, Force f) {
  AffinePart sum;
  for (std::size_t j = 0; j < m.count; ++j) m.all.add(sum, m.node + j, f(j));
  return m.all.solve(m.block, sum);
}

/// f_j/s_j - P_j . common: acceleration times the mass of the block.
Vec2 beside_affine(const MeshOf& m, const AffinePart& common, std::size_t j, Vec2 force) {
  return force / m.all.share[m.node + j] - m.all.at(common, m.node + j);
}

/// Local damping of mesh node j under the force that is left to it, N.
Vec2 damped_locally(const MeshOf& m, std::size_t j, Vec2 acceleration, Vec2 velocity, double beta) {
  return local_damping(m.all.share[m.node + j] * acceleration, velocity, beta);
}

/// Accelerations of the mesh nodes times the mass of the block.
std::vector<Vec2> accelerations_of(const MeshOf& m, const Leap& leap, double beta) {
  const ModeVectors &on = leap.force.modes, &v = leap.old_velocity.modes;
  const AffinePart common = common_part(m, [&](std::size_t j) { return on[m.mode + j]; });
  std::vector<Vec2> a(m.count);
  for (std::size_t j = 0; j < m.count; ++j) a[j] = beside_affine(m, common, j, on[m.mode + j]);
  if (beta == 0.0) return a;
  std::vector<Vec2> damping(m.count);
  for (std::size_t j = 0; j < m.count; ++j)
    damping[j] = damped_locally(m, j, a[j], v[m.mode + j], beta);
  const AffinePart of_damping = common_part(m, [&](std::size_t j) { return damping[j]; });
  for (std::size_t j = 0; j < m.count; ++j) a[j] += beside_affine(m, of_damping, j, damping[j]);
  return a;
}

}  // namespace

void advance_meshes(State& s, const Leap& leap, std::size_t begin, std::size_t end) {
  const BlockSet& b = leap.blocks;
  for (std::size_t i = begin; i < end; ++i) {
    if (!b.is_meshed(i)) continue;
    const MeshOf m = mesh_of(b, i);
    if (!is_free(b, s, i)) {
      for (std::size_t j = 0; j < m.count; ++j) s.velocity.modes.set(m.mode + j, {});
      continue;
    }
    const Kick kick = kick_of_block(leap, i);
    const std::vector<Vec2> a = accelerations_of(m, leap, kick.local);
    const double inverse = leap.masses.mode_inverse[i];
    for (std::size_t j = 0; j < m.count; ++j)
      s.velocity.modes.set(m.mode + j,
                           kicked(leap.old_velocity.modes[m.mode + j], inverse * a[j], kick));
    for (std::size_t j = 0; j < m.count; ++j)
      s.position.modes.add(m.mode + j, kick.h_new * s.velocity.modes[m.mode + j]);
  }
}

void push_mesh(State& s, const Leap& leap, const Kick& kick, const BodyVector& force,
               std::size_t i) {
  const MeshOf m = mesh_of(leap.blocks, i);
  const double per_force = kick.h * leap.masses.mode_inverse[i];
  const AffinePart common = common_part(m, [&](std::size_t j) { return force.modes[j]; });
  for (std::size_t j = 0; j < m.count; ++j) {
    const Vec2 more = per_force * beside_affine(m, common, j, force.modes[j]);
    s.velocity.modes.add(m.mode + j, more);
    s.position.modes.add(m.mode + j, kick.h_new * more);
  }
}

void account_meshes(const State& s, const Leap& leap, double* joules, std::size_t begin,
                    std::size_t end) {
  const BlockSet& b = leap.blocks;
  for (std::size_t i = begin; i < end; ++i) {
    if (!b.is_meshed(i) || !is_free(b, s, i)) continue;
    const MeshOf m = mesh_of(b, i);
    const Kick kick = kick_of_block(leap, i);
    const double mass = 1.0 / leap.masses.mode_inverse[i], by_mass = leap.damping.mass_of(i);
    if (kick.local == 0.0 && by_mass == 0.0) continue;
    const ModeVectors& on = leap.force.modes;
    const AffinePart common = common_part(m, [&](std::size_t j) { return on[m.mode + j]; });
    double sum = 0.0;
    for (std::size_t j = 0; j < m.count; ++j) {
      const Vec2 before = leap.old_velocity.modes[m.mode + j], after = s.velocity.modes[m.mode + j];
      const Vec2 moved = 0.5 * (leap.h_old * before + leap.h_new * after);
      const Vec2 a = beside_affine(m, common, j, on[m.mode + j]);
      sum -= dot(damped_locally(m, j, a, before, kick.local), moved);
      sum += by_mass * mass * m.all.share[m.node + j] * dot(0.5 * (before + after), moved);
    }
    joules[i] += sum;
  }
}

}  // namespace edda
