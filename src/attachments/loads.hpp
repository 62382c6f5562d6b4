// Loads from outside: forces at points, tractions and pressures along lines, water, and the inertia
// of a ground that shakes.
#pragma once

#include <array>
#include <vector>

#include "attachments/bolts.hpp"
#include "base/fault.hpp"
#include "blocks/initial_stress.hpp"
#include "blocks/pose.hpp"
#include "lines/polygon_set.hpp"
#include "model/model.hpp"

namespace edda {

/// A force of constant direction on a material point.
struct PointLoad {
  Id block;
  std::array<double, 3> weight;  ///< of the point
  Vec2 force;                    ///< N
  Index load;                    ///< row of Model::loads, or as of an EdgeLoad
};

/// Traction or pressure on the part of an edge from s = from to s = to (0: its first vertex, 1: its
/// second).
struct EdgeLoad {
  Id edge;
  double from, to;
  Vec2 traction;    ///< N per m of edge as it was at the start
  double pressure;  ///< N per m of edge as it is, against its outward normal
  Index load;       ///< row of Model::loads, or their number and the row of Model::boundaries
};

/// Water on a part of an edge, over which the table is straight.
struct WetEdge {
  Id edge;
  double from, to;
  double level_from, level_to;  ///< y of the table above the ends of the part, m, local
  Index water;                  ///< row of Model::waters
};

/// When what stages may switch on began to act, s: histories run from there. Infinite: it does not
/// act.
struct ActiveSince {
  std::vector<double> boundaries;  ///< [rows of Model::boundaries]
  std::vector<double> shakings;    ///< [rows of Model::shakings]
};

/// All of them, each list sorted by block, on blocks that are not held.
struct Loads {
  std::vector<PointLoad> points;
  std::vector<EdgeLoad> edges;
  std::vector<WetEdge> wet;
  std::vector<Id> blocks;  ///< that carry any, ascending
  struct Range {
    Id point_begin, point_end, edge_begin, edge_end, wet_begin, wet_end;
  };
  std::vector<Range> range;  ///< [blocks]
  std::vector<Id> place;     ///< [nb] index into `blocks`, or no_id; empty where there are none
  ActiveSince since;
};

/// Loads as they act at one time.
struct LoadsNow {
  const Loads* loads = nullptr;  ///< null: there are none
  std::vector<double> factor;    ///< [rows of Model::loads, then those of Model::boundaries]
  std::vector<double> rise;      ///< [rows of Model::waters] m
  std::vector<double> weight;    ///< [rows of Model::waters] N/m3 times thickness
  const Bolts* bolts = nullptr;  ///< with their forces at this time; null: there are none
  Vec2 frame;  ///< m/s2: acceleration of the ground that all blocks feel backwards
};

/// Finds what the loads, waters and boundaries of type stress act on. One that finds nothing is a
/// fault.
Result<Loads> attach_loads(const Model& model, const PolygonSet& polygons, const BlockSet& blocks);

/// Adds loads on points to the lists.
void add_point_loads(const BlockSet& blocks, const std::vector<PointLoad>& more, Loads& loads);

LoadsNow loads_at(const Model& model, const Loads& loads, double time);

/// Adds what acts on block i, its vertices at `x`, `y`, to the forces on its nodes, N. Water:
/// gamma (level + rise - y) across each edge where that is positive.
void add_loads(std::array<Vec2, 3>& on_nodes, const BlockSet& blocks, const LoadsNow& now,
               const std::vector<double>& x, const std::vector<double>& y, std::size_t i);

/// What the water on the part from s = from to s = to of a face does, as forces on the ends of that
/// part; its vertices at `x`, `y`.
EndForces water_on(const BlockSet& blocks, const LoadsNow& now, const std::vector<double>& x,
                   const std::vector<double>& y, Id edge, double from, double to);

/// Their resultant on block i at the pose, N.
Vec2 load_on(const BlockSet& blocks, const LoadsNow& now, const Pose& pose, std::size_t i);

}  // namespace edda
