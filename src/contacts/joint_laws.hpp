// What the slip of a joint changes (theory, sections 5.4 to 5.7): its accumulated slip, by which
// its strength follows (contacts/strength.hpp), and its opening by dilation. Such faces are few,
// and the loops over all faces do not evaluate the laws: they read the friction and cohesion in
// force, which are updated here between two steps.
//
//  psi dilation angle; u accumulated slip, both directions added up (m)
//  dilation: a slip du opens the joint by tan(psi) |du|: the locked closure increases by that much,
//    and the energy that the normal spring gains is taken from what friction dissipates, which
//    becomes T |du| - N tan(psi) |du|. The opening r between n and n + 1 is that of the slip in the
//    same step: dilation is integrated implicitly, since with the slip of the step before N would
//    lag by a step, which is negative damping, and blocks hop. In the leapfrog's terms it takes r
//    (N_n + N_{n+1})/2 from friction, with N_{n+1} in the new position of the blocks: they give way
//    as the joint opens, and r may be many times their closure under the load.
#pragma once

#include "blocks/pose.hpp"
#include "contacts/face_set.hpp"
#include "contacts/face_states.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// A face at n: where `complete` is false only what it remembers, and what follows from its corners
/// (closures, normal forces, lengths) is found where a law asks for it.
struct FaceAtN {
  FaceFields state;
  bool complete;
};
/// Adds the slip of face k up to n, puts the resulting strength in force, and opens the joint, if
/// it dilates, by what the slip between n and n + 1 asks for. Requires pose.x1 at n and pose.x at
/// n + 1.
void update_joint_law(FaceSet& faces, const BlockSet& blocks, const Pose& pose,
                      const LawTable& laws, FaceAtN& at_n, std::size_t k);

}  // namespace edda
