// The contacts of the paper as printed (theory, section 4.8; contact.model = "points"), for the
// comparison of tools/reproduce-paper: a vertex P1 of one block on an edge P2 P3 of another,
// springs p_n and p_t, Coulomb friction. A run has either faces or point contacts, never both.
#pragma once

#include <cstdint>
#include <vector>

#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/laws.hpp"
#include "forces/block_equations.hpp"
#include "forces/nodal_forces.hpp"

namespace edda {

/// Vertices near edges of other blocks, sorted by vertex and edge, [np] each, with the memory of
/// those in contact.
struct PointSet {
  std::size_t size() const { return vertex.size(); }

  std::vector<Id> vertex, edge;
  std::vector<std::uint16_t> law;  ///< row of the LawTable

  std::vector<double> closed;    ///< 1: in contact
  std::vector<double> position;  ///< contact position P0 along the edge: 0 at P2, 1 at P3
  std::vector<double> entered;   ///< the same where the vertex first entered
  std::vector<double> normal;    ///< p_n d_n, N
  std::vector<double> shear;     ///< -p_t s, N: positive where it drives P1 from P2 to P3
  std::vector<double> slides;    ///< 1: friction cut the shear at the last step
  std::vector<double> slipped;   ///< 1: has slid at least once
  std::vector<double> opened;    ///< 1: has opened after having been closed

  NearSprings springs;                            ///< of all contacts that are near
  double stiffness = 0.0, shear_stiffness = 0.0;  ///< p_n, p_t, N/m
  double energy = 0.0;    ///< stored between the last two steps, in the leapfrog's terms, J
  double friction = 0.0;  ///< dissipated by friction so far, J
  double due = 0.0;  ///< dissipated by friction in the last step, not yet added, since half of its
                     ///< force has yet to act, J
  double deepest = 0.0;  ///< largest penetration, m
};

/// The arrays that are carried over a search and into a checkpoint.
inline constexpr std::vector<double> PointSet::*point_columns[] = {
    &PointSet::closed, &PointSet::position, &PointSet::entered, &PointSet::normal,
    &PointSet::shear,  &PointSet::slides,   &PointSet::slipped, &PointSet::opened};

/// Lists all vertices nearer than `reach` (m) to an edge of another block, and carries over the
/// memory of those that were in the old list.
void find_points(PointSet& points, const BlockSet& blocks, const State& state, const Pose& pose,
                 const LawTable& laws, double reach);

/// Computes states and forces at the positions of `pose`, one step after the last call.
void move_points(PointSet& points, const BlockSet& blocks, const Pose& pose, const LawTable& laws);

/// Computes stiffnesses and `springs`.
void complete_points(PointSet& points, const BlockSet& blocks, const Pose& pose,
                     const LawTable& laws);

/// Sets the forces on the nodes to those of the contacts, N.
void sum_points(BodyVectors& on, const BlockSet& blocks, const PointSet& points, const Pose& pose);

/// Position of vertex k relative to its edge.
struct PointGap {
  double depth;   ///< d_n, m: positive where the vertex is inside
  double along;   ///< distance from P2 towards P3, m
  double length;  ///< l, m
  Vec2 tangent;   ///< from P2 to P3
};
PointGap gap_of(const PointSet& points, const BlockSet& blocks, const Pose& pose, std::size_t k);

/// Whether the vertex is in contact, or touches its edge within `noise` (m).
bool meets(const PointSet& points, const BlockSet& blocks, const Pose& pose, std::size_t k,
           double noise);

/// Force on the block of the vertex, N; the force on the block of the edge is opposite.
Vec2 force_on_vertex(const PointSet& points, const BlockSet& blocks, const Pose& pose,
                     std::size_t k);

inline std::size_t closed_points(const PointSet& points) {
  std::size_t count = 0;
  for (const double closed : points.closed) count += closed > 0.0;
  return count;
}

}  // namespace edda
