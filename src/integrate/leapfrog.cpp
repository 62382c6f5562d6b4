#include "integrate/leapfrog.hpp"

#include <algorithm>
#include <array>
#include <cmath>

#include "base/parallel.hpp"
#include "blocks/free_blocks.hpp"
#include "integrate/kick.hpp"
#include "integrate/mesh_step.hpp"

namespace edda {
namespace {

/// One node of all blocks, with lumped mass.
struct NodeView {
  const double *inverse_mass, *fx, *fy, *old_vx, *old_vy;
  double *vx, *vy, *x, *y;
};

EDDA_INLINE void advance_one(const NodeView& n, const Kick& kick, std::size_t i) {
  const Vec2 after =
      kicked_node({n.old_vx[i], n.old_vy[i]}, {n.fx[i], n.fy[i]}, n.inverse_mass[i], kick);
  n.vx[i] = after.x;
  n.vy[i] = after.y;
  n.x[i] += kick.h_new * after.x;
  n.y[i] += kick.h_new * after.y;
}

EDDA_VECTOR void advance_nodes(NodeView n, OneKick kicks, std::size_t begin, std::size_t end) {
  const Kick kick = kicks.kick;
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) advance_one(n, kick, i);
}
EDDA_VECTOR void advance_nodes(NodeView n, OwnKicks kicks, std::size_t begin, std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) advance_one(n, kicks.of(i), i);
}

/// Blocks whose nodes have lumped masses and are damped. `free`, `local` (beta) and `by_mass` (a)
/// have the numbers of the blocks from `begin` on.
struct DampedView {
  ConstNodeValues mass, fx, fy, old_vx, old_vy, vx, vy;
  const double *free, *local, *by_mass;
  std::size_t begin;
  double* joules;
};

/// The displacement (x_{n+1} - x_{n-1})/2 on which the forces at n do their work.
EDDA_INLINE Vec2 half_way(Vec2 before, Vec2 after, double h_old, double h_new) {
  return 0.5 * (h_old * before + h_new * after);
}

EDDA_INLINE void add_damping_work(const DampedView& b, double h_old, double h_new, std::size_t i) {
  double by_local = 0.0, by_mass = 0.0;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const Vec2 before{b.old_vx[k][i], b.old_vy[k][i]}, after{b.vx[k][i], b.vy[k][i]};
    const Vec2 moved = half_way(before, after, h_old, h_new);
    const Vec2 push = local_damping({b.fx[k][i], b.fy[k][i]}, before, b.local[i - b.begin]);
    by_local -= dot(push, moved);
    by_mass += b.mass[k][i] * dot(0.5 * (before + after), moved);
  }
  const double dissipated = by_local + b.by_mass[i - b.begin] * by_mass;
  b.joules[i] += b.free[i - b.begin] > 0.0 ? dissipated : 0.0;
}

EDDA_VECTOR void add_damping_work_of_all(DampedView b, double h_old, double h_new,
                                         std::size_t begin, std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) add_damping_work(b, h_old, h_new, i);
}

Kick kick_of(const Leap& leap, double h_of_positions) {
  const double h = 0.5 * (leap.h_old + leap.h_new);
  const double half = 0.5 * leap.damping.mass * h;
  return {(1.0 - half) / (1.0 + half), h / (1.0 + half), h_of_positions, leap.damping.local};
}

OwnKicks own_kicks(const Leap& leap, double h_of_positions) {
  const BlockKicks& k = *leap.damping.kicks;
  return {k.keeps.data(), k.h.data(), h_of_positions, leap.damping.local};
}

Leap damped_by(const Leap& leap, const StepDamping& other) {
  return {leap.blocks, leap.masses, leap.force, leap.old_velocity, leap.h_old, leap.h_new, other};
}

/// The first block of [begin, end) that local damping spares; else `end`.
std::size_t next_spared(const StepDamping& damping, std::size_t begin, std::size_t end) {
  if (damping.local == 0.0 || damping.spared == nullptr) return end;
  const std::vector<Id>& of = *damping.spared;
  const auto i = std::lower_bound(of.begin(), of.end(), static_cast<Id>(begin));
  return i == of.end() ? end : std::min<std::size_t>(*i, end);
}

double local_damping_of(const StepDamping& damping, std::size_t i) {
  return next_spared(damping, i, i + 1) == i ? 0.0 : damping.local;
}

}  // namespace

Kick kick_of_block(const Leap& leap, std::size_t i) {
  Kick kick =
      leap.damping.kicks != nullptr ? own_kicks(leap, leap.h_new).of(i) : kick_of(leap, leap.h_new);
  kick.local = local_damping_of(leap.damping, i);
  return kick;
}

void advance(State& s, const Leap& leap, std::size_t begin, std::size_t end) {
  const BlockSet& b = leap.blocks;
  const Masses& masses = leap.masses;
  const StepDamping& damping = leap.damping;
  for (std::size_t i = next_spared(damping, begin, end); i < end;
       i = next_spared(damping, begin, end)) {
    StepDamping all = damping, its = damping;
    all.spared = its.spared = nullptr;
    its.local = 0.0;
    advance(s, damped_by(leap, all), begin, i);
    advance(s, damped_by(leap, its), i, i + 1);
    begin = i + 1;
  }
  const double h_new = leap.h_new;
  const StepsAround step{leap.old_velocity, leap.h_old, h_new};
  // With strain damping the nodes of a block move together, after all have their new velocities.
  const bool strains = damping.strain != nullptr;
  const double h_of_positions = strains ? 0.0 : h_new;
  const Kick kick = kick_of(leap, h_of_positions);
  if (masses.kind != MassKind::consistent) {
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      const NodeView node{
          masses.node_inverse[k].data(), leap.force.x[k].data(),        leap.force.y[k].data(),
          leap.old_velocity.x[k].data(), leap.old_velocity.y[k].data(), s.velocity.x[k].data(),
          s.velocity.y[k].data(),        s.position.x[k].data(),        s.position.y[k].data()};
      if (damping.kicks != nullptr) {
        advance_nodes(node, own_kicks(leap, h_of_positions), begin, end);
      } else {
        advance_nodes(node, OneKick{kick}, begin, end);
      }
    }
    if (strains) damp_strain_and_move(*damping.strain, b, masses, s, step, begin, end);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    const NodeVectors v = vectors_of(leap.old_velocity, i);
    NodeVectors f = vectors_of(leap.force, i);
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      f[k] += local_damping(f[k], v[k], damping.local);
    }
    const NodeVectors a = is_free(b, s, i) ? accelerations(masses, i, f) : NodeVectors{};
    const Kick own = damping.kicks != nullptr ? own_kicks(leap, h_of_positions).of(i) : kick;
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      const Vec2 after = kicked(v[k], a[k], own);
      s.velocity.x[k][i] = after.x;
      s.velocity.y[k][i] = after.y;
      s.position.x[k][i] += own.h_new * after.x;
      s.position.y[k][i] += own.h_new * after.y;
    }
  }
  if (strains) damp_strain_and_move(*damping.strain, b, masses, s, step, begin, end);
}

double velocity_per_acceleration(const Leap& leap, std::size_t i) {
  return leap.damping.kicks != nullptr ? leap.damping.kicks->h[i] : kick_of(leap, leap.h_new).h;
}

ModeLeap of_modes(const Leap& leap) {
  return {leap.blocks, leap.masses, leap.force, leap.old_velocity, leap.damping.modes};
}

namespace {

/// The kicks of the group of blocks from i on.
void fill_kick(GroupKick& kick, const State& s, const Leap& leap, const Kick& of_all,
               std::size_t i) {
  kick.h_new = leap.h_new;
  const std::size_t many = std::min(group_size, leap.blocks.size() - i);
  const bool all =
      leap.damping.kicks == nullptr && next_spared(leap.damping, i, i + many) == i + many;
  for (std::size_t at = 0; at < many; ++at) {
    const Kick own = all ? of_all : kick_of_block(leap, i + at);
    kick.keeps[at] = own.keeps;
    kick.h[at] = own.h;
    kick.local[at] = own.local;
    kick.by_mass[at] = leap.damping.mass_of(i + at);
    kick.moves[at] = s.alive[i + at] != 0 ? 1.0 : 0.0;
  }
}

/// Calls body(kicks, begin, end) for parts of the blocks [begin, end), with those of their groups.
template <class Body>
void with_kicks(const State& s, const Leap& leap, std::size_t begin, std::size_t end, Body body) {
  const Kick of_all = kick_of(leap, leap.h_new);
  for (std::size_t from = begin; from < end; from += blocks_at_once) {
    const std::size_t last = std::min(end, from + blocks_at_once);
    std::array<GroupKick, blocks_at_once / group_size> kicks;
    for (std::size_t i = from; i < last; i += group_size)
      fill_kick(kicks[(i - from) / group_size], s, leap, of_all, i);
    body(kicks.data(), from, last);
  }
}

}  // namespace

void advance_modes(State& s, const Leap& leap, BodyVectors& forces, std::size_t begin,
                   std::size_t end) {
  if (leap.blocks.meshes.any()) advance_meshes(s, leap, begin, end);
  if (!leap.blocks.bending.any()) return;
  const ModeLeap modes = of_modes(leap);
  with_kicks(s, leap, begin, end, [&](const GroupKick* kicks, std::size_t from, std::size_t last) {
    advance_modes(s, modes, kicks, forces, from, last);
  });
}

void add_and_advance(State& s, const Leap& leap, const ForcesToAdd& forces, std::size_t begin,
                     std::size_t end) {
  const StepDamping& damping = leap.damping;
  const bool spares = next_spared(damping, begin, end) < end;
  if (damping.strain == nullptr || leap.masses.kind == MassKind::consistent || spares) {
    add_to_free(leap.blocks, s, forces, begin, end);
    return advance(s, leap, begin, end);
  }
  const StepsAround step{leap.old_velocity, leap.h_old, leap.h_new};
  if (damping.kicks != nullptr) {
    add_kick_and_damp(*damping.strain, leap.blocks, leap.masses, s, forces, step,
                      own_kicks(leap, leap.h_new), begin, end);
  } else {
    add_kick_and_damp(*damping.strain, leap.blocks, leap.masses, s, forces, step,
                      OneKick{kick_of(leap, leap.h_new)}, begin, end);
  }
}

void advance(State& s, const Leap& leap) {
  parallel_blocks(leap.blocks.size(), 15, [&](std::size_t, std::size_t begin, std::size_t end) {
    advance(s, leap, begin, end);
  });
}

namespace {

/// Adds what all damping of the modes has dissipated.
void account_modes(const State& s, const Leap& leap, DampingWork& work) {
  const BlockSet& b = leap.blocks;
  if (leap.damping.modes == nullptr && !leap.damping.any_of_nodes()) return;
  const ModeLeap of = of_modes(leap);
  parallel_blocks(b.size(), 10, [&](std::size_t, std::size_t begin, std::size_t end) {
    if (b.meshes.any()) account_meshes(s, leap, work.joules.data(), begin, end);
    if (!b.bending.any()) return;
    with_kicks(s, leap, begin, end,
               [&](const GroupKick* kicks, std::size_t from, std::size_t last) {
                 account_modes(s, of, kicks, leap.h_old, work.joules.data(), from, last);
               });
  });
}

}  // namespace

void account_damping(const State& s, const Leap& leap, DampingWork& work) {
  const BlockSet& b = leap.blocks;
  if (b.mode_places() > 0) account_modes(s, leap, work);
  const StepDamping& damping = leap.damping;
  const Nodes &old_vx = leap.old_velocity.x, &old_vy = leap.old_velocity.y;
  const double h_old = leap.h_old, h_new = leap.h_new;
  if (damping.strain != nullptr) {
    const double* const of_strain = damping.strain->work.data();
    parallel_for(
        b.size(), [&](std::size_t i) { work.joules[i] += of_strain[i]; }, 1);
  }
  if (!damping.any_of_nodes()) return;
  if (leap.masses.kind == MassKind::consistent) {
    parallel_for(b.size(), [&](std::size_t i) {
      if (!is_free(b, s, i)) return;
      const double local = local_damping_of(damping, i);
      const NodeVectors before = vectors_of(old_vx, old_vy, i), after = vectors_of(s.velocity, i);
      const NodeVectors f = vectors_of(leap.force, i);
      NodeVectors moved;
      for (std::size_t k = 0; k < nodes_per_block; ++k) {
        moved[k] = half_way(before[k], after[k], h_old, h_new);
        work.joules[i] -= dot(local_damping(f[k], before[k], local), moved[k]);
      }
      work.joules[i] +=
          damping.mass_of(i) * mass_product(leap.masses, i, 0.5 * (before + after), moved);
    });
    return;
  }
  parallel_blocks(b.size(), 6, [&](std::size_t, std::size_t begin, std::size_t end) {
    const FreeMarks free(b, s, begin, end);
    std::array<double, blocks_at_once> local, mass;
    local.fill(damping.local);
    for (std::size_t i = begin; i < end; ++i) mass[i - begin] = damping.mass_of(i);
    for (std::size_t i = next_spared(damping, begin, end); i < end;
         i = next_spared(damping, i + 1, end))
      local[i - begin] = 0.0;
    const DampedView view{values_of(leap.masses.node),
                          values_of(leap.force.x),
                          values_of(leap.force.y),
                          values_of(old_vx),
                          values_of(old_vy),
                          values_of(s.velocity.x),
                          values_of(s.velocity.y),
                          free.data(),
                          local.data(),
                          mass.data(),
                          begin,
                          work.joules.data()};
    add_damping_work_of_all(view, h_old, h_new, begin, end);
  });
}

void undo_step(State& s, double h_new, const BodyVectors& old_velocity) {
  for (std::size_t m = 0; m < old_velocity.modes.size(); ++m)
    s.position.modes.add(m, -h_new * s.velocity.modes[m]);
  parallel_for(s.alive.size(),
               [&](std::size_t i) { add(-h_new * vectors_of(s.velocity, i), s.position, i); });
  s.velocity = old_velocity;
}

void start_velocities(State& s, const BlockSet& b, const Masses& masses, const BodyVectors& force,
                      double h, const Damping& damping) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    const BodyVector a = accelerations(masses, b, i, vector_of(b, force, i));
    add(-0.5 * h * (a - mass_damping_of(masses, damping, i) * vector_of(b, s.velocity, i)), b,
        s.velocity, i);
  });
}

}  // namespace edda
