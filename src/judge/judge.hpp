// The judge of rest and failure: what stands, what moves, what has left its place. Stages, ramps,
// trials of a factor and the calm after a ground motion all ask it (theory, section 11.3).
//
//  - A block is judged by its own size L and time T (rest.hpp), and by how it has moved as seen
//  from
//    the blocks beside it (moved_sets.hpp). No mean over the model enters.
//  - The model is in equilibrium if every free block is at rest, or has left its place and is
//  named.
//  - A set of blocks has left its place that has moved by more than a tenth of its size.
//  - While joints are stronger than the model's, or loads incomplete, nothing is at rest.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

#include "judge/moved_sets.hpp"
#include "judge/rest.hpp"

namespace edda {

/// Parts of its size by which a set of blocks has moved: little, as where joints close, bolts take
/// up their force and columns lean on each other; and so far that it has left its place.
inline constexpr double moved_little = 0.01, left_its_place = 0.1;

/// Largest displacement of a corner, and its block.
struct Furthest {
  double value = 0.0;  ///< m
  Id block = no_id;
};

/// The fastest free block by its centroid, m/s.
Furthest fastest_block(const Simulation& sim);
/// The fastest of these blocks by its centroid, m/s.
Furthest fastest_of(const Simulation& sim, const std::vector<Id>& blocks);

class Judge {
 public:
  Judge() = default;
  /// Displacements count from the present state. left_out: [nb] 1: the block has left its place
  /// before and does not count; may be empty.
  explicit Judge(Simulation& sim, std::vector<std::uint8_t> left_out = {});

  /// Call when a change begins to be applied (begin_gradually()).
  void begin(const Simulation& sim);
  /// Displacements count anew, where supports have been displaced: blocks that follow them turn and
  /// slide on each other as geometry has it. What has gone by its whole size meanwhile has left.
  void follow_supports(Simulation& sim);
  /// Call after every step; looks at every 32nd of an explicit method. Returns whether it looked.
  /// Marks what has left its place as loose, which damping does not consider (Relaxation::loose).
  bool look(Simulation& sim);

  /// Whether every block that counts has been at rest at three looks in sequence, or has left its
  /// place.
  bool in_equilibrium() const { return found_in_sequence_ >= looks_in_sequence; }
  /// The same, where what has left its place must have come to rest, too.
  bool all_at_rest() const { return at_rest_in_sequence_ >= looks_in_sequence; }
  /// Sets that have moved by more than moved_little at the last look, the largest part first.
  const std::vector<MovedSet>& moved() const { return moved_; }
  /// What flows in meshed blocks that have not left their place.
  std::vector<FlowingPart> flowing(const Simulation& sim) const {
    return motion_.flowing(sim, left_);
  }
  /// [nb] 1: the block has left its place, also before; empty: none has.
  const std::vector<std::uint8_t>& left() const { return left_; }
  /// Whether that is so of all free blocks.
  bool all_left(const Simulation& sim) const;
  /// [nb] 1: at rest at the last look.
  const std::vector<std::uint8_t>& rests() const { return rests_; }
  /// ", except for 2 blocks (0.4 m2) that have left their place: ..."; empty: none has.
  std::string left_text(const Simulation& sim) const;
  /// The corner of a block that counts which has moved furthest since the start as seen from the
  /// ground.
  Furthest furthest(const Simulation& sim) const;

  /// Whether what a checkpoint contained is of this model.
  bool fits(const Simulation& sim) const;
  /// Names every field that a checkpoint contains, after the prefix `of`.
  template <class Archive>
  void list(Archive& a, const std::string& of);

 private:
  static constexpr int looks_in_sequence = 3;
  void find_moved(Simulation& sim);

  std::vector<std::uint8_t> left_out_, left_, rests_;
  std::vector<MovedSet> gone_;  ///< left on the way, follow_supports()
  RelativeMotion motion_;
  SlowingDown slowing_;
  std::vector<MovedSet> moved_;
  bool was_complete_ = false;  ///< gradual changes, at the last look
  int found_in_sequence_ = 0, at_rest_in_sequence_ = 0;
};

template <class Archive>
void list_sets(Archive& a, const std::string& name, std::vector<MovedSet>& sets) {
  std::size_t count = sets.size();
  a(name + ".sets", count);
  if constexpr (Archive::loads) sets.resize(count);
  for (std::size_t q = 0; q < sets.size(); ++q) {
    const std::string set = name + "." + std::to_string(q) + ".";
    a(set + "blocks", sets[q].blocks);
    a(set + "area", sets[q].area);
    a(set + "distance", sets[q].distance);
    a(set + "part", sets[q].part);
  }
}

template <class Archive>
void Judge::list(Archive& a, const std::string& of) {
  a(of + "judge.left_out", left_out_);
  a(of + "judge.left", left_);
  a(of + "judge.rests", rests_);
  a(of + "judge.was_complete", was_complete_);
  a(of + "judge.found", found_in_sequence_);
  a(of + "judge.at_rest", at_rest_in_sequence_);
  motion_.list(a, of);
  slowing_.list(a, of);
  list_sets(a, of + "judge.moved", moved_);
  list_sets(a, of + "judge.gone", gone_);
}

}  // namespace edda
