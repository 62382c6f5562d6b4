#include "integrate/leapfrog.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "base/parallel.hpp"
#include "blocks/cover.hpp"

namespace edda {
namespace {

EDDA_INLINE double sign(double v) {
  return (v > 0.0 ? 1.0 : 0.0) - (v < 0.0 ? 1.0 : 0.0);
}

std::array<Vec2, 3> node_vectors(const Nodes& x, const Nodes& y, std::size_t i) {
  return {Vec2{x[0][i], y[0][i]}, Vec2{x[1][i], y[1][i]}, Vec2{x[2][i], y[2][i]}};
}

/// Cundall's local damping: beta |f| against the velocity, component by component.
EDDA_INLINE Vec2 local_damping(Vec2 f, Vec2 v, double beta) {
  return {-beta * std::abs(f.x) * sign(v.x), -beta * std::abs(f.y) * sign(v.y)};
}

/// u^T M v of one block.
double mass_product(const BlockSet& b, std::size_t i, const std::array<Vec2, 3>& u,
                    const std::array<Vec2, 3>& v) {
  if (b.mass_kind != MassKind::consistent) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) sum += b.node_mass[k][i] * dot(u[k], v[k]);
    return sum;
  }
  std::array<double, 6> inverse;
  for (std::size_t e = 0; e < 6; ++e) inverse[e] = b.inverse_mass[e][i];
  const std::array<double, 6> m = inverse_symmetric(inverse);
  return dot(u[0], m[0] * v[0] + m[1] * v[1] + m[2] * v[2]) +
         dot(u[1], m[1] * v[0] + m[3] * v[1] + m[4] * v[2]) +
         dot(u[2], m[2] * v[0] + m[4] * v[1] + m[5] * v[2]);
}

}  // namespace

std::array<Vec2, 3> accelerations(const BlockSet& b, std::size_t i, const std::array<Vec2, 3>& f) {
  if (b.mass_kind != MassKind::consistent) {
    return {f[0] / b.node_mass[0][i], f[1] / b.node_mass[1][i], f[2] / b.node_mass[2][i]};
  }
  const auto& m = b.inverse_mass;
  return {m[0][i] * f[0] + m[1][i] * f[1] + m[2][i] * f[2],
          m[1][i] * f[0] + m[3][i] * f[1] + m[4][i] * f[2],
          m[2][i] * f[0] + m[4][i] * f[1] + m[5][i] * f[2]};
}

namespace {

/// What one step does to a velocity: v+ = ((1 - drag) v- + h f/m)/(1 + drag), and the step it then
/// makes.
struct Kick {
  double h, h_new, drag, local;
};

EDDA_INLINE Vec2 kicked(Vec2 before, Vec2 acceleration, const Kick& kick) {
  return ((1.0 - kick.drag) * before + kick.h * acceleration) / (1.0 + kick.drag);
}

/// One node of all blocks, its mass lumped.
struct NodeView {
  const double *mass, *fx, *fy, *old_vx, *old_vy;
  double *vx, *vy, *x, *y;
};

EDDA_INLINE void advance_one(const NodeView& n, const Kick& kick, std::size_t i) {
  constexpr double held = std::numeric_limits<double>::infinity();
  const Vec2 before{n.old_vx[i], n.old_vy[i]}, push{n.fx[i], n.fy[i]};
  const Vec2 force = push + local_damping(push, before, kick.local);
  const double mass = n.mass[i] > 0.0 ? n.mass[i] : held;
  const Vec2 after = kicked(before, (1.0 / mass) * force, kick);
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

void advance(State& s, const BlockSet& b, const Nodes& force_x, const Nodes& force_y,
             const Nodes& old_vx, const Nodes& old_vy, double h_old, double h_new,
             const StepDamping& damping, std::size_t begin, std::size_t end) {
  if (damping.local > 0.0 && damping.spared != nullptr) {
    const std::vector<Id>& spared = *damping.spared;
    const StepDamping others{damping.mass, damping.local, nullptr, damping.strain},
        these{damping.mass, 0.0, nullptr, damping.strain};
    auto next = std::lower_bound(spared.begin(), spared.end(), static_cast<Id>(begin));
    for (; next != spared.end() && *next < end; ++next) {
      advance(s, b, force_x, force_y, old_vx, old_vy, h_old, h_new, others, begin, *next);
      advance(s, b, force_x, force_y, old_vx, old_vy, h_old, h_new, these, *next, *next + 1);
      begin = *next + 1;
    }
  }
  const double h = 0.5 * (h_old + h_new);
  // With viscous strain the nodes of a block go on together, once all have their kick.
  const bool strains = damping.strain != nullptr;
  const Kick kick{h, strains ? 0.0 : h_new, 0.5 * damping.mass * h, damping.local};
  if (b.mass_kind != MassKind::consistent) {
    for (std::size_t k = 0; k < 3; ++k) {
      const NodeView node{b.node_mass[k].data(), force_x[k].data(), force_y[k].data(),
                          old_vx[k].data(),      old_vy[k].data(),  s.vx[k].data(),
                          s.vy[k].data(),        s.x[k].data(),     s.y[k].data()};
      advance_nodes(node, kick, begin, end);
    }
    if (strains) damp_strain_and_move(*damping.strain, b, s, h_new, begin, end);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    const std::array<Vec2, 3> v = node_vectors(old_vx, old_vy, i);
    std::array<Vec2, 3> f = node_vectors(force_x, force_y, i);
    for (std::size_t k = 0; k < 3; ++k) f[k] += local_damping(f[k], v[k], damping.local);
    const bool moves = is_free(b, s, i);
    const std::array<Vec2, 3> a = moves ? accelerations(b, i, f) : std::array<Vec2, 3>{};
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 after = kicked(v[k], a[k], kick);
      s.vx[k][i] = after.x;
      s.vy[k][i] = after.y;
      s.x[k][i] += kick.h_new * after.x;
      s.y[k][i] += kick.h_new * after.y;
    }
  }
  if (strains) damp_strain_and_move(*damping.strain, b, s, h_new, begin, end);
}

void advance(State& s, const BlockSet& b, const Nodes& force_x, const Nodes& force_y, double h_old,
             double h_new, const StepDamping& damping) {
  parallel_chunks(b.size(), blocks_at_once, [&](std::size_t, std::size_t begin, std::size_t end) {
    advance(s, b, force_x, force_y, s.vx, s.vy, h_old, h_new, damping, begin, end);
  });
}

void book_damping(const State& s, const BlockSet& b, const Nodes& force_x, const Nodes& force_y,
                  const Nodes& old_vx, const Nodes& old_vy, double h_old, double h_new,
                  const StepDamping& damping, DampingWork& work) {
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
    const std::array<Vec2, 3> f = node_vectors(force_x, force_y, i);
    double dissipated = 0.0;
    const double local = damping.local > 0.0 && !is_spared(i) ? damping.local : 0.0;
    std::array<Vec2, 3> moved, mean;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 before{old_vx[k][i], old_vy[k][i]}, after{s.vx[k][i], s.vy[k][i]};
      moved[k] = 0.5 * (h_old * before + h_new * after);
      mean[k] = 0.5 * (before + after);
      if (local > 0.0) dissipated -= dot(local_damping(f[k], before, local), moved[k]);
    }
    if (damping.mass > 0.0) {
      dissipated += damping.mass * mass_product(b, i, mean, moved);
    }
    work.joules[i] += dissipated;
  });
}

void retreat(State& s, const BlockSet& b, double h_new, const Nodes& old_vx, const Nodes& old_vy) {
  parallel_for(b.size(), [&](std::size_t i) {
    for (std::size_t k = 0; k < 3; ++k) {
      s.x[k][i] -= h_new * s.vx[k][i];
      s.y[k][i] -= h_new * s.vy[k][i];
      s.vx[k][i] = old_vx[k][i];
      s.vy[k][i] = old_vy[k][i];
    }
  });
}

void start_velocities(State& s, const BlockSet& b, const Nodes& force_x, const Nodes& force_y,
                      double h, double mass_damping) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    const std::array<Vec2, 3> a = accelerations(b, i, node_vectors(force_x, force_y, i));
    for (std::size_t k = 0; k < 3; ++k) {
      s.vx[k][i] -= 0.5 * h * (a[k].x - mass_damping * s.vx[k][i]);
      s.vy[k][i] -= 0.5 * h * (a[k].y - mass_damping * s.vy[k][i]);
    }
  });
}

double kinetic_energy(const BlockSet& b, const Nodes& vx, const Nodes& vy, std::size_t i) {
  const std::array<Vec2, 3> v = node_vectors(vx, vy, i);
  return 0.5 * mass_product(b, i, v, v);
}

}  // namespace edda
