// Inertial masses of the blocks: as the model gives them, or raised by mass scaling. Weights do not
// change (BlockSet::mass). Theory, sections 2 and 8.
#pragma once

#include <array>
#include <vector>

#include "blocks/block_set.hpp"
#include "blocks/state.hpp"

namespace edda {

/// Filled by given_masses(); changed by scale_block_masses() and fill_viscosity().
struct Masses {
  MassKind kind = MassKind::matched;
  Nodes node;          ///< [nodes][nb] lumped m_k, kg (unused by `consistent`)
  Nodes node_inverse;  ///< [nodes][nb] 1/m_k, 1/kg; 0 without mass
  std::array<std::vector<double>, 6>
      inverse;  ///< [6][nb] M^-1, order 11 12 13 22 23 33, 1/kg; `consistent` only
  std::vector<double> point_inverse,
      edge_inverse;  ///< [nv] w_v^T M^-1 w_v and w_v^T M^-1 w_next, 1/kg; 0 where it is fixed
  std::vector<double> mode_inverse;  ///< [in_groups(nb)] 1/m of each mode, of a mesh one over the
                                     ///< mass of the block, 1/kg; 0 where it is fixed; empty where
                                     ///< no block has modes
  std::array<std::vector<double>, bendings + 1>
      mode_damping;  ///< [5][in_groups(nb)] 2 zeta w along each e_b, and of the other modes, 1/s;
                     ///< empty where none is damped
  std::vector<double> viscosity;  ///< [nb] eta: viscous stress over elastic stress rate, s; empty
                                  ///< where no block has any
  std::vector<double> decay;   ///< [nb] coefficient of mass-proportional damping, 1/s; empty: all
                               ///< have that of Damping::mass_damping()
  std::vector<double> raised;  ///< [nb] factor of mass scaling on the masses; empty: none is raised
};

/// Masses as the model gives them, without viscosity.
Masses given_masses(const BlockSet& blocks);

/// Fills node_inverse, point_inverse and edge_inverse. Call again whenever the masses of the nodes
/// change.
void fill_point_masses(Masses& masses, const BlockSet& blocks);

/// Coefficient of mass-proportional damping of block i, 1/s.
inline double mass_damping_of(const Masses& masses, const Damping& damping, std::size_t i) {
  return masses.decay.empty() ? damping.mass_damping() : masses.decay[i];
}

/// Masses::viscosity of block i, s.
inline double viscosity_of(const Masses& masses, std::size_t i) {
  return masses.viscosity.empty() ? 0.0 : masses.viscosity[i];
}

/// Inertial mass of block i as a whole, kg: more than that of its weight where inertia has been
/// raised. (For `consistent` from M^-1 for a uniform acceleration: the cover is centred on the
/// centroid.)
double inertia_of(const Masses& masses, std::size_t i);

/// Accelerations of the nodes of block i under nodal forces, m/s2: f_k/m_k, or M^{-1} f for
/// `consistent`.
inline NodeVectors accelerations(const Masses& masses, std::size_t i, const NodeVectors& f) {
  if (masses.kind != MassKind::consistent) {
    NodeVectors a;
    for (std::size_t k = 0; k < nodes_per_block; ++k) a[k] = f[k] / masses.node[k][i];
    return a;
  }
  const auto& m = masses.inverse;
  return {m[0][i] * f[0] + m[1][i] * f[1] + m[2][i] * f[2],
          m[1][i] * f[0] + m[3][i] * f[1] + m[4][i] * f[2],
          m[2][i] * f[0] + m[4][i] * f[1] + m[5][i] * f[2]};
}

/// u^T M v of block i.
double mass_product(const Masses& masses, std::size_t i, const NodeVectors& u,
                    const NodeVectors& v);

/// The same of all that block i is made of.
BodyVector accelerations(const Masses& masses, const BlockSet& blocks, std::size_t i,
                         const BodyVector& f);
double mass_product(const Masses& masses, const BlockSet& blocks, std::size_t i,
                    const BodyVector& u, const BodyVector& v);

/// Q p, Q = I^-1 - G^-1 of the mesh of block i (blocks/meshes.hpp): affine acceleration under
/// forces with the affine part p beside that of the lumped masses, for `x` and `y` per m of the
/// arm.
AffinePart beside_lumped(const Masses& masses, const BlockSet& blocks, std::size_t i,
                         const AffinePart& p);

/// Unbalanced forces: the resultant of those on a block, or on each node of its mesh (its inertia
/// force).
struct Unbalanced {
  double sum = 0.0;  ///< of their magnitudes, N
  std::size_t count = 0;
};
Unbalanced unbalanced_forces(const Masses& masses, const BlockSet& blocks,
                             const BodyVectors& forces, std::size_t i);

/// Kinetic energy of block i, J, with these velocities (m/s).
double kinetic_energy(const Masses& masses, const BlockSet& blocks, const BodyVectors& velocity,
                      std::size_t i);

/// w_v^T M^-1 w_u of two vertices of a block that is not fixed: acceleration of one by a unit force
/// on the other, 1/kg.
double inverse_product(const Masses& masses, const BlockSet& blocks, std::size_t v, std::size_t u);

/// Quadratic form of the inverse mass along an edge, 1/kg: w^T M^-1 w at its start, of both ends,
/// and at its end (Masses::point_inverse, edge_inverse).
struct EdgeInverseMass {
  double start = 0.0, both = 0.0, end = 0.0;
};
template <class PointMasses>
[[gnu::always_inline]] inline EdgeInverseMass inverse_mass_of_edge(const PointMasses& m,
                                                                   std::size_t e, std::size_t f) {
  return {m.point_inverse[e], m.edge_inverse[e], m.point_inverse[f]};
}
/// Inverse of the effective mass of a force on the edge at the fraction xi of its length, 1/kg: the
/// form for the weights (1 - xi) w_start + xi w_end.
[[gnu::always_inline]] inline double inverse_mass_at(const EdgeInverseMass& m, double xi) {
  const double rest = 1.0 - xi;
  return rest * rest * m.start + 2.0 * xi * rest * m.both + xi * xi * m.end;
}

}  // namespace edda
