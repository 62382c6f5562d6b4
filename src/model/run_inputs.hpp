// How a model is run and what is asked of it, as read: parts of the Model (model.hpp).
#pragma once

#include <numbers>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "base/fault.hpp"
#include "base/vec2.hpp"
#include "model/geometry_inputs.hpp"

namespace edda {

enum class Method { edda, dda };
/// How a block deforms: its corners deviate from the uniform strain, or do not, or it is meshed.
/// automatic, of a material: zones if it yields, or else as the model says; of the model: zones if
/// it has [zones], or else corners.
enum class BlockDeformation { automatic, corners, uniform, zones };
enum class MassKind { matched, covering, consistent };
enum class Switching { exact, plain };
enum class StageEnd { time, equilibrium, collapse };
enum class StageJoints { as_given, glued };
enum class StageMasses { as_given, scaled };
enum class FallingBlocks { report, wait };
enum class LooseBlocks { go_on, stop };
enum class Varied {
  strength,
  load,
  shaking,
  water,
  tilt,
  kh,
  kv,
  gravity,
  boundary,
  flow,
  change,
  time
};

/// Rayleigh damping: in proportion to mass and stiffness, least at one frequency.
struct Rayleigh {
  double fraction = 0.0;   ///< of critical there
  double frequency = 0.0;  ///< Hz
  /// Coefficients of the mass, 1/s, and of the stiffness of the blocks, s.
  double mass() const { return fraction * 2.0 * std::numbers::pi * frequency; }
  double stiffness() const { return fraction / (2.0 * std::numbers::pi * frequency); }
  friend bool operator==(const Rayleigh&, const Rayleigh&) = default;
};

struct Damping {
  double mass = 0.0;     ///< 1/s
  double local = 0.0;    ///< fraction of the unbalanced force (Cundall)
  double contact = 0.0;  ///< fraction of critical
  /// Fraction of critical of mass-proportional damping at the frequency with which the model moves
  /// at present.
  double adaptive = 0.0;
  /// The value of `adaptive` with which a model reaches equilibrium in the fewest steps.
  static constexpr double for_equilibrium = 0.8;
  std::optional<Rayleigh> rayleigh{};  ///< in place of the materials' damping
  /// The Rayleigh damping in force where the material has `own`, which goes first but on the way to
  /// an equilibrium.
  const std::optional<Rayleigh>& rayleigh_with(const std::optional<Rayleigh>& own) const {
    return own && adaptive == 0.0 ? own : rayleigh;
  }
  /// Coefficient of mass-proportional damping, with that of Rayleigh damping, 1/s.
  double mass_damping(const std::optional<Rayleigh>& own = {}) const {
    const std::optional<Rayleigh>& in_force = rayleigh_with(own);
    return mass + (in_force ? in_force->mass() : 0.0);
  }
};

struct Solver {
  Method method = Method::edda;
  MassKind mass = MassKind::matched;
  Switching switching = Switching::exact;
  double duration = 0.0;            ///< s; 0: not given
  std::optional<double> time_step;  ///< s; empty: "auto"
  bool allow_unstable = false;
  double safety = 0.7;                   ///< of the critical step
  bool dynamic = true;                   ///< dda: false drops velocities at each step
  double max_displacement_ratio = 0.01;  ///< of half the model's least width, in a step
  double mass_scaling = 0.0;             ///< s; edda: step up to which inertia is raised; 0: off
  Damping damping;
  Where where;
};

using NumberMap = std::vector<std::pair<std::string, double>>;

/// What a ramp or [fos] varies, in the words of their keys.
struct VariedRange {
  std::string vary;           ///< "kh", "load:NAME" ...; empty: not given
  std::optional<Vec2> range;  ///< from, to
};

enum class HoldFor { equilibrium };

/// [[stage]] ramp: something varied in increments, each held until the model is in equilibrium.
struct Ramp {
  static constexpr double longest_value = 1000.0;  ///< s, default of Stage::duration; also where a
                                                   ///< support may be displaced
  VariedRange what;
  HoldFor hold = HoldFor::equilibrium;
  int steps = 200;                   ///< number of increments
  Varied varied = Varied::strength;  ///< from `what`
  Index target = none;               ///< row of loads, waters or boundaries
};

/// Joints, rock or linings that have other properties from the start of a stage on, all of them or
/// those in a part of the model.
struct PropertyChange {
  Index joints = none, material = none;  ///< those that change: one of the two
  std::string to;                        ///< a law of joints, or a material
  Index row = none;                      ///< its row
  std::string set;                       ///< only joints of these joint sets or fracture networks
  std::vector<Vec2> region;              ///< only within this polygon, as drawn; empty: everywhere
  std::string around;                    ///< only so far from this opening, as drawn
  double distance = 0.0;                 ///< m
  Index opening = none;                  ///< `around`
  double over = 0.0;                     ///< s of a stage with a duration; 0: at once
  /// Of joints: each law that changes, and what it becomes (LawChange).
  std::vector<std::pair<Index, Index>> laws{};
  Where where;
};

/// [[stage]]: a part of the run, until a time, until equilibrium, or until collapse under a ramp.
struct Stage {
  std::string name;
  StageEnd until = StageEnd::time;
  double ratio = 1e-5;     ///< criterion of equilibrium: mean resultant over mean contact force
  double duration = 10.0;  ///< s; until equilibrium: at most
  bool may_last =
      false;  ///< no duration is given: it may take as many steps as a search (most_steps)
  static constexpr double crossings = 200.0;  ///< of the model by waves, in the least default of it
  bool to_equilibrium() const { return until != StageEnd::time; }
  /// s, the longest that the whole stage may take; of a ramp `duration` for each value.
  double longest() const { return ramp ? duration * (ramp->steps + 1) : duration; }
  std::vector<std::string> excavate;   ///< openings excavated at its start
  NumberMap relax;                     ///< fraction of the wall forces released, by opening
  std::vector<std::string> install;    ///< bolts and patterns installed at its start
  std::vector<std::string> fill;       ///< fills placed at its start
  std::vector<PropertyChange> change;  ///< at its start, one after the other
  std::vector<std::string> activate, deactivate;  ///< loads, waters, boundaries, shakings
  bool reset_displacements = false;               ///< at its start
  double strength_factor = 1.0;  ///< the strength of all joints is divided by this during the stage
  Damping damping;               ///< while it lasts
  StageJoints joints = StageJoints::as_given;     ///< while it lasts
  StageMasses masses = StageMasses::as_given;     ///< while it lasts
  FallingBlocks falling = FallingBlocks::report;  ///< whether an equilibrium waits for them
  LooseBlocks otherwise = LooseBlocks::go_on;     ///< what follows where some blocks come loose
  std::optional<Ramp> ramp;
  Where where;
};

struct Output {
  double every = 0.0;          ///< s; default: duration / 20
  double history_every = 0.0;  ///< s; default: duration / 200; "record": the interval of a record
  bool settling = true;  ///< more rows and frames in stages until equilibrium; default: where the
                         ///< two above are not given
  double checkpoint_every = 5.0;  ///< minutes of wall time
  bool stages = true;             ///< contacts and a checkpoint at the end of each stage
};

constexpr bool changes_gravity(Varied varied) {
  return varied == Varied::tilt || varied == Varied::kh || varied == Varied::kv ||
         varied == Varied::gravity;
}

/// The criterion of failure of a trial; by default from the size of the blocks and gravity.
struct FosFails {
  std::optional<double> displacement;  ///< m, of a corner since the start of the trial
  std::optional<double> velocity;      ///< m/s, at its end
};

/// Target of kh, kv and tilt that act to the left or downwards.
inline constexpr Index backwards = -2;

/// [fos]: the factor of safety.
struct Fos {
  std::string stage;                 ///< stage from whose end the trials begin; empty: the last
  std::string vary = "strength";     ///< as written
  Vec2 bracket{0.5, 3.0};            ///< factors to begin with, lower and upper
  double tolerance = 0.01;           ///< width of the bracket at the end, over its lower factor
  std::vector<std::string> exclude;  ///< joints that keep their strength
  double least_area = 0.0;           ///< m2: mechanisms that move less are left out
  bool rigid_proof = true;           ///< trials end where rigid blocks have no equilibrium
  FosFails fails;
  Varied varied = Varied::strength;  ///< from `vary`
  Index target = none;  ///< row of loads, shakings, waters or boundaries; or `backwards`
  Where where;
};

/// [limit]: rigid limit analysis; what is varied is [fos]'s.
struct Limit {
  bool crushing = false;  ///< joints have the compressive strength of their rock
  Where where;
};

}  // namespace edda
