// How water in joints and blocks move each other in a step (theory, section 13.9.5).
#pragma once

#include <vector>

#include "blocks/masses.hpp"
#include "flow/network.hpp"
#include "flow/seepage.hpp"

namespace edda {

/// Force on a corner of a free block of a pressure of 1 Pa at a node, N/Pa; and what the joints
/// that are the node's open where the corner moves, times the thickness: m2 per m.
struct NodeForce {
  Id block, corner, node;
  Vec2 force, opens;
};
/// By block and corner.
std::vector<NodeForce> node_forces(const FlowNetwork& network, const FlowScene& scene);

/// opens M^-1 force times `seconds_squared` over the thickness: how volumes grow in a step whose
/// forces had the pressures, too.
std::vector<Storage::Give> gives_of(const std::vector<NodeForce>& forces, const FlowScene& scene,
                                    const Masses& masses, double seconds_squared);

}  // namespace edda
