// Contacts: every vertex near an edge of another block ("candidate"), whether it touches or not,
// and the memory of those that do. Structure of arrays, [nc] each, sorted by (vertex, edge).
// Notation of method.md section 4: vertex A = P1 of block i, edge e = P2P3 of block j, unit tangent
// t, outward normal n, penetration d = -(P1 - P2).n, foot z = (P1 - P2).t = xi l.
#pragma once

#include <algorithm>
#include <cstdint>
#include <limits>
#include <vector>

#include "base/vec2.hpp"
#include "base/vector_loop.hpp"
#include "blocks/block_set.hpp"
#include "contacts/face_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Bits of ContactSet::state.
namespace contact_state {
inline constexpr std::uint8_t closed = 1;  ///< carries force
inline constexpr std::uint8_t bonded = 2;  ///< has its peak strength: its shear is not cut
inline constexpr std::uint8_t sliding =
    4;  ///< shear was cut at the last round (dda; else see cut())
inline constexpr std::uint8_t slipped = 8;   ///< has slid at least once
inline constexpr std::uint8_t opened = 16;   ///< has opened after having been closed
inline constexpr std::uint8_t blocked = 32;  ///< penetrated but not allowed to carry (see Blocked)
inline constexpr std::uint8_t glued = 64;    ///< never opens or slides
inline constexpr std::uint8_t pulls = 128;   ///< has tensile strength: N may be negative
}  // namespace contact_state

/// Two candidates (A, e) and (B, f) at one pair of corners A and B whose edges lie against each
/// other; see contacts/shares.hpp for the weights they are given.
struct CornerPair {
  Id first = 0, second = 0;     ///< candidates, first < second
  bool first_at_start = true;   ///< B is the start (else the end) of e
  bool second_at_start = true;  ///< A is the start (else the end) of f
  double reach = 0.0;           ///< r_v, m
  /// The edges run the same way from the corner (one corner passes the other along a joint); else
  /// they run away from each other (corner against corner).
  bool same_way() const { return first_at_start != second_at_start; }
};

/// How corner pairs stood when their shares were last set; [pairs] each. For the loop that finds
/// those that have moved since.
struct PairMemory {
  std::vector<Id> first, second;              ///< candidates, as in CornerPair
  std::vector<double> first_end, second_end;  ///< 1 where the corner is the end of the edge, else 0
  std::vector<double> first_seen, second_seen;  ///< delta_A, delta_B, m; infinite before that
  std::vector<double> against;  ///< how far the edges lay against each other, 0 to 1
  std::vector<double> zone;     ///< m: within which they share
  /// The shares of pair p must be set again whatever its corners do.
  void forget(std::size_t p) { first_seen[p] = std::numeric_limits<double>::infinity(); }
};

/// What a candidate's share of its spring is about to be, and how far its edge carries then.
struct NextShare {
  double share, before, beyond;
  bool balanced;  ///< its partner takes what it gives
};

/// Candidates in several pairs, and their partners; what pairs they are in.
struct Tangle {
  std::vector<Id> candidate;        ///< ascending
  std::vector<Id> begin, pair;      ///< [candidates + 1] into the pairs of each, ascending
  std::vector<Id> place;            ///< [2 per pair that is not alone] where its candidates stand
  std::vector<std::uint8_t> stale;  ///< [candidates] scratch of update_shares()
};

/// A candidate whose edge has a reentrant end: how far the edge is taken to run on, m.
struct RunOn {
  Id candidate;
  double before, beyond;
};

/// Contacts closed at the start between one pair of edges, which break together.
struct Segment {
  std::vector<Id> members;  ///< candidates
};

/// Why a penetrated candidate carries nothing.
enum class Blocked : std::uint8_t { no, conflict, shield, depth, facing, outside };

/// What of its state decides the force of a contact, as a number for the loops over many of them: 0
/// where it is open; else 1, and 1 more where it is bonded, 2 more where it may pull, and a quarter
/// where it has slid before.
inline double hold_of(std::uint8_t state) {
  namespace cs = contact_state;
  if ((state & cs::closed) == 0) return 0.0;
  return 1.0 + ((state & cs::bonded) != 0 ? 1.0 : 0.0) + ((state & cs::pulls) != 0 ? 2.0 : 0.0) +
         ((state & cs::slipped) != 0 ? 0.25 : 0.0);
}
EDDA_INLINE bool carries(double hold) {
  return hold != 0.0;
}
EDDA_INLINE bool is_bonded(double hold) {
  return ((hold >= 2.0) & (hold < 3.0)) | (hold >= 4.0);
}
EDDA_INLINE bool may_pull(double hold) {
  return hold >= 3.0;
}
EDDA_INLINE bool has_slipped(double hold) {
  return (hold == 1.25) | (hold == 2.25) | (hold == 3.25) | (hold == 4.25);
}

/// What the arrays of a contact say together. Self: ContactSet or ContactView.
template <class Self>
struct ContactTerms {
  /// Effective penetration d - d0 at n, n - 1 and n - 2.
  [[gnu::always_inline]] double effective(std::size_t c) const {
    return self().depth[c] - self().rest[c];
  }
  [[gnu::always_inline]] double effective_1(std::size_t c) const {
    return self().depth_1[c] - self().rest[c];
  }
  [[gnu::always_inline]] double effective_2(std::size_t c) const {
    return self().depth_2[c] - self().rest[c];
  }
  /// Slip s at step n before the return map, m.
  [[gnu::always_inline]] double trial_slip(std::size_t c) const {
    return self().foot[c] - self().anchor[c] * self().span[c];
  }
  /// Coulomb's limit of the shear force under a normal force N, c L + tan(phi) N; none is below
  /// zero.
  [[gnu::always_inline]] double shear_limit(std::size_t c, double n) const {
    return larger(self().cohesion[c] + self().friction[c] * n, 0.0);
  }
  /// Foot within the stretch of the edge that carries.
  [[gnu::always_inline]] bool on_edge(std::size_t c, double slack = 0.0) const {
    const double foot = self().foot[c], from = -(self().before[c] + slack),
                 to = self().span[c] + self().beyond[c] + slack;
    return foot >= from && foot <= to;
  }
  /// Unit tangent of the edge.
  [[gnu::always_inline]] Vec2 tangent(std::size_t c) const { return {self().tx[c], self().ty[c]}; }

 private:
  [[gnu::always_inline]] const Self& self() const { return static_cast<const Self&>(*this); }
};

/// The arrays that the loops over all contacts of a step read and write (base/vector_loop.hpp);
/// what they mean stands in ContactSet.
struct ContactView : ContactTerms<ContactView> {
  const Id *vertex, *edge, *edge_end, *slot;
  double *depth, *depth_1, *depth_2, *foot, *span, *tx, *ty, *share, *before, *beyond, *hold, *rest,
      *anchor, *kn, *ks, *friction, *cohesion, *normal, *shear, *shear_1, *slip_trial,
      *friction_work, *force, *reaction, *drag;
  const double *zeta, *shear_zeta;
};

struct ContactSet : ContactTerms<ContactSet> {
  std::size_t size() const { return vertex.size(); }

  // Identity. Filled by rebuild_candidates(); fixed between two searches.
  std::vector<Id> vertex, edge, edge_end;  ///< A, P2, P3
  std::vector<Id> block_i, block_j;        ///< of the vertex, of the edge
  std::vector<std::uint16_t> law;          ///< row of the LawTable

  // Geometry. Filled by update_gaps() at every step.
  std::vector<double> depth, depth_1, depth_2;  ///< d at n, n - 1, n - 2, m
  std::vector<double> foot;                     ///< z at n, m
  std::vector<double> span;                     ///< length l of the edge at n, m
  std::vector<double> tx, ty;                   ///< its unit tangent t at n
  std::vector<double> share;  ///< w: part of the spring this candidate has, 0 to 1
  std::vector<double> before,
      beyond;  ///< m before the edge's start and beyond its end in which the foot still counts

  // Per chunk of `chunk` candidates, so that a step need not look where nothing happens. Filled by
  // update_gaps().
  static constexpr std::size_t chunk = 32;
  static constexpr std::size_t run = 16 * chunk;  ///< what a thread takes at once
  std::vector<std::uint8_t>
      stirs;  ///< [chunks] 1: a contact in it may switch, open, close or leave its edge
  std::vector<double>
      deepest;  ///< [chunks] largest effective penetration of a closed contact at n - 1, m
  std::vector<std::uint8_t>
      lingers;  ///< [chunks] 1: one without a partner may have a part of its share
  std::vector<std::uint8_t>
      cuts;  ///< [chunks] 1: the shear of one was cut at the last step, and slip_trial holds
  void stir(std::size_t c) { stirs[c / chunk] = 1; }
  std::size_t chunks() const { return (size() + chunk - 1) / chunk; }
  std::size_t chunk_end(std::size_t q) const { return std::min(size(), (q + 1) * chunk); }
  /// What only saves looking: whatever the contacts' memory is, slip_trial included, this fits it.
  void look_everywhere() {
    hold.resize(size());
    for (std::size_t c = 0; c < size(); ++c) hold[c] = hold_of(state[c]);
    reduced.clear();
    for (std::size_t c = 0; c < size(); ++c) {
      if (alpha[c] < 1.0) reduced.push_back(static_cast<Id>(c));
    }
    for (auto* flags : {&stirs, &lingers, &cuts}) flags->assign(chunks(), 1);
  }

  // Memory. Filled by the transitions.
  std::vector<std::uint8_t> state;  ///< contact_state bits; changed by set() and clear()
  std::vector<double> hold;         ///< hold_of(state)
  std::vector<double> rest;         ///< d0, m; +infinity while blocked
  std::vector<double> anchor;       ///< xi0
  std::vector<double> kn,
      ks;  ///< p_n, p_t, N/m; grow_springs() keeps them up (before it closes: what they would be)
  std::vector<double> length;    ///< L it stands for, m; 0 for a lone corner
  std::vector<double> friction;  ///< tan(phi) in force
  std::vector<double> cohesion;  ///< c L in force, N
  std::vector<double> tension;   ///< sigma_t L in force, N; of those that pull
  std::vector<double> alpha;     ///< part of the last force that the open-close iteration kept
  std::vector<Id> reduced;       ///< those whose alpha is below 1; may name one twice
  std::vector<double> normal;    ///< N at n - 1 of the whole spring (before share and alpha), N
  std::vector<double> shear, shear_1;  ///< T at n - 1 and n - 2 of the whole spring, N
  std::vector<double> slip_trial;  ///< s before the return map at n - 1, m; see slip_before_cut()
  // Dashpots of laws that have their own; empty where no law has.
  std::vector<double> zeta, shear_zeta;  ///< fractions of critical; zeta < 0: that of all contacts
  std::vector<double> drag;              ///< N along the tangent, of the shear dashpot at n
  std::vector<double> slid;  ///< slip so far, m; infinite: has its residual strength; empty where
                             ///< no law asks for it
  std::vector<double> owed;  ///< m that the joint has still to open by its dilation; as `slid`
  void take_slip_of(std::size_t c, std::size_t other) {
    if (slid.empty()) return;
    slid[c] = slid[other];
    owed[c] = owed[other];
  }
  std::vector<double> friction_work, damping_work, fracture_work;  ///< dissipated so far, J

  // Forces of the last evaluation, N.
  std::vector<double> force;     ///< [2 nc] x, y on P1
  std::vector<double> reaction;  ///< [4 nc] x, y on P2, x, y on P3; by slot

  std::vector<Blocked> why;  ///< why it is blocked
  std::vector<Id> blocked;   ///< the blocked candidates, ascending
  std::vector<CornerPair>
      pairs;                   ///< by (first, second): those that share no candidate, then others
  std::size_t lone_pairs = 0;  ///< how many share none
  PairMemory pair_memory;
  Tangle tangle;
  std::vector<double> pair_moved;         ///< scratch of update_shares()
  std::vector<std::uint8_t> pairs_moved;  ///< scratch of update_shares()
  std::vector<Id> pair_of;                ///< [nc] a pair the candidate is in, or no_id
  std::vector<RunOn> run_ons;             ///< edges with a reentrant end, by candidate
  std::vector<std::uint8_t> lent;         ///< [nc] of what a stage glues: its state before, of the
                                          ///< bits closed, bonded and pulls; else 0; empty while
                                          ///< nothing is glued
  std::vector<Segment> segments;          ///< the bonded ones
  std::vector<Id> begin_of_vertex;        ///< [nv + 1] candidates of a vertex

  // Slots: the candidates by (edge, vertex), so that a block finds in one place what acts on its
  // edges, as it does what acts on its vertices.
  std::vector<Id> begin_of_edge;  ///< [nv + 1] slots of an edge
  std::vector<Id> of_slot;        ///< [nc] its candidate
  std::vector<Id> slot;           ///< [nc] of a candidate

  FaceSet faces;          ///< of contact.model = "faces": in place of all the rest
  bool on_faces = false;  ///< contact.model

  // When the list was made, and how long it lives.
  std::vector<double> built_x, built_y;  ///< [nv] vertices then, m
  double noise = 0.0;                    ///< m: gaps this small are rounding of the coordinates
  double reach = 0.0;          ///< m: every vertex nearer than this to an edge is in the list
  double travel = 0.0;         ///< m: bound of what any vertex has moved since
  std::uint64_t built_at = 0;  ///< step
  std::uint64_t rebuilds = 0;

  std::uint64_t broken = 0;  ///< bonded contacts that have gone to their residual law so far
  double retired_friction = 0.0, retired_damping = 0.0,
         retired_fracture = 0.0;  ///< J, of candidates let go

  /// Calls visit(c, has_vertex) for the candidates of a block's vertices [first, end), then for
  /// those of its edges, each by (vertex, edge) or (edge, vertex).
  template <class Visit>
  void for_contacts(Id first, Id end, Visit visit) const {
    for (Id c = begin_of_vertex[first]; c < begin_of_vertex[end]; ++c) visit(c, true);
    for (Id q = begin_of_edge[first]; q < begin_of_edge[end]; ++q) visit(of_slot[q], false);
  }
  /// As above, for block i.
  template <class Visit>
  void for_contacts(const BlockSet& b, std::size_t i, Visit visit) const {
    for_contacts(b.vertex_begin[i], b.vertex_begin[i + 1], visit);
  }

  Vec2 on_vertex(std::size_t c) const { return {force[2 * c], force[2 * c + 1]}; }
  Vec2 on_start(std::size_t c) const {
    const std::size_t q = slot[c];
    return {reaction[4 * q], reaction[4 * q + 1]};
  }
  Vec2 on_end(std::size_t c) const {
    const std::size_t q = slot[c];
    return {reaction[4 * q + 2], reaction[4 * q + 3]};
  }

  double drag_of(std::size_t c) const { return drag.empty() ? 0.0 : drag[c]; }

  void set_alpha(std::size_t c, double value) {
    if (value < 1.0) reduced.push_back(static_cast<Id>(c));
    alpha[c] = value;
  }

  /// s of step n - 1 before its return map, m.
  double slip_before_cut(std::size_t c) const {
    return cuts[c / chunk] != 0 ? slip_trial[c] : -shear[c] / ks[c];
  }
  /// Fills slip_trial in the chunk of c.
  void keep_slips(std::size_t c) {
    const std::size_t q = c / chunk;
    if (cuts[q] != 0) return;
    for (std::size_t k = q * chunk; k < chunk_end(q); ++k) slip_trial[k] = slip_before_cut(k);
    cuts[q] = 1;
  }
  /// Takes its shear for one that has not been cut.
  void forget_cut(std::size_t c) {
    keep_slips(c);
    slip_trial[c] = -shear[c] / ks[c];
  }
  /// Whether its shear was cut at the last step.
  bool cut(std::size_t c) const {
    return is(c, contact_state::closed) && !is(c, contact_state::bonded) &&
           slip_before_cut(c) != -shear[c] / ks[c];
  }
  bool is(std::size_t c, std::uint8_t bits) const { return (state[c] & bits) != 0; }
  void set(std::size_t c, std::uint8_t bits) {
    state[c] = static_cast<std::uint8_t>(state[c] | bits);
    hold[c] = hold_of(state[c]);
  }
  void clear(std::size_t c, std::uint8_t bits) {
    state[c] = static_cast<std::uint8_t>(state[c] & ~bits);
    hold[c] = hold_of(state[c]);
  }
  ContactView view();
};

inline ContactView ContactSet::view() {
  ContactView v;
  v.vertex = vertex.data();
  v.edge = edge.data();
  v.edge_end = edge_end.data();
  v.depth = depth.data();
  v.depth_1 = depth_1.data();
  v.depth_2 = depth_2.data();
  v.foot = foot.data();
  v.span = span.data();
  v.tx = tx.data();
  v.ty = ty.data();
  v.share = share.data();
  v.before = before.data();
  v.beyond = beyond.data();
  v.hold = hold.data();
  v.rest = rest.data();
  v.anchor = anchor.data();
  v.kn = kn.data();
  v.ks = ks.data();
  v.friction = friction.data();
  v.cohesion = cohesion.data();
  v.normal = normal.data();
  v.shear = shear.data();
  v.shear_1 = shear_1.data();
  v.slip_trial = slip_trial.data();
  v.friction_work = friction_work.data();
  v.slot = slot.data();
  v.drag = drag.data();
  v.zeta = zeta.data();
  v.shear_zeta = shear_zeta.data();
  v.force = force.data();
  v.reaction = reaction.data();
  return v;
}

}  // namespace edda
