// The water in the joints of a model with [flow]: its state, and what is reported of it.
#pragma once

#include <cstdint>
#include <vector>

#include "flow/network.hpp"
#include "flow/node_forces.hpp"
#include "flow/seepage.hpp"

namespace edda {

/// Water in a face.
struct FlowRow {
  Id edge, facing;                ///< of the face
  double aperture;                ///< m, hydraulic: of a uniform joint with its discharge
  double discharge;               ///< m2/s, from end a to end b
  double pressure_a, pressure_b;  ///< Pa, at its ends
};

/// Water in a pipe of a face when a time began to pass.
struct WaterContent {
  Id edge, facing;                    ///< of the face
  double part_from, part_to;          ///< of the pipe, as FlowPipe
  double from, to;                    ///< V (s + p/K) of its two nodes, m2
  double aperture_from, aperture_to;  ///< at them, m
};

struct JointWater {
  FlowGround ground;
  std::vector<double> pressure, filled;  ///< [nv] NodeWater of the node of each corner
  std::vector<FlowRow> rows;             ///< of the faces with water, by edge and facing
  std::vector<double> inflow;   ///< [rows of Model::waters, and the open air] m2/s into the joints
  std::uint64_t not_found = 0;  ///< times that the free surface has not been found
  std::uint64_t not_taken = 0;  ///< times that no joint took what a water injects
  std::vector<Id> injected;  ///< [rows of Model::waters] a corner at the crossing into which one is
                             ///< injected as the joints are; no_id: none
  std::vector<std::size_t> heads;      ///< [rows of Model::waters] nodes on their lines at present
  std::vector<WaterContent> contents;  ///< by face
  std::vector<WetEdge> before;  ///< water in joints before what changes gradually began to change
};

/// Solves for steady flow through the joints as they are now, and puts its pressures on their walls
/// (Loads::wet). now: waters_at().
void flow_through(JointWater& joints, const FlowScene& scene, const LoadsNow& now, Loads& loads);
/// Takes what the joints contain as what they contained when a time began to pass.
void take_contents(JointWater& joints, const FlowScene& scene, const LoadsNow& now);

/// Puts the water in joints on their walls as these are, with the pressures that it has.
void put_flow(JointWater& joints, const FlowScene& scene, const LoadsNow& now, Loads& loads);

struct CornerForce {
  Id block, corner;
  Vec2 force;  ///< N
};
/// What the blocks in a step do to the water in joints, and it to them.
struct WaterInStep {
  const Masses& masses;
  double seconds_squared;  ///< of the step: displacement over acceleration
  double passed;           ///< s, of the time of the flow, since the contents were taken
};
/// Solves for the water as it is at the end of a step, scene.pose, that has been made under its
/// pressures before; puts it on the walls, and returns what must be added to the forces on the
/// blocks, by block, so that the step is made under the pressures at its end.
std::vector<CornerForce> flow_in_step(JointWater& joints, const FlowScene& scene,
                                      const LoadsNow& now, const WaterInStep& step, Loads& loads);
/// What follows changes gradually from the water in joints as it is now, which is there twice from
/// then on: as it is and, of the other part of its weight, as it was.
void keep_water(JointWater& joints, const BlockSet& blocks, Index waters, Loads& loads);

/// The row of the face between two edges; null: no water flows in it.
const FlowRow* row_of(const JointWater& joints, Id edge, Id facing);

}  // namespace edda
