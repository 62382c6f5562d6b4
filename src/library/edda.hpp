// The library's interface: read a model, cut it, run it step by step, look at it and change it.
//
//   const edda::api::Model model = edda::api::Model::read("slope.toml");
//   edda::api::Simulation simulation(model, {.results = "slope"});
//   const edda::api::Outcome outcome = simulation.run();
//
// Units are SI, angles in rad, coordinates those of the model unless stated otherwise. Stresses are
// positive in tension, those of joints in compression. nb: number of blocks, nv: of their vertices.
//
// Invalid input raises an Error, an exception with the list of faults. A run that ends badly (it
// diverges, or does not reach equilibrium) raises none: Outcome says how it ended.
// A Simulation belongs to one thread at a time, but for pause() and stop().
#pragma once

#include <array>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#define EDDA_API __attribute__((visibility("default")))

namespace edda::api {

/// "0.1.0".
EDDA_API std::string_view version();

struct Point {
  double x = 0.0, y = 0.0;
};

/// One fault of the input.
struct EDDA_API Fault {
  std::string key;              ///< dotted path in the model ("block.slider.polygon"), or empty
  std::string file;             ///< "--set" for an override (line = its number, from 1)
  int line = 0, column = 0;     ///< from 1; 0 where unknown
  std::string problem, remedy;  ///< no full stops
  std::string text() const;     ///< "FILE:LINE:COLUMN: key: problem: remedy"
};

class EDDA_API Error : public std::runtime_error {
 public:
  explicit Error(std::vector<Fault> faults);
  ~Error() override;
  const std::vector<Fault>& faults() const { return faults_; }

 private:
  std::vector<Fault> faults_;  ///< one or more
};

// ---- Models and blocks

/// A checked model; never changes. Copies share it.
class EDDA_API Model {
 public:
  /// Reads a TOML file and applies `overrides` ("solver.duration=0.2"), as --set does. A model
  /// without stages may lack solver.duration for cut() and fos(), not for other functions.
  static Model read(const std::string& path, const std::vector<std::string>& overrides = {});
  /// The same for a text; `name` is its file name, for faults and relative paths.
  static Model parse(std::string_view toml, const std::string& name = "model",
                     const std::vector<std::string>& overrides = {});

  std::string title() const, file() const;
  double duration() const;      ///< s; 0: none is given
  std::string to_toml() const;  ///< every key and default filled in; reads back to the same bits

  // Names, in the order of the model. Numbers of materials and joints below are rows of these.
  std::vector<std::string> materials() const, joints() const, openings() const, stages() const;

  /// What is valid but not plausible, as `edda check` reports it. Error: it cannot be computed.
  const std::vector<std::string>& warnings() const;

  struct Impl;
  explicit Model(std::shared_ptr<const Impl> impl);
  const Impl& impl() const { return *impl_; }

 private:
  std::shared_ptr<const Impl> impl_;
};

/// One block as cut.
struct CutBlock {
  std::string name;  ///< of a [[block]], else empty
  int material = 0;  ///< row of Model::materials(), -1: none
  bool fixed = false;
  double area = 0.0;                      ///< m2
  std::vector<std::vector<Point>> rings;  ///< outer one counter-clockwise, then holes, clockwise
  /// joints[r][e]: row of Model::joints() of the edge from rings[r][e] to the next vertex, -1: none
  std::vector<std::vector<int>> joints;
};

/// The model's blocks, and what the cut did to its lines.
struct Cut {
  std::vector<CutBlock> blocks;  ///< in the order of their ids
  int trimmed = 0, merged = 0;   ///< ends of joints inside a block; slivers
  double smallest_area = 0.0, smallest_edge = 0.0, smallest_angle = 0.0;  ///< m2, m, degrees
  std::vector<std::string> notes;  ///< what was imported, drawn at random, left out, cuts nothing
};

EDDA_API Cut cut(const Model& model);

// ---- Studies of a model

/// The report of `edda check`.
struct ModelCheck {
  std::size_t blocks = 0, held = 0;                                ///< held: those that are fixed
  std::size_t contacts = 0;                                        ///< closed at the start
  double critical_step = 0.0, time_step = 0.0;                     ///< s; the first one
  double steps = 0.0;                                              ///< to expect
  bool at_most = false;                                            ///< stages may end before
  double steps_per_second = 0.0;                                   ///< of wall time
  std::string governed_by;                                         ///< what limits the step
  std::vector<std::string> loads, initial_stress, strain_damping;  ///< a sentence each
  std::vector<std::string> warnings;                               ///< those of the model
};

/// Makes a few steps and discards them. Error: the model cannot be computed.
EDDA_API ModelCheck check(const Model& model);

/// One trial.
struct FosTrial {
  double factor = 0.0;
  bool holds = false;
  std::string reason;                 ///< a few words
  double displacement = 0.0;          ///< m, largest of a corner since the start of the trial
  std::int32_t block = -1;            ///< whose corner that is; -1: none
  double velocity = 0.0, time = 0.0;  ///< m/s at its end; s, its duration in the model
};

/// The result of `edda fos`.
struct FactorOfSafety {
  std::string status;                  ///< found, below, above, unstable or interrupted
  std::string message, mechanism;      ///< a sentence each; the latter empty where nothing failed
  std::optional<double> factor;        ///< middle of the bracket; none where there is no bracket
  std::optional<double> holds, fails;  ///< the largest that holds, the smallest that fails
  std::vector<FosTrial> trials;        ///< in the order in which one thread makes them
  std::vector<std::string> warnings;
  double wall_seconds = 0.0;
};

/// The search that [fos] of the model describes. `stop`, set from anywhere, ends it as interrupted.
/// Error: the model cannot be computed, or has nothing to search for.
EDDA_API FactorOfSafety fos(const Model& model, const std::atomic<bool>* stop = nullptr);

/// The force of a joint between two blocks at their limit load.
struct LimitJoint {
  std::uint32_t block_i = 0, block_j = 0;
  std::string joint;                            ///< name of its law
  double x = 0.0, y = 0.0, fx = 0.0, fy = 0.0;  ///< m, of the thrust; N, on block_i
  double normal_force = 0.0, mobilised = 0.0;   ///< N, in compression; part of its shear strength
};

/// The result of `edda limit`; numbers are empty where there is no such limit.
struct LimitLoad {
  std::string status, message, mechanism;  ///< found, unlimited, unstable or unsolved; sentences
  std::optional<double> limit, upper, other_end;     ///< largest, by both theorems; smallest value
  std::optional<double> without_dilation, residual;  ///< `limit` of joints that are weaker
  std::vector<LimitJoint> joints;                    ///< those that carry a force at the limit
  std::vector<std::string> warnings;
  double wall_seconds = 0.0;
};

/// Rigid limit analysis of what [fos] of the model varies. Error: it cannot be computed.
EDDA_API LimitLoad limit(const Model& model);

/// A monitor's displacement at the end, and the differences of the other runs from it, m.
struct ErrorBar {
  std::string monitor;
  double ux = 0.0, uy = 0.0, step = 0.0, stiffness = 0.0, order = 0.0;
};

/// The result of `edda verify`.
struct Verification {
  std::vector<ErrorBar> monitors;
  double time = 0.0, largest_drift = 0.0;  ///< s, of the model; error of the energy balance
  std::string failed;  ///< which run did not reach its end, and why; empty: none
};

/// Runs the model four times: as it is, at half the step, with springs three times as stiff, and
/// with its blocks in reverse order. `stop` as in fos(). Error: as in fos(), or no monitors.
EDDA_API Verification verify(const Model& model, const std::atomic<bool>* stop = nullptr);

// ---- Results of a simulation

enum class Status { completed, equilibrium, collapsed, interrupted, failed };
EDDA_API std::string_view name_of(Status status);

/// How a run ended.
struct Outcome {
  Status status = Status::completed;
  std::string message;  ///< one sentence
  double time = 0.0;    ///< s reached
  std::uint64_t steps = 0;
  std::size_t contacts = 0;   ///< closed at the end
  double drift = 0.0;         ///< error of the energy balance: the largest of all rows, in size
  bool at_rest = true;        ///< in equilibrium at the end; false: something still moves
  std::int32_t fastest = -1;  ///< block with the fastest corner at the end; -1: none is free
  double speed = 0.0;         ///< m/s, of that corner
  std::vector<std::string> failed_checks;  ///< those of summary.json, a sentence each
  double wall_seconds = 0.0;
};

struct Progress {
  double fraction = 0.0, time = 0.0;  ///< of the duration; s simulated
  std::uint64_t steps = 0;
  double rate = 0.0, seconds_left = 0.0;  ///< steps per second of wall time; -1 while unknown
  double kinetic = 0.0, largest_overlap = 0.0, largest_velocity = 0.0;  ///< J, m; m/s, of centroids
  std::size_t stage = 0,
              stages = 1;    ///< the current one, from 1, of so many; 1 where there are none
  std::string stage_name{};  ///< empty where there are none
};

/// The energy balance since t = 0, J: friction, damping and fracture are dissipated, external is
/// work done on the blocks, transfer is taken by the moving ends of faces; drift is the error of
/// the balance over the largest energy so far.
struct Ledger {
  double kinetic = 0.0, strain = 0.0, contact = 0.0, gravity = 0.0, friction = 0.0, damping = 0.0,
         fracture = 0.0, external = 0.0, step_change = 0.0, drift = 0.0, transfer = 0.0;
};

enum class ContactState : std::int32_t { open = 0, stick = 1, slide = 2, bonded = 3 };

/// A face: an edge of block i against one of block j, as in joints.csv.
struct Contact {
  std::int32_t block_i = 0, block_j = 0;
  std::int32_t joint = 0;  ///< row of Model::joints(), -1: glued
  ContactState state = ContactState::open;
  double x = 0.0, y = 0.0;    ///< middle of the overlap, m
  double normal_force = 0.0;  ///< N, positive in compression
  double shear_force = 0.0;   ///< N, positive where it drives block i from end a to end b
  double opening = 0.0;    ///< m, minus the larger drawn closure of the two ends; negative: closed
  double slip = 0.0;       ///< m from end a to end b since the start
  double mobilised = 0.0;  ///< |shear| over shear strength
  bool ever_slipped = false, ever_opened = false;
  double length = 0.0, closed_length = 0.0;           ///< of the overlap, of its closed part, m
  double x_a = 0.0, y_a = 0.0, x_b = 0.0, y_b = 0.0;  ///< ends of the overlap, m
  double normal_stress = 0.0;  ///< Pa, positive in compression: the mean over the overlap
  double normal_stress_a = 0.0, normal_stress_b = 0.0;  ///< at its ends
  double shear_stress = 0.0;  ///< Pa: the mean over the overlap, signed as shear_force
};

/// A quantity of blocks, and how many numbers it has for each block.
enum class Field {
  centroid,      ///< 2: x, y, m
  displacement,  ///< 2: of the centroid since the start or the last reset, m
  rotation,      ///< 1: rad, full turns counted
  velocity,      ///< 2: of the centroid, at the time of the positions, m/s
  omega,         ///< 1: rad/s
  stress,        ///< 4: xx, yy, zz, xy, Pa
  overstress,    ///< 1: stress over the strength of the rock
};
EDDA_API std::size_t components_of(Field field);

/// The motion of a material point.
struct MonitorReading {
  double ux = 0.0, uy = 0.0, vx = 0.0, vy = 0.0;  ///< m; m/s
  double sxx = 0.0, syy = 0.0, sxy = 0.0;         ///< Pa, of its block
};

/// [3] spans of nb numbers each: node k of block i is the k-th span's element i.
using Nodes = std::array<std::span<const double>, 3>;
using MutableNodes = std::array<std::span<double>, 3>;

/// Properties of the blocks that never change. Views that live as long as the Simulation.
struct BlockViews {
  std::span<const double> area;                 ///< [nb] at the start, m2
  std::span<const double> mass;                 ///< [nb] kg
  std::span<const std::int32_t> material;       ///< [nb] row of Model::materials(), -1: none
  std::span<const std::uint8_t> fixed;          ///< [nb] 1: fixed
  std::span<const std::uint32_t> vertex_begin;  ///< [nb + 1] first vertex of each block
  /// [nv] the next vertex of the ring, with the block on the left.
  std::span<const std::uint32_t> next;
};

// ---- Simulations

struct Options {
  std::string results{};  ///< folder for results, as of `edda run -o`; empty: none
  bool resume = false;    ///< continue from the checkpoint in it, with the model of its model.toml
  std::optional<std::size_t> from_stage{};  ///< continue from its end; counted from 1
  /// Called between two steps, about every `progress_every` s of wall time, and once after the end,
  /// when it may only query; false: as stop(). May be empty.
  std::function<bool(const Progress&)> progress{};
  double progress_every = 0.2;
  std::function<void(const std::string&)> warn{};  ///< for warnings; may be empty
};

/// A model at step n of its run. run(), step() and advance_to() continue the same run, in parts or
/// as a whole, with its stages, rows and frames, to the same bits; queries change nothing.
class EDDA_API Simulation {
 public:
  /// Cuts the geometry, builds the model and checks it; nothing is written before the first step.
  explicit Simulation(const Model& model, Options options = {});
  /// A run with a results folder that has begun and not ended ends here as interrupted.
  ~Simulation();
  Simulation(Simulation&&) noexcept;
  Simulation& operator=(Simulation&&) noexcept;

  // -- Running. An exception from a callback is passed on and leaves the simulation between two
  // steps, from which it may continue. Error of the first call: a folder that cannot be made, or
  // that another run is writing to.
  Outcome run();  ///< to the end, or to a pause (then outcome says interrupted)
  bool step(std::uint64_t steps = 1);  ///< fewer at the end; false: the run has ended
  bool advance_to(double time);        ///< first step at or after it (s); false: ended. Error: NaN
  bool over() const;
  Outcome finish();  ///< ends the run here and writes all results
  void pause();      ///< from any thread: the current call returns; without one nothing happens
  void stop();       ///< from any thread: the run ends as interrupted

  /// Calls `action` between two steps, after every `steps`-th one. Returns a number for forget().
  /// Error: 0 steps, an empty function.
  std::size_t every(std::uint64_t steps, std::function<void()> action);
  void forget(std::size_t callback);

  // -- Queries
  const Model& model() const;
  double time() const;  ///< s
  std::uint64_t steps() const;
  double time_step() const, critical_step() const;  ///< s; of the last step, 0 before the first
  std::string governed_by() const;                  ///< what limits the step
  std::vector<std::string> warnings() const;
  std::size_t stage() const;  ///< the current one, from 1
  Ledger ledger() const;
  double unbalanced() const;  ///< mean resultant over the mean contact force

  // Views of the arrays that the steps work on, valid as long as the Simulation.
  std::size_t block_count() const, vertex_count() const;
  BlockViews blocks() const;
  std::span<const std::uint8_t> alive() const;  ///< [nb] 0: excavated
  Point origin() const;                         ///< node positions count from here
  Nodes node_x() const, node_y() const;         ///< m, at step n, relative to origin()
  /// m/s, half a step before the positions (method "dda": with them). May be written to before the
  /// first and between two steps, which counts as external work. The next call restores those of
  /// blocks that are not free. Error: numbers that are not finite, any change after the end.
  MutableNodes node_vx(), node_vy();
  /// The name of a block (below block_count()), empty where it has none, and the block of a name.
  std::string name(std::size_t block) const;
  std::optional<std::size_t> block_called(std::string_view name) const;

  /// Writes nb * components_of(field) numbers into `out`, block by block; excavated blocks have the
  /// values of their last step. Error: `out` has another size; the same for vertices().
  void field(Field field, std::span<double> out) const;
  std::vector<double> field(Field field) const;
  void vertices(std::span<double> out) const;  ///< nv times x, y, m
  std::vector<Contact> contacts() const;       ///< closed now or before, as in joints.csv

  // -- Monitors
  /// The material point that is at `point` at the start; with a results folder only before the
  /// first step, since history.csv and model.toml of the folder have it from the beginning. Error:
  /// in no block, a name that is taken or cannot head a column.
  void add_monitor(const std::string& name, Point point);
  std::vector<std::string> monitors() const;              ///< those of the model first
  MonitorReading read(const std::string& monitor) const;  ///< Error: none of that name

  // -- Changes, between two steps. A change before the first step begins the run, except for
  // velocities, with which the run then begins. Changes that a stage could not make either
  // (activate what is active, install twice, relax less than before) are an Error; a later stage
  // skips what was done by a call before it.
  /// Velocity of the centroid and angular velocity of a free block; its strain rate becomes 0. In
  /// an explicit run velocities are those half a step ago; field() gives their mean over the two
  /// halves of the step, which differs by half a step's acceleration.
  void set_velocity(std::size_t block, Point velocity, double omega = 0.0);
  /// Mass-proportional (1/s, from 0), local (0 to 1), and of contacts (part of critical, 0 to 10).
  /// Adaptive and Rayleigh damping remain those of the model or the stage. Error: values beyond
  /// these.
  void set_damping(double mass, double local = 0.0, double contact = 0.0);
  /// Divides cohesion, tensile strength and the tangent of the friction angle as the model gives
  /// them (1e-6 or more), of all joints or of one; replaces an earlier factor. Error: less.
  void set_strength_factor(double factor);
  void set_strength_factor(const std::string& joint, double factor);
  /// Names as in a stage. The rock of an opening is in the model, and can be excavated, if a stage
  /// names it.
  void excavate(const std::vector<std::string>& openings);
  /// From now on the fraction `part`, 0 to 1, of the forces of the rock on the walls is released,
  /// all calls and stages together.
  void relax(const std::string& opening, double part);
  /// Deactivates and activates loads, water, boundaries and ground motions by their names. A
  /// boundary takes over the forces of one that is deactivated.
  void switch_over(const std::vector<std::string>& deactivate,
                   const std::vector<std::string>& activate);
  void install(const std::vector<std::string>& bolts);
  void reset_displacements();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Threads that each simulation of this process uses from its next call on (default: up to all
/// cores, with the number that is fastest); results do not depend on it. Error: less than 1.
EDDA_API void set_threads(int threads);

}  // namespace edda::api
