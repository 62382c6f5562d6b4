// How water in joints and blocks move each other in a step (theory, section 13.9.5).
#pragma once

#include <vector>

#include "blocks/masses.hpp"
#include "flow/network.hpp"
#include "flow/seepage.hpp"

namespace edda {

/// Forces on a free block of a pressure of 1 Pa at a node, linear along its pipes to 0 at the
/// others: b, N/Pa. A displacement u of the block opens the part of the joints that is the node's
/// by b . u over the thickness, where apertures follow their walls.
struct NodeForce {
  Id block, node;
  BodyVector force;
  BodyVector opens;  ///< b, of what follows
};
/// By block and node.
std::vector<NodeForce> node_forces(const FlowNetwork& network, const FlowScene& scene);

/// opens M^-1 b times `seconds_squared` over the thickness: how volumes grow in a step whose forces
/// had the pressures, too.
std::vector<Storage::Give> gives_of(const std::vector<NodeForce>& forces, const FlowScene& scene,
                                    const Masses& masses, double seconds_squared);

}  // namespace edda
