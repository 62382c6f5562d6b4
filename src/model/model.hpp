// The model as read: plain, constant, in SI units (angles in degrees, as written). Every reference
// by name is already an index, every default filled in, every range checked. Built by read_model().
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <numbers>
#include <optional>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/polygon.hpp"
#include "base/vec2.hpp"
#include "model/geometry_inputs.hpp"
#include "model/key_places.hpp"
#include "model/run_inputs.hpp"

namespace edda {

enum class Plane { strain, stress };
enum class ContactModel { faces, points };
enum class LawType { coulomb, glued, slip_weakening, barton_bandis };
enum class BoundaryType { fixed, roller, viscous, stress, velocity, free_field, displacement };
enum class AccelerationUnit { as_stated, m_s2, g, cm_s2, gal, mm_s2 };
enum class ShakingKind { base, inertia, upgoing };
enum class BoltType { grouted, end };
enum class SurfaceKind { level, outline };

/// Three numbers, such as the components xx, yy and xy of a stress.
using Triple = std::array<double, 3>;

/// Strength of intact rock.
struct RockStrength {
  double ucs = 0.0;      ///< Pa, uniaxial compressive
  double tension = 0.0;  ///< Pa, tensile
};

/// Shear and tensile strength of a joint.
struct Strength {
  double friction_angle = 0.0;    ///< degrees
  double cohesion = 0.0;          ///< Pa
  double tensile_strength = 0.0;  ///< Pa
};

/// Strength of a rock mass after Mohr and Coulomb (friction_angle and cohesion) or Hoek and Brown
/// (ucs, and gsi with mi or m with s), with a tension cut-off.
struct RockMass {
  std::optional<double> friction_angle, dilation_angle;  ///< degrees; dilation empty: 0
  std::optional<double> cohesion;                        ///< Pa
  std::optional<double> tensile_strength;  ///< Pa; empty: 0, or s ucs/m of Hoek and Brown
  std::optional<double> ucs;               ///< Pa, of the intact rock
  std::optional<double> gsi, mi, disturbance;
  std::optional<double> m, s, a;  ///< of the rock mass, in place of gsi and mi; a empty: 0.5
};

/// Where rock yields, in zones.
struct Yield {
  RockMass peak;
  std::optional<RockMass> residual;     ///< what is left out is as at the peak
  std::optional<double> slip_distance;  ///< m, of a band of shear, from the peak to the residual
  /// The residual strength with what it has from the peak.
  RockMass after() const;
};

/// Planes of weakness of one direction throughout a material (foliation, ubiquitous joints).
struct FoliationInputs {
  double angle = 0.0;  ///< degrees, of their trace from +x
  // Elasticity across the planes; all empty: isotropic.
  std::optional<double> young, shear_modulus;  ///< Pa
  std::optional<double> poisson;
  // Their strength; friction_angle empty: as the rock's.
  std::optional<double> friction_angle, dilation_angle;  ///< degrees; dilation empty: 0
  std::optional<double> cohesion, tensile_strength;      ///< Pa; empty: 0
  bool is_elastic() const { return young || shear_modulus || poisson; }
  bool operator==(const FoliationInputs&) const = default;
};

struct Material {
  std::string name;
  double density = 0.0;  ///< kg/m3
  double young = 0.0;    ///< Pa
  double poisson = 0.0;
  Where where;
  std::optional<RockStrength> strength{};
  std::optional<Yield> yield{};
  std::optional<FoliationInputs> foliation{};
  std::optional<double> zone_size{};  ///< m; empty: that of [zones]
  BlockDeformation deformation = BlockDeformation::automatic;
  bool pore_pressure = true;  ///< of the water in the pores of its zones
  double damping =
      0.5;  ///< strain damping, as a fraction of critical in the lowest mode of a block
  std::optional<Rayleigh> rayleigh{};  ///< in place of `damping` and of Damping::rayleigh
  bool deforms_as(const Material& other) const {
    return density == other.density && young == other.young && poisson == other.poisson &&
           foliation == other.foliation && damping == other.damping && rayleigh == other.rayleigh &&
           pore_pressure == other.pore_pressure && deformation == other.deformation;
  }
  /// Whether rock of this material may become rock of another: only its strength in zones changes.
  bool may_weather_to(const Material& other) const {
    return deforms_as(other) && yield && other.yield;
  }
};

/// Restitution of an impact (theory, section 9.7): a fraction of the velocity, or, for a rocking
/// block, what follows from Housner's assumption (the striking corner stays on the ground).
struct Restitution {
  bool housner = false;
  double part = 0.0;  ///< of the normal velocity of a flat impact
};

/// Springs and dashpots that give a contact law its restitution (step/restitution.hpp).
struct LawDashpots {
  double damping = 0.0, shear_damping = 0.0;  ///< fractions of critical of a contact
  double spring = 0.0;   ///< N/m per metre of thickness, of contacts without kn
  double rebound = 0.0;  ///< of dashpots in proportion to the pressure; 0: they are linear
};

/// How joints of one law have come to have another, where they do not have it as it is given: they
/// change gradually, or it decays from then on. Not a key: found from the changes of stages.
struct LawChange {
  Index from = none;      ///< none: they have changed at once
  Index to = none;        ///< a law that the model gives
  std::size_t stage = 0;  ///< at whose start they begin to change
  double over = 0.0;      ///< s, of that stage; 0: by its ramp
};

/// The contact law of a joint (theory, section 5).
struct JointLaw {
  std::string name;
  LawType type = LawType::coulomb;
  Strength peak;      ///< of a bonded contact
  Strength residual;  ///< after failure, and of every contact not closed at the start
  std::optional<double> dilation_angle;  ///< degrees; coulomb, slip-weakening
  std::optional<double> slip_distance;   ///< m: from peak to residual; coulomb: of dilation
  /// J/m2, of tension and of shear; coulomb
  std::optional<double> fracture_energy, shear_fracture_energy;
  std::optional<double> jrc, jcs;  ///< roughness (-), strength of the walls (Pa); barton-bandis
  std::optional<double> residual_angle;  ///< degrees; barton-bandis
  std::optional<double> decay_time;      ///< s: in which 1 - 1/e of peak less residual is lost
  std::optional<double> kn;              ///< Pa/m; without it a penalty (contact_springs.hpp)
  std::optional<double> ks;        ///< Pa/m; filled with 0.4 kn where kn is given and ks is not
  std::optional<double> aperture;  ///< m, as drawn, of [flow]; 0: watertight
  std::optional<double> residual_aperture;  ///< m: the least; empty: a tenth of it
  std::optional<double> largest_aperture;   ///< m, for its discharge; empty: ten times as much
  std::optional<Restitution> restitution;
  std::optional<LawDashpots> dashpots{};  ///< not a key: found from `restitution`
  std::optional<LawChange> change{};      ///< of laws that stages add, the last of Model::joints
  Where where;
};

struct ContactDefaults {
  ContactModel model = ContactModel::faces;
  // Springs at each end of a face, Pa (N/m per metre of thickness); none: they follow from the
  // blocks (model/contact_springs.hpp).
  std::optional<double> normal_stiffness, shear_stiffness;
  double stiffer = 1.0;     ///< not a key: by what those that follow from the blocks are multiplied
  double close_gaps = 0.0;  ///< m: joints of given blocks drawn up to so wide are closed
  Index joint = none;  ///< law of contacts whose edges name none; none only if no law is needed
  Where where;
};

/// [[block]]
struct BlockInput {
  std::string name;  ///< empty if none was given
  Ring polygon;      ///< either orientation, as written
  Index material = none;
  Index joint = none;  ///< law of its edges, or none
  bool fixed = false;
  Vec2 velocity;                  ///< m/s
  double angular_velocity = 0.0;  ///< rad/s
  Where where;
};

/// A curve over time from a file, linear between its rows, constant before the first and after the
/// last.
struct TimeHistory {
  std::vector<double> time;  ///< s, ascending; empty: none was given
  std::vector<double> value;
  /// At t, or `otherwise` where none was given.
  double at(double t, double otherwise) const;
};

/// [[boundary]]
struct Boundary {
  std::string name;
  BoundaryType type = BoundaryType::fixed;
  std::vector<std::string>
      sides;                ///< of "left", "right", "bottom", "top"; empty where `along` is given
  std::vector<Vec2> along;  ///< polyline
  /// Pa: spring per block vertex on it; fixed, roller, velocity, displacement; empty: as the joints
  /// of its block
  std::optional<double> stiffness;
  std::optional<Vec2>
      traction;  ///< Pa, on the edges along it; stress; empty: that of the initial stress
  std::optional<Vec2> velocity;      ///< m/s; velocity
  std::optional<Vec2> displacement;  ///< m, from the start; displacement
  bool frictionless = false;         ///< springs across the line only; velocity, displacement
  std::optional<Vec2> wave_speeds;   ///< m/s, P and S; viscous; empty: the rock's own
  std::string history;               ///< path of a file of time, factor; stress, velocity,
                                     ///< displacement
  TimeHistory factor;
  Where where;
  /// Whether its springs act across its line only.
  bool slides() const { return type == BoundaryType::roller || frictionless; }
};

/// Acceleration of the ground over time: linear between its rows, zero before the first and after
/// the last. The velocity is its integral
/// from the first row on.
struct Accelerogram {
  std::vector<double> time;        ///< s, ascending
  std::vector<Vec2> acceleration;  ///< m/s2
  std::vector<Vec2> velocity;      ///< m/s
  std::string read_as;             ///< what the file was taken for, with its unit; for reports
  bool unit_known = false;         ///< the file or the model states the unit of its accelerations
};

/// Where an acceleration comes from: a file, or a sine.
struct Acceleration {
  std::string file;                 ///< path; empty: a sine
  std::optional<double> amplitude;  ///< m/s2
  std::optional<double> frequency;  ///< Hz
  Vec2 direction{1.0, 0.0};         ///< of the sine; its length does not matter
};

/// [[shaking]]
struct Shaking {
  std::string name;
  Acceleration acceleration;
  Vec2 direction{1.0, 0.0};  ///< of a file that has one component; its length does not matter
  AccelerationUnit units = AccelerationUnit::as_stated;  ///< of the file
  int component = 1;                                     ///< of a record that has several, from 1
  double scale = 1.0;
  ShakingKind apply = ShakingKind::base;
  std::string boundary;  ///< upgoing: name of the viscous boundary that the wave comes in through
  Index enters = none;   ///< its row
  Accelerogram record;   ///< of the file
  Where where;
};

/// [initial_stress]: either stress at a level with its gradient, or the weight of the rock above
/// with k0. Stresses are total, positive in tension.
struct InitialStress {
  std::optional<Triple> stress;     ///< Pa, xx, yy and xy at y = at_y
  std::optional<double> at_y;       ///< m; with stress, filled with 0
  std::optional<Triple> gradient;   ///< Pa per metre of y; with stress, filled with 0
  std::optional<double> k0;         ///< xx / yy
  std::optional<double> k0_out;     ///< zz / yy; empty: k0, or nu (xx + yy) where stress is given
  std::optional<double> surface_y;  ///< m
  SurfaceKind surface = SurfaceKind::level;  ///< level: at surface_y
  Where where;
};

/// [[load]]: a force at a point, a traction or pressure on the edges along a line, or a body force
/// in a region.
struct Load {
  std::string name;
  std::optional<Vec2> point;       ///< either this, `along` or `within`
  std::vector<Vec2> along;         ///< polyline
  std::vector<Vec2> within;        ///< polygon
  std::optional<Vec2> force;       ///< N; on a line Pa
  std::optional<double> pressure;  ///< Pa, across the edge and into the block
  std::optional<Vec2> body_force;  ///< N/m3, on all blocks whose centroids lie in `within`
  std::string history;             ///< path of a file of time, factor
  TimeHistory factor;
  Where where;
};

/// [[water]]: hydrostatic pressure in joints and on faces below a table; of a model with [flow] on
/// faces outside its joints, and the head along lines of the rock.
struct Water {
  std::string name;
  std::vector<Vec2> table;           ///< from left to right; either this or `level`
  std::optional<double> level;       ///< m
  std::optional<double> rain;        ///< m/s; in place of either
  std::optional<double> injection;   ///< m2/s into the joints, in place of either, at
  std::optional<Vec2> at;            ///< their crossing nearest to it
  std::vector<std::string> sides;    ///< where the rock has this head, or
  std::vector<Vec2> along;           ///< the polyline along which it has
  std::vector<std::string> flooded;  ///< flooded openings
  double unit_weight = 9810.0;       ///< N/m3
  std::string history;               ///< path of a file of time, rise (m)
  TimeHistory rise;
  Where where;
};

/// [flow]: water that flows through the joints.
struct FlowInputs {
  double viscosity = 1e-3;      ///< Pa s
  double bulk_modulus = 2.2e9;  ///< Pa
  Where where;
};

/// Grout along a bolt: elastic up to its strength, perfectly plastic beyond it.
struct BoltBond {
  double stiffness = 0.0;  ///< Pa, that is N/m per metre of bolt
  double strength = 0.0;   ///< N/m
};

/// A bolt sheared by a joint: elastic up to its strength, perfectly plastic beyond it. Both are
/// given, or follow from the bar and from what it is bedded in.
struct BoltDowel {
  std::optional<double> stiffness{};           ///< N/m
  std::optional<double> strength{};            ///< N
  std::optional<double> bearing_strength{};    ///< Pa; empty: the ucs of the rock
  std::optional<double> foundation_modulus{};  ///< Pa; empty: Young's modulus of the rock
  bool of_bar() const { return !stiffness && !strength; }
};

/// [[bolt]], per bolt and not per metre of thickness.
struct Bolt {
  std::string name;
  Vec2 from, to;
  BoltType type = BoltType::grouted;
  double diameter = 0.0;                 ///< m
  double young = 200e9;                  ///< Pa
  std::optional<double> yield_stress;    ///< Pa; empty: never yields
  std::optional<double> rupture_strain;  ///< empty: never breaks
  double spacing = 1.0;                  ///< m, out of plane
  double pretension = 0.0;               ///< N
  BoltBond bond;                         ///< between bolt and rock along the bolt
  std::optional<BoltDowel> dowel;        ///< across the bolt, where it crosses a joint
  Where where;
};

/// [[bolt_pattern]]: bolts from the outline of an opening outwards, away from its centroid.
struct BoltPattern {
  std::string name;
  std::string opening;
  double from_angle = 0.0, to_angle = 0.0;  ///< degrees, counter-clockwise from +x
  int count = 0;
  double length = 0.0;  ///< m
  Bolt bolt;            ///< all that they have in common
  Where where;
};

/// Strengths of a section of a lining once it has yielded; empty: as before.
struct LiningResidual {
  std::optional<double> compressive_strength{}, tensile_strength{};  ///< Pa
};

/// [[lining]]: shotcrete, concrete or steel sets, a chain of beams along a line. Per metre of
/// thickness of the model, but area and inertia, which are those of one steel set.
struct Lining {
  std::string name;
  std::string opening;                         ///< on whose outline it is, or
  std::string on;                              ///< the lining on whose inner side it is, or
  std::optional<double> from_angle, to_angle;  ///< degrees; part of it; both empty: all of it
  std::vector<Vec2> along;                     ///< a line on whose left it is
  Index material = none;
  std::optional<double> thickness;      ///< m
  std::optional<double> area, inertia;  ///< m2 and m4, of a steel set
  double spacing = 1.0;                 ///< m, out of plane, of steel sets
  // Strength; empty: it stays elastic.
  std::optional<double> compressive_strength;  ///< Pa
  std::optional<double> tensile_strength;      ///< Pa; empty: 0, of a steel set as in compression
  std::optional<LiningResidual> residual;      ///< empty: the strength does not fall
  std::optional<double> plastic_moment;        ///< N m, of a steel set; empty: of the solid section
  std::optional<double> size;                  ///< m, of its pieces; empty: "auto"
  Index interface = none;                      ///< law of its faces
  Where where;
  /// Thickness of the strip that stands for it: of steel sets that of a solid section with their
  /// area and inertia, m.
  double drawn_thickness() const;
  /// Its mass over that of the solid strip.
  double solidity() const;
};

/// [[fill]]: blocks that a stage places: paste, rock fill, concrete or masonry.
struct Fill {
  std::string name;
  std::string opening;         ///< whose room it takes, or
  Ring polygon;                ///< its own outline
  std::optional<double> lift;  ///< m, height of the layers that it is divided into
  Index material = none;
  Index joint = none;  ///< law of its faces
  Where where;
};

struct Monitor {
  std::string name;
  Vec2 point;
  Where where;
};

/// [[convergence]]: decrease of the distance between two material points.
struct Convergence {
  std::string name;
  std::vector<Vec2> between;  ///< two points
  Where where;
};

/// [[measurement]]: a region whose mean stress and strain are recorded.
struct Measurement {
  std::string name;
  std::vector<Vec2> polygon;  ///< at the start
  Where where;
};

/// [zones]: the mesh of meshed blocks.
struct ZoneInputs {
  std::optional<double> size;    ///< m, of the edges of zones; at openings, where there are any;
                                 ///< empty: "auto"
  std::optional<double> growth;  ///< m per metre of distance from the openings; empty: 0 with a
                                 ///< size, else 0.15
  Where where;
};

struct Model {
  std::string title;
  std::string file;          ///< path as given on the command line
  Vec2 gravity{0.0, -9.81};  ///< m/s2
  Plane plane = Plane::strain;
  double thickness = 1.0;  ///< m
  BlockDeformation deformation = BlockDeformation::automatic;

  std::vector<Material> materials;
  std::vector<JointLaw> joints;
  ContactDefaults contact;
  std::vector<BlockInput> blocks;
  std::optional<Domain> domain;
  std::optional<Slope> slope;
  std::optional<CrossSection> section;
  std::vector<JointSet> joint_sets;
  std::vector<Trace> traces;
  std::vector<FractureNetwork> networks;
  std::optional<Voronoi> voronoi;
  std::vector<Import> imports;
  std::vector<Opening> openings;
  std::vector<Region> regions;
  std::vector<FixedPoint> fixed;
  std::vector<BrickWall> walls;
  std::vector<Arch> arches;
  Quality quality;
  std::optional<ZoneInputs> zones;
  std::vector<ContactPair> pairs;
  std::optional<InitialStress> initial_stress;
  std::vector<Boundary> boundaries;
  std::vector<Load> loads;
  std::vector<Water> waters;
  std::optional<FlowInputs> flow;
  std::vector<Shaking> shakings;
  std::vector<Bolt> bolts;
  std::vector<BoltPattern> bolt_patterns;
  std::vector<Lining> linings;
  std::vector<Fill> fills;
  std::vector<Monitor> monitors;
  std::vector<Convergence> convergences;
  std::vector<Measurement> measurements;
  std::vector<Stage> stages;  ///< in sequence; none: one, until solver.duration
  Solver solver;
  Output output;
  std::optional<Fos> fos;
  std::optional<Limit> limit;

  KeyPlaces key_places;  ///< places of the given keys; empty for a model that was not read
  std::vector<std::string> warnings;  ///< of reading: old names

  /// The laws of joints but those that stages add.
  std::span<const JointLaw> given_joints() const {
    return {joints.begin(), std::find_if(joints.begin(), joints.end(),
                                         [](const JointLaw& law) { return law.change; })};
  }
};

}  // namespace edda
