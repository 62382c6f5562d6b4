// Matrices of one block in its degrees of freedom, dense and small: of its nodes (u1 v1 u2 v2 ...),
// and of the whole body, which are those of its nodes and then those of its modes (theory, section
// 3.4).
#pragma once

#include <Eigen/Dense>

#include "attachments/boundary_springs.hpp"
#include "blocks/kinematics.hpp"
#include "blocks/masses.hpp"

namespace edda {

using NodalMatrix = Eigen::Matrix<double, degrees_of_freedom, degrees_of_freedom>;
using NodalVector = Eigen::Matrix<double, degrees_of_freedom, 1>;
using StrainMatrix = Eigen::Matrix<double, 3, degrees_of_freedom>;
using BodyMatrix = Eigen::MatrixXd;
/// The components of a BodyVector.
using BodyColumn = Eigen::Matrix<double, Eigen::Dynamic, 1, Eigen::ColMajor,
                                 degrees_of_freedom + 2 * most_modes, 1>;

/// Row of u_k in these; that of v_k is the next.
inline Eigen::Index row_of_node(std::size_t k) {
  return static_cast<Eigen::Index>(2 * k);
}

/// (u1 v1 u2 v2 ...)
inline NodalVector nodal(const NodeVectors& u) {
  NodalVector v;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    v[row_of_node(k)] = u[k].x;
    v[row_of_node(k) + 1] = u[k].y;
  }
  return v;
}
inline NodalVector nodal(const BodyVectors& u, std::size_t i) {
  return nodal(vectors_of(u, i));
}
inline NodeVectors vectors_of(const NodalVector& u) {
  NodeVectors v;
  for (std::size_t k = 0; k < nodes_per_block; ++k) {
    v[k] = {u[row_of_node(k)], u[row_of_node(k) + 1]};
  }
  return v;
}

/// The number of components of block i: of its nodes and modes.
inline Eigen::Index components_of(const BlockSet& b, std::size_t i) {
  return static_cast<Eigen::Index>(degrees_of_freedom + 2 * b.bending.modes_of(i));
}
BodyColumn column_of(const BlockSet& blocks, const BodyVectors& u, std::size_t i);
void store(const BodyColumn& c, const BlockSet& blocks, BodyVectors& u, std::size_t i);

/// Nodal forces of a unit force along `direction` at the material point of weights w.
NodalVector along(const NodeWeights& w, Vec2 direction);
/// Forces on the body of a force at its corner v.
BodyColumn at_corner(const BlockSet& blocks, Id v, Vec2 force);

/// Adds c, a matrix at the material point of weights w, to that of the block: w w^T (x) c.
void add_at(NodalMatrix& m, const NodeWeights& w, const Eigen::Matrix2d& c);

/// B: strains xx, yy and twice xy per displacement of the nodes, undeformed block, 1/m.
StrainMatrix strain_matrix(const BlockSet& blocks, std::size_t i);

/// C: elasticity matrix of the block's rock, Pa.
Eigen::Matrix3d stiffness_of_rock(const BlockSet& blocks, std::size_t i);

/// Elastic stiffness of the undeformed block, V B^T C B, in its own frame, N/m.
NodalMatrix elastic_matrix(const BlockSet& blocks, std::size_t i);

/// Viscous matrix D = eta V B^T C B of the undeformed block, in its own frame, N s/m.
NodalMatrix viscous_matrix(const BlockSet& blocks, const Masses& masses, std::size_t i);
/// The same at the deformation f, dU/dt = B v (blocks/strain_rate.hpp).
NodalMatrix viscous_matrix(const BlockSet& blocks, const Masses& masses, std::size_t i,
                           const Deformation& f);

/// Mass (Eq. 23; lumped except for `consistent`), kg. The same in every frame.
NodalMatrix mass_matrix(const Masses& masses, std::size_t i);

/// Stiffness of the boundary springs on the block, N/m, in the block's frame, whose rotation is r.
NodalMatrix boundary_matrix(const BlockSet& blocks, const BoundarySprings& springs,
                            const Rotation& r, std::size_t i);

/// Of the body.
BodyMatrix boundary_of_body(const BlockSet& blocks, const BoundarySprings& springs,
                            const Rotation& r, std::size_t i);

/// Stiffness of the modes of a block in its own frame, N/m, and their strain damping, N s/m.
BodyMatrix stiffness_of_modes(const BlockSet& blocks, std::size_t i);
BodyMatrix viscosity_of_modes(const BlockSet& blocks, const Masses& masses, std::size_t i);

/// A matrix of the body from those of its nodes and of its modes.
BodyMatrix of_body(const NodalMatrix& nodes, const BodyMatrix& modes);

/// The mass of a body.
struct BodyMass {
  NodalMatrix nodes;
  double mode = 0.0;  ///< of each mode, kg
  void add_to(BodyMatrix& k, double factor) const;
};
BodyColumn operator*(const BodyMass& mass, const BodyColumn& u);
BodyMass body_mass(const BlockSet& blocks, const Masses& masses, std::size_t i);

/// A matrix of the block's own frame in space: Q K Q^T with Q = diag(R, R, ...).
template <class Matrix>
Matrix rotated(const Matrix& k, const Rotation& r) {
  Eigen::Matrix2d q;
  q << r.c, -r.s, r.s, r.c;
  Matrix out(k.rows(), k.cols());
  for (Eigen::Index row = 0; row < k.rows(); row += 2) {
    for (Eigen::Index column = 0; column < k.cols(); column += 2) {
      const Eigen::Matrix2d part = k.template block<2, 2>(row, column);
      out.template block<2, 2>(row, column) = q * part * q.transpose();
    }
  }
  return out;
}

}  // namespace edda
