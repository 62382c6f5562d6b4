// One simulation: model, blocks, contacts, forces, step, ledger. The one place that names every
// stage.
#pragma once

#include <cmath>
#include <cstdint>
#include <limits>
#include <optional>
#include <string>

#include "attachments/bolts.hpp"
#include "attachments/boundary_springs.hpp"
#include "attachments/dashpots.hpp"
#include "attachments/free_field.hpp"
#include "attachments/ground.hpp"
#include "attachments/loads.hpp"
#include "base/fault.hpp"
#include "blocks/block_set.hpp"
#include "blocks/pose.hpp"
#include "blocks/state.hpp"
#include "contacts/face_set.hpp"
#include "contacts/points.hpp"
#include "forces/nodal_forces.hpp"
#include "forces/stiffness.hpp"
#include "implicit/newmark.hpp"
#include "integrate/leapfrog.hpp"
#include "lines/polygon_set.hpp"
#include "model/model.hpp"
#include "model/stage_names.hpp"
#include "run/divergence.hpp"
#include "run/face_switching.hpp"
#include "run/initial_balance.hpp"
#include "run/ledger.hpp"
#include "run/stage_clock.hpp"

namespace edda {

/// The frequency with which a model moves at present (Rayleigh's quotient; Underwood 1983):
/// -dx . df / dx . M dx with dx and df what positions and forces have changed by over some steps, a
/// quarter of a radian of it. Over so many steps what shakes fast hardly counts: step by step it
/// would drown the slow motion that has furthest to go.
struct Pace {
  double frequency = 0.0;                     ///< 1/s; 0: not known yet
  double least = 0.0;                         ///< 1/s: half of it when the last change began
  std::uint64_t since = 0;                    ///< step of what follows
  std::array<std::vector<double>, 3> x, y;    ///< [3][nb] positions then, m; empty: none kept
  std::array<std::vector<double>, 3> fx, fy;  ///< [3][nb] forces then, N

  /// By which time is counted, 1/s: what slides away, and takes the frequency with it, stops no
  /// clock.
  double clock() const { return frequency > least ? frequency : least; }
};

struct StepStatistics {
  double smallest = 0.0, largest = 0.0, sum = 0.0;  ///< s
  std::uint64_t changes = 0;                        ///< of the step
  double over_critical = 0.0;                       ///< largest step over the bound then in force
  std::uint64_t redone = 0;  ///< steps made again with half the step ("step cuts")
};

/// In which order the blocks are numbered: as the cut gives them, or the other way round (for
/// verification: nothing but rounding may depend on it).
enum class BlockOrder { as_cut, reversed };

struct Simulation {
  Model model;
  PolygonSet polygons;
  BlockSet blocks;
  LawTable laws;
  BoundarySprings springs;
  Loads loads;
  Dashpots dashpots;
  FreeField free_field;

  Bolts bolts;
  State state;
  Pose pose;
  FaceSet contacts;
  PointSet point_contacts;  ///< in their place, where contact.model = "points"
  Ground ground;
  NodalForces forces;
  NodalForces jump;  ///< by which forces at n have jumped since the last step; or empty
  std::vector<Vec2> on_dashpots;  ///< [points of dashpots] their forces in the last step, N
  std::vector<KeptForce> kept;    ///< of rock taken out, and of boundaries taken over from
  DampingWork damping_work;
  Damping damping;                        ///< in force
  bool dynamic = true;                    ///< of method "dda": whether velocities carry over
  std::optional<InitialBalance> initial;  ///< of the initial stress, as created; empty without one
  std::vector<double> inertia;      ///< [nb] factor on the masses, by solver.mass_scaling; or empty
  StepBound bound;                  ///< at the last search
  double step_limit = 0.0;          ///< s: largest step allowed at present
  double base_reach = 0.0;          ///< m: skin of the contact search at rest
  double displacement_limit = 0.0;  ///< m in one step
  double last_displacement = 0.0;   ///< m: largest of a vertex in the last step
  double penetration = 0.0;         ///< m: largest at the last step
  double max_penetration = 0.0;     ///< m, over the run
  double smallest_half_width = 0.0;  ///< m, of all blocks
  bool settles =
      false;  ///< is to come to rest: its pace is looked at, what changes may come gently
  bool balanced = false;    ///< while it settles: all but single blocks is in balance
  double rest_ratio = 0.0;  ///< of unbalanced forces at which it rests (Stage::ratio)
  Pace pace;                ///< while it settles
  std::vector<std::uint8_t>
      aloof;  ///< [nb] 1: does not count in it, falls or slides away; empty: none
  double step_change_energy = 0.0;  ///< J, created by changes of the step
  double external_work = 0.0;       ///< J, of loads, shaking and driven boundaries so far
  StepStatistics steps;
  OpenCloseCounts open_close;          ///< rounds of an implicit step count as passes
  ImplicitSolver implicit;             ///< of method "dda"
  StageSeconds seconds;                ///< sampled; only their ratios mean something
  std::optional<double> start_energy;  ///< J, of the ledger
  double largest_energy = 0.0;         ///< J, so far

  /// Cuts, builds, finds what touches, bounds the step. Faults of the geometry come back as values.
  static Result<Simulation> create(Model model, BlockOrder order = BlockOrder::as_cut);

  /// Chooses the step so that a whole number of steps ends at `first_event` (s), and takes the
  /// velocities half a step back: v_{-1/2} = v_0 - a_0 h/2. Once, before the first step().
  void start(double first_event);
  /// Sets the step towards an event at `time` s: as few equal steps as the limit allows.
  void aim_at(double time);
  /// Puts other damping in force between two steps, and the step that it allows.
  void change_damping(const Damping& now, bool carry_velocities);
  /// From now on the strength of law r, as the model gives it, is divided by factors[r] (rows of
  /// the LawTable, above zero): cohesion, tangent of the friction angle and tensile strength, peak
  /// and residual. Between two steps.
  void set_strength_factors(const std::vector<double>& factors);
  /// What begins or ends to act now, and this change of strength, comes little by little from here
  /// on, over some periods of the motion; at the very start weight does, too, where the ground has
  /// no stress of its own. With adaptive damping. `more`: so does something else, that goes by
  /// Loads::gentle.
  void begin_gently(const std::vector<double>& strength_factors, bool more = false);
  /// Whether all that was to come has come.
  bool all_on() const { return loads.gentle.part >= 1.0; }
  /// The same factor for all laws.
  void set_strength_factor(double factor);
  /// Takes out the rock of these openings (rows of Model::openings), between two steps. What it did
  /// to its walls is kept as loads, of which nothing acts until relax() says so; the energy that
  /// goes with it counts as external work.
  void excavate(const std::vector<Index>& openings);
  /// Lets go `part` (0 to 1) of the forces that the rock of an opening had on its walls.
  void relax(Index opening, double part);
  /// Some of what the model names acts no more, other from now on, between two steps. A boundary of
  /// any type but stress that now acts where one acted that no longer does bears what that one
  /// bore; energy stored in springs that go counts as external work.
  void switch_over(const NamedRows& off, const NamedRows& on);
  /// Puts in bolts (rows of all_bolts()) where the rock now is.
  std::optional<Fault> install(const std::vector<Index>& bolts);
  /// What is closed neither opens nor slides from now on; or does again.
  void glue_joints(bool glued);
  /// What the block that allows the longest step allows, s: that of masses raised so that all do.
  double uniform_step() const;
  /// Masses as given, or raised so that all blocks allow one time step.
  void scale_masses(StageMasses masses);
  /// Displacements count from here.
  void reset_displacements();
  /// Every second step leaves the velocities in other arrays than before. Moves them, contents and
  /// all, into the arrays that the step before had: for views of them that outlive a step.
  void exchange_velocity_arrays();
  /// Other velocities of the nodes (finite, m/s) from now on, between two steps. The energy that
  /// they bring counts as external work; those of blocks that are not free stay as they are.
  void change_velocities(const Nodes& vx, const Nodes& vy);
  /// One step of the method: forces, motion, gaps, switching, search, contacts.
  std::optional<Failure> step();
  Ledger ledger();
  /// The same without its drift, and without remembering that it was looked at.
  Ledger ledger_now() const;
  /// What its drift is measured against: the largest so far, not less than rounding may make, J.
  double energy_scale(const Ledger& ledger) const;

  /// Loads and bolts as they act at n.
  LoadsNow acting() const;
  /// What dashpots are held to at n, and what pushes besides, [points]: the ground where it moves
  /// at `ground_velocity`, and twice that of a wave that comes up; beside free-field columns these,
  /// at the mean of their velocities now and in `next`, and their stress.
  struct DashpotHold {
    std::vector<Vec2> reference;  ///< m/s
    std::vector<Vec2> push;       ///< N; empty: none
  };
  DashpotHold dashpot_hold(Vec2 ground_velocity, const std::vector<FreeFieldColumn>& next) const;
  /// Free-field columns a step further.
  std::vector<FreeFieldColumn> next_free_field(Vec2 ground_velocity, double h_old,
                                               double h_new) const;
  /// Velocity of the ground at n, m/s.
  Vec2 ground_velocity() const;

  bool explicit_method() const { return model.solver.method == Method::edda; }
  bool at_points() const { return model.contact.model == ContactModel::points; }
  /// Damping in proportion to mass that acts at present, 1/s.
  double drag() const;
  /// Largest step allowed, s: of the implicit method once its short first ones are over.
  double usual_step() const { return explicit_method() ? step_limit : nominal_step_; }

 private:
  /// Names every field that a checkpoint holds (run/simulation_memory.cpp).
  template <class Archive>
  friend void list_memory(Archive& archive, Simulation& sim);

  void place_all();
  void place_again();
  void hold_boundaries();
  void close_contacts();
  void keep(const std::vector<KeptForce>& forces);
  std::vector<KeptForce> release_boundaries(const std::vector<Index>& rows);
  void start_implicit();
  std::optional<Failure> step_implicit();
  void set_implicit_limit();
  void search(double reach);
  void search_if_due();
  bool list_is_due();
  bool list_is_scattered() const;
  bool move(double h_old, double h_new, const LoadsNow* not_yet_gathered);
  Vec2 twice_incoming(Index boundary) const;
  void start_ground(double h);
  void drive_ground(double h_old, double h_new);
  void hold_ground();
  Vec2 force_on_held() const;
  double bolt_power() const;
  void book_boundaries(double h_old, double h_new);
  void set_viscosity();
  StepDamping step_damping();
  void finish_step();
  void book_implicit_loads(const LoadsNow& now);
  void book_loads(double h_old, double h_new, const LoadsNow& now);
  std::optional<Failure> inspect() const;
  Failure lost() const;
  StepInUse step_in_use() const;
  void set_limit();
  void raise_masses();
  NodalForces forces_now() const;
  void note_jump(const NodalForces& before);
  void split_jump();
  void plan_slivers();
  /// Masses of the nodes as the model gives them.
  struct GivenMass {
    decltype(BlockSet::node_mass) node_mass;
    decltype(BlockSet::inverse_mass) inverse_mass;
  };
  GivenMass given_mass_;      ///< kept where a stage scales them
  double scaled_step_ = 0.0;  ///< s: step that a stage raises inertia for; 0: none does
  double sliver_step_ =
      0.0;  ///< s: step that the inertia of slivers is raised for; 0: there are none
  std::vector<double> sliver_most_;  ///< [nb] factor on masses that they may have at most for it
  double displacement_cap_ = std::numeric_limits<double>::infinity();  ///< s: after halvings
  KnownSteps known_steps_;
  std::uint64_t larger_since_ = 0;  ///< step from which a much larger one would have been allowed
  double target_ = 0.0;             ///< s: the event aimed at
  double nominal_step_ = 0.0;       ///< s: of method "dda", before any cut
  double step_before_ = 0.0;        ///< s: step behind v_{n-1/2}
  std::uint64_t steps_left_ = 0;
  StrainDamping strain_damping_;
  StepDamping damps_;  ///< of the step in hand

  void take_pace(const LoadsNow& at_work);
  double wave_frequency() const;
  void bring_on();
  void take_strength_factors(const std::vector<double>& factors);
  std::vector<double> strength_from_, strength_to_;  ///< [laws] while strength changes gently

  // Of one step, kept so that it allocates nothing.
  Nodes old_vx_, old_vy_;  ///< velocities before it, and where the next ones will be
  GroundStep next_ground_;
  Vec2 on_held_;  ///< N at n: force_on_held() before the open-close iteration
  DashpotHold hold_;
  std::vector<FreeFieldColumn> next_columns_;
  std::vector<double> largest_;
  FaceSwitchingScratch switching_;
};

}  // namespace edda
