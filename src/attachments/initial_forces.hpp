// Forces of the initial stress on faces of blocks, and the boundaries that carry them.
#pragma once

#include "attachments/boundary_springs.hpp"
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

/// Springs take over the force of the initial stress on the open faces along their boundary. Across
/// the line and along it: along a roller it stays as it is.
void hold_initial_stress(BoundarySprings& springs, const Model& model, const BlockSet& blocks,
                         const FaceForces& faces);

/// Boundaries of type viscous, and those of type stress that name no traction, keep it up as a load of
/// constant direction on the vertices of those faces.
void load_initial_stress(Loads& loads, const Model& model, const BlockSet& blocks,
                         const FaceForces& faces);

}  // namespace edda
