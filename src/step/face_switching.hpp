// Energy-consistent contact activation: corrects the step just made where ends of faces opened or
// closed in it, so that the work of a face equals the decrease of its stored energy
// (theory, sections 6.2 and 6.3).
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_energy.hpp"
#include "contacts/tiled_faces.hpp"
#include "integrate/push_block.hpp"

namespace edda {

struct OpenCloseCounts {
  std::uint64_t steps = 0;          ///< steps with at least one pass
  std::uint64_t passes = 0;         ///< passes in all steps
  std::uint64_t most = 0;           ///< most passes in one step
  std::uint64_t switched = 0;       ///< faces of which an end opened or closed
  std::uint64_t not_converged = 0;  ///< steps without convergence in the last pass
  std::vector<Id> of_face;          ///< [nf] `switched` by face, since the list of faces was made
  std::uint64_t of_list = 0;        ///< FaceSet::rebuilds of that list
};

/// A face of which an end opened or closed in the last two steps.
struct SwitchingFace {
  Id face;
  FaceFields before;     ///< its state at n, with the present alpha
  FacePoints then, at;   ///< corners at n - 1 and n
  Face element;          ///< element at n
  Face risen;            ///< the same with the locked closure of n + 1, which dilation has raised
  double dilation_work;  ///< J, work of that dilation
  CornerForces force;    ///< its force at n with the present alpha, shear included
  double stored;         ///< U_{n-1/2}, J
  double stored_next;    ///< U_{n+1/2}, J
  bool was_closed;       ///< at n - 1
  double own_work;  ///< work of the whole normal force on the displacement it makes in the step, J
  double alpha;     ///< activation factor: part of the normal force that acts
  std::uint64_t corrected_at;  ///< SwitchingGroup::corrections when it was last corrected
  bool done;                   ///< it changed by less than the tolerance then
};

/// Faces that switch and share free blocks, directly or by others of the group.
struct SwitchingGroup {
  std::vector<Id> faces;          ///< by their places in FaceSwitchingScratch::set
  std::vector<Id> pushed;         ///< blocks that have moved
  double pushed_by = 0.0;         ///< m: no vertex was pushed farther
  Vec2 on_fixed;                  ///< N: change of the forces on fixed blocks
  std::uint64_t corrections = 0;  ///< running count over all steps; orders them
  std::uint64_t passes = 0;
  bool converged = false;

  /// Keeps the memory of its lists.
  void begin_anew(std::uint64_t corrections_so_far) {
    faces.clear();
    pushed.clear();
    pushed_by = 0.0;
    on_fixed = {};
    corrections = corrections_so_far;
    passes = 0;
    converged = false;
  }
};

/// Lists of one step, kept for their memory.
struct FaceSwitchingScratch {
  std::vector<SwitchingFace> set;
  std::vector<Id> known;               ///< the faces of the set, ascending
  std::vector<SwitchingGroup> groups;  ///< since the set was last divided
  std::vector<Id> evaluated;           ///< faces evaluated again since blocks were pushed
  std::vector<std::uint64_t>
      moved_at;  ///< [nb] SwitchingGroup::corrections when a face last moved the block
  std::vector<Id> first_face;  ///< [nb] working memory: no_id everywhere between uses
  std::uint64_t corrections = 0;
  double pushed_by = 0.0;  ///< m: no vertex was pushed farther in the last correction
  Vec2 on_fixed;           ///< N: change of the forces on fixed blocks
};

/// On entry: positions and faces of step n + 1, made with the whole forces of step n. On return
/// both are final, and the tiles remember of n the forces that acted. switching: the faces that may
/// switch, ascending.
void correct_switching(FaceSet& faces, FaceTiles& tiles, FacesInStep& in_step,
                       const StepTaken& taken, OpenCloseCounts& counts,
                       FaceSwitchingScratch& scratch, const std::vector<Id>& switching);

}  // namespace edda
