#include "integrate/leapfrog.hpp"

#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"

namespace edda {
namespace {

EDDA_INLINE double sign(double v) {
  return (v > 0.0 ? 1.0 : 0.0) - (v < 0.0 ? 1.0 : 0.0);
}

/// Cundall's local damping: beta |f| against the velocity, by component.
EDDA_INLINE Vec2 local_damping(Vec2 f, Vec2 v, double beta) {
  return {-beta * std::abs(f.x) * sign(v.x), -beta * std::abs(f.y) * sign(v.y)};
}

/// Change of a velocity in one step, v+ = ((1 - a h/2) v- + h f/m)/(1 + a h/2) with the
/// mass-proportional damping a, and the step h_new of the position that follows.
struct Kick {
  double keeps;  ///< (1 - a h/2)/(1 + a h/2)
  double h;      ///< h/(1 + a h/2), s
  double h_new, local;
};

EDDA_INLINE Vec2 kicked(Vec2 before, Vec2 acceleration, const Kick& kick) {
  return kick.keeps * before + kick.h * acceleration;
}

/// One node of all blocks, with lumped mass.
struct NodeView {
  const double *inverse_mass, *fx, *fy, *old_vx, *old_vy;
  double *vx, *vy, *x, *y;
};

EDDA_INLINE void advance_one(const NodeView& n, const Kick& kick, std::size_t i) {
  const Vec2 before{n.old_vx[i], n.old_vy[i]}, push{n.fx[i], n.fy[i]};
  const Vec2 force = push + local_damping(push, before, kick.local);
  const Vec2 after = kicked(before, n.inverse_mass[i] * force, kick);
  n.vx[i] = after.x;
  n.vy[i] = after.y;
  n.x[i] += kick.h_new * after.x;
  n.y[i] += kick.h_new * after.y;
}

EDDA_VECTOR void advance_nodes(NodeView n, Kick kick, std::size_t begin, std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) advance_one(n, kick, i);
}

}  // namespace

void advance(State& s, const Leap& leap, std::size_t begin, std::size_t end) {
  const BlockSet& b = leap.blocks;
  const Masses& masses = leap.masses;
  const StepDamping& damping = leap.damping;
  if (damping.local > 0.0 && damping.spared != nullptr) {
    const std::vector<Id>& spared = *damping.spared;
    const StepDamping others{damping.mass, damping.local, nullptr, damping.strain},
        these{damping.mass, 0.0, nullptr, damping.strain};
    const auto damped_by = [&](const StepDamping& other) {
      return Leap{b,           masses,     leap.force_x, leap.force_y, leap.old_vx,
                  leap.old_vy, leap.h_old, leap.h_new,   other};
    };
    auto next = std::lower_bound(spared.begin(), spared.end(), static_cast<Id>(begin));
    for (; next != spared.end() && *next < end; ++next) {
      advance(s, damped_by(others), begin, *next);
      advance(s, damped_by(these), *next, *next + 1);
      begin = *next + 1;
    }
  }
  const double h = 0.5 * (leap.h_old + leap.h_new), h_new = leap.h_new;
  // With strain damping the nodes of a block move together, after all have their new velocities.
  const bool strains = damping.strain != nullptr;
  const double half = 0.5 * damping.mass * h;
  const Kick kick{(1.0 - half) / (1.0 + half), h / (1.0 + half), strains ? 0.0 : h_new,
                  damping.local};
  if (masses.kind != MassKind::consistent) {
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      const NodeView node{masses.node_inverse[k].data(),
                          leap.force_x[k].data(),
                          leap.force_y[k].data(),
                          leap.old_vx[k].data(),
                          leap.old_vy[k].data(),
                          s.vx[k].data(),
                          s.vy[k].data(),
                          s.x[k].data(),
                          s.y[k].data()};
      advance_nodes(node, kick, begin, end);
    }
    if (strains) damp_strain_and_move(*damping.strain, b, masses, s, h_new, begin, end);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    const NodeVectors v = vectors_of(leap.old_vx, leap.old_vy, i);
    NodeVectors f = vectors_of(leap.force_x, leap.force_y, i);
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      f[k] += local_damping(f[k], v[k], damping.local);
    }
    const NodeVectors a = is_free(b, s, i) ? accelerations(masses, i, f) : NodeVectors{};
    for (std::size_t k = 0; k < nodes_per_block; ++k) {
      const Vec2 after = kicked(v[k], a[k], kick);
      s.vx[k][i] = after.x;
      s.vy[k][i] = after.y;
      s.x[k][i] += kick.h_new * after.x;
      s.y[k][i] += kick.h_new * after.y;
    }
  }
  if (strains) damp_strain_and_move(*damping.strain, b, masses, s, h_new, begin, end);
}

void advance(State& s, const Leap& leap) {
  parallel_chunks(
      leap.blocks.size(), blocks_at_once,
      [&](std::size_t, std::size_t begin, std::size_t end) { advance(s, leap, begin, end); });
}

void account_damping(const State& s, const Leap& leap, DampingWork& work) {
  const BlockSet& b = leap.blocks;
  const StepDamping& damping = leap.damping;
  const Nodes &old_vx = leap.old_vx, &old_vy = leap.old_vy;
  const double h_old = leap.h_old, h_new = leap.h_new;
  if (damping.strain != nullptr) {
    add_strain_dissipation(*damping.strain, b, s, old_vx, old_vy, h_old, h_new, work.joules);
  }
  if (damping.mass == 0.0 && damping.local == 0.0) return;
  const auto is_spared = [&](std::size_t i) {
    return damping.spared != nullptr &&
           std::binary_search(damping.spared->begin(), damping.spared->end(), static_cast<Id>(i));
  };
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    const NodeVectors before = vectors_of(old_vx, old_vy, i), after = vectors_of(s.vx, s.vy, i),
                      moved = 0.5 * (h_old * before + h_new * after);
    double dissipated = 0.0;
    if (damping.local > 0.0 && !is_spared(i)) {
      const NodeVectors f = vectors_of(leap.force_x, leap.force_y, i);
      for (std::size_t k = 0; k < nodes_per_block; ++k) {
        dissipated -= dot(local_damping(f[k], before[k], damping.local), moved[k]);
      }
    }
    if (damping.mass > 0.0) {
      dissipated += damping.mass * mass_product(leap.masses, i, 0.5 * (before + after), moved);
    }
    work.joules[i] += dissipated;
  });
}

void undo_step(State& s, const BlockSet& b, double h_new, const Nodes& old_vx,
               const Nodes& old_vy) {
  parallel_for(b.size(), [&](std::size_t i) {
    add(-h_new * vectors_of(s.vx, s.vy, i), s.x, s.y, i);
    store(vectors_of(old_vx, old_vy, i), s.vx, s.vy, i);
  });
}

void start_velocities(State& s, const BlockSet& b, const Masses& masses, const Nodes& force_x,
                      const Nodes& force_y, double h, double mass_damping) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    const NodeVectors a = accelerations(masses, i, vectors_of(force_x, force_y, i));
    add(-0.5 * h * (a - mass_damping * vectors_of(s.vx, s.vy, i)), s.vx, s.vy, i);
  });
}

}  // namespace edda
