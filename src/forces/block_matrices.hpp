// Matrices of one block in its six degrees of freedom (u1 v1 u2 v2 u3 v3), dense and small.
#pragma once

#include <Eigen/Dense>
#include <array>

#include "attachments/boundary_springs.hpp"
#include "blocks/kinematics.hpp"

namespace edda {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Vector6 = Eigen::Matrix<double, 6, 1>;

/// What a unit force along `direction` at the material point of weights w does on the nodes.
Vector6 along(const std::array<double, 3>& w, Vec2 direction);

/// (u1 v1 u2 v2 u3 v3) of block i.
inline Vector6 nodal(const Nodes& x, const Nodes& y, std::size_t i) {
  Vector6 v;
  v << x[0][i], y[0][i], x[1][i], y[1][i], x[2][i], y[2][i];
  return v;
}

inline std::array<double, 3> vertex_weights(const BlockSet& b, Id v) {
  return {b.weight[0][v], b.weight[1][v], b.weight[2][v]};
}

/// B: rates of the strains xx, yy and twice xy of the undeformed block, 1/m.
Eigen::Matrix<double, 3, 6> strain_matrix(const BlockSet& blocks, std::size_t i);

/// C: stress per strain of its rock, Pa.
Eigen::Matrix3d stiffness_of_rock(const BlockSet& blocks, std::size_t i);

/// Elastic stiffness of the undeformed block, V B^T C B, in its own frame, N/m.
Matrix6 elastic_matrix(const BlockSet& blocks, std::size_t i);

/// D = eta V B^T C B of the block's viscosity, undeformed and in its own frame, N s/m.
Matrix6 viscous_matrix(const BlockSet& blocks, std::size_t i);
/// The same at the deformation f, dU/dt = B v (blocks/strain_rate.hpp).
Matrix6 viscous_matrix(const BlockSet& blocks, std::size_t i, const Deformation& f);

/// Mass (Eq. 23; lumped but for `consistent`), kg. The same in every frame.
Matrix6 mass_matrix(const BlockSet& blocks, std::size_t i);

/// Boundary springs on the block, N/m, seen from the frame in which `r` is no rotation.
Matrix6 boundary_matrix(const BlockSet& blocks, const BoundarySprings& springs, const Rotation& r,
                        std::size_t i);

/// A matrix of the block's own frame seen from outside: Q K Q^T with Q = diag(R, R, R).
Matrix6 turned(const Matrix6& k, const Rotation& r);

}  // namespace edda
