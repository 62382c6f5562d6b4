// How far blocks have moved as seen from those that they touched: what moves is a set of blocks,
// and how far it has moved is told by its own size (theory, section 11.3). Nothing here depends on
// what is far away: neither the size of the ground, nor whether it is fixed, settles or is carried
// along.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "checkpoint/archive.hpp"
#include "step/simulation.hpp"

namespace edda {

/// Blocks that have moved together.
struct MovedSet {
  std::vector<Id> blocks;  ///< ascending
  double area = 0.0;       ///< m2, of all of them
  double distance = 0.0;   ///< m, that they have moved as seen from the blocks beside them
  double part = 0.0;       ///< that distance over the size of the largest of them
};

/// A part of a meshed block that has changed its place in the block.
struct FlowingPart {
  Id block = 0;
  double area = 0.0;     ///< m2, of the mesh nodes that have moved at least half as far as the
                         ///< farthest
  double part = 0.0;     ///< distance of the farthest over sqrt(area)
  double strains = 0.0;  ///< `part` over (s1 - s3)/(2 G) of the zones that shear
};

/// Whether block i counts in verdicts: a sliver that the cut could not merge, and whose inertia is
/// raised, does not, since its motion is not that of rock.
bool counts_in_verdicts(const Simulation& sim, std::size_t i);

/// Relative motion since the state in which this is created.
///
/// Two blocks that touch then have moved by D, the largest displacement of a corner of the smaller
/// block as seen from the larger one, which carries it by its affine motion and by what the
/// nearest point of its boundary deviates from that; a block has also moved by D from where it was,
/// as seen from the ground or from a boundary that holds it. Blocks are joined in the order of
/// their D (single linkage). Where a set S is joined at D to a larger one that contains all its
/// neighbours, S has moved by the part D/L of its size, L = sqrt(area) of the largest block of S.
/// If S has other neighbours, these may have carried it along, and it is judged together with them.
/// Of a set that was unsupported at the start, which falls before it rests, a tenth of D counts.
class RelativeMotion {
 public:
  RelativeMotion() = default;
  explicit RelativeMotion(const Simulation& sim);

  /// Sets that have moved by more than the part `least` of their size, the largest part first; of
  /// sets within each other the larger. `left_out`: [nb] 1: the block does not count; may be empty.
  std::vector<MovedSet> sets(const Simulation& sim, double least,
                             const std::vector<std::uint8_t>& left_out = {}) const;

  /// Of each meshed block that counts and in which zones shear, what has moved in it as the shape
  /// of the block has changed (blocks/shape_change.hpp). A part of a few nodes is left out: a mesh
  /// cannot tell how it would move.
  std::vector<FlowingPart> flowing(const Simulation& sim,
                                   const std::vector<std::uint8_t>& left_out = {}) const;

  /// Whether a boundary has been displaced since the start.
  bool supports_have_moved(const Simulation& sim) const;
  /// Largest displacement of a corner of block i as seen from the ground, m.
  double moved_from_start(const Simulation& sim, Id i) const;

  bool fits(const BlockSet& blocks) const;
  /// Names every field that a checkpoint contains, after the prefix `of`.
  template <class Archive>
  void list(Archive& a, const std::string& of);

 private:
  /// Blocks that touch at the start; the second is the larger one.
  struct Pair {
    Id small = 0, large = 0;
  };
  double moved(const Simulation& sim, const Pair& pair) const;
  double moved_with(const Simulation& sim, Id i, Vec2 carried) const;
  double moved_from_support(const Simulation& sim, Id i) const;
  double size_of(const Simulation& sim, Id i) const;

  /// Of a point of a block's boundary from its affine motion, at the start and now, m.
  struct Deviation {
    Vec2 then, now;
  };
  /// Where the boundary of a block is nearest to p at the start.
  Deviation deviation_beside(const Simulation& sim, Id block, Vec2 p) const;
  Vec2 corner_at_start(const BlockSet& blocks, Id v) const;
  Vec2 corner_now(const Simulation& sim, Id v) const;

  BodyVectors then_;                 ///< positions at the start, m
  Vec2 ground_;                      ///< m, displacement of the ground then
  std::vector<Vec2> shift_;          ///< [boundaries] m, that of each boundary then
  std::vector<Id> small_, large_;    ///< [pairs]
  std::vector<std::uint8_t> apart_;  ///< [nb] 1: nothing supported it then
};

template <class Archive>
void RelativeMotion::list(Archive& a, const std::string& of) {
  list_vectors(a, of + "moved.position", then_);
  a(of + "moved.ground_x", ground_.x);
  a(of + "moved.ground_y", ground_.y);
  list_points(a, of + "moved.shift", shift_);
  a(of + "moved.small", small_);
  a(of + "moved.large", large_);
  a(of + "moved.apart", apart_);
}

}  // namespace edda
