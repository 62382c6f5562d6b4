// The failure mechanism: which blocks move, how, and along which joints.
#pragma once

#include <string>
#include <string_view>
#include <vector>

#include "results/records.hpp"
#include "step/simulation.hpp"

namespace edda {

enum class FailureMode { slides, topples, falls, hinges, yields };

constexpr std::string_view motion_name(FailureMode m) {
  constexpr std::string_view names[] = {"slides", "topples", "falls", "hinges", "yields"};
  return names[static_cast<int>(m)];
}

/// Relative motion of the two sides of a joint.
enum class JointMotion { slips, opens, hinges };

constexpr std::string_view motion_name(JointMotion m) {
  constexpr std::string_view names[] = {"slips", "opens", "hinges"};
  return names[static_cast<int>(m)];
}

/// A moving block: a vertex moves by more than a part of the largest displacement, usually a tenth
/// (mechanism_of()).
struct MovingBlock {
  Id id = 0;
  Vec2 place;                  ///< m, centroid at the start
  Vec2 displacement;           ///< m, displacement of the centroid
  double largest = 0.0;        ///< m, largest displacement of a vertex
  double rotation = 0.0;       ///< rad, counter-clockwise
  double rotation_part = 0.0;  ///< ratio |rotation| r/|displacement|, with r the distance of the
                               ///< furthest vertex from the centroid
  FailureMode motion = FailureMode::slides;
};

/// A straight part of a joint.
struct Stretch {
  Vec2 from, to;              ///< m, its ends
  Vec2 from_moved, to_moved;  ///< m, displacement of the ends with the block beside it
};

/// A joint between two blocks that slips, opens, or gapes at one end by rotation, by more than
/// that. It hinges where its rotation displaces it at least twice as
/// far as it slips and one of its ends stays closed.
struct MovingJoint {
  Id block_i = 0, block_j = 0;
  std::string joint;
  std::uint16_t law = 0;           ///< row of the law table
  Vec2 place;                      ///< m, at the contact that moves most
  std::string table;               ///< BlockSet::table_of() of that contact
  std::vector<Stretch> stretches;  ///< the parts along which the two blocks lie against each other
                                   ///< and move
  double slip = 0.0;               ///< m, largest along the joint, in either direction
  double opening = 0.0;            ///< m, largest across the joint
  double turning = 0.0;            ///< m: relative rotation times the length of the joint
  JointMotion motion = JointMotion::slips;
};

struct Mechanism {
  std::vector<MovingBlock> blocks;  ///< by id
  std::vector<MovingJoint> joints;  ///< by blocks
  double sliding = 0.0, toppling = 0.0, falling = 0.0, hinging = 0.0,
         yielding = 0.0;              ///< fractions of the weight that moves
  double brittle_length = 0.0;        ///< m of its joints whose law loses cohesion at failure
  double cohesion_lost_length = 0.0;  ///< m of these joints without cohesion before the failure:
                                      ///< lost, or closed after the start
  std::string text;                   ///< one sentence
};

/// The mechanism of the motion from `before`, in equilibrium, to `after`, the same model later.
/// moving: part of the largest displacement that counts as motion, also that of a joint.
///
/// Blocks hinge where they move as one piece (no joint between them moves) between two hinges or
/// more, and nothing slips along that piece: parts of an arch. Of the others, a block topples where
/// it rotates about a point below its centroid (in the direction of gravity) and rotation moves its
/// furthest vertex by at least half of the displacement of the block itself: rotation_part >= 1/2
/// (about 1 for a block that rotates about one of its vertices, 0 for one that slides); else it
/// slides. A block that is no longer within a tenth of the largest displacement of another block
/// falls. A meshed block yields whose shape changes by a quarter of its largest
/// displacement or more.
Mechanism mechanism_of(const Simulation& before, const Simulation& after, double moving = 0.1);
/// The same, where the state `apart` says which blocks are no longer within that distance.
Mechanism mechanism_of(const Simulation& before, const Simulation& after, double moving,
                       const Simulation& apart);

/// Rows of the BlockSet that move, ascending, and the area of them all, m2.
std::vector<Id> blocks_of(const Mechanism& mechanism);
double area_of(const Mechanism& mechanism, const BlockSet& b);

/// Determines how much cohesion the mechanism's joints had lost in the state `stable`, which
/// is the last stable one.
void find_lost_cohesion(Mechanism& mechanism, const Simulation& stable);
/// A sentence on the lost cohesion; empty where little was lost.
std::string lost_cohesion_text(const Mechanism& mechanism);

std::string mechanism_csv(const Simulation& sim, const Mechanism& mechanism);
std::string mechanism_joints_csv(const Mechanism& mechanism);

}  // namespace edda
