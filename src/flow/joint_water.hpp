// The water in the joints of a model with [flow]: its state, and what is reported of it.
#pragma once

#include <cstdint>
#include <vector>

#include "flow/network.hpp"
#include "flow/seepage.hpp"

namespace edda {

/// Water in a face.
struct FlowRow {
  Id edge, facing;                ///< of the face
  double aperture;                ///< m, hydraulic: of a uniform joint with its discharge
  double discharge;               ///< m2/s, from end a to end b
  double pressure_a, pressure_b;  ///< Pa, at its ends
};

struct JointWater {
  FlowGround ground;
  std::vector<double> pressure, filled;  ///< [nv] NodeWater of the node of each corner
  std::vector<FlowRow> rows;             ///< of the faces with water, by edge and facing
  std::vector<double> inflow;   ///< [rows of Model::waters, and the open air] m2/s into the joints
  std::uint64_t not_found = 0;  ///< times that the free surface has not been found
  std::vector<std::size_t> heads;  ///< [rows of Model::waters] nodes on their lines at present
  std::vector<WetEdge> before;  ///< water in joints before what changes gradually began to change
};

/// Solves for steady flow through the joints as they are now, and puts its pressures on their walls
/// (Loads::wet). now: waters_at().
void flow_through(JointWater& joints, const FlowScene& scene, const LoadsNow& now, Loads& loads);
/// What follows changes gradually from the water in joints as it is now.
void keep_water(JointWater& joints, const Loads& loads, Index waters);

/// The row of the face between two edges; null: no water flows in it.
const FlowRow* row_of(const JointWater& joints, Id edge, Id facing);

}  // namespace edda
