#include "contacts/strength.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>

#include "contacts/face_softening.hpp"

namespace edda {
namespace {

constexpr double steepest = 70.0;  // degrees

double radians(double degrees) {
  return degrees * std::numbers::pi / 180.0;
}

StrengthInForce weakened(const Law& law, double slip) {
  const double w = std::min(slip / law.slip_distance, 1.0);
  const auto between = [&](double peak, double residual) {
    return w < 1.0 ? peak + w * (residual - peak) : residual;
  };
  return {between(law.peak_friction, law.residual_friction),
          between(law.peak_cohesion, law.residual_cohesion),
          between(law.peak_tension, law.residual_tension), (1.0 - w) * law.dilation};
}

StrengthInForce rough(const Law& law, double slip, double length, double sigma, double divided_by) {
  constexpr double sizes = 500.0, power = 0.33;
  const double peak = law.jrc > 0.0 ? length / sizes * std::pow(law.jrc / length, power) : 0.0;
  const double left = roughness_left(slip, peak);
  const double angle = barton_angle(law, left, sigma);
  return {std::tan(radians(angle)) / divided_by, 0.0, 0.0,
          std::tan(radians(0.5 * (angle - law.residual_angle)))};
}

/// Of a face that has exceeded its strength.
StrengthInForce softened(const Law& law, const StrengthInputs& in) {
  const FaceEnds damage = damage_of(law, in.parted, in.slip);
  const double left = 1.0 - 0.5 * (damage.a + damage.b);
  return {law.peak_friction, left * law.peak_cohesion, left * law.peak_tension, 0.0};
}

StrengthInForce coulomb(const Law& law, BondState bond, double slip) {
  const bool whole = bond != BondState::unbonded;
  return {whole ? law.peak_friction : law.residual_friction,
          whole ? law.peak_cohesion : law.residual_cohesion,
          bond == BondState::intact ? law.peak_tension : law.residual_tension,
          slip < law.slip_distance ? law.dilation : 0.0};
}

}  // namespace

LawTable divided_laws(const Model& model, const std::vector<double>& factors,
                      const LawProgress& progress) {
  LawTable laws = build_laws(model, progress);
  laws.divided_by = factors;
  for (std::size_t r = 0; r < laws.rows.size(); ++r) {
    Law& law = laws.rows[r];
    for (double* strength : {&law.peak_friction, &law.peak_cohesion, &law.peak_tension,
                             &law.residual_friction, &law.residual_cohesion, &law.residual_tension})
      *strength /= factors[r];
  }
  return laws;
}

StrengthInForce strength_of(const LawTable& laws, std::uint16_t row, BondState bond,
                            const StrengthInputs& in) {
  const Law& law = laws.rows[row];
  const auto of_law = [&] {
    if (law.type == LawType::slip_weakening) return weakened(law, in.slip);
    if (law.type == LawType::barton_bandis && in.length > 0.0) {
      const double sigma = std::max(in.normal, 0.0) / (in.length * laws.thickness);
      return rough(law, in.slip, in.length, sigma, laws.divided_by[row]);
    }
    if (law.softens && bond == BondState::unbonded && std::isfinite(in.slip))
      return softened(law, in);
    return coulomb(law, bond, in.slip);
  };
  StrengthInForce s = of_law();
  s.cohesion *= laws.thickness;
  s.tension *= laws.thickness;
  return s;
}

void put_in_force(FaceSet& c, const StrengthInForce& s, std::size_t k) {
  c.friction[k] = s.friction;
  c.cohesion[k] = s.cohesion;
  c.tension[k] = s.tension;
}

void put_in_force(FaceSet& c, const FaceStates& states, const LawTable& laws) {
  for (std::size_t k = 0; k < c.size(); ++k) {
    const FaceFields& m = states.before[k];
    // Of faces that stored nothing length and forces may be those of an earlier step.
    const double length = m.energy > 0.0 ? m.length : 0.0;
    const StrengthInputs in{
        c.slip_so_far[k], length, m.normal_a + m.normal_b, {c.parted_a[k], c.parted_b[k]}};
    put_in_force(c, strength_of(laws, c.law[k], c.bond(k), in), k);
  }
}

void set_bond(FaceSet& c, const LawTable& laws, BondState bond, double slip, std::size_t k) {
  c.set_bond(bond, k);
  c.slip_so_far[k] = slip;
  c.set(FaceFlag::carries_tension, k, laws.rows[c.law[k]].residual_tension > 0.0);
  put_in_force(c, strength_of(laws, c.law[k], bond, {.slip = slip}), k);
}

void set_residual_strength(FaceSet& c, const LawTable& laws, std::size_t k) {
  set_bond(c, laws, BondState::unbonded, first_slip(laws.rows[c.law[k]]), k);
}

double first_slip(const Law& law) {
  const bool falls = law.type == LawType::slip_weakening || law.softens;
  return falls ? std::numeric_limits<double>::infinity() : 0.0;
}

double roughness_left(double slip, double peak) {
  // Barton, Bandis and Bakhtar (1985), beyond the peak; linear in log10(u/u_p) between the points.
  constexpr std::array<std::array<double, 2>, 6> table{
      {{1.0, 1.0}, {2.0, 0.85}, {4.0, 0.70}, {10.0, 0.50}, {25.0, 0.40}, {100.0, 0.0}}};
  if (slip <= peak) return 1.0;
  const double ratio = slip / peak;
  for (std::size_t q = 1; q < table.size(); ++q) {
    if (ratio > table[q][0]) continue;
    const double part = std::log(ratio / table[q - 1][0]) / std::log(table[q][0] / table[q - 1][0]);
    return table[q - 1][1] + part * (table[q][1] - table[q - 1][1]);
  }
  return 0.0;
}

double barton_angle(const Law& law, double roughness, double sigma) {
  if (law.jrc == 0.0 || roughness == 0.0 || sigma >= law.jcs) return law.residual_angle;
  if (sigma <= 0.0) return std::max(law.residual_angle, steepest);
  const double angle = law.residual_angle + roughness * law.jrc * std::log10(law.jcs / sigma);
  return std::max(law.residual_angle, std::min(angle, steepest));
}

}  // namespace edda
