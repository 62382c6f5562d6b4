// The critical step of a meshed block (theory, section 7.2).
//
// For every motion v of the mesh nodes, v.K v <= sum_j v_j.(w_j^2 m_j + k_j) v_j: of each pair of
// zones K is at most the square of its own highest frequency times its lumped mass, w_j^2 is the
// largest of those around node j, and k_j are the springs at it. A spring of a bolt at a point with
// the weights a_j in a zone counts k |a_j| sum_l |a_l| at each of its corners (Cauchy and Schwarz).
// So
//   omega_max^2 <= kappa max_j (w_j^2 + k_j/m_j),   kappa = max(1, lambda_max(I^-1 G)),
// kappa for the mass matrix whose affine part is exact (blocks/meshes.hpp).
#pragma once

#include "forces/block_equations.hpp"

namespace edda {

struct MeshBound {
  double square = 0.0;    ///< omega_max^2, 1/s2
  double dashpots = 0.0;  ///< largest of the dashpots and the viscosity of zones at a node,
                          ///< c_j/m_j + eta w_j^2, 1/s
  Id contact = no_id;     ///< the stiffest face at that node
  double of_contacts = 0.0, of_boundaries = 0.0, of_bolts = 0.0;  ///< parts of `square`
};
MeshBound mesh_bound(const StiffnessInputs& inputs, std::size_t i);

}  // namespace edda
