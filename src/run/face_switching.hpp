// Open-close iteration of faces: corrects the step just made where ends of faces opened or closed
// in it, so that what a face does to the blocks is what it stores less (docs/contacts.md).
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/place_faces.hpp"
#include "run/push_block.hpp"

namespace edda {

struct OpenCloseCounts {
  std::uint64_t steps = 0;      ///< with at least one pass
  std::uint64_t passes = 0;     ///< over all steps
  std::uint64_t most = 0;       ///< passes in one step
  std::uint64_t switched = 0;   ///< faces of which an end opened or closed
  std::uint64_t unsettled = 0;  ///< steps that had not settled after the last pass
  std::vector<Id> of_face;      ///< [nf] those of each, since the list of faces was made
  std::uint64_t of_list = 0;    ///< FaceSet::rebuilds
};

/// A face of which an end opened or closed in the last two steps.
struct SwitchingFace {
  Id face;
  FacePoints then, at;  ///< corners at n - 1 and n
  Face placed;          ///< at n
  CornerForces force;   ///< of it at n, as it is now
  double stored;        ///< U_{n-1/2}, J
  double stored_next;   ///< U_{n+1/2}, J
  bool was_closed;      ///< at n - 1
  double pushes;        ///< work of the normal force on what it moves in a step, J
  double alpha;         ///< part of the normal force that acts
  std::uint64_t seen;   ///< tick at which it was last corrected
  bool done;            ///< it changed by next to nothing then
};

/// Lists of one step, kept so that a step allocates nothing once they have grown.
struct FaceSwitchingScratch {
  std::vector<SwitchingFace> set;
  std::vector<Id> pushed;            ///< blocks that have moved since the faces were looked at
  std::vector<std::uint64_t> moved;  ///< [nb] tick at which a face last moved the block
  std::uint64_t tick = 0;
  Vec2 on_held;  ///< N: what the forces on blocks that are held have changed by
};

/// At entry: positions and faces of step n + 1, made with all of the forces of step n; at return
/// both are final, and `before` of the faces holds what acted at n.
void correct_switching(FaceSet& faces, const BlockSet& blocks, const LawTable& laws, State& state,
                       Pose& pose, const StepTaken& taken, OpenCloseCounts& counts,
                       FaceSwitchingScratch& scratch);

/// Largest closure of a face that acts, m.
double largest_closure(const FaceSet& faces);

}  // namespace edda
