// One step of traditional DDA: Newmark with beta = 1/2, gamma = 1 (Eqs. 7-12), the global equations
// solved again while contacts open, close, stick and slide (open-close iteration), the step cut
// where that does not end. method.md section 6; docs/method-notes.md says what was made better.
#pragma once

#include <optional>
#include <vector>

#include "attachments/boundary_springs.hpp"
#include "forces/nodal_forces.hpp"
#include "implicit/block_matrix.hpp"
#include "implicit/face_springs.hpp"
#include "implicit/linear_solver.hpp"

namespace edda {

/// What a step acts on and never changes.
struct ImplicitScene {
  const BlockSet& blocks;
  const LawTable& laws;
  const BoundarySprings& springs;
  Vec2 gravity;
  LoadsNow loads = {};  ///< at the end of the step
};

struct ImplicitSettings {
  double step = 0.0;                ///< h, s
  bool dynamic = true;              ///< false: velocities are dropped at the start of each step
  double mass_damping = 0.0;        ///< a of C = a M, 1/s
  double contact_damping = 0.0;     ///< zeta
  double displacement_limit = 0.0;  ///< m, of any vertex in one step
  double balance = 1e-3;  ///< of the forces, that the last round may leave; of those on one block
                          ///< ten times that
};

/// How an attempt at a step ended.
enum class Attempt {
  accepted,
  unsettled,   ///< no agreement of forces and contacts after the last round
  too_far,     ///< a vertex moved further than displacement_limit
  no_solution  ///< the equations have none: numbers out of range
};

/// Everything that lives from step to step.
struct ImplicitSolver {
  BlockMatrix matrix;  ///< K^ of Eq. 11
  LinearSolver linear;
  FaceSprings springs;
  std::vector<Id> row_of;                        ///< [nb] row of a free block, or no_id
  std::vector<Id> block_of;                      ///< [rows]
  std::vector<Matrix6> elastic, mass;            ///< [nb] in the block's own frame
  std::uint64_t pattern_of = ~std::uint64_t{0};  ///< rebuild of the list of faces it was made for
  Nodes start_x, start_y;                        ///< [3][nb] positions at its start, m
  Nodes drift_x, drift_y;            ///< [3][nb] mean velocity over the step before, m/s
  FaceSet faces_before;              ///< to go back to where the step is cut
  Eigen::VectorXd moved;             ///< [6 rows] displacement of the step D, m
  Eigen::VectorXd residual;          ///< [6 rows] what is out of balance, N
  Eigen::VectorXd base, correction;  ///< [6 rows] D of the round before, and what it adds
  std::vector<double> stiffest;      ///< [rows] largest stiffness on the diagonal, N/m
  std::vector<double> carried;       ///< [rows] scratch of measure_residual(), N
  std::vector<double> error;         ///< [rows] scratch of measure_residual()
  std::vector<double> energy;        ///< [nb] strain at the start of the step, J
  int rounds = 0;                    ///< solves of the last attempt
  std::uint64_t switched = 0;        ///< changes of states of faces in it
  double last_displacement = 0.0;    ///< m: largest of a vertex
};

/// Tries one step of `settings.step` s. Accepted: positions, velocities (of the same instant), pose
/// (x1, y1 the positions before), contacts and damping work are those of its end. Otherwise they
/// are, bit for bit, what they were; `forces` are those of the last trial position.
Attempt newmark_step(ImplicitSolver& solver, const ImplicitScene& scene,
                     const ImplicitSettings& settings, State& state, Pose& pose, FaceSet& contacts,
                     NodalForces& forces, std::vector<double>& damping_work);

}  // namespace edda
