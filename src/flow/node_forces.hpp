// How water in joints and blocks move each other in a step (theory, section 13.9.5).
#pragma once

#include <vector>

#include "blocks/masses.hpp"
#include "flow/network.hpp"
#include "flow/seepage.hpp"

namespace edda {

/// Force on a corner of a free block of a pressure of 1 Pa at a node, N/Pa.
struct NodeForce {
  Id block, corner, node;
  Vec2 force;
};
/// By block and corner.
std::vector<NodeForce> node_forces(const FlowNetwork& network, const FlowScene& scene);

/// How the walls at an end of a pipe (Storage::Give) part where a corner of a free block moves.
struct EndOpening {
  Id block, corner, end;
  Vec2 opens;  ///< m per m
};
/// By block and corner.
std::vector<EndOpening> end_openings(const FlowNetwork& network, const FlowScene& scene);

/// opens M^-1 force times `seconds_squared`: how the walls part in a step whose forces had the
/// pressures, too. Both by block and corner.
std::vector<Storage::Give> gives_of(const std::vector<NodeForce>& forces,
                                    const std::vector<EndOpening>& openings, const FlowScene& scene,
                                    const Masses& masses, double seconds_squared);

}  // namespace edda
