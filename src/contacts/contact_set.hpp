// Contacts: every vertex near an edge of another block ("candidate"), whether it touches or not,
// and the memory of those that do. Structure of arrays, [nc] each, sorted by (vertex, edge).
// Notation of method.md section 4: vertex A = P1 of block i, edge e = P2P3 of block j, unit tangent
// t, outward normal n, penetration d = -(P1 - P2).n, foot z = (P1 - P2).t = xi l.
#pragma once

#include <algorithm>
#include <cstdint>
#include <vector>

#include "blocks/block_set.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// Bits of ContactSet::state.
namespace contact_state {
inline constexpr std::uint8_t closed = 1;    ///< carries force
inline constexpr std::uint8_t bonded = 2;    ///< has its peak strength: its shear is not cut
inline constexpr std::uint8_t sliding = 4;   ///< shear was cut at the last step
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

/// Contacts closed at the start between one pair of edges, which break together.
struct Segment {
  std::vector<Id> members;  ///< candidates
};

/// Why a penetrated candidate carries nothing.
enum class Blocked : std::uint8_t { no, conflict, shield, depth, facing };

struct ContactSet {
  std::size_t size() const { return vertex.size(); }

  // Identity. Filled by rebuild_candidates(); fixed between two searches.
  std::vector<Id> vertex, edge, edge_end;  ///< A, P2, P3
  std::vector<Id> block_i, block_j;        ///< of the vertex, of the edge
  std::vector<std::uint16_t> law;          ///< row of the LawTable
  std::vector<double> extend_start,
      extend_end;  ///< m the edge is taken to run on at reentrant ends

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
  static constexpr std::size_t chunk = 256;
  std::vector<std::uint8_t>
      stirs;  ///< [chunks] 1: a contact in it may switch, open, close or leave its edge
  std::vector<double>
      deepest;  ///< [chunks] largest effective penetration of a closed contact at n - 1, m
  void stir(std::size_t c) { stirs[c / chunk] = 1; }

  // Memory. Filled by the transitions.
  std::vector<std::uint8_t> state;  ///< contact_state bits
  std::vector<double> rest;         ///< d0, m; +infinity while blocked
  std::vector<double> anchor;       ///< xi0
  std::vector<double> kn,
      ks;  ///< p_n, p_t, N/m, frozen when it closes (before: what they would be)
  std::vector<double> length;    ///< L it stands for, m; 0 for a lone corner
  std::vector<double> friction;  ///< tan(phi) in force
  std::vector<double> cohesion;  ///< c L in force, N
  std::vector<double> tension;   ///< sigma_t L in force, N; of those that pull
  std::vector<double> alpha;     ///< part of the last force that the open-close iteration kept
  std::vector<double> normal;    ///< N at n - 1 of the whole spring (before share and alpha), N
  std::vector<double> shear, shear_1;  ///< T at n - 1 and n - 2 of the whole spring, N
  std::vector<double> slip_trial;      ///< s before the return map at n - 1, m
  std::vector<double> dashpot;         ///< viscous part of N at n - 1, N
  std::vector<double> friction_work, damping_work, fracture_work;  ///< dissipated so far, J

  // Forces of the last evaluation, N: on the vertex and on P2; on P3 acts minus their sum.
  std::vector<double> fx, fy, gx, gy;

  std::vector<Blocked> why;                      ///< why it is blocked
  std::vector<Id> blocked;                       ///< the blocked candidates, ascending
  std::vector<CornerPair> pairs;                 ///< sorted by (first, second)
  std::vector<Id> paired;                        ///< candidates in any pair, ascending
  std::vector<Id> pair_of;                       ///< [nc] a pair the candidate is in, or no_id
  std::vector<double> next_before, next_beyond;  ///< scratch of update_shares()
  std::vector<double> next_share;                ///< scratch of update_shares()
  std::vector<std::uint8_t>
      balanced;                     ///< scratch of update_shares(): its partner takes what it gives
  std::vector<Segment> segments;    ///< the bonded ones
  std::vector<Id> begin_of_vertex;  ///< [nv + 1] candidates of a vertex

  // Contacts of a block, in the order of (partner, vertex, edge): entry = 2 candidate + side, side
  // 0 where the block has the vertex, 1 where it has the edge.
  std::vector<Id> block_begin;  ///< [nb + 1]
  std::vector<Id> block_entry;

  // When the list was made, and how long it lives.
  std::vector<double> built_x, built_y;  ///< [nv] vertices then, m
  double noise = 0.0;                    ///< m: gaps this small are rounding of the coordinates
  double reach = 0.0;          ///< m: every vertex nearer than this to an edge is in the list
  double travel = 0.0;         ///< m: bound of what any vertex has moved since
  std::uint64_t built_at = 0;  ///< step
  std::uint64_t rebuilds = 0;

  double retired_friction = 0.0, retired_damping = 0.0,
         retired_fracture = 0.0;  ///< J, of candidates let go

  /// Effective penetration d - d0 at n and n - 1.
  double effective(std::size_t c) const { return depth[c] - rest[c]; }
  double effective_1(std::size_t c) const { return depth_1[c] - rest[c]; }
  double effective_2(std::size_t c) const { return depth_2[c] - rest[c]; }
  /// Coulomb's limit of the shear force under a normal force N, c L + tan(phi) max(N, 0).
  double shear_limit(std::size_t c, double n) const {
    return cohesion[c] + friction[c] * std::max(n, 0.0);
  }
  bool is(std::size_t c, std::uint8_t bits) const { return (state[c] & bits) != 0; }
  void set(std::size_t c, std::uint8_t bits) {
    state[c] = static_cast<std::uint8_t>(state[c] | bits);
  }
  void clear(std::size_t c, std::uint8_t bits) {
    state[c] = static_cast<std::uint8_t>(state[c] & ~bits);
  }
  /// Foot within the stretch of the edge that carries.
  bool on_edge(std::size_t c, double slack = 0.0) const {
    return foot[c] >= -(before[c] + slack) && foot[c] <= span[c] + beyond[c] + slack;
  }
};

}  // namespace edda
