// The candidate list: made anew when a vertex may have crossed the skin, its memory carried over.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/contact_set.hpp"

namespace edda {

/// Corners nearer than this part of the shorter edge count as lined up (r_v, method.md section 4).
inline constexpr double corner_reach = 1e-3;
/// Edges whose normals satisfy n_f.n_e < -opposite lie against each other.
inline constexpr double opposite = 0.99;

/// Makes the list for all vertices nearer than `reach` to an edge: searches, carries over what is
/// remembered of candidates that stay (force, shear, bond, rest penetration), keeps every closed
/// one, pairs lined-up corners, and lists each block's contacts. New candidates take their gap a
/// step ago from pose.x1, y1.
void rebuild_candidates(ContactSet& contacts, const BlockSet& blocks, const State& state,
                        const Pose& pose, const LawTable& laws, double reach);

/// Fills begin_of_vertex and the slots.
void list_by_corner(ContactSet& contacts, std::size_t vertices);

/// Fills run_ons: at a reentrant corner the block goes on beyond the end of the edge, and so does,
/// by a twentieth of its length, the stretch that carries.
void list_run_ons(ContactSet& contacts, const BlockSet& blocks);

/// Closes what touches at the start: contacts whose gap is within 1e-6 of the smaller block's size
/// and whose law has cohesion, tension, glue or a peak friction above the residual are bonded, and
/// grouped into segments by their pair of edges. Those with tensile strength (or glue) pull, too.
/// Needs update_gaps().
void bond_contacts(ContactSet& contacts, const BlockSet& blocks, const State& state,
                   const Pose& pose, const LawTable& laws);

/// Length a contact of this vertex and edge stands for: half of what the edge shares with each of
/// the vertex's edges that lie against it, m; 0 for a lone corner.
double contact_length(const BlockSet& blocks, const Pose& pose, Id vertex, Id edge);

/// Of contact k, m: an edge that has only begun to overlap stands for a little at once (a hundredth
/// of the shortest edge), or it would carry nothing.
double carried_length(const ContactSet& contacts, const BlockSet& blocks, std::size_t k);

/// Of the smaller block at contact k, the root of its area, m.
double smaller_size(const ContactSet& contacts, const BlockSet& blocks, std::size_t k);

/// Takes the spring of the contact from its law and its present length (method.md section 4).
void set_spring(ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                const LawTable& laws, std::size_t c);

/// Sizes what belongs to laws that have dashpots of their own, and fills their fractions of
/// critical.
void set_dashpots(ContactSet& contacts, const LawTable& laws);

/// Springs go with their overlap, in leaps of a fiftieth, or of a tenth where a stiffer spring may
/// cost a new bound of the step. Where it grows the force does not jump (the rest penetration and
/// the anchor move, until settle_rests()), and what the stiffer spring stores less is booked as
/// dissipated; where it shrinks, what has gone takes its part of force and energy along. Only
/// contacts whose law gives stiffness or residual cohesion by length, and no bonds. True if any
/// became stiffer.
bool grow_springs(ContactSet& contacts, const BlockSet& blocks, const Pose& pose,
                  const LawTable& laws);

}  // namespace edda
