// The mechanism of a failure: which blocks move, how, and along which joints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "results/records.hpp"
#include "run/simulation.hpp"

namespace edda {

enum class Motion { slides, topples, falls, hinges };

constexpr std::string_view motion_name(Motion m) {
  constexpr std::string_view names[] = {"slides", "topples", "falls", "hinges"};
  return names[static_cast<int>(m)];
}

/// What the two sides of a joint do to each other.
enum class JointMotion { slips, opens, hinges };

constexpr std::string_view motion_name(JointMotion m) {
  constexpr std::string_view names[] = {"slips", "opens", "hinges"};
  return names[static_cast<int>(m)];
}

/// A block that moves: by more than a tenth of the largest displacement of a corner.
struct MovingBlock {
  Id id = 0;
  Vec2 place;                 ///< of its centroid at the start, m
  Vec2 displacement;          ///< of its centroid since then, m
  double largest = 0.0;       ///< displacement of a corner, m
  double rotation = 0.0;      ///< rad, counter-clockwise
  double turning_part = 0.0;  ///< |rotation| r/|displacement|, r from centroid to furthest corner
  Motion motion = Motion::slides;
};

/// A straight part of a joint.
struct Stretch {
  Vec2 from, to;              ///< m, its ends
  Vec2 from_moved, to_moved;  ///< m, how far the block beside it has carried them
};

/// A joint between two blocks that slips, opens, or gapes at one end by turning, by more than a
/// tenth of that displacement. It hinges where it turns at least twice as far as it slips and one
/// of its ends stays closed.
struct MovingJoint {
  Id block_i = 0, block_j = 0;
  std::string joint;
  std::uint16_t law = 0;           ///< row of the law table
  Vec2 place;                      ///< m, of the contact that moves most
  std::vector<Stretch> stretches;  ///< where the two lie against each other and move
  double slip = 0.0;               ///< m, largest along the joint, either way
  double opening = 0.0;            ///< m, largest across it
  double turning = 0.0;            ///< m: relative rotation times the length of the joint
  JointMotion motion = JointMotion::slips;
};

struct Mechanism {
  std::vector<MovingBlock> blocks;                                     ///< by id
  std::vector<MovingJoint> joints;                                     ///< by blocks
  double sliding = 0.0, toppling = 0.0, falling = 0.0, hinging = 0.0;  ///< parts of the weight
                                                                       ///< that moves
  double brittle_length = 0.0;  ///< m of its joints whose cohesion goes down as they break
  double cohesion_lost_length =
      0.0;  ///< m of that without it before anything moved: lost, or closed since the start
  std::string text;  ///< one sentence
};

/// From `before`, at rest, to `after`, the same model later.
///
/// Blocks hinge where they move as one piece (no joint between them moves) between two hinges or
/// more, and nothing slips along that piece: parts of an arch. Of the others a block topples where
/// it turns about a point below its centroid (as gravity has it) and turning moves its furthest
/// corner by at least half of what the block itself moves: turning_part >= 1/2 (a block that turns
/// about one of its corners has about 1, one that slides 0); else it slides. One that is next to
/// nothing any more, but for a tenth of that displacement, falls.
Mechanism mechanism_of(const Simulation& before, const Simulation& after);

/// Finds out how much cohesion the mechanism's joints had lost in a state that still `held`.
void find_lost_cohesion(Mechanism& mechanism, const Simulation& held);
/// What it means; nothing where little was lost.
std::string lost_cohesion_text(const Mechanism& mechanism);

std::string mechanism_csv(const Simulation& sim, const Mechanism& mechanism);
std::string mechanism_joints_csv(const Mechanism& mechanism);

}  // namespace edda
