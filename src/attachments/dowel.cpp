#include "attachments/dowel.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

namespace edda {
namespace {

/// Displacement and rotation of the bar in the middle of the joint, of a half that begins there:
/// y = (force, mixed) . (F, M), y' = (mixed, moment) . (F, M).
struct Compliance {
  double force, mixed, moment;
};

/// A semi-infinite beam on a foundation of modulus k, with beta^4 = k/4EI, has 2 beta/k,
/// 2 beta^2/k and 4 beta^3/k at its end. From there to the middle of the joint it is free.
Compliance half(double bending, double modulus, double free) {
  const double beta = std::sqrt(std::sqrt(modulus / (4.0 * bending)));
  const double y = 2.0 * beta / modulus, mixed = beta * y, turn = 2.0 * beta * mixed;
  return {y + free * (2.0 * mixed + free * (turn + free / (3.0 * bending))),
          mixed + free * (turn + 0.5 * free / bending), turn + free / bending};
}

/// Scales both trial forces: N = N'/(1 + x k_N/N_p^2), and likewise V. Returns x >= 0 for which
/// they lie on the ellipse. 1/radius is nearly linear in x and concave, so Newton's method comes
/// from below without passing the root.
double on_ellipse(const LinkPair& trial, const LinkPair& rate, const LinkPair& strength) {
  constexpr int most = 60;
  constexpr double rounding = 1e-15;
  double x = 0.0;
  for (int round = 0; round < most; ++round) {
    const double a = 1.0 / (1.0 + x * rate.axial), s = 1.0 / (1.0 + x * rate.shear);
    const double n = trial.axial * a / strength.axial, v = trial.shear * s / strength.shear;
    const double square = n * n + v * v, radius = std::sqrt(square);
    const double fall = (n * n * rate.axial * a + v * v * rate.shear * s) / square;
    const double change = (radius - 1.0) / fall;
    x += change;
    if (!(change > rounding * x)) break;
  }
  return x;
}

}  // namespace

DowelAction dowel_action(const DowelBar& bar, const Foundation& before, const Foundation& after,
                         double gap) {
  const double d = bar.diameter, square = d * d;
  const double bending = bar.young * std::numbers::pi * square * square / 64.0;
  const Compliance a = half(bending, before.modulus, 0.5 * gap),
                   b = half(bending, after.modulus, 0.5 * gap);
  const double skew = a.mixed - b.mixed;
  // Plastic moments M at both hinges, F/p from the walls: F^2/p + F gap = 2 M, p the harmonic mean.
  const double moment = bar.yield_stress * d * square / 6.0;
  const double p = 2.0 * d / (1.0 / before.strength + 1.0 / after.strength);
  const double shear = 0.5 * p * (std::sqrt(gap * gap + 8.0 * moment / p) - gap);
  const double section = 0.25 * std::numbers::pi * square * bar.yield_stress / std::numbers::sqrt3;
  return {1.0 / (a.force + b.force - skew * skew / (a.moment + b.moment)), std::min(shear, section),
          2.0 * shear / p + gap};
}

BarLink link_at(double hinges, double elongation, double offset) {
  BarLink link;
  const double along = hinges + elongation;
  link.length = std::sqrt(along * along + offset * offset);
  link.cosine = along / link.length;
  link.sine = offset / link.length;
  link.longer =
      (elongation * (2.0 * hinges + elongation) + offset * offset) / (link.length + hinges);
  link.shear = hinges * std::atan2(offset, along);
  link.part = hinges / link.length;
  return link;
}

LinkForces link_forces(const LinkPair& trial, const LinkPair& stiffness, const LinkPair& strength,
                       double hardening) {
  LinkForces f;
  const double n = trial.axial / strength.axial, v = trial.shear / strength.shear;
  const double whole = 0.5 * (trial.axial * trial.axial / stiffness.axial +
                              trial.shear * trial.shear / stiffness.shear);
  if (!(n * n + v * v > 1.0)) return {trial, stiffness.axial, 0.0, stiffness.shear, whole, false};
  const LinkPair rate{stiffness.axial / (strength.axial * strength.axial),
                      stiffness.shear / (strength.shear * strength.shear)};
  const double x = on_ellipse(trial, rate, strength);
  const double a = 1.0 / (1.0 + x * rate.axial), s = 1.0 / (1.0 + x * rate.shear);
  const LinkPair at{trial.axial * a, trial.shear * s};
  // Of the condition that the forces stay on the ellipse: dx = (g_N dN' + g_V dV')/w.
  const double g_n = at.axial * a / (strength.axial * strength.axial),
               g_v = at.shear * s / (strength.shear * strength.shear);
  const double w = at.axial * rate.axial * g_n + at.shear * rate.shear * g_v;
  const double turn_n = at.axial * a * rate.axial, turn_v = at.shear * s * rate.shear;
  const double e = stiffness.axial, c = stiffness.shear, held = 1.0 - hardening;
  f.axial_slope = e * (held * (a - turn_n * g_n / w) + hardening);
  f.shear_slope = c * (held * (s - turn_v * g_v / w) + hardening);
  f.mixed_slope = -held * c * turn_n * g_v / w;
  const double flow_n = (trial.axial - at.axial) / e, flow_v = (trial.shear - at.shear) / c;
  f.energy = held * (0.5 * (at.axial * at.axial / e + at.shear * at.shear / c) + at.axial * flow_n +
                     at.shear * flow_v) +
             hardening * whole;
  f.force = {held * at.axial + hardening * trial.axial, held * at.shear + hardening * trial.shear};
  f.flows = true;
  return f;
}

}  // namespace edda
