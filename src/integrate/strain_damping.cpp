#include "integrate/strain_damping.hpp"

#include "base/parallel.hpp"
#include "blocks/cover.hpp"

namespace edda {
namespace {

/// B M^-1 B^T of the undeformed block, entries 11 12 13 22 23 33, 1/(kg m2).
std::array<double, 6> compliance_of_inertia(const BlockSet& b, const Masses& masses,
                                            std::size_t i) {
  const auto rate = [&](const NodeVectors& v) {
    const Deformation l = gradient_of(b, v, i);
    return StrainTerms{l.xx, l.yy, l.xy + l.yx};
  };
  const auto column = [&](const Deformation& unit) {  // of M^-1 B^T
    return accelerations(masses, i, nodal_forces_of(b, unit, 1.0, i));
  };
  const StrainTerms p = rate(column({1.0, 0.0, 0.0, 0.0})), q = rate(column({0.0, 0.0, 0.0, 1.0})),
                    r = rate(column({0.0, 1.0, 1.0, 0.0}));
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
  return strain_frame(plus(deformation(b, s.position, i), -h_new, deformation(b, s.velocity, i)));
}

/// Work of s over the displacement (h_old u + h_new v)/2, with the velocities u before and v after
/// step n: the dissipation of the step.
template <class Blocks>
EDDA_INLINE double work_of(const Blocks& b, const StrainFrame& frame, const StrainTerms& s,
                           double h_old, const NodeVectors& u, double h_new, const NodeVectors& v,
                           std::size_t i) {
  const NodeVectors moved = (0.5 * h_old) * u + (0.5 * h_new) * v;
  const StrainTerms strained = strain_rate(frame, gradient_of(b, moved, i));
  return s.xx * strained.xx + s.yy * strained.yy + s.xy * strained.xy;
}

/// v - h M^-1 B^T W d, with d the strain rate to be damped; W d is added to s.
NodeVectors damped_velocity(StrainDamping& damping, const BlockSet& b, const Masses& masses,
                            std::size_t i, const StrainFrame& frame, const StrainTerms& rate,
                            const NodeVectors& v) {
  const StrainTerms s = times(damping.matrix, i, rate);
  damping.stress[0][i] += s.xx;
  damping.stress[1][i] += s.yy;
  damping.stress[2][i] += s.xy;
  const NodeVectors f = nodal_forces_of(b, stress_on_rate(frame, s), 1.0, i);
  return v - damping.step_of(i) * accelerations(masses, i, f);
}

/// Dissipation of block i once its velocities are v.
void update_work(StrainDamping& d, const BlockSet& b, const StrainFrame& frame,
                 const StepsAround& step, std::size_t i, const NodeVectors& v) {
  const StrainTerms s{d.stress[0][i], d.stress[1][i], d.stress[2][i]};
  d.work[i] = work_of(b, frame, s, step.h_old, vectors_of(step.old_velocity, i), step.h_new, v, i);
}

/// Data of the loops over blocks with lumped masses.
struct BlocksView {
  ConstNodeValues grad_x, grad_y, inverse_mass;
  std::array<const double*, 6> w;
  std::array<double*, 3> stress;
  double* work;
  NodeValues x, y, vx, vy;
  ConstNodeValues old_vx, old_vy;
  double h;             ///< s, of W, StrainDamping::step
  const double* steps;  ///< StrainDamping::steps; null: none
  double h_old, h_new;
};
BlocksView blocks_view(StrainDamping& d, const BlockSet& b, const Masses& masses, State& s,
                       const StepsAround& step) {
  return {values_of(b.grad_x),
          values_of(b.grad_y),
          values_of(masses.node_inverse),
          {d.matrix[0].data(), d.matrix[1].data(), d.matrix[2].data(), d.matrix[3].data(),
           d.matrix[4].data(), d.matrix[5].data()},
          {d.stress[0].data(), d.stress[1].data(), d.stress[2].data()},
          d.work.data(),
          values_of(s.position.x),
          values_of(s.position.y),
          values_of(s.velocity.x),
          values_of(s.velocity.y),
          values_of(step.old_velocity.x),
          values_of(step.old_velocity.y),
          d.step,
          d.steps.empty() ? nullptr : d.steps.data(),
          step.h_old,
          step.h_new};
}

/// Damps v*, the velocities v of block i, and moves it. h: of its W.
EDDA_INLINE void damp_and_move(const BlocksView& b, const NodeVectors& v, double h, std::size_t i) {
  const StrainFrame frame = strain_frame(deformation(b, b.x, b.y, i));
  const StrainTerms s = times(b.w, i, strain_rate_over(frame, gradient_of(b, v, i), b.h_new));
  const NodeVectors f = nodal_forces_of(b, stress_on_rate(frame, s), h, i);
  NodeVectors after;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    const double per_mass = b.inverse_mass[k][i];
    after[k] = {v[k].x - per_mass * f[k].x, v[k].y - per_mass * f[k].y};
  }
  b.stress[0][i] = s.xx;
  b.stress[1][i] = s.yy;
  b.stress[2][i] = s.xy;
  b.work[i] = work_of(b, frame, s, b.h_old, vectors_of(b.old_vx, b.old_vy, i), b.h_new, after, i);
  store(after, b.vx, b.vy, i);
  add(b.h_new * after, b.x, b.y, i);
}

EDDA_VECTOR void damp_and_move_all(BlocksView b, std::size_t begin, std::size_t end) {
  if (b.steps != nullptr) {
#pragma omp simd
    for (std::size_t i = begin; i < end; ++i)
      damp_and_move(b, vectors_of(b.vx, b.vy, i), b.steps[i], i);
    return;
  }
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) damp_and_move(b, vectors_of(b.vx, b.vy, i), b.h, i);
}

/// Completes the forces of block i, kicks, damps and moves it.
EDDA_INLINE void kick_and_move(const BlocksView& b, const FreeForces& f, const Kick& kick,
                               std::size_t i) {
  NodeVectors v;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    v[k] =
        kicked_node({b.old_vx[k][i], b.old_vy[k][i]}, f.complete(k, i), b.inverse_mass[k][i], kick);
  }
  damp_and_move(b, v, kick.h, i);
}

EDDA_VECTOR void add_kick_and_damp_all(BlocksView b, FreeForces f, OneKick kicks, std::size_t begin,
                                       std::size_t end) {
  const Kick kick = kicks.kick;
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) kick_and_move(b, f, kick, i);
}
EDDA_VECTOR void add_kick_and_damp_all(BlocksView b, FreeForces f, OwnKicks kicks,
                                       std::size_t begin, std::size_t end) {
#pragma omp simd
  for (std::size_t i = begin; i < end; ++i) kick_and_move(b, f, kicks.of(i), i);
}

/// Computes W of the blocks of which `changed` says so, for the step h_of(i).
template <class Changed, class Step>
void find_responses(StrainDamping& d, const BlockSet& b, const Masses& masses, Changed changed,
                    Step h_of) {
  for (auto& entry : d.matrix) entry.resize(b.size(), 0.0);
  for (auto& stress : d.stress) stress.resize(b.size(), 0.0);
  d.work.resize(b.size(), 0.0);
  parallel_for(b.size(), [&](std::size_t i) {
    if (!changed(i)) return;
    const bool damped = b.fixed[i] == 0 && !b.is_meshed(i) && masses.viscosity[i] > 0.0;
    const std::array<double, 6> w =
        damped ? response(b, masses, i, h_of(i)) : std::array<double, 6>{};
    for (std::size_t e = 0; e < 6; ++e) d.matrix[e][i] = w[e];
  });
}

}  // namespace

void prepare(StrainDamping& d, const BlockSet& b, const Masses& masses, double h) {
  if (d.step == h && d.steps.empty() && d.matrix[0].size() == b.size()) return;
  d.step = h;
  d.steps.clear();
  find_responses(
      d, b, masses, [](std::size_t) { return true; }, [h](std::size_t) { return h; });
}

void prepare(StrainDamping& d, const BlockSet& b, const Masses& masses,
             const std::vector<double>& h) {
  const bool all = d.step == 0.0 || d.steps.size() != b.size();
  if (!all && d.steps == h) return;
  find_responses(
      d, b, masses, [&](std::size_t i) { return all || d.steps[i] != h[i]; },
      [&](std::size_t i) { return h[i]; });
  d.steps = h;
  d.step = h.empty() ? 0.0 : h.front();
}

void damp_strain_and_move(StrainDamping& d, const BlockSet& b, const Masses& masses, State& s,
                          const StepsAround& step, std::size_t begin, std::size_t end) {
  if (masses.kind != MassKind::consistent) {
    damp_and_move_all(blocks_view(d, b, masses, s, step), begin, end);
    return;
  }
  for (std::size_t i = begin; i < end; ++i) {
    if (is_free(b, s, i)) {
      const StrainFrame frame = strain_frame(deformation(b, s.position, i));
      const StrainTerms rate = strain_rate_over(frame, deformation(b, s.velocity, i), step.h_new);
      for (std::vector<double>& stress : d.stress) stress[i] = 0.0;
      const NodeVectors after =
          damped_velocity(d, b, masses, i, frame, rate, vectors_of(s.velocity, i));
      store(after, s.velocity, i);
      update_work(d, b, frame, step, i, after);
    } else {
      d.work[i] = 0.0;
    }
    add(step.h_new * vectors_of(s.velocity, i), s.position, i);
  }
}

void add_kick_and_damp(StrainDamping& d, const BlockSet& b, const Masses& masses, State& s,
                       const ForcesToAdd& forces, const StepsAround& step, const OneKick& kick,
                       std::size_t begin, std::size_t end) {
  const FreeMarks free(b, s, begin, end);
  add_kick_and_damp_all(blocks_view(d, b, masses, s, step), free_forces(forces, free), kick, begin,
                        end);
}

void add_kick_and_damp(StrainDamping& d, const BlockSet& b, const Masses& masses, State& s,
                       const ForcesToAdd& forces, const StepsAround& step, const OwnKicks& kicks,
                       std::size_t begin, std::size_t end) {
  const FreeMarks free(b, s, begin, end);
  add_kick_and_damp_all(blocks_view(d, b, masses, s, step), free_forces(forces, free), kicks, begin,
                        end);
}

NodeVectors damped_change(StrainDamping& d, const BlockSet& b, const Masses& masses, const State& s,
                          const StepsAround& step, std::size_t i, const NodeVectors& change) {
  const StrainFrame frame = frame_before(b, s, step.h_new, i);
  const NodeVectors remains = damped_velocity(
      d, b, masses, i, frame, strain_rate(frame, gradient_of(b, change, i)), change);
  update_work(d, b, frame, step, i, vectors_of(s.velocity, i) + remains);
  return remains;
}

}  // namespace edda
