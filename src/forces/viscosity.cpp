#include "forces/viscosity.hpp"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "base/parallel.hpp"
#include "forces/block_matrices.hpp"

namespace edda {

double lowest_frequency(const BlockSet& b, const Masses& masses, std::size_t i) {
  const StrainMatrix strain = strain_matrix(b, i);
  Eigen::Matrix3d inverse_inertia;
  if (masses.kind != MassKind::consistent) {
    const NodalVector inverse = mass_matrix(masses, i).diagonal().cwiseInverse();
    inverse_inertia = strain * inverse.asDiagonal() * strain.transpose();
  } else {
    inverse_inertia = strain * mass_matrix(masses, i).ldlt().solve(strain.transpose().eval());
  }
  const Eigen::Matrix3d root = (b.volume[i] * stiffness_of_rock(b, i)).llt().matrixL();
  Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d> solver;
  solver.computeDirect(root.transpose() * inverse_inertia * root, Eigen::EigenvaluesOnly);
  return std::sqrt(std::max(solver.eigenvalues()[0], 0.0));
}

void fill_viscosity(Masses& masses, const BlockSet& b, const Damping& damping) {
  const bool elastic =
      std::all_of(b.damping.begin(), b.damping.end(), [](double zeta) { return zeta == 0.0; });
  masses.viscosity.clear();
  for (std::vector<double>& rate : masses.mode_damping) rate.clear();
  if (damping.rayleigh ? damping.rayleigh->fraction == 0.0 : elastic) return;
  masses.viscosity.assign(b.size(), 0.0);
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.is_meshed(i)) return;
    masses.viscosity[i] = damping.rayleigh ? damping.rayleigh->stiffness()
                                           : 2.0 * b.damping[i] / lowest_frequency(b, masses, i);
  });
  if (b.mode_places() == 0) return;
  for (std::vector<double>& rate : masses.mode_damping) rate.assign(in_groups(b.size()), 0.0);
  parallel_for(b.size(), [&](std::size_t i) {
    if (b.is_meshed(i)) return;
    const std::array<double, bendings + 1> along = stiffness_along(b.bending, b.modes(i), i);
    for (std::size_t k = 0; k <= bendings; ++k) {
      const double square = std::max(along[k], 0.0) * masses.mode_inverse[i];
      masses.mode_damping[k][i] = damping.rayleigh ? damping.rayleigh->stiffness() * square
                                                   : 2.0 * b.damping[i] * std::sqrt(square);
    }
  });
}

}  // namespace edda
