#include "zones/foliation.hpp"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>

namespace edda {

std::optional<TransverseElasticity> transverse_elasticity(double young, double poisson,
                                                          double young_across,
                                                          double poisson_across, double shear) {
  Eigen::Matrix3d compliance;  // tt, nn, zz
  const double in = 1.0 / young, out = 1.0 / young_across, coupled = -poisson_across * out;
  compliance << in, coupled, -poisson * in, coupled, out, coupled, -poisson * in, coupled, in;
  const Eigen::LLT<Eigen::Matrix3d> factors(compliance);
  if (factors.info() != Eigen::Success || !(shear > 0.0)) return {};
  const Eigen::Matrix3d c = factors.solve(Eigen::Matrix3d::Identity());
  return TransverseElasticity{c(0, 0), c(1, 1), c(2, 2), c(0, 1), c(0, 2), c(1, 2), shear};
}

std::array<double, 3> strains_of(const TransverseElasticity& c, double tt, double nn, double zz) {
  Eigen::Matrix3d stiffness;
  stiffness << c.tt, c.tn, c.tz, c.tn, c.nn, c.nz, c.tz, c.nz, c.zz;
  const Eigen::Vector3d e = stiffness.llt().solve(Eigen::Vector3d(tt, nn, zz));
  return {e[0], e[1], e[2]};
}

double usual_shear_modulus(double young, double young_across, double poisson_across) {
  return 1.0 / (1.0 / young + (1.0 + 2.0 * poisson_across) / young_across);
}

FoliationSlip slip_to(const FoliationStrength& s, double stiffness, double shear_modulus,
                      double across, double along) {
  const double shear = std::abs(along), beyond = shear + across * s.friction - s.cohesion;
  const double tension =
      s.friction > 0.0 ? std::min(s.tension, s.cohesion / s.friction) : s.tension;
  if (beyond <= 0.0 && across <= tension) return {};
  double slip = std::max(beyond, 0.0) / (shear_modulus + stiffness * s.dilation * s.friction),
         opening = slip * s.dilation;
  const bool opens = across - stiffness * opening > tension;
  if (opens) {
    opening = (across - tension) / stiffness;
    slip = std::max(shear + tension * s.friction - s.cohesion, 0.0) / shear_modulus;
  }
  return {std::copysign(slip, along), opening, opens};
}

}  // namespace edda
