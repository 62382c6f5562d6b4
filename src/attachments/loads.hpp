// Loads from outside: forces at points, tractions and pressures along lines, water, and the inertia
// of a ground that shakes.
#pragma once

#include <array>
#include <cmath>
#include <limits>
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
  Index load;                    ///< row of Model::loads, or that of a keeper (keep_forces())
};

/// Traction or pressure on the part of an edge from s = from to s = to (0: its first vertex, 1: its
/// second).
struct EdgeLoad {
  Id edge;
  double from, to;
  Vec2 traction;     ///< N per m of edge as it was at the start
  double pressure;   ///< N per m of edge as it is, against its outward normal
  Index load;        ///< row of Model::loads, or their number and the row of Model::boundaries
  EndForces ends{};  ///< N: of constant direction, on the ends of the part
};

/// What the forces at the ends of a part are on the two vertices of its edge.
inline EndForces on_vertices(double from, double to, const EndForces& ends) {
  return {(1.0 - from) * ends.at_from + (1.0 - to) * ends.at_to,
          from * ends.at_from + to * ends.at_to};
}

/// Water on a part of an edge, over which the table is straight.
struct WetEdge {
  Id edge;
  double from, to;
  double level_from, level_to;  ///< y of the table above the ends of the part, m, local
  Index water;                  ///< row of Model::waters
};

/// What comes and goes little by little in a stage until equilibrium, in place of at once: whatever
/// begins or ends to act at one time.
struct GentleChange {
  double at = -1.0;     ///< s: that time
  double part = 1.0;    ///< of it that has come; 1: all
  bool weight = false;  ///< gravity itself comes so
};

/// When something acts, s. At the instant of a jump its part is the mean of both sides, so that a
/// leapfrog that has this instant amid its step begins and ends where it should.
struct Spell {
  double since = 0.0;  ///< histories run from here; infinite: it does not act yet
  double until = std::numeric_limits<double>::infinity();
  bool acts() const { return std::isfinite(since) && !std::isfinite(until); }
  double part(double time) const {
    if (time < since || time > until) return 0.0;
    return (time == since && since > 0.0) || time == until ? 0.5 : 1.0;
  }
  double part(double time, const GentleChange& gentle) const {
    if (gentle.part < 1.0 && until == gentle.at) return 1.0 - gentle.part;
    return gentle.part < 1.0 && since == gentle.at && time <= until ? gentle.part : part(time);
  }
};

/// Of what stages may switch on and off.
struct Spells {
  std::vector<Spell> loads;       ///< [rows of Model::loads]
  std::vector<Spell> waters;      ///< [rows of Model::waters]
  std::vector<Spell> boundaries;  ///< [rows of Model::boundaries]
  std::vector<Spell> shakings;    ///< [rows of Model::shakings]
};

/// How much of the forces on a keeper (see KeptForce) is still there: now, and before the last
/// change.
struct Hold {
  double part = 0.0, before = 0.0;
  double changed = -1.0;  ///< s
  double at(double time) const { return time == changed ? 0.5 * (before + part) : part; }
  double at(double time, const GentleChange& gentle) const {
    return gentle.part < 1.0 && changed == gentle.at ? before + gentle.part * (part - before)
                                                     : at(time);
  }
  void change(double to, double time) { *this = {to, time == changed ? before : part, time}; }
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
  Spells spells;
  std::vector<Hold> held;  ///< [keepers]
  GentleChange gentle;
};

/// Loads as they act at one time.
struct LoadsNow {
  const Loads* loads = nullptr;  ///< null: there are none
  std::vector<double> factor;    ///< [rows of Model::loads, those of Model::boundaries, keepers]
  std::vector<double> rise;      ///< [rows of Model::waters] m
  std::vector<double> weight;    ///< [rows of Model::waters] N/m3 times thickness
  const Bolts* bolts = nullptr;  ///< with their forces at this time; null: there are none
  const std::vector<std::array<Vec2, 3>>* on_nodes =
      nullptr;   ///< [nb] N, of contacts at points (contacts/points.hpp); null: contacts are faces
  Vec2 frame;    ///< m/s2: acceleration of the ground that all blocks feel backwards
  Vec2 to_come;  ///< m/s2: what of gravity has not come yet (GentleChange::weight)
  /// What gravity is less by.
  Vec2 less_gravity() const { return frame + to_come; }
};

/// Finds what the loads, waters and boundaries of type stress act on. One that finds nothing is a
/// fault.
Result<Loads> attach_loads(const Model& model, const PolygonSet& polygons, const BlockSet& blocks);

/// Adds loads on faces to the lists.
void add_edge_loads(const BlockSet& blocks, const std::vector<EdgeLoad>& more, Loads& loads);

/// A force on a vertex, N, of something that has gone: rock taken out, or a boundary that another
/// has taken over from. Its keeper says how much of it is still there: a row of Model::openings, or
/// their number and the row of the Model::boundaries that took over.
struct KeptForce {
  Id vertex;
  Vec2 force;
  Index keeper;
};

/// Puts these forces among the loads, of which the part Loads::held is there.
void keep_forces(const Model& model, const BlockSet& blocks, const std::vector<KeptForce>& forces,
                 Loads& loads);
/// Takes those on one keeper out again.
void drop_forces(const Model& model, const BlockSet& blocks, Index keeper, Loads& loads);

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
