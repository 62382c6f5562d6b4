// The geometry that the blocks are cut from, as read: parts of the Model (model.hpp). Fields named
// given_* hold the values of the file; complete.cpp derives from them the fields that are used.
#pragma once

#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/polygon.hpp"
#include "base/vec2.hpp"

namespace edda {

/// Index into one of the model's lists; `none` where nothing is named.
using Index = int;
inline constexpr Index none = -1;

enum class Spread { uniform, normal };
enum class JointSpread { uniform, normal, exponential };
enum class LengthKind { lognormal, power, constant, exponential };
enum class NetworkModel { traces, baecher, veneziano };
enum class ShapeKind { arch, circle, rectangle, horseshoe };
enum class ImportAs { lines, blocks };
enum class LengthUnit { m, mm, cm, km, ft, in };
enum class QualityAction { merge, report, error };

/// [domain]
struct Domain {
  Ring outline;        ///< given_outline, or that of the slope
  Ring given_outline;  ///< as written; empty where there is a [slope]
  Index material = none;
  Index joint = none;  ///< law of cut edges that name none; none: contact.joint
  double snap = 0.0;   ///< m
  long long max_blocks = 300000;
  Where where;
};

/// [slope]: an outline from a few parameters. The ground rises to the right.
struct Slope {
  Vec2 toe;                  ///< m
  double height = 0.0;       ///< m, from the toe to the crest
  double face_angle = 0.0;   ///< degrees from the horizontal, of each face
  double base_y = 0.0;       ///< m
  Vec2 extent;               ///< left and right end, x in m
  int benches = 1;           ///< faces one above the other
  double bench_width = 0.0;  ///< m, horizontal distance between one face and the next
  Where where;
};

/// [section]
struct CrossSection {
  double azimuth = 0.0;  ///< degrees: bearing of +x, clockwise from north
  Where where;
};

/// Scatter of the joints of a set about its means: half the width of a uniform distribution, or a
/// standard deviation. With the exponential distribution only lengths are exponential, from the
/// mean less the deviation upwards; angles are then normal.
struct Deviation {
  double angle = 0.0;         ///< degrees
  double spacing = 0.0;       ///< m
  double trace_length = 0.0;  ///< m
  double gap = 0.0;           ///< m
  JointSpread distribution = JointSpread::uniform;
};

struct JointSet {
  std::string name;
  double angle = 0.0;     ///< degrees, counter-clockwise from +x, on the section
  double spacing = 0.0;   ///< m, on the section
  double apparent = 1.0;  ///< spacing on the section over the true one
  std::optional<double> given_angle;
  double given_spacing = 0.0;           ///< m, as written: true where a dip is given
  std::optional<double> dip;            ///< degrees
  std::optional<double> dip_direction;  ///< degrees, clockwise from north
  Vec2 origin;
  Index joint = none;
  Ring region;                         ///< empty: the whole domain
  std::optional<double> trace_length;  ///< m; none: persistent
  double gap = 0.0;                    ///< m, between one trace and the next
  std::optional<double> stagger;       ///< m, of the traces from one joint, or layer, to the next
  std::string bounded_by;  ///< name of the set of beds from one to the next of which it runs
  Index beds = none;       ///< that set, in Model::joint_sets
  Deviation deviation;
  long long seed = 0;
  Where where;
};

struct Trace {
  std::vector<Vec2> points;
  Index joint = none;
  Where where;
};

struct AngleSpread {
  double mean = 0.0;       ///< degrees
  double deviation = 0.0;  ///< degrees: standard deviation, or half the width
  Spread distribution = Spread::normal;
};

struct LengthSpread {
  LengthKind distribution = LengthKind::lognormal;
  std::optional<double> mean;      ///< m; lognormal, constant, exponential
  double deviation = 0.0;          ///< m; standard deviation of a lognormal
  std::optional<double> exponent;  ///< power: density falls as length to minus this
  std::optional<double> min, max;  ///< m; power
};

/// [[fracture_network]]: fractures at random.
struct FractureNetwork {
  std::string name;
  NetworkModel model = NetworkModel::traces;
  std::optional<double> persistence;  ///< veneziano: part of each line that is fracture
  std::optional<double> p21;          ///< 1/m: length per area inside the domain; either this
  std::optional<long long> count;     ///< or the number of fractures that reach into the domain
  AngleSpread angle;
  LengthSpread length;
  Index joint = none;
  Ring region;  ///< empty: the whole domain
  long long seed = 0;
  Where where;
};

/// [voronoi]: the domain divided into Voronoi polygons.
struct Voronoi {
  double size = 0.0;  ///< m: side of a square as large as the mean polygon
  int smoothing = 5;  ///< iterations that move points to the centroids of their polygons (Lloyd)
  double min_edge = 0.0;  ///< m: shorter edges become points
  Index joint = none;
  Ring region;  ///< empty: the whole domain
  long long seed = 0;
  Where where;
};

/// [[import]]: lines from a file.
struct Import {
  std::string file;  ///< path
  LengthUnit units = LengthUnit::m;
  double scale = 1.0;
  bool size_given = false;                            ///< the model gives units or scale
  Vec2 shift;                                         ///< m, after scaling
  std::optional<double> snap;                         ///< m: ends closer to a line are joined to it
  ImportAs as = ImportAs::lines;                      ///< lines cut rock, closed ones are blocks
  std::vector<std::pair<std::string, Index>> layers;  ///< layer -> joint; empty: all layers
  std::vector<std::pair<std::string, Index>> materials;  ///< layer -> material; as blocks
  std::vector<std::string> fixed;                        ///< layers of fixed blocks; as blocks
  Index joint = none;                                    ///< law of lines whose layer names none
  Index material = none;  ///< of the blocks, where there is no domain or they are blocks themselves
  Where where;
};

/// The shape of an opening from a few parameters.
struct OpeningShape {
  ShapeKind kind = ShapeKind::arch;
  Vec2 at;                       ///< m: middle of the floor; of a circle the centre
  double width = 0.0;            ///< m: the largest; of a circle the diameter
  std::optional<double> height;  ///< m: from the floor to the crown
  int segments = 48;             ///< straight pieces of a full turn
};

struct Opening {
  std::string name;
  Ring polygon;        ///< given_polygon, or that of the shape
  Ring given_polygon;  ///< as written; empty where there is a shape
  std::optional<OpeningShape> shape;
  Index joint = none;   ///< law of its outline until it is excavated; none: glued
  bool staged = false;  ///< a stage excavates it; until then its rock is there
  Where where;
};

/// [[region]]: another material inside a polygon.
struct Region {
  Ring polygon;
  Index material = none;
  Index joint = none;  ///< law of its outline
  Where where;
};

struct FixedPoint {
  Vec2 point;
  Where where;
};

struct BrickWall {
  Vec2 origin;  ///< lower left corner
  int columns = 0;
  int rows = 0;
  Vec2 brick;  ///< length, height of a brick, m
  Index material = none;
  Index joint = none;
  Where where;
};

/// [[arch]]: voussoirs, counter-clockwise.
struct Arch {
  Vec2 centre;
  double radius = 0.0;     ///< m, of the middle line
  double thickness = 0.0;  ///< m
  int count = 0;
  double from_angle = 0.0, to_angle = 180.0;  ///< degrees, counter-clockwise from +x
  Index material = none;
  Index joint = none;
  Where where;
};

/// [quality]: which blocks are too small or too thin, and what is done with them. 0: no limit.
struct Quality {
  double min_area = 0.0;   ///< m2
  double min_edge = 0.0;   ///< m
  double min_angle = 0.0;  ///< degrees
  QualityAction action = QualityAction::merge;
  Where where;
};

/// [[contact_pair]]: the law where edges of two joints, or blocks of two materials, meet.
struct ContactPair {
  std::vector<std::string> between;
  Index joint = none;
  Index joints[2] = {none, none};     ///< of the names in `between`, where both are joints
  Index materials[2] = {none, none};  ///< likewise
  Where where;
};

}  // namespace edda
