// The paper's contacts, as printed and no more (contact.model = "points"), for the comparison of
// tools/reproduce-paper: a vertex P1 of one block on an edge P2 P3 of another, springs p_n and p_t,
// Coulomb friction. One set for each model of contacts, and never both in one run.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/laws.hpp"

namespace edda {

/// A spring that may come to act on a block, for the bound of the step.
struct PointSpring {
  Id block;
  std::array<double, 3> weight;  ///< of the point
  double factor;                 ///< 1 against a held block, else 2
};

/// Vertices near edges of other blocks, sorted by vertex and edge, [np] each, with the memory of
/// those in contact.
struct PointSet {
  std::size_t size() const { return vertex.size(); }

  std::vector<Id> vertex, edge;
  std::vector<std::uint16_t> law;  ///< row of the LawTable

  std::vector<double> closed;   ///< 1: in contact
  std::vector<double> foot;     ///< where P0 is on the edge: 0 at P2, 1 at P3
  std::vector<double> entered;  ///< the same where the vertex first came in
  std::vector<double> normal;   ///< p_n d_n, N
  std::vector<double> shear;    ///< -p_t s, N: positive where it drives P1 from P2 to P3
  std::vector<double> slides;   ///< 1: friction cut the shear at the last step
  std::vector<double> slipped;  ///< 1: has slid at least once
  std::vector<double> opened;   ///< 1: has opened after having been closed

  std::vector<std::array<Vec2, 3>> on_nodes;      ///< [nb] forces of all on the nodes, N
  std::vector<PointSpring> springs;               ///< sorted by block
  double stiffness = 0.0, shear_stiffness = 0.0;  ///< p_n, p_t, N/m
  double energy = 0.0;    ///< stored between the last two steps, in the leapfrog's terms, J
  double friction = 0.0;  ///< taken by friction so far, J
  double due = 0.0;       ///< by that of the last step: half of its force has still to act, J
  double deepest = 0.0;   ///< largest penetration, m
};

/// The arrays that are kept over a search and in a checkpoint.
inline constexpr std::vector<double> PointSet::*point_columns[] = {
    &PointSet::closed, &PointSet::foot,   &PointSet::entered, &PointSet::normal,
    &PointSet::shear,  &PointSet::slides, &PointSet::slipped, &PointSet::opened};

/// Makes the list of all vertices nearer than `reach` (m) to an edge of another block, and carries
/// over the memory of those that were in it.
void find_points(PointSet& points, const BlockSet& blocks, const State& state, const Pose& pose,
                 const LawTable& laws, double reach);

/// States and forces at the places of `pose`, a step after the last call.
void move_points(PointSet& points, const BlockSet& blocks, const Pose& pose, const LawTable& laws);

/// Forces on the nodes, from the memory of those in contact; and `springs`.
void complete_points(PointSet& points, const BlockSet& blocks, const Pose& pose,
                     const LawTable& laws);

/// Where vertex k is, seen from its edge.
struct PointGap {
  double depth;   ///< d_n, m: positive where it is inside
  double along;   ///< from P2 towards P3, m
  double length;  ///< l, m
  Vec2 tangent;   ///< from P2 to P3
};
PointGap gap_of(const PointSet& points, const BlockSet& blocks, const Pose& pose, std::size_t k);

/// Whether the vertex is in contact, or as good as touches its edge from outside (`noise`: m).
bool meets(const PointSet& points, const BlockSet& blocks, const Pose& pose, std::size_t k,
           double noise);

/// Force on the block of the vertex; that of the edge has the opposite.
Vec2 force_on_vertex(const PointSet& points, const BlockSet& blocks, const Pose& pose,
                     std::size_t k);

inline std::size_t closed_points(const PointSet& points) {
  std::size_t count = 0;
  for (const double closed : points.closed) count += closed > 0.0;
  return count;
}

}  // namespace edda
