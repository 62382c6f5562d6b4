// The result of cutting: one polygon per block, with the joint of every edge.
#pragma once

#include <string>
#include <vector>

#include "base/polygon.hpp"
#include "base/vec2.hpp"
#include "model/model.hpp"

namespace edda {

/// One block as a polygon, before it has mass or motion. Filled by build_polygons().
struct BlockPolygon {
  std::vector<Ring> rings;  ///< [0] the outer ring, counter-clockwise; then holes, clockwise; m,
                            ///< relative to PolygonSet::origin
  std::vector<std::vector<Index>>
      joint;  ///< joint[r][e]: law of the edge from rings[r][e] to the next
              ///< vertex; none where none is named (contact.joint applies)
  std::vector<std::vector<Index>>
      table;  ///< table[r][e]: row of PolygonSet::tables, from which
              ///< the line of that edge comes, or none, as of the outline; empty: all none
  Index material = none;
  bool fixed = false;             ///< it does not move
  Vec2 velocity;                  ///< of the centroid at the start, m/s
  double angular_velocity = 0.0;  ///< rad/s about the centroid
  std::string name;               ///< of a [[block]], else empty
  Where where;                    ///< the table of the model that it comes from
  Index opening = none;           ///< the opening it lies in, for rock that is excavated; for fill
                                  ///< that is, its owner (Owners)
  Index lining = none;            ///< row of Model::linings, if it is one (cutting/linings.hpp)
  Index fill = none;              ///< row of Model::fills, if it is part of one (cutting/fills.hpp)
  bool slow = false;  ///< a sliver that [quality] could not merge: its inertia is raised so that it
                      ///< does not shorten the step
};

/// A sliver that was merged. Model coordinates.
struct MergedSliver {
  Vec2 at;            ///< its centroid
  double area = 0.0;  ///< m2
  std::string joint;  ///< table of the joint on the removed face between it and its neighbour
  double face = 0.0;  ///< m, length of that face
};

/// A sliver that was not merged. Model coordinates.
struct KeptSliver {
  Vec2 at;
  double area = 0.0;  ///< m2
};

/// Report of the cut for the user.
struct CutReport {
  int cut_blocks = 0;         ///< blocks of the domain: the last of PolygonSet::blocks
  int dangling = 0;           ///< ends of joints that end inside a block and were trimmed
  int bridging = 0;           ///< pieces of joint with the same block on both sides, removed
  int merged = 0;             ///< faces thinner than twice `domain.snap`, merged into a neighbour
  int quality_merged = 0;     ///< blocks below [quality], merged into a neighbour
  double quality_area = 0.0;  ///< their area, m2
  std::vector<MergedSliver> merges;  ///< each of them
  std::vector<KeptSliver> kept;      ///< slivers that could not be merged; their inertia is raised
  int slivers = 0;        ///< cut blocks that are still below min_area or thinner than min_edge
  int short_edges = 0;    ///< edges of cut blocks below min_edge
  int sharp_corners = 0;  ///< corners of cut blocks below min_angle
  std::vector<std::string> notes;  ///< what was imported and drawn at random, and what was left out
  std::vector<std::string> left_out;  ///< those of these notes that say what was left out
  std::vector<std::string> warnings;  ///< joints that cut nothing, drawings in doubtful units
  double area_in = 0.0;               ///< of the outline without its openings, m2
  double area_out = 0.0;              ///< sum over the cut blocks, m2
  int snap_rounded = 0;               ///< 1 where the line work had to be snap-rounded
  double smallest_area = 0.0;         ///< m2, over all blocks
  double smallest_edge = 0.0;         ///< m
  double smallest_angle = 0.0;        ///< degrees
  double rounding = 0.0;  ///< m, by which rounded coordinates of given blocks may overlap
  Vec2 smallest_area_at, smallest_edge_at, smallest_angle_at;  ///< model coordinates (origin added)
};

/// All blocks in their final order: [[block]] in file order, walls row by row from the lower left,
/// cut blocks by centroid (y, then x).
struct PolygonSet {
  Vec2 origin;                       ///< model coordinates of the local origin (the model's centre)
  std::vector<BlockPolygon> blocks;  ///< local coordinates
  std::vector<BlockPolygon>
      removed;  ///< rock cut inside openings, ordered like cut blocks; not in `blocks`
  std::vector<std::string> tables;  ///< of the model, from which the lines come that cut blocks:
                                    ///< "joint_set.bedding"
  CutReport report;
  bool reversed = false;  ///< the order of the blocks is reversed (for verification)
};

}  // namespace edda
