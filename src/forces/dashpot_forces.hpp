// Forces of the dashpots of viscous boundaries, centred in the step (theory, section 13.5).
#pragma once

#include <vector>

#include "attachments/dashpots.hpp"
#include "blocks/masses.hpp"
#include "forces/nodal_forces.hpp"

namespace edda {

/// Blocks, and the velocities on which the dashpots act.
struct DashpotScene {
  const BlockSet& blocks;
  const Masses& masses;
  const State& state;
  const BodyVectors& velocity;  ///< v_{n-1/2}, m/s
};

/// Data of a step for the dashpots.
struct DashpotStep {
  double h;                            ///< mean of the last and the next step, s
  double half_damping;                 ///< a h/2, a the coefficient of mass-proportional damping
  const std::vector<double>* damping;  ///< [nb] a of each block, 1/s, instead; null: all alike
  const std::vector<Vec2>& reference;  ///< [points] r_n, velocity of the ground, m/s
  const std::vector<Vec2>& push;       ///< [points] additional forces, N; empty: none
  double half_damping_of(std::size_t i) const {
    return damping == nullptr ? half_damping : 0.5 * h * (*damping)[i];
  }
};

/// Adds the forces f = -C ((v_{n-1/2} + v_{n+1/2})/2 - r_n) + push of the dashpots on the blocks
/// [begin, end) to their nodal forces. v_{n+1/2} results from these forces, so for each block this
/// is solved:
/// ((1 + a h/2) M + h C/2 + h D) v+ = ((1 - a h/2) M - h C/2) v- + h (f + C r), with D of the
/// strain damping, whose force is left to advance(). The dashpots thus dissipate in every step,
/// whatever its length, and the critical step is what it is without them. on_point: [points] N,
/// filled. Blocks that are meshed are left out.
void add_dashpots(BodyVectors& forces, std::vector<Vec2>& on_point, const Dashpots& dashpots,
                  const DashpotScene& scene, const DashpotStep& step, std::size_t begin,
                  std::size_t end);

/// The same of the meshed blocks, before their modes advance. The mass of a mesh is diagonal but
/// for its affine part, M^-1 = M_L^-1 + P Q P^T with Q = I^-1 - G^-1 (blocks/meshes.hpp), and C is
/// diagonal, so that six equations remain for all nodes (Woodbury): with u the mean velocity, f the
/// force of the dashpots without r and push and h' = h/(1 + a h/2),
///   u_j = A_j^-1 (u*_j + h' P_j.z/2), A_j = 1 + h' C_j/(2 m_j),  (1 + h' Q S/2) z = Q P^T f(z =
///   0), S = sum_j P_j C_j A_j^-1 P_j^T.
/// yet_on_nodes: forces that the three nodes have not got yet, the modes have; null: none.
void add_mesh_dashpots(BodyVectors& forces, std::vector<Vec2>& on_point, const Dashpots& dashpots,
                       const DashpotScene& scene, const DashpotStep& step,
                       const BodyVectors* yet_on_nodes, std::size_t begin, std::size_t end);

/// Subtracts the forces on_point from those on the blocks.
void remove_dashpots(BodyVectors& forces, const std::vector<Vec2>& on_point,
                     const Dashpots& dashpots, const BlockSet& blocks);

}  // namespace edda
