#include "integrate/strain_damping.hpp"

#include "base/parallel.hpp"
#include "blocks/cover.hpp"

namespace edda {
namespace {

/// B M^-1 B^T of the undeformed block, entries 11 12 13 22 23 33, 1/(kg m2).
std::array<double, 6> compliance_of_inertia(const BlockSet& b, const Masses& masses,
                                            std::size_t i) {
  const auto rate = [&](const NodeVectors& v) {
    const Deformation l = deformed_by(b, i, v);
    return StrainTerms{l.xx, l.yy, l.xy + l.yx};
  };
  NodeVectors xx, yy, xy;  // columns of B^T
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const double gx = b.grad_x[k][i], gy = b.grad_y[k][i];
    xx[k] = {gx, 0.0};
    yy[k] = {0.0, gy};
    xy[k] = {gy, gx};
  }
  const StrainTerms p = rate(accelerations(masses, i, xx)), q = rate(accelerations(masses, i, yy)),
                    r = rate(accelerations(masses, i, xy));
  return {p.xx, p.yy, p.xy, q.yy, q.xy, r.xy};
}

/// W of block i.
std::array<double, 6> response(const BlockSet& b, const Masses& masses, std::size_t i, double h) {
  const double lambda = b.lame_lambda[i], mu = b.lame_mu[i];
  const double per = 1.0 / (masses.viscosity[i] * b.volume[i] * 4.0 * mu * (lambda + mu));
  std::array<double, 6> a = compliance_of_inertia(b, masses, i);
  for (double& entry : a) entry *= h;
  a[0] += per * (lambda + 2.0 * mu);
  a[1] -= per * lambda;
  a[3] += per * (lambda + 2.0 * mu);
  a[5] += per * 4.0 * (lambda + mu);
  return inverse_symmetric(a);
}

/// s = W d.
template <class Matrix>
EDDA_INLINE StrainTerms times(const Matrix& w, std::size_t i, const StrainTerms& d) {
  return {w[0][i] * d.xx + w[1][i] * d.yy + w[2][i] * d.xy,
          w[1][i] * d.xx + w[3][i] * d.yy + w[4][i] * d.xy,
          w[2][i] * d.xx + w[4][i] * d.yy + w[5][i] * d.xy};
}

/// f + h l.
EDDA_INLINE Deformation plus(const Deformation& f, double h, const Deformation& l) {
  return {f.xx + h * l.xx, f.xy + h * l.xy, f.yx + h * l.yx, f.yy + h * l.yy};
}

/// The frame at step n, when positions are x_{n+1} = x_n + h_new v_{n+1/2} already.
StrainFrame frame_before(const BlockSet& b, const State& s, double h_new, std::size_t i) {
  return strain_frame(plus(deformation(b, s.x, s.y, i), -h_new, deformation(b, s.vx, s.vy, i)));
}

/// v - h M^-1 B^T W d, with d the strain rate to be damped; W d is added to s.
NodeVectors damped_velocity(StrainDamping& damping, const BlockSet& b, const Masses& masses,
                            std::size_t i, const StrainFrame& frame, const StrainTerms& rate,
                            const NodeVectors& v) {
  const StrainTerms s = times(damping.matrix, i, rate);
  damping.stress[0][i] += s.xx;
  damping.stress[1][i] += s.yy;
  damping.stress[2][i] += s.xy;
  const Deformation p = stress_on_rate(frame, s);
  NodeVectors f;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const double gx = b.grad_x[k][i], gy = b.grad_y[k][i];
    f[k] = {p.xx * gx + p.xy * gy, p.yx * gx + p.yy * gy};
  }
  return v - damping.step * accelerations(masses, i, f);
}

/// Data of the loops over blocks with lumped masses.
struct BlocksView {
  ConstNodeValues grad_x, grad_y, inverse_mass;
  std::array<const double*, 6> w;
  std::array<double*, 3> stress;
  NodeValues x, y, vx, vy;
};
BlocksView blocks_view(StrainDamping& d, const BlockSet& b, const Masses& masses, State& s) {
  return {values_of(b.grad_x),
          values_of(b.grad_y),
          values_of(masses.node_inverse),
          {d.matrix[0].data(), d.matrix[1].data(), d.matrix[2].data(), d.matrix[3].data(),
           d.matrix[4].data(), d.matrix[5].data()},
          {d.stress[0].data(), d.stress[1].data(), d.stress[2].data()},
          values_of(s.x),
          values_of(s.y),
          values_of(s.vx),
          values_of(s.vy)};
}

/// The rate of F for velocities v.
EDDA_INLINE Deformation rate_of(const BlocksView& b, const NodeVectors& v, std::size_t i) {
  Deformation l{v[0].x * b.grad_x[0][i], v[0].x * b.grad_y[0][i], v[0].y * b.grad_x[0][i],
                v[0].y * b.grad_y[0][i]};
  for (std::size_t k = 1; k < nodes_per_block; ++k) {
    const double gx = b.grad_x[k][i], gy = b.grad_y[k][i];
    l = {l.xx + v[k].x * gx, l.xy + v[k].x * gy, l.yx + v[k].y * gx, l.yy + v[k].y * gy};
  }
  return l;
}

/// Damps v* and moves block i.
EDDA_INLINE void damp_and_move(const BlocksView& b, double h, double h_new, const NodeVectors& v,
                               std::size_t i) {
  const StrainFrame frame = strain_frame(deformation(b, b.x, b.y, i));
  const StrainTerms s = times(b.w, i, strain_rate_over(frame, rate_of(b, v, i), h_new));
  const Deformation p = stress_on_rate(frame, s);
  b.stress[0][i] = s.xx;
  b.stress[1][i] = s.yy;
  b.stress[2][i] = s.xy;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const double per = h * b.inverse_mass[k][i];
    const double gx = b.grad_x[k][i], gy = b.grad_y[k][i];
    const double vx = v[k].x - per * (p.xx * gx + p.xy * gy);
    const double vy = v[k].y - per * (p.yx * gx + p.yy * gy);
    b.vx[k][i] = vx;
    b.vy[k][i] = vy;
    b.x[k][i] += h_new * vx;
    b.y[k][i] += h_new * vy;
  }
}

EDDA_INLINE void damp_and_move(const BlocksView& b, double h, double h_new, std::size_t i) {
  damp_and_move(b, h, h_new, vectors_of(b.vx, b.vy, i), i);
}

EDDA_VECTOR void damp_and_move_all(BlocksView b, double h, double h_new, std::size_t begin,
                                   std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) damp_and_move(b, h, h_new, i);
}

/// Completes the forces of block i, kicks, damps and moves it.
EDDA_INLINE void kick_and_move(const BlocksView& b, const FreeForces& f,
                               const ConstNodeValues& old_vx, const ConstNodeValues& old_vy,
                               const Kick& kick, double h, std::size_t i) {
  NodeVectors v;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    v[k] = kicked_node({old_vx[k][i], old_vy[k][i]}, f.complete(k, i), b.inverse_mass[k][i], kick);
  }
  damp_and_move(b, h, kick.h_new, v, i);
}

EDDA_VECTOR void add_kick_and_damp_all(BlocksView b, FreeForces f, ConstNodeValues old_vx,
                                       ConstNodeValues old_vy, Kick kick, double h,
                                       std::size_t begin, std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) kick_and_move(b, f, old_vx, old_vy, kick, h, i);
}

/// Data of the loop that adds up the dissipation.
struct DissipationView {
  ConstNodeValues grad_x, grad_y;
  std::array<const double*, 3> stress;
  ConstNodeValues x, y, vx, vy, old_vx, old_vy;
  double* joules;
};

EDDA_INLINE void add_dissipation(const DissipationView& b, double h_old, double h_new,
                                 std::size_t i) {
  const Deformation after = deformation(b, b.vx, b.vy, i);
  const StrainFrame frame = strain_frame(plus(deformation(b, b.x, b.y, i), -h_new, after));
  const Deformation before = deformation(b, b.old_vx, b.old_vy, i);
  const Deformation moved{
      0.5 * (h_old * before.xx + h_new * after.xx), 0.5 * (h_old * before.xy + h_new * after.xy),
      0.5 * (h_old * before.yx + h_new * after.yx), 0.5 * (h_old * before.yy + h_new * after.yy)};
  const StrainTerms strained = strain_rate(frame, moved);
  b.joules[i] +=
      b.stress[0][i] * strained.xx + b.stress[1][i] * strained.yy + b.stress[2][i] * strained.xy;
}

EDDA_VECTOR void add_dissipation_of_all(DissipationView b, double h_old, double h_new,
                                        std::size_t begin, std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) add_dissipation(b, h_old, h_new, i);
}

}  // namespace

void prepare(StrainDamping& d, const BlockSet& b, const Masses& masses, double h) {
  if (d.step == h && d.matrix[0].size() == b.size()) return;
  d.step = h;
  for (auto& entry : d.matrix) entry.assign(b.size(), 0.0);
  for (auto& stress : d.stress) stress.resize(b.size(), 0.0);
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.fixed[i] != 0 || !(masses.viscosity[i] > 0.0)) return;
    const std::array<double, 6> w = response(b, masses, i, h);
    for (std::size_t e = 0; e < 6; ++e) d.matrix[e][i] = w[e];
  });
}

void damp_strain_and_move(StrainDamping& d, const BlockSet& b, const Masses& masses, State& s,
                          double h_new, std::size_t begin, std::size_t end) {
  if (masses.kind != MassKind::consistent) {
    damp_and_move_all(blocks_view(d, b, masses, s), d.step, h_new, begin, end);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    if (is_free(b, s, i)) {
      const StrainFrame frame = strain_frame(deformation(b, s.x, s.y, i));
      const StrainTerms rate = strain_rate_over(frame, deformation(b, s.vx, s.vy, i), h_new);
      for (std::vector<double>& stress : d.stress) stress[i] = 0.0;
      store(damped_velocity(d, b, masses, i, frame, rate, vectors_of(s.vx, s.vy, i)), s.vx, s.vy,
            i);
    }
    add(h_new * vectors_of(s.vx, s.vy, i), s.x, s.y, i);
  }
}

void add_kick_and_damp(StrainDamping& d, const BlockSet& b, const Masses& masses, State& s,
                       const ForcesToAdd& forces, const Nodes& old_vx, const Nodes& old_vy,
                       const Kick& kick, std::size_t begin, std::size_t end) {
  const FreeMarks free(b, s, begin, end);
  add_kick_and_damp_all(blocks_view(d, b, masses, s), free_forces(forces, free), values_of(old_vx),
                        values_of(old_vy), kick, d.step, begin, end);
}

NodeVectors damped_change(StrainDamping& d, const BlockSet& b, const Masses& masses, const State& s,
                          double h_new, std::size_t i, const NodeVectors& change) {
  const StrainFrame frame = frame_before(b, s, h_new, i);
  return damped_velocity(d, b, masses, i, frame, strain_rate(frame, deformed_by(b, i, change)),
                         change);
}

void add_strain_dissipation(const StrainDamping& d, const BlockSet& b, const State& s,
                            const Nodes& old_vx, const Nodes& old_vy, double h_old, double h_new,
                            std::vector<double>& joules) {
  const DissipationView view{values_of(b.grad_x),
                             values_of(b.grad_y),
                             {d.stress[0].data(), d.stress[1].data(), d.stress[2].data()},
                             values_of(s.x),
                             values_of(s.y),
                             values_of(s.vx),
                             values_of(s.vy),
                             values_of(old_vx),
                             values_of(old_vy),
                             joules.data()};
  parallel_chunks(b.size(), blocks_at_once, 6,
                  [&](std::size_t, std::size_t begin, std::size_t end) {
                    add_dissipation_of_all(view, h_old, h_new, begin, end);
                  });
}

}  // namespace edda
