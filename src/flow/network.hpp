// The joints as a network of pipes for water (theory, section 13.9): each face with an aperture is
// a pipe between two nodes, which are the crossings and the outcrops of joints.
#pragma once

#include <cstdint>
#include <vector>

#include "attachments/loads.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"

namespace edda {

/// What water meets in a model, as drawn.
struct FlowGround {
  double snap = 0.0;  ///< m: what is nearer to a line lies on it
  std::vector<std::uint8_t>
      supported;  ///< [nv] 1: the edge lies along a boundary, where the rock goes on
  /// A line along which the rock has the head of a water; local coordinates.
  struct HeadLine {
    Vec2 a, b;
    Index water;
  };
  std::vector<HeadLine> heads;
  std::vector<WetEdge> outside;  ///< water on faces of blocks beside joints, by edge
};
FlowGround flow_ground(const Model& model, const BlockSet& blocks, std::vector<WetEdge> outside);

struct FlowNode {
  Vec2 place;  ///< m, local coordinates
  // An open part of an edge beside it, if there is one.
  Id edge = no_id;
  double at = 0.0;           ///< its own coordinate s there
  Index water = none;        ///< on whose line of heads it lies
  double conductance = 0.0;  ///< of its pipes together
};

/// A face with an aperture, or a part of one.
struct FlowPipe {
  Id face;                            ///< row of the FaceSet
  Id from, to;                        ///< nodes on the side of end a, and of end b
  double part_from, part_to;          ///< of the overlap of the face, 0 at end a, 1 at end b
  double length;                      ///< m
  double from_aperture, to_aperture;  ///< m
  double conductance;                 ///< m2/s per Pa
};

/// A part of an edge that a face covers.
struct CoveredPart {
  Id edge;
  double from, to;        ///< its own coordinate s
  Id from_node, to_node;  ///< no_id: no water flows along it
  Id pipe;                ///< or no_id
};

/// A part of an edge beside which no block is.
struct OpenPart {
  Id edge;
  double from, to;
};

struct FlowNetwork {
  std::vector<Id> node_of;  ///< [nv] node of each corner; no_id: no face ends there
  std::vector<FlowNode> nodes;
  std::vector<FlowPipe> pipes;
  std::vector<CoveredPart> covered;  ///< by edge, and along it
  std::vector<OpenPart> open;        ///< the other parts of edges of free blocks, by edge
};

/// The blocks, where they are, and their contacts.
struct FlowScene {
  const Model& model;
  const BlockSet& blocks;
  const State& state;
  const Pose& pose;
  const FaceSet& faces;
};

/// acts: [rows of Model::waters] 1: the head along its lines holds at present.
FlowNetwork flow_network(const FlowScene& scene, const FlowGround& ground,
                         const std::vector<std::uint8_t>& acts);

/// Discharge over the difference of pressures of a joint between parallel plates whose aperture is
/// linear between its ends (m), of unit thickness, m2/s per Pa:
///   1 / Int 12 mu/h^3 ds = h_a^2 h_b^2 / (6 mu l (h_a + h_b)),   h^3/(12 mu l) of a uniform one
double conductance_of(double from_aperture, double to_aperture, double length, double viscosity);

}  // namespace edda
