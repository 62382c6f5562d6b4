// One step of traditional DDA: Newmark with beta = 1/2, gamma = 1 (Eqs. 7-12). The global equations
// are solved repeatedly while contacts open, close, stick and slide (open-close iteration), and the
// step is halved where that does not converge. Theory, section 12 (12.1 equations, 12.2 open-close
// iteration, 12.5 step, 12.6 angular momentum); docs/dev/design-history.md, section 12, has the
// differences to the paper.
#pragma once

#include <optional>
#include <vector>

#include "attachments/boundary_springs.hpp"
#include "forces/nodal_forces.hpp"
#include "implicit/block_matrix.hpp"
#include "implicit/face_springs.hpp"
#include "implicit/linear_solver.hpp"

namespace edda {

/// What a step uses and does not change.
struct ImplicitScene {
  const BlockSet& blocks;
  const Masses& masses;
  const LawTable& laws;
  const BoundarySprings& springs;
  Vec2 gravity;
  LoadsNow loads = {};                   ///< at the end of the step
  const ModeVectors& locked = no_modes;  ///< forces on modes that balance the initial stress
                                         ///< (forces/bending_forces.hpp); empty by default
  static inline const ModeVectors no_modes;

  FaceScene faces(const Pose& pose) const { return {blocks, masses, pose, laws}; }
};

struct ImplicitSettings {
  double step = 0.0;    ///< h, s
  bool dynamic = true;  ///< false: static analysis, velocities are dropped at the start of each
                        ///< step
  Damping damping;
  double contact_damping = 0.0;     ///< zeta
  double displacement_limit = 0.0;  ///< m, of any vertex in one step
  double balance = 1e-3;  ///< residual, as a part of the forces, after the last iteration; ten
                          ///< times that for a single block
  /// a of C = a M of block i, 1/s.
  double mass_damping(const Masses& masses, std::size_t i) const {
    return mass_damping_of(masses, damping, i);
  }
};

/// Result of an attempt at a step.
enum class Attempt {
  accepted,
  not_converged,  ///< forces and contact states do not agree after the last iteration
  too_far,        ///< a vertex moved further than displacement_limit
  no_solution     ///< the equations cannot be solved: values out of range
};

/// All data that are kept from step to step.
struct ImplicitSolver {
  BlockMatrix matrix;  ///< K^ of Eq. 11
  LinearSolver linear;
  FaceSprings springs;
  std::vector<Id> row_of;                        ///< [nb] row of a free block, or no_id
  std::vector<Id> block_of;                      ///< [rows] block
  std::vector<BodyMatrix> elastic;               ///< [nb] in the block's own frame, N/m
  std::vector<BodyMass> mass;                    ///< [nb]
  std::uint64_t pattern_of = ~std::uint64_t{0};  ///< FaceSet::rebuilds of the list of faces that
                                                 ///< the pattern is for
  BodyVectors start;                             ///< positions at the start of the step, m
  BodyVectors mean_velocity;                     ///< in the last step, m/s
  // [matrix.lines()] each:
  Eigen::VectorXd moved;             ///< displacement of the step D, m
  Eigen::VectorXd residual;          ///< N
  Eigen::VectorXd base, correction;  ///< D of the last iteration, and its increment, m
  std::vector<double> stiffest;      ///< [rows] largest stiffness on the diagonal, N/m
  std::vector<double> carried;       ///< [rows] working array of measure_residual(), N
  std::vector<double> error;         ///< [rows] working array of measure_residual()
  std::vector<double> energy;        ///< [nb] stored_energy() at the start of the step, J
  std::vector<double> by_faces;      ///< [nb] sizes of the forces of the faces on it, N
  BodyVectors on_faces;              ///< forces of the faces in the last iteration, N
  int iterations = 0;                ///< iterations of the last attempt
  std::uint64_t switched = 0;        ///< changes of contact states in it
  double last_displacement = 0.0;    ///< m: largest displacement of a vertex
};

/// Tries one step of `settings.step` s. If accepted, positions, velocities (of the same instant),
/// pose (x1, y1 the positions before), contacts and damping work are those of its end. Otherwise
/// they are unchanged, bit for bit; `forces` are those of the last trial position.
Attempt newmark_step(ImplicitSolver& solver, const ImplicitScene& scene,
                     const ImplicitSettings& settings, State& state, Pose& pose,
                     const TrialFaces& contacts, BodyVectors& forces,
                     std::vector<double>& damping_work);

}  // namespace edda
