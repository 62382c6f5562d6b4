// Rock bolts: steel along a line through blocks, held to them by grout, or at its ends.
//
// A bolt is a chain of nodes without mass. Node k sits in a block (its host) at the material point
// X_k + s_k a, a the bolt's direction as the host had it when the bolt was put in; s_k, its slip
// along the bolt, is all that it may do by itself. With area coordinates w and their derivative d
// along a it lies at
//
//   x_k = sum_j (w_j + s_k d_j) x_j,      m_k = sum_j d_j x_j  (the bolt's direction there now).
//
// Bar k from node k to node k + 1 is longer than when it was put in by e_k = t_k . (x_{k+1} - x_k)
// - L_k, t_k the direction of m_k + m_{k+1}, and carries N_k = EA/L_k (e_k - its plastic part). The
// bond carries K_k (s_k - its plastic part). The slips are those of equilibrium along the bolt,
//
//   (t_{k-1} . m_k) N_{k-1} - (t_k . m_k) N_k + K_k (s_k - ...) = 0,
//
// a tridiagonal system. Where two hosts meet, two nodes lie at one point and a dowel works across:
// delta = t x (h_{k+1} - h_k), h the points X themselves. An end-anchored bolt has two nodes that
// cannot slip and one bar along their distance, which pulls but does not push.
//
// All energies depend on nothing but distances and the hosts' own directions, so that forces,
// their gradients, keep momentum and angular momentum.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <vector>

#include "base/fault.hpp"
#include "blocks/kinematics.hpp"
#include "model/model.hpp"

namespace edda {

/// What is the same along a bolt; forces and stiffnesses as the model has them, that is those of a
/// bolt times thickness over spacing.
struct BoltData {
  std::string name;  ///< as given, or its number
  Index row = 0;     ///< of all_bolts()
  bool grouted = true;
  double share = 1.0;       ///< thickness over spacing
  double steel = 0.0;       ///< EA, N
  double yield = 0.0;       ///< N; infinite: never
  double rupture = 0.0;     ///< strain; infinite: never
  double gauge = 0.0;       ///< m: length that stretches where a bolt crosses a joint
  double pretension = 0.0;  ///< N
  double bond = 0.0, bond_strength = 0.0;    ///< Pa, N/m
  double dowel = 0.0, dowel_strength = 0.0;  ///< N/m, N
};

/// Springs of one kind, one per node: bonds, bars (from the node to the next) or dowels.
struct BoltSprings {
  std::vector<double> stiffness;       ///< N/m; 0: there is none
  std::vector<double> strength;        ///< N
  std::vector<double> plastic;         ///< m, of its elongation
  std::vector<double> force, force_1;  ///< N, at n and n - 1; tension positive
  std::vector<std::uint8_t> yielded;   ///< ever
  std::vector<std::uint8_t> broken;
};

/// Where a bar is, and what slips do to it.
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
  std::vector<Id> begin;                      ///< [rows + 1] first node of each
  std::vector<Id> host;                       ///< [nn] block
  std::array<std::vector<double>, 3> weight;  ///< [3][nn] w
  std::array<std::vector<double>, 3> along;   ///< [3][nn] d, 1/m
  std::vector<double> distance;               ///< [nn] from the head, m
  std::vector<double> bonded;                 ///< [nn] length that the node's bond stands for, m
  std::vector<double> length;                 ///< [nn] L of the bar after the node, m
  std::vector<std::uint8_t> crossing;         ///< [nn] 1: that bar goes from host to host

  std::vector<double> slip;                     ///< [nn] s, m
  BoltSprings bonds, bars, dowels;              ///< [nn] each
  double slipped = 0.0;                         ///< J, dissipated by yield and slip
  double fractured = 0.0;                       ///< J, by rupture
  double will_slip = 0.0, will_fracture = 0.0;  ///< J: what the forces at n will add to them
  double owed = 0.0;  ///< J: what the step in hand brings more, by velocities changed since n
  std::vector<std::array<Vec2, 3>> on_host;  ///< [nn] what node, bar and dowel do to its host, N

  std::vector<Id> place;        ///< [nb] index into `block_begin`, or no_id; empty without bolts
  std::vector<Id> block_begin;  ///< [blocks with nodes + 1]
  std::vector<Id> block_nodes;  ///< nodes by block

  // Of one step, [nn] each, kept so that it allocates nothing.
  std::vector<BarFrame> frame;
  std::vector<double> trial, diagonal, upper, right, change;
  std::size_t size() const { return host.size(); }
};

/// Whether the model has any.
inline bool has_bolts(const Model& model) {
  return !model.bolts.empty() || !model.bolt_patterns.empty();
}

/// The bolts of the model, those of patterns after the others. A pattern's bolts stand where rays
/// from the centroid of the opening leave its outline for the last time.
std::vector<Bolt> all_bolts(const Model& model);

/// Puts bolts in where the blocks now are (`x`, `y`: their vertices), and lets pretension settle:
/// `which` of all_bolts(). A bolt that meets no free block, and an end-anchored one with an end
/// further outside of all blocks than `slack` of its length, is a fault.
Result<Bolts> attach_bolts(const Model& model, const BlockSet& blocks, const State& state,
                           const std::vector<double>& x, const std::vector<double>& y,
                           const std::vector<Index>& which, double slack);
/// Those that no stage installs, at the start of the run; one of the others that could not be put
/// in there is a fault, too.
Result<Bolts> attach_bolts(const Model& model, const BlockSet& blocks, const State& state,
                           const std::vector<double>& x, const std::vector<double>& y);

/// Adds bolts to others in the same blocks.
void add_bolts(Bolts& bolts, const Bolts& more, const Model& model, std::size_t blocks);
/// What follows from the other arrays: data of the rows, lists by block, room for a step.
void complete_bolts(Bolts& bolts, const Model& model, std::size_t blocks);

/// Bar k where it now is.
BarFrame bar_frame(const Bolts& bolts, const State& state, std::size_t k);

/// Where node k now lies, slip and all.
Vec2 node_place(const Bolts& bolts, const State& state, std::size_t k);

/// Slips and forces at the nodes' present places; what yields or breaks is booked. Bars of blocks
/// that have been taken out carry nothing.
void update_bolts(Bolts& bolts, const State& state);

/// Adds what the bolts do to block i.
void add_bolts(std::array<Vec2, 3>& on_nodes, const Bolts& bolts, std::size_t i);

/// Their stored energy in the ledger's terms, sum of F_{n-1} F_n / 2k, and what is owed, J.
double bolt_energy(const Bolts& bolts);

}  // namespace edda
