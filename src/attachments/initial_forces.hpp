// Forces of the initial stress on faces of blocks, and the boundaries that carry them.
#pragma once

#include "attachments/edges_on_line.hpp"
#include "attachments/loads.hpp"
#include "blocks/initial_stress.hpp"

namespace edda {

/// What holds a face at the start, over parts of it.
class FaceForces {
 public:
  /// The water of `loads` at t = 0 bears its share of the stress, which is total.
  FaceForces(const BlockSet& blocks, const StressField& field, const LoadsNow& at_start);

  /// On the part of face `edge`: sigma n, linear between its ends, without the pressure of water on
  /// it.
  EndForces on(Id edge, Part part) const;

 private:
  const BlockSet& b_;
  const StressField& field_;
  const LoadsNow& now_;
};

/// What the boundaries that act at the start hold of the initial stress on the open faces along
/// them: those with springs and dashpots, across the line and along it (a roller too), keep it up
/// as forces on the vertices. No face is held twice: springs go first, then tractions.
std::vector<KeptForce> held_initial_stress(const Model& model, const BlockSet& blocks,
                                           const Spells& spells, const FaceForces& faces);

/// Boundaries of type stress that name no traction have that of the initial stress.
void load_initial_stress(Loads& loads, const Model& model, const BlockSet& blocks,
                         const FaceForces& faces);

}  // namespace edda
