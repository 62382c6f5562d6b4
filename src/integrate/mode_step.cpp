#include "integrate/mode_step.hpp"

#include <utility>

// Vectors are passed between inlined functions alone.
#pragma GCC diagnostic ignored "-Wpsabi"

namespace edda {
namespace {

/// How the modes of a block (T = double) or of a group (T = Eight) are damped in a step: what
/// (1 + h C)^-1 - 1 is along each bending and beside them, the force that makes a change of their
/// rate in it, kg/s, and the rotation.
template <class T>
struct ModeDecay {
  T part[bendings + 1];
  T per_rate, c, s;
};

/// Damps the rates p of modes, as seen from their blocks, where they are at q: leaves what that
/// changes, in space, in place of p, adds its forces, and returns the couple that goes with them.
template <class T>
EDDA_INLINE T damp(const BendingView& b, ModePlaces modes, const ModeDecay<T>& decay,
                   const ModeArray<T>& q, ModeArray<T>& p, double* force_x, double* force_y) {
  const T rest = decay.part[bendings];
  BentParts<T> along = bent_parts(b, modes, p);
  for (std::size_t k = 0; k < bendings; ++k) along.along[k] *= decay.part[k] - rest;
  for (std::size_t a = 0; a < modes.count; ++a) {
    p.x[a] *= rest;
    p.y[a] *= rest;
  }
  add_bendings(b, modes, along, p);
  T couple{};
  for (std::size_t a = 0; a < modes.count; ++a) {
    const T x = decay.c * p.x[a] - decay.s * p.y[a], y = decay.s * p.x[a] + decay.c * p.y[a];
    p.x[a] = x;
    p.y[a] = y;
    double *const on_x = force_x + modes[a], *const on_y = force_y + modes[a];
    to<T>(on_x, from<T>(on_x) + decay.per_rate * x);
    to<T>(on_y, from<T>(on_y) + decay.per_rate * y);
    couple -= decay.per_rate * (x * q.y[a] - y * q.x[a]);
  }
  return couple;
}

bool is_damped(const ModeLeap& leap) {
  return leap.damping != nullptr && !leap.masses.mode_damping[0].empty();
}

/// What a group needs in a step. damp_x, damp_y, couple: null where none is damped.
struct GroupView {
  BendingView own;
  GradientView gradients;
  ConstNodeValues x, y, old_vx, old_vy;
  const double *force_x, *force_y, *old_x, *old_y, *mode_inverse, *rate[bendings + 1];
  double *bend_x, *bend_y, *rate_x, *rate_y, *damp_x, *damp_y, *couple;
  EDDA_INLINE Deformation deformation_of(std::size_t i) const {
    return deformation(gradients, x, y, i);
  }
};

GroupView view_of(const ModeLeap& leap, State& s) {
  const BlockSet& b = leap.blocks;
  GroupView v{view_of(b.bending),
              gradients_of(b),
              values_of(std::as_const(s.position.x)),
              values_of(std::as_const(s.position.y)),
              values_of(leap.old_velocity.x),
              values_of(leap.old_velocity.y),
              leap.force.modes.x.data(),
              leap.force.modes.y.data(),
              leap.old_velocity.modes.x.data(),
              leap.old_velocity.modes.y.data(),
              leap.masses.mode_inverse.data(),
              {},
              s.position.modes.x.data(),
              s.position.modes.y.data(),
              s.velocity.modes.x.data(),
              s.velocity.modes.y.data(),
              nullptr,
              nullptr,
              nullptr};
  if (!is_damped(leap)) return v;
  for (std::size_t k = 0; k <= bendings; ++k) v.rate[k] = leap.masses.mode_damping[k].data();
  v.damp_x = leap.damping->force.x.data();
  v.damp_y = leap.damping->force.y.data();
  v.couple = leap.damping->couple.data();
  return v;
}

EDDA_INLINE double spin_now(const GroupView& b, const GroupTurn& turn, std::size_t i,
                            std::size_t at) {
  return spin_of(turn.of(at),
                 gradient_of(b.gradients, vectors_of(b.old_vx, b.old_vy, i + at), i + at));
}

EDDA_INLINE Eight local_damping(Eight force, Eight rate, Eight beta) {
  const Eight zero{};
  const Eight size = force < zero ? -force : force;
  return rate > zero ? -beta * size : (rate < zero ? beta * size : zero);
}

/// The damping of a group in the step of which p has the new rates.
EDDA_INLINE void damp_group(const GroupView& b, ModePlaces modes, const GroupKick& kick,
                            std::size_t i, std::size_t many, ModeArray<Eight>& rate, NodeValues fx,
                            NodeValues fy) {
  GroupTurn turn;
  turn_of_group(b, i, many, turn);
  alignas(64) double spin[group_size] = {};
#pragma omp simd
  for (std::size_t at = 0; at < many; ++at) spin[at] = spin_now(b, turn, i, at);
  const Eight w = from<Eight>(spin), h = from<Eight>(kick.h), zero{}, one = zero + 1.0;
  const Eight inverse = h * from<Eight>(b.mode_inverse + i);
  ModeDecay<Eight> decay{
      {}, inverse > zero ? one / inverse : zero, from<Eight>(turn.c), from<Eight>(turn.s)};
  for (std::size_t k = 0; k <= bendings; ++k) {
    const Eight hc = h * from<Eight>(b.rate[k] + i);
    decay.part[k] = -hc / (one + hc);
  }
  ModeArray<Eight> q, p;
  for (std::size_t a = 0; a < modes.count; ++a) {
    q.x[a] = from<Eight>(b.bend_x + modes[a]);
    q.y[a] = from<Eight>(b.bend_y + modes[a]);
    const Eight x = rate.x[a] + w * q.y[a], y = rate.y[a] - w * q.x[a];
    p.x[a] = decay.c * x + decay.s * y;
    p.y[a] = decay.c * y - decay.s * x;
    to<Eight>(b.damp_x + modes[a], Eight{});
    to<Eight>(b.damp_y + modes[a], Eight{});
  }
  alignas(64) double couple[group_size];
  to<Eight>(couple, damp(b.own, modes, decay, q, p, b.damp_x, b.damp_y));
  for (std::size_t a = 0; a < modes.count; ++a) {
    rate.x[a] += p.x[a];
    rate.y[a] += p.y[a];
  }
  for (std::size_t at = 0; at < many; ++at) {
    if (!(kick.moves[at] > 0.0)) couple[at] = 0.0;
    b.couple[i + at] = couple[at];
  }
  add_couples(b.gradients, turn, couple, fx, fy, i, many);
}

EDDA_VECTOR void advance_group(const GroupView b, ModePlaces modes, const GroupKick& kick,
                               std::size_t i, std::size_t many, NodeValues fx, NodeValues fy) {
  const Eight keeps = from<Eight>(kick.keeps), h = from<Eight>(kick.h),
              local = from<Eight>(kick.local);
  const Eight per_mass = from<Eight>(b.mode_inverse + i);
  ModeArray<Eight> rate;
  for (std::size_t a = 0; a < modes.count; ++a) {
    const Eight x = from<Eight>(b.old_x + modes[a]), y = from<Eight>(b.old_y + modes[a]);
    const Eight on_x = from<Eight>(b.force_x + modes[a]), on_y = from<Eight>(b.force_y + modes[a]);
    rate.x[a] = keeps * x + h * (per_mass * (on_x + local_damping(on_x, x, local)));
    rate.y[a] = keeps * y + h * (per_mass * (on_y + local_damping(on_y, y, local)));
  }
  if (b.damp_x != nullptr) damp_group(b, modes, kick, i, many, rate, fx, fy);
  const Eight moves = from<Eight>(kick.moves), zero{};
  const double h_new = kick.h_new;
  const Eight step = zero + h_new;
  const auto settle = [&](double* bend, double* was, Eight now) __attribute__((always_inline)) {
    const Eight chosen = moves > zero ? now : zero;
    to<Eight>(was, chosen);
    to<Eight>(bend, from<Eight>(bend) + step * chosen);
  };
  for (std::size_t a = 0; a < modes.count; ++a) {
    settle(b.bend_x + modes[a], b.rate_x + modes[a], rate.x[a]);
    settle(b.bend_y + modes[a], b.rate_y + modes[a], rate.y[a]);
  }
}

/// Work of the couple of the damping of block i on its nodes.
EDDA_INLINE double couple_work(const GroupView& b, ConstNodeValues vx, ConstNodeValues vy,
                               double h_old, double h_new, std::size_t i) {
  const NodeVectors before = vectors_of(b.old_vx, b.old_vy, i), after = vectors_of(vx, vy, i);
  const NodeVectors moved = (0.5 * h_old) * before + (0.5 * h_new) * after;
  const NodeVectors at_n = vectors_of(b.x, b.y, i) - h_new * after;
  const Rotation r = rotation(gradient_of(b.gradients, at_n, i));
  return dot(couple_on_nodes(b.gradients, r, b.couple[i], i), moved);
}

/// What the damping of a group has dissipated over the displacements half way, J: by local damping,
/// in proportion to mass, and by strain.
EDDA_VECTOR void dissipate(const GroupView b, ModePlaces modes, const GroupKick& kick, double h_old,
                           std::size_t i, std::size_t many, ConstNodeValues vx, ConstNodeValues vy,
                           double* joules) {
  const Eight local = from<Eight>(kick.local), a_of = from<Eight>(kick.by_mass),
              half = Eight{} + 0.5;
  const Eight zero{}, inverse = from<Eight>(b.mode_inverse + i);
  const Eight am = inverse > zero ? a_of / inverse : zero, old = zero + h_old,
              now = zero + kick.h_new;
  Eight sum{};
  const auto add_one = [&](const double* force, const double* before_at, const double* after_at,
                           const double* damp_at) __attribute__((always_inline)) {
    const Eight before = from<Eight>(before_at), after = from<Eight>(after_at);
    const Eight moved = half * (old * before + now * after);
    sum -= local_damping(from<Eight>(force), before, local) * moved;
    sum += am * (half * (before + after)) * moved;
    if (damp_at != nullptr) sum -= from<Eight>(damp_at) * moved;
  };
  const bool damped = b.damp_x != nullptr;
  for (std::size_t a = 0; a < modes.count; ++a) {
    const std::size_t m = modes[a];
    add_one(b.force_x + m, b.old_x + m, b.rate_x + m, damped ? b.damp_x + m : nullptr);
    add_one(b.force_y + m, b.old_y + m, b.rate_y + m, damped ? b.damp_y + m : nullptr);
  }
  alignas(64) double work[group_size];
  to<Eight>(work, sum);
  const double h_new = kick.h_new;
  if (damped) {
#pragma omp simd
    for (std::size_t at = 0; at < many; ++at)
      work[at] -= couple_work(b, vx, vy, h_old, h_new, i + at);
  }
#pragma omp simd
  for (std::size_t at = 0; at < many; ++at) joules[i + at] += kick.moves[at] > 0.0 ? work[at] : 0.0;
}

}  // namespace

void advance_modes(State& s, const ModeLeap& leap, const GroupKick* kicks, BodyVectors& forces,
                   std::size_t begin, std::size_t end) {
  const GroupView view = view_of(leap, s);
  const Groups groups = groups_of(leap.blocks);
  groups.for_each(begin, end, [&](std::size_t i, std::size_t many, ModePlaces modes) {
    advance_group(view, modes, kicks[(i - begin) / group_size], i, many, values_of(forces.x),
                  values_of(forces.y));
  });
}

void take_back_couples(const ModeDamping& d, const BlockSet& b, const State& s, BodyVectors& forces,
                       std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end && !d.couple.empty(); ++i) {
    if (d.couple[i] == 0.0 || !is_free(b, s, i)) continue;
    const Rotation r = rotation(deformation(b, s.position, i));
    add(couple_on_nodes(b, r, -d.couple[i], i), forces, i);
  }
}

double push_modes(State& s, const ModeLeap& leap, const Kick& kick, const Rotation& r,
                  const ModesOfBlock& force, std::size_t i) {
  const BlockModes modes = leap.blocks.modes(i);
  const double per_mass = leap.masses.mode_inverse[i];
  ModesOfBlock change;
  for (std::size_t a = 0; a < modes.count; ++a) change.set(a, (kick.h * per_mass) * force[a]);
  double couple = 0.0;
  if (is_damped(leap)) {
    ModesOfBlock p, at_n;
    for (std::size_t a = 0; a < modes.count; ++a) {
      p.set(a, turned_back(r, change[a]));
      at_n.set(a, s.position.modes[modes[a]] - kick.h_new * s.velocity.modes[modes[a]]);
    }
    ModeDecay<double> decay{{}, 1.0 / (per_mass * kick.h), r.c, r.s};
    for (std::size_t k = 0; k <= bendings; ++k) {
      const double rate = kick.h * leap.masses.mode_damping[k][i];
      decay.part[k] = -rate / (1.0 + rate);
    }
    ModeVectors& on = leap.damping->force;
    couple = damp(view_of(leap.blocks.bending), modes, decay, at_n, p, on.x.data(), on.y.data());
    for (std::size_t a = 0; a < modes.count; ++a) change.set(a, change[a] + p[a]);
    leap.damping->couple[i] += couple;
  }
  for (std::size_t a = 0; a < modes.count; ++a) {
    const std::size_t m = modes[a];
    s.velocity.modes.add(m, change[a]);
    s.position.modes.add(m, kick.h_new * change[a]);
  }
  return couple;
}

void account_modes(const State& s, const ModeLeap& leap, const GroupKick* kicks, double h_old,
                   double* joules, std::size_t begin, std::size_t end) {
  const GroupView view = view_of(leap, const_cast<State&>(s));  // nothing is written through it
  const Groups groups = groups_of(leap.blocks);
  groups.for_each(begin, end, [&](std::size_t i, std::size_t many, ModePlaces modes) {
    dissipate(view, modes, kicks[(i - begin) / group_size], h_old, i, many, values_of(s.velocity.x),
              values_of(s.velocity.y), joules);
  });
}

}  // namespace edda
