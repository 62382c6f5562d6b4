#include "integrate/mode_step.hpp"

namespace edda {
namespace {

/// (1 + h C)^-1 p - p, in place of p.
void decay(const BlockSet& b, const Masses& masses, const BlockModes& modes, double h,
           std::size_t i, ModesOfBlock& p) {
  const auto& rate = masses.mode_damping;
  const auto part = [h](double c) { return -h * c / (1.0 + h * c); };
  const double rest = part(rate[bendings][i]);
  BentParts along = bent_parts(b.bending, modes, [&p](std::size_t a) { return p[a]; });
  for (std::size_t k = 0; k < bendings; ++k) along.along[k] *= part(rate[k][i]) - rest;
  for (std::size_t a = 0; a < modes.count; ++a)
    p[a] = rest * p[a] + of_bendings(b.bending, along, modes.first + a);
}

/// w of the block's rotation, 1/s, at these velocities of its nodes.
double spin_of(const BlockSet& b, const Rotation& r, const NodeVectors& v, std::size_t i) {
  const Deformation l = gradient_of(b, v, i);
  return (r.c * (l.yx - l.xy) - r.s * (l.xx + l.yy)) * r.inverse;
}

/// Damps the rates p of the modes of block i, as seen from it, where they are at q(a) at n: leaves
/// what that changes, in space, in place of p, adds its forces, and returns the couple that goes
/// with them.
template <class Amplitudes>
double damp(const ModeLeap& leap, const Kick& kick, const Rotation& r, std::size_t i,
            const Amplitudes& q, ModesOfBlock& p) {
  const BlockModes modes = leap.blocks.modes(i);
  decay(leap.blocks, leap.masses, modes, kick.h, i, p);
  const double to_force = 1.0 / (leap.masses.mode_inverse[i] * kick.h);
  double couple = 0.0;
  for (std::size_t a = 0; a < modes.count; ++a) {
    p[a] = turned(r, p[a]);
    leap.damping->force.add(modes.first + a, to_force * p[a]);
    couple -= to_force * cross(p[a], q(a));
  }
  return couple;
}

bool is_damped(const ModeLeap& leap) {
  return leap.damping != nullptr && !leap.masses.mode_damping[0].empty();
}

}  // namespace

void advance_modes(State& s, const ModeLeap& leap, const Kick& kick, std::size_t i, Nodes& fx,
                   Nodes& fy) {
  const BlockSet& b = leap.blocks;
  const BlockModes modes = b.modes(i);
  const double per_mass = leap.masses.mode_inverse[i];
  for (std::size_t m = modes.first; m < modes.first + modes.count; ++m)
    s.bend_rate.set(m, kicked_node(leap.old_rate[m], leap.force[m], per_mass, kick));
  if (is_damped(leap) && kick.h > 0.0) {
    ModeDamping& d = *leap.damping;
    const Rotation r = rotation(deformation(b, s.x, s.y, i));
    const double spin = spin_of(b, r, vectors_of(leap.old_vx, leap.old_vy, i), i);
    ModesOfBlock p;
    for (std::size_t a = 0; a < modes.count; ++a) {
      const std::size_t m = modes.first + a;
      p[a] = turned_back(r, s.bend_rate[m] - spin * perp(s.bend[m]));
      d.force.set(m, {});
    }
    d.couple[i] = damp(
        leap, kick, r, i, [&](std::size_t a) { return s.bend[modes.first + a]; }, p);
    for (std::size_t a = 0; a < modes.count; ++a) s.bend_rate.add(modes.first + a, p[a]);
    add(couple_on_nodes(b, r, d.couple[i], i), fx, fy, i);
  }
  for (std::size_t m = modes.first; m < modes.first + modes.count; ++m)
    s.bend.add(m, kick.h_new * s.bend_rate[m]);
}

void take_back_couples(const ModeDamping& d, const BlockSet& b, const State& s, Nodes& fx,
                       Nodes& fy, std::size_t begin, std::size_t end) {
  for (std::size_t i = begin; i < end && !d.couple.empty(); ++i) {
    if (d.couple[i] == 0.0) continue;
    const Rotation r = rotation(deformation(b, s.x, s.y, i));
    add(couple_on_nodes(b, r, -d.couple[i], i), fx, fy, i);
  }
}

double push_modes(State& s, const ModeLeap& leap, const Kick& kick, const Rotation& r,
                  const ModesOfBlock& force, std::size_t i) {
  const BlockModes modes = leap.blocks.modes(i);
  const double per_mass = leap.masses.mode_inverse[i];
  ModesOfBlock change;
  for (std::size_t a = 0; a < modes.count; ++a) change[a] = (kick.h * per_mass) * force[a];
  double couple = 0.0;
  if (is_damped(leap)) {
    ModesOfBlock p;
    for (std::size_t a = 0; a < modes.count; ++a) p[a] = turned_back(r, change[a]);
    const auto at_n = [&](std::size_t a) {
      return s.bend[modes.first + a] - kick.h_new * s.bend_rate[modes.first + a];
    };
    couple = damp(leap, kick, r, i, at_n, p);
    for (std::size_t a = 0; a < modes.count; ++a) change[a] += p[a];
    leap.damping->couple[i] += couple;
  }
  for (std::size_t a = 0; a < modes.count; ++a) {
    const std::size_t m = modes.first + a;
    s.bend_rate.add(m, change[a]);
    s.bend.add(m, kick.h_new * change[a]);
  }
  return couple;
}

double mode_dissipation(const ModeDamping& d, const ModeLeap& leap, const State& s, double h_old,
                        double h_new, const Rotation& at_n, const NodeVectors& by_nodes,
                        std::size_t i) {
  const BlockModes modes = leap.blocks.modes(i);
  double work = dot(couple_on_nodes(leap.blocks, at_n, d.couple[i], i), by_nodes);
  for (std::size_t m = modes.first; m < modes.first + modes.count; ++m)
    work += dot(d.force[m], 0.5 * (h_old * leap.old_rate[m] + h_new * s.bend_rate[m]));
  return -work;
}

}  // namespace edda
