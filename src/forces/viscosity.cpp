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

namespace {

/// Of the pieces of block i, a lining, each by itself, 1/s.
double highest_frequency(const ZoneModel& zones, const BlockSet& b, std::size_t i) {
  const auto first = zones.square.begin();
  return std::sqrt(*std::max_element(first + b.meshes.begin[i], first + b.meshes.begin[i + 1]));
}

}  // namespace

void fill_viscosity(Masses& masses, const BlockSet& b, const Damping& damping,
                    const ZoneModel& zones) {
  const auto rayleigh = [&](std::size_t i) -> const std::optional<Rayleigh>& {
    return damping.rayleigh_with(b.rayleigh[i]);
  };
  const auto eta = [&](std::size_t i) {
    if (rayleigh(i)) return rayleigh(i)->stiffness();
    if (!b.is_meshed(i)) return 2.0 * b.damping[i] / lowest_frequency(b, masses, i);
    const bool vibrates = b.is_lining(i) && damping.adaptive == 0.0;
    return vibrates ? 2.0 * b.damping[i] / highest_frequency(zones, b, i) : 0.0;
  };
  masses.viscosity.assign(b.size(), 0.0);
  masses.decay.assign(b.size(), 0.0);
  for (std::vector<double>& rate : masses.mode_damping)
    rate.assign(b.mode_places() == 0 ? 0 : in_groups(b.size()), 0.0);
  parallel_for(b.size(), [&](std::size_t i) {
    masses.viscosity[i] = eta(i);
    masses.decay[i] = damping.mass_damping(b.rayleigh[i]);
    if (b.mode_places() == 0 || b.is_meshed(i)) return;
    const std::array<double, bendings + 1> along = stiffness_along(b.bending, b.modes(i), i);
    for (std::size_t k = 0; k <= bendings; ++k) {
      const double square = std::max(along[k], 0.0) * masses.mode_inverse[i];
      masses.mode_damping[k][i] =
          rayleigh(i) ? rayleigh(i)->stiffness() * square : 2.0 * b.damping[i] * std::sqrt(square);
    }
  });
  const auto absent = [](double value) { return value == 0.0; };
  if (std::all_of(masses.viscosity.begin(), masses.viscosity.end(), absent)) {
    masses.viscosity.clear();
    for (std::vector<double>& rate : masses.mode_damping) rate.clear();
  }
  const double all = damping.mass_damping();
  if (std::all_of(masses.decay.begin(), masses.decay.end(), [&](double a) { return a == all; }))
    masses.decay.clear();
}

}  // namespace edda
