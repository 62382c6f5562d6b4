#include "integrate/leapfrog.hpp"

#include <cmath>

#include "base/parallel.hpp"
#include "blocks/cover.hpp"

namespace edda {
namespace {

double sign(double v) { return v > 0.0 ? 1.0 : v < 0.0 ? -1.0 : 0.0; }

std::array<Vec2, 3> node_forces(const Nodes& x, const Nodes& y, std::size_t i) {
  return {Vec2{x[0][i], y[0][i]}, Vec2{x[1][i], y[1][i]}, Vec2{x[2][i], y[2][i]}};
}

}  // namespace

std::array<Vec2, 3> accelerations(const BlockSet& b, std::size_t i,
                                  const std::array<Vec2, 3>& f) {
  if (b.mass_kind != MassKind::consistent) {
    return {f[0] / b.node_mass[0][i], f[1] / b.node_mass[1][i], f[2] / b.node_mass[2][i]};
  }
  const auto& m = b.inverse_mass;
  return {m[0][i] * f[0] + m[1][i] * f[1] + m[2][i] * f[2],
          m[1][i] * f[0] + m[3][i] * f[1] + m[4][i] * f[2],
          m[2][i] * f[0] + m[4][i] * f[1] + m[5][i] * f[2]};
}

void advance(State& s, const BlockSet& b, const Nodes& force_x, const Nodes& force_y, double h_old,
             double h_new, const StepDamping& damping, DampingWork& work) {
  const double h = 0.5 * (h_old + h_new);
  const bool damped = damping.mass > 0.0 || damping.local > 0.0;
  const double drag = 0.5 * damping.mass * h;
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    std::array<Vec2, 3> f = node_forces(force_x, force_y, i);
    std::array<Vec2, 3> local{};
    if (damping.local > 0.0) {
      for (std::size_t k = 0; k < 3; ++k) {
        local[k] = {-damping.local * std::abs(f[k].x) * sign(s.vx[k][i]),
                    -damping.local * std::abs(f[k].y) * sign(s.vy[k][i])};
        f[k] += local[k];
      }
    }
    const std::array<Vec2, 3> a = accelerations(b, i, f);
    double dissipated = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 before{s.vx[k][i], s.vy[k][i]};
      const Vec2 after = ((1.0 - drag) * before + h * a[k]) / (1.0 + drag);
      s.vx[k][i] = after.x;
      s.vy[k][i] = after.y;
      s.x[k][i] += h_new * after.x;
      s.y[k][i] += h_new * after.y;
      if (damped) {
        const Vec2 mean = 0.5 * (before + after);
        dissipated += h * (damping.mass * b.node_mass[k][i] * dot(mean, mean) - dot(local[k], mean));
      }
    }
    if (damped) work.joules[i] += dissipated;
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
                      double h) {
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] || !s.alive[i]) return;
    const std::array<Vec2, 3> a = accelerations(b, i, node_forces(force_x, force_y, i));
    for (std::size_t k = 0; k < 3; ++k) {
      s.vx[k][i] -= 0.5 * h * a[k].x;
      s.vy[k][i] -= 0.5 * h * a[k].y;
    }
  });
}

double kinetic_energy(const BlockSet& b, const Nodes& vx, const Nodes& vy, std::size_t i) {
  if (b.mass_kind != MassKind::consistent) {
    double sum = 0.0;
    for (std::size_t k = 0; k < 3; ++k) {
      sum += 0.5 * b.node_mass[k][i] * (vx[k][i] * vx[k][i] + vy[k][i] * vy[k][i]);
    }
    return sum;
  }
  std::array<double, 6> inverse;
  for (std::size_t e = 0; e < 6; ++e) inverse[e] = b.inverse_mass[e][i];
  const std::array<double, 6> m = inverse_symmetric(inverse);
  auto form = [&](const Nodes& v) {
    const double v0 = v[0][i], v1 = v[1][i], v2 = v[2][i];
    return v0 * (m[0] * v0 + 2.0 * m[1] * v1 + 2.0 * m[2] * v2) +
           v1 * (m[3] * v1 + 2.0 * m[4] * v2) + v2 * m[5] * v2;
  };
  return 0.5 * (form(vx) + form(vy));
}

}  // namespace edda
