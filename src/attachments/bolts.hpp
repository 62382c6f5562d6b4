// Rock bolts (theory, section 14): steel along a line through blocks, connected to them by grout,
// or at its ends.
//
// A bolt is a chain of nodes without mass. Node k sits in a block (its host) at the material point
// X_k + s_k a, with a the bolt's direction in the host at installation. Its only degree of freedom
// is s_k, the slip along the bolt. It is carried by three points j: the nodes of the block, or
// where that is meshed the corners of the zone that held the node at installation. With area
// coordinates w in them and their derivative d along a it lies at
//
//  x_k = sum_j (w_j + s_k d_j) x_j,      m_k = sum_j d_j x_j  (the bolt's direction there now).
//
// Bar k from node k to node k + 1 has the elongation e_k = t_k . (x_{k+1} - x_k) - L_k since
// installation, with t_k the direction of m_k + m_{k+1}, and carries N_k = EA/L_k (e_k - its
// plastic part). The bond carries K_k (s_k - its plastic part). The slips are those of equilibrium
// along the bolt,
//
//  (t_{k-1} . m_k) N_{k-1} - (t_k . m_k) N_k + K_k (s_k - ...) = 0,
//
// a tridiagonal system. Where two hosts meet, two nodes lie at one point, and a dowel acts across
// the bolt on delta = t x (h_{k+1} - h_k), with h the points X themselves. Where the dowel follows
// from the bar, that and bar k are one (attachments/dowel.hpp). An end-anchored bolt has two nodes
// that cannot slip and one bar along their distance, which pulls but does not push.
//
// All energies depend only on distances and on the hosts' own directions, so the forces, their
// gradients, conserve momentum and angular momentum.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "attachments/dowel.hpp"
#include "base/fault.hpp"
#include "blocks/kinematics.hpp"
#include "model/model.hpp"

namespace edda {

/// Data that are constant along a bolt. Forces and stiffnesses are those of one bolt times
/// thickness over spacing.
struct BoltData {
  std::string name;  ///< as given, or its number
  Index row = 0;     ///< of all_bolts()
  bool grouted = true;
  double share = 1.0;    ///< thickness over spacing
  double steel = 0.0;    ///< EA, N
  double yield = 0.0;    ///< N; infinite: never
  double rupture = 0.0;  ///< rupture strain; infinite: never
  double gauge = 0.0;    ///< m: length over which the steel stretches where a bolt crosses a joint
  double pretension = 0.0;                   ///< N
  double bond = 0.0, bond_strength = 0.0;    ///< Pa, N/m
  double dowel = 0.0, dowel_strength = 0.0;  ///< N/m, N
};

/// Springs of one kind, one per node: bonds, bars (from the node to the next) or dowels.
struct BoltSprings {
  std::vector<double> stiffness;       ///< N/m; 0: there is none
  std::vector<double> strength;        ///< N
  std::vector<double> plastic;         ///< m, plastic elongation
  std::vector<double> force, force_1;  ///< N, at n and n - 1; tension positive
  std::vector<std::uint8_t> yielded;   ///< 1: has yielded at least once
  std::vector<std::uint8_t> broken;
};

/// Position of a bar, and the derivatives of its elongation by the slips.
struct BarFrame {
  Vec2 from, to;      ///< m_k, m_{k+1}
  Vec2 t;             ///< direction of the bar
  Vec2 gap;           ///< x_{k+1} - x_k without the slips, m
  double size;        ///< |m_k + m_{k+1}|
  double start, end;  ///< t . m_k, t . m_{k+1}
  double stretch;     ///< e_k without the slips, m
};

struct Bolts {
  std::vector<BoltData> rows;
  std::vector<Id> begin;               ///< [rows + 1] first node of each
  std::vector<Id> host;                ///< [nn] block
  std::vector<Id> zone;                ///< [nn] of all meshes; no_id: the block has none
  Nodes weight;                        ///< [nodes][nn] w
  Nodes along;                         ///< [nodes][nn] d, 1/m
  std::vector<double> distance;        ///< [nn] from the head, m
  std::vector<double> bonded;          ///< [nn] tributary length of the node's bond, m
  std::vector<double> length;          ///< [nn] L of the bar after the node, m
  std::vector<std::uint8_t> crossing;  ///< [nn] 1: that bar connects two hosts
  std::vector<double> hinges;          ///< [nn] H of that bar and its dowel as a link, m; 0: none

  std::vector<double> slip;         ///< [nn] s, m
  BoltSprings bonds, bars, dowels;  ///< [nn] each
  double slipped = 0.0;             ///< J, dissipated by yield and slip
  double fractured = 0.0;           ///< J, by rupture
  double pending_friction = 0.0,
         pending_fracture = 0.0;  ///< J: what the forces at n will add to these
  double work_pending = 0.0;  ///< J: work yet to be counted in the current step, because velocities
                              ///< or bolts changed at n
  int most_increments = 0;    ///< of Newton's method for one bolt in the last step
  std::vector<NodeVectors> on_host;  ///< [nn] forces of node, bar and dowel on the points that
                                     ///< carry it, N

  std::vector<Id> place;        ///< [nb] index into `block_begin`, or no_id; empty without bolts
  std::vector<Id> block_begin;  ///< [blocks with nodes + 1]
  std::vector<Id> block_nodes;  ///< nodes by block

  // Working arrays of one step, [nn] each, kept so that steps allocate nothing.
  std::vector<BarFrame> frame;
  std::vector<double> trial, diagonal, upper, right, change;
  std::size_t size() const { return host.size(); }
};

/// Whether the model has any bolts.
inline bool has_bolts(const Model& model) {
  return !model.bolts.empty() || !model.bolt_patterns.empty();
}

/// The bolts of the model, those of patterns last. A pattern's bolts start where rays from the
/// centroid of the opening leave its outline for the last time.
std::vector<Bolt> all_bolts(const Model& model);

/// Installs `which` of all_bolts() in the blocks as they are now (`x`, `y`: their vertices), and
/// computes the equilibrium of the pretension. It is a fault if a bolt meets no free block, or if
/// an end of an end-anchored bolt lies further outside all blocks than `slack` times its length.
Result<Bolts> attach_bolts(const Model& model, const BlockSet& blocks, const State& state,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<Index>& which, double slack);
/// Installs, at the start of the run, the bolts that no stage installs. It is a fault, too, if one
/// of the others could not be installed there.
Result<Bolts> attach_bolts(const Model& model, const BlockSet& blocks, const State& state,
                           const std::vector<double>& x, const std::vector<double>& y);

/// Adds bolts to others in the same blocks.
void add_bolts(Bolts& bolts, const Bolts& more, const Model& model, std::size_t blocks);
/// Fills what follows from the other arrays: data of the rows, lists by block, working arrays.
void complete_bolts(Bolts& bolts, const Model& model, std::size_t blocks);

/// Where the points are that carry node k.
NodeVectors carriers_at(const Bolts& bolts, const BlockSet& blocks, const State& state,
                        std::size_t k);

/// Bar k in its present position.
BarFrame bar_frame(const Bolts& bolts, const BlockSet& blocks, const State& state, std::size_t k);

/// The link that bar k is with its dowel; Bolts::hinges[k] > 0.
BarLink link_of(const Bolts& bolts, const BarFrame& frame, std::size_t k);

/// Whether node k lies in excavated rock, so that the bolt has nothing to hold there.
inline bool is_cut_off(const Bolts& bolts, const State& state, std::size_t k) {
  return state.alive[bolts.host[k]] == 0;
}

/// Present position of node k, slip included.
Vec2 node_place(const Bolts& bolts, const BlockSet& blocks, const State& state, std::size_t k);

/// Computes slips and forces at the present positions of the nodes, and accounts for yield and
/// rupture. Bars with an end in excavated blocks carry nothing.
void update_bolts(Bolts& bolts, const BlockSet& blocks, const State& state);

/// Adds the forces of the bolts on a block, N.
void add_bolts(BlockForces& on, const Bolts& bolts);

/// Stored energy in the terms of the energy balance, sum of F_{n-1} F_n / 2k, plus
/// Bolts::work_pending, J.
double bolt_energy(const Bolts& bolts);

}  // namespace edda
