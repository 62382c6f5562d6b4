// The joints as a network of pipes for water (theory, section 13.9): each face with an aperture is
// a pipe between two nodes, which are the crossings and the outcrops of joints.
#pragma once

#include <algorithm>
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
  /// A line along which the rock has the head of a water; local coordinates.
  struct HeadLine {
    Vec2 a, b;
    Index water;
  };
  std::vector<HeadLine> heads;
  std::vector<std::vector<Id>> along;  ///< [rows of Model::boundaries] edges on those that go on
                                       ///< as rock: all but tractions of their own
  std::vector<std::uint8_t> open;      ///< [nv] 1: no block is beside the edge, or beside a part
                                       ///< of it; or an opening will be
  std::vector<WetEdge> outside;        ///< water on edges where no joint is, by edge
};
FlowGround flow_ground(const Model& model, const BlockSet& blocks, std::vector<WetEdge> outside);

struct FlowNode {
  Vec2 place;                ///< m, local coordinates
  double conductance = 0.0;  ///< of its pipes together
};

/// The aperture of a joint at a point: what its walls leave open, but within the residual and the
/// largest one; m.
struct Aperture {
  double walls = 0.0, least = 0.0, largest = 0.0;
  double value() const { return std::clamp(walls, least, largest); }
};

/// A face with an aperture, or a part of one.
struct FlowPipe {
  Id face;                    ///< row of the FaceSet
  Id from, to;                ///< nodes on the side of end a, and of end b
  double part_from, part_to;  ///< of the overlap of the face, 0 at end a, 1 at end b
  double length;              ///< m
  double conductance;         ///< m2/s per Pa
  FaceEnds of_to;        ///< of the pressure at `to`, on the side of end a and on that of end b
                         ///< (parts_of_end()); of that at `from` it is the rest of a half
  Aperture aperture[2];  ///< at `from` and at `to`
};
/// What a node has of the volume of a pipe, by weights linear along it, m2: from the apertures at
/// the node and at its other end.
inline double volume_at(const FlowPipe& pipe, double near, double far) {
  return pipe.length * (2.0 * near + far) / 6.0;
}
/// What walls that part so far press out of a pipe (draw in, where they open) goes to the node at
/// which it does work, `to` by f of parts_of_end(): as flow that is not uniform along it does
/// (Reynolds' equation). By how much that is more than what the volumes of the nodes give, m2; by
/// so much less it is for the other node.
inline double drawn_to(const FlowPipe& pipe, FaceEnds opening) {
  return pipe.length *
         ((pipe.of_to.a - 1.0 / 6.0) * opening.a + (pipe.of_to.b - 1.0 / 3.0) * opening.b);
}

/// A part of an edge that a joint with water covers, from the node `from_node` to the other one of
/// the pipe.
struct CoveredPart {
  Id edge;
  double from, to;  ///< its own coordinate s
  Id from_node;
  Id pipe;
};

/// A part of an edge of a free block beside which no block is.
struct OpenPart {
  Id edge;
  double from, to;
  Id void_node;           ///< of an enclosed void, which is one node; no_id: it lies open
  bool wet;               ///< open water may be there: it goes on from where water was drawn
  Id from_node, to_node;  ///< outcrops of joints before and behind it; no_id: the block has none
  double sky = 0.0;       ///< m: its width as seen from above, under the open sky
};

/// A node at the end of what lies open, where the edge has the coordinate s = at.
struct Outcrop {
  Id node, edge;
  double at;
  bool wet;  ///< OpenPart::wet
};

/// A node on the line of heads of a water.
struct HeadNode {
  Id node;
  Index water;
};

struct FlowNetwork {
  std::vector<Id> node_of;      ///< [nv] node of each corner; no_id: no face ends there
  std::vector<FlowNode> nodes;  ///< first those with corners, then those where lines of heads
                                ///< cross a face between its ends
  std::size_t with_corners = 0;
  std::vector<FlowPipe> pipes;
  std::vector<CoveredPart> covered;
  std::vector<OpenPart> open;  ///< but of edges along boundaries that act
  std::vector<Outcrop> outcrops;
  std::vector<HeadNode> heads;
};

/// The blocks, where they are, and their contacts.
struct FlowScene {
  const Model& model;
  const BlockSet& blocks;
  const State& state;
  const Pose& pose;
  const FaceSet& faces;
  const ActiveIntervals& intervals;
};

FlowNetwork flow_network(const FlowScene& scene, const FlowGround& ground);
/// Marks in `ground` the edges of free blocks beside which no block is now, boundaries or not.
void note_open_edges(const FlowScene& scene, FlowGround& ground);

/// Discharge over the difference of pressures of a joint between parallel plates whose aperture is
/// linear between its ends (m), of unit thickness, m2/s per Pa:
///   1 / Int 12 mu/h^3 ds = h_a^2 h_b^2 / (6 mu l (h_a + h_b)),   h^3/(12 mu l) of a uniform one
double conductance_of(double from_aperture, double to_aperture, double length, double viscosity);
/// Along the joint the potential falls as its aperture demands:
///   phi = phi_a + (phi_b - phi_a) f,  f = (h^-2 - h_a^-2)/(h_b^-2 - h_a^-2)
/// Integrals over its length, as a part of it, of f (1 - s) and f s, s from 0 at end a to 1 at end
/// b: 1/6 and 1/3 where the aperture is uniform.
FaceEnds parts_of_end(double a_aperture, double b_aperture);

}  // namespace edda
