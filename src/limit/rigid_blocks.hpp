// The model as rigid limit analysis sees it: rigid blocks, the joints along which they touch as
// drawn, what holds them, and the forces on them.
//
// Sign: the force of a joint acts on its block b, N along the normal n (from a to b, compression
// positive), T along the tangent t; block a feels the opposite. Coordinates are local, as those of
// the BlockSet; forces and lengths are those of the whole thickness, N and m.
#pragma once

#include <cstdint>
#include <vector>

#include "base/fault.hpp"
#include "blocks/block_set.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Two edges that lie against each other, or a corner that leans on an edge.
struct RigidJoint {
  Id block_a = 0, block_b = 0;
  Vec2 ends[2];           ///< m; equal where a corner leans
  Vec2 t, n;              ///< unit vectors
  std::uint16_t law = 0;  ///< row of the LawTable
  std::size_t face = 0;   ///< row of the FaceSet
  double compression =
      0.0;  ///< N per m of joint: compressive strength of the weaker rock; 0: not limited
  bool has_peak = false;  ///< lay flush as drawn, so that it has its peak strength

  bool is_corner() const { return ends[0] == ends[1]; }
  double length() const { return norm(ends[1] - ends[0]); }
};

/// A point of a block that cannot move along a direction, either way.
struct RigidSupport {
  Id block = 0;
  Vec2 place, direction;
};

/// A force along `direction` on block a at its place, and the opposite on block b: a bolt that
/// crosses from one to the other, or its resistance to being sheared there.
struct RigidTie {
  Id block_a = 0, block_b = 0;
  Vec2 place_a, place_b, direction;
  double least = 0.0, most = 0.0;  ///< N
};

/// The bond of a bolt to a block: the forces of the ties before and after it differ by no more.
struct RigidGrout {
  static constexpr std::size_t no_tie = static_cast<std::size_t>(-1);
  std::size_t before = no_tie, after = no_tie;
  double strength = 0.0;  ///< N
};

/// Force at a body's centroid, N, and moment about it, N m.
struct RigidForce {
  Vec2 force;
  double moment = 0.0;
};
using RigidForces = std::vector<RigidForce>;  ///< [bodies]

/// Bodies are free blocks, or several that are glued together. Those that are glued to something
/// fixed, or held by boundaries in every direction, count as fixed.
struct RigidBlocks {
  std::vector<std::vector<Id>> blocks;  ///< [bodies] rows of the BlockSet
  std::vector<Id> body;                 ///< [nb] the other way round; no_id: fixed or excavated
  std::vector<Vec2> centroid;           ///< [bodies] m
  /// [bodies] N and m: the units in which programs count the equilibrium of each body, its weight
  /// (without gravity that under 1 g) and the square root of its area.
  std::vector<double> weight, extent;
  std::vector<RigidJoint> joints;      ///< between different bodies
  std::vector<RigidSupport> supports;  ///< independent of each other
  std::vector<RigidTie> ties;
  std::vector<RigidGrout> grout;
  std::vector<Id> loose;  ///< blocks that nothing touches or holds; left out
  double size = 1.0;      ///< m, mean square root of the areas of free blocks
  double force = 1.0;     ///< N, mean weight of the free blocks, without gravity that of 1 g

  std::size_t bodies() const { return blocks.size(); }
};

/// Gap, as a part of the smaller block's size, up to which two blocks touch: what a model may
/// overlap as drawn.
inline constexpr double rigid_gap = 1e-3;

/// What bolts that are anchored at their ends may carry: up to their capacity, as after blocks have
/// moved and stretched them, or what they carry now. Grouted bolts need no such way.
enum class BoltForces { to_capacity, as_now };

/// gap: as rigid_gap, up to which faces count as closed.
RigidBlocks rigid_blocks(const Simulation& sim, BoltForces bolts = BoltForces::to_capacity,
                         double gap = rigid_gap);

/// The same with these blocks fixed where they are.
RigidBlocks carrying(const RigidBlocks& rigid, const std::vector<Id>& blocks);

/// Weight of the bodies under gravity (m/s2).
RigidForces weights_under(const RigidBlocks& rigid, const Simulation& sim, Vec2 gravity);

/// Gravity in force, m/s2: that of the model, changed by ramps, whose last values count.
Vec2 last_gravity(const Simulation& sim);
Vec2 last_gravity(const Simulation& sim, const SlowLoading& slow);

/// Which of the loads act; each [rows] a factor.
struct LoadFactors {
  std::vector<double> loads;   ///< of Model::loads, Model::boundaries, and owners of wall forces
  std::vector<double> waters;  ///< of Model::waters
};
/// Those in force, each with the last value of its history.
LoadFactors last_factors(const Simulation& sim);
/// All loads and waters with these factors.
RigidForces loads_with(const RigidBlocks& rigid, const Simulation& sim, const LoadFactors& factors);

RigidForces operator+(RigidForces a, const RigidForces& b);
RigidForces operator*(double s, RigidForces a);

}  // namespace edda
