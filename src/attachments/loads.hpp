// External loads: forces at points, tractions and pressures along lines, water (theory, sections
// 13.1 and 13.2), and the inertia forces of a shaken frame (13.8).
#pragma once

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <vector>

#include "attachments/bolts.hpp"
#include "base/fault.hpp"
#include "blocks/block_point.hpp"
#include "blocks/initial_stress.hpp"
#include "blocks/pose.hpp"
#include "cutting/polygon_set.hpp"
#include "model/model.hpp"
#include "model/stage_names.hpp"

namespace edda {

/// A force of constant direction on a material point.
struct PointLoad {
  BlockPoint at;
  Vec2 force;  ///< N
  Index load;  ///< row of Model::loads, or that of an owner (keep_wall_forces())
};

/// Traction or pressure on the part of an edge from s = from to s = to (0: its first vertex, 1: its
/// second).
struct EdgeLoad {
  Id edge;
  double from, to;
  Vec2 traction;     ///< N per m of edge as it was at the start
  double pressure;   ///< N per m of edge as it is now, against its outward normal
  Index load;        ///< row of Model::loads, or their number plus the row of Model::boundaries
  EndForces ends{};  ///< N: of constant direction, on the ends of the part
};

/// Forces on the two vertices of an edge that are equivalent to forces at the ends of a part of it.
inline EndForces on_vertices(double from, double to, const EndForces& ends) {
  return {(1.0 - from) * ends.at_from + (1.0 - to) * ends.at_to,
          from * ends.at_from + to * ends.at_to};
}

/// Water on a part of an edge under one straight piece of the table.
struct WetEdge {
  Id edge;
  double from, to;
  double level_from, level_to;  ///< y of the table above the ends of the part, m, local
  /// Row of Model::waters, or beyond them of the water that flows in joints: as it is, and as it
  /// was before what changes gradually began to change.
  Index water;
};

/// Gradual application, in a stage until equilibrium, of all that begins or ends to act at one
/// time.
struct GradualChange {
  std::optional<double> at;  ///< s: that time; none: strength alone changes (Relaxation)
  double part = 1.0;         ///< fraction applied; 1: all
  bool weight = false;       ///< gravity is applied gradually, too
  double least = 0.0;        ///< s: time that it takes at least, where a support is displaced
  /// Periods of the motion that it takes, times the square root of the factor by which inertia is
  /// raised, where it is; 0: one period in any case.
  double periods = 0.0;
  double settling = 0.0;  ///< periods of the motion that the model settles before any is applied

  /// Whether the weight comes first, in the first half, and supports move on it in the second.
  bool weight_first() const { return weight && least > 0.0; }
  double of_weight() const {
    return !weight ? 1.0 : weight_first() ? std::min(1.0, 2.0 * part) : part;
  }
  /// The same as supports feel it: their velocity does not jump.
  GradualChange of_supports() const {
    GradualChange smooth = *this;
    const double s = weight_first() ? std::max(0.0, 2.0 * part - 1.0) : part;
    smooth.part = s * s * (3.0 - 2.0 * s);
    return smooth;
  }
  /// s, in which supports move; 0: none does at present.
  double time_of_supports() const {
    if (part >= 1.0 || (weight_first() && part < 0.5)) return 0.0;
    return weight_first() ? 0.5 * least : least;
  }
};

/// The interval in which something is active, s. At the instant of a jump it counts half, so that a
/// leapfrog, whose step extends to both sides of this instant, begins and ends it at the right
/// time.
struct ActiveInterval {
  double since = 0.0;  ///< histories count from here; infinite: not active yet
  double until = std::numeric_limits<double>::infinity();
  bool acts() const { return std::isfinite(since) && !std::isfinite(until); }
  double part(double time) const {
    if (time < since || time > until) return 0.0;
    return (time == since && since > 0.0) || time == until ? 0.5 : 1.0;
  }
  double part(double time, const GradualChange& gradual) const {
    if (gradual.part < 1.0 && until == gradual.at) return 1.0 - gradual.part;
    return gradual.part < 1.0 && since == gradual.at && time <= until ? gradual.part : part(time);
  }
};

/// The active intervals of everything that stages may activate or deactivate.
struct ActiveIntervals {
  std::vector<ActiveInterval> loads;       ///< [rows of Model::loads]
  std::vector<ActiveInterval> waters;      ///< [rows of Model::waters]
  std::vector<ActiveInterval> boundaries;  ///< [rows of Model::boundaries]
  std::vector<ActiveInterval> shakings;    ///< [rows of Model::shakings]
};

/// A number that changes at one time: what it is from then on, and what it was before.
struct SteppedValue {
  double value = 0.0, before = 0.0;
  double changed = -1.0;  ///< s
  double at(double time) const { return time == changed ? 0.5 * (before + value) : value; }
  double at(double time, const GradualChange& gradual) const {
    return gradual.part < 1.0 && changed == gradual.at ? before + gradual.part * (value - before)
                                                       : at(time);
  }
  /// Ends a gradual change at what it has reached.
  void stop(double time, const GradualChange& gradual) {
    if (gradual.part < 1.0 && changed == gradual.at) value = before = at(time, gradual);
  }
  void change(double to, double time) { *this = {to, time == changed ? before : value, time}; }
};

/// What ramps and the trials of a factor have made of gravity and of the loads that the model gives
/// (theory, section 11.5).
struct SlowLoading {
  SteppedValue kh, kv;                       ///< seismic coefficients
  SteppedValue tilt;                         ///< degrees
  SteppedValue kh_back, kv_back, tilt_back;  ///< the same to the left and downwards
  SteppedValue gravity{1., 1.};              ///< multiplier of the weight
  SteppedValue flow;                         ///< s, time of the flow in joints
  SteppedValue change;  ///< part of the changes of joint laws of the present stage
  SteppedValue time;    ///< s, time of joints in the ramp of the present stage
  /// Multipliers, [rows of Model::loads], of Model::waters and of Model::boundaries.
  std::vector<SteppedValue> loads, waters, boundaries;
};

/// Gravity g (m/s2) turned by the tilt and changed by the seismic coefficients (forces of that part
/// of the weight to the right of g, seen with g downwards, and against it), times its multiplier.
Vec2 gravity_at(Vec2 g, const SlowLoading& slow, double time, const GradualChange& gradual);

/// The value of what a ramp or the trials of a factor vary (`target`: row of the model's loads,
/// waters or boundaries, or `backwards`); null for strength and ground motions, which are none of
/// these.
SteppedValue* slow_value(SlowLoading& slow, Varied varied, Index target);
/// The interval in which that load, water or boundary is active; null for all others.
ActiveInterval* interval_of(ActiveIntervals& intervals, Varied varied, Index target);

/// How water in joints follows their motion: it has all the time it needs; it has that of
/// SlowLoading::flow; or its pressures stay what they are.
enum class JointFlow : std::uint8_t { steady, timed, held };

/// All loads, each list sorted by block, on free blocks.
struct Loads {
  std::vector<PointLoad> points;
  std::vector<EdgeLoad> edges;
  std::vector<WetEdge> wet;
  std::vector<WetZone> wet_zones;  ///< by zone
  double in_joints = 0.0;          ///< N/m2: unit weight times thickness of what flows there
  std::vector<Id> blocks;          ///< blocks that carry any, ascending
  struct Range {
    Id point_begin, point_end, edge_begin, edge_end, wet_begin, wet_end;
  };
  std::vector<Range> range;  ///< [blocks]
  std::vector<Id> place;     ///< [nb] index into `blocks`, or no_id; empty where there are none
  JointFlow flow = JointFlow::steady;
  ActiveIntervals intervals;
  std::vector<SteppedValue> remaining;  ///< [owners] fraction of wall forces that still acts; an
                                        ///< owner: see WallForce
  SlowLoading slow;
  GradualChange gradual;
};

/// Loads at one time.
struct LoadsNow {
  const Loads* loads = nullptr;  ///< null: there are none
  std::vector<double> factor;    ///< [rows of Model::loads, those of Model::boundaries, owners]
  // [rows of Model::waters, and of a model with flow two of the water in joints: see WetEdge]
  std::vector<double> rise;      ///< m
  std::vector<double> weight;    ///< unit weight times thickness, N/m2
  const Bolts* bolts = nullptr;  ///< with their forces at this time; null: there are none
  Vec2 frame;                    ///< m/s2: acceleration of the frame; all blocks feel its opposite
  Vec2 to_come;  ///< m/s2: gravity of the model less the present one, which is applied gradually
                 ///< (GradualChange::weight) or changed (SlowLoading)
  /// What is to be subtracted from gravity.
  Vec2 gravity_reduction() const { return frame + to_come; }
};

/// Finds the points and faces on which the loads, waters and boundaries of type stress act. A load
/// without any is a fault.
Result<Loads> attach_loads(const Model& model, const PolygonSet& polygons, const BlockSet& blocks);

/// Level of a water at x (m, local coordinates, as the level).
double level_of(const Water& water, Vec2 origin, double x);
/// Replaces the water on edges.
void put_water(const BlockSet& blocks, std::vector<WetEdge> wet, Loads& loads);

/// Adds loads on faces to the lists.
void add_edge_loads(const BlockSet& blocks, const std::vector<EdgeLoad>& more, Loads& loads);

/// A force on a vertex, N, of something that is no longer there: excavated rock or fill, or a
/// boundary that another took over from. Its owner determines the fraction that still acts
/// (Loads::remaining; Owners).
struct WallForce {
  Id vertex;
  Vec2 force;
  Index owner;
};

/// Adds these forces to the loads; Loads::remaining has the fractions that act.
void keep_wall_forces(const Model& model, const BlockSet& blocks,
                      const std::vector<WallForce>& forces, Loads& loads);
/// Removes the forces of one owner.
void remove_wall_forces(const Model& model, const BlockSet& blocks, Index owner, Loads& loads);

/// The factor on the displacement of a boundary at one time: its history times its multiplier,
/// which has been 0 until the boundary began to act, and changes gradually without a jump of the
/// velocity.
double displacement_factor(const Model& model, const Loads& loads, std::size_t row, double time);

/// Velocity of the frame that ground motions of kind "inertia" shake, m/s: the integral of their
/// accelerations, each since it was activated.
Vec2 frame_velocity(const Model& model, const ActiveIntervals& intervals, double time);

LoadsNow loads_at(const Model& model, const Loads& loads, double time);
/// The waters of the model alone, as they are once all that changes gradually has changed.
LoadsNow waters_at(const Model& model, const Loads& loads, double time);

/// Adds the loads on a block, its vertices at `x`, `y`, to the forces on it, N. Water: pressure
/// gamma (level + rise - y) on each edge where that is positive.
void add_loads(BlockForces& on, const LoadsNow& now, const std::vector<double>& x,
               const std::vector<double>& y);

/// Forces of the water on the part from s = from to s = to of a face, at the ends of that part; its
/// vertices at `x`, `y`.
EndForces water_on(const BlockSet& blocks, const LoadsNow& now, const std::vector<double>& x,
                   const std::vector<double>& y, Id edge, double from, double to);

/// Resultant of the loads on block i at the pose, N.
Vec2 load_on(const BlockSet& blocks, const LoadsNow& now, const Pose& pose, std::size_t i);

}  // namespace edda
