// Forces of the initial stress on faces of blocks, and the boundaries that carry them (theory,
// sections 3.3 and 13.4).
#pragma once

#include "attachments/edges_on_line.hpp"
#include "attachments/loads.hpp"
#include "blocks/initial_stress.hpp"

namespace edda {

/// Support forces of faces in the initial stress, over parts of them.
class FaceForces {
 public:
  /// The stress is total; the water of `loads` at t = 0 carries its share of it.
  FaceForces(const BlockSet& blocks, const StressField& field, const LoadsNow& at_start);

  /// Forces on the part of face `edge`: sigma n, linear between its ends, less the water pressure
  /// on it.
  EndForces on(Id edge, Part part) const;

 private:
  const BlockSet& b_;
  const StressField& field_;
  const LoadsNow& now_;
};

/// Support of the open faces along the boundaries that are active at the start: boundaries with
/// springs and dashpots carry the initial stress as forces on the vertices, normal and tangential
/// (a roller, too). No face is supported twice: springs come first, then tractions.
std::vector<WallForce> supported_initial_stress(const Model& model, const BlockSet& blocks,
                                                const ActiveIntervals& intervals,
                                                const FaceForces& faces);

/// Forces of the initial stress on the walls of the openings that are there from the start, of
/// the rock that was in them.
std::vector<WallForce> initial_wall_forces(const Model& model, const BlockSet& blocks,
                                           const FaceForces& faces);

/// Gives boundaries of type stress without a traction that of the initial stress.
void load_initial_stress(Loads& loads, const Model& model, const BlockSet& blocks,
                         const FaceForces& faces);

/// Forces on the modes of blocks that bend, of the total initial stress on all of their faces, N.
/// As the initial stress of the block does for the nodes, forces locked in the modes balance them,
/// so that ground in its initial stress does not bend.
ModeVectors initial_mode_forces(const BlockSet& blocks, const StressField& field);

}  // namespace edda
