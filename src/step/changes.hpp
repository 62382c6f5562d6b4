// Changes between two steps: damping, strength, excavation, active loads and boundaries,
// velocities. Energy that they add or remove is accounted for as external work.
#pragma once

#include <cstdint>
#include <optional>
#include <vector>

#include "attachments/loads.hpp"
#include "base/fault.hpp"
#include "blocks/kinematics.hpp"
#include "contacts/face_states.hpp"
#include "model/stage_names.hpp"
#include "step/divergence.hpp"

namespace edda {

struct Attached;
struct Scene;
struct Simulation;

/// Replaces the damping, and updates the step that it allows.
void change_damping(Simulation& sim, const Damping& now, bool carry_velocities);

/// Sets the strength factors: from now on the strength of law r as the model gives it is divided by
/// factors[r] (rows of the LawTable, above zero): cohesion, tangent of the friction angle and
/// tensile strength, peak and residual.
void set_strength_factors(Simulation& sim, const std::vector<double>& factors);
/// The same factor for all laws.
void set_strength_factor(Simulation& sim, double factor);
/// As set_strength_factors(), but without correcting the velocities for the jump of forces
/// (note_jump()).
void take_strength_factors(Simulation& sim, const std::vector<double>& factors);

/// Gives joints, rock or linings other properties (stage.change): laws of faces, strength of zones,
/// elasticity and strength of linings. Forces and stresses go on from what they are.
void change_properties(Simulation& sim, const PropertyChange& change);
/// The same in the scene alone, of these linings (by row).
void repeat_change(Scene& scene, const PropertyChange& change,
                   const std::vector<std::uint8_t>& linings);

/// Removes the rock of these openings (rows of Model::openings). The forces that it had on the
/// walls become loads, which keep their full value until relax() reduces them.
void excavate(Simulation& sim, const std::vector<Index>& openings);

/// Takes out a block whose trouble is its own (Failure::of_block), so that the others go on, and
/// enters it in Accounts::set_aside. False: with those taken out before it is more than a tenth of
/// all rock, so that the model itself is in trouble; nothing is changed then.
bool set_aside(Simulation& sim, const Failure& failure);
/// Releases `part` (0 to 1) of the forces that the rock of an opening had on its walls.
void relax(Simulation& sim, Index opening, double part);
/// Adds these forces to the loads.
void keep(Simulation& sim, const std::vector<WallForce>& more);

/// Deactivates the rows `off` and activates the rows `on`. A boundary of any type but stress that
/// is activated where another is deactivated takes over the forces that that one carried; energy
/// stored in springs that are removed counts as external work.
void switch_over(Simulation& sim, const NamedRows& off, const NamedRows& on);
/// Installs bolts (rows of all_bolts()) in the present positions of the rock.
std::optional<Fault> install(Simulation& sim, const std::vector<Index>& bolts);
/// Blocks that were not there come into being where they are placed, at rest and without force on
/// what they touch.
void begin_blocks(Simulation& sim, const std::vector<Id>& blocks);
/// Puts linings (rows of Model::linings) without stress on the walls as they are now.
void install_linings(Simulation& sim, const std::vector<Index>& rows);
/// Places fill (rows of Model::fills) without stress between the blocks as they are now; its weight
/// is released gradually (Loads::remaining). Fault: there is no room for it.
std::optional<Fault> place_fills(Simulation& sim, const std::vector<Index>& rows);
/// Glues all closed contacts, so that they neither open nor slide, or ends this.
void glue_joints(Simulation& sim, bool glued);

/// Displacements count from the present positions on.
void reset_displacements(Simulation& sim);
/// Every second step leaves the velocities in other arrays than the step before. This moves their
/// contents into the arrays of the step before, for views of them that outlive a step.
void exchange_velocity_arrays(Simulation& sim);
/// Replaces the velocities (finite, m/s); those of blocks that are not free do not change.
void change_velocities(Simulation& sim, const BodyVectors& velocity);
/// The ground and all free blocks lose the velocity v (m/s), as if the last step had been made
/// without it: the model is seen from a frame that moves with v. None of its forces changes.
void lose_velocity(Simulation& sim, Vec2 v);

/// The flow at the start, before contacts have forces.
void start_flow(Simulation& sim);
/// Water as drawn acts outside the joints alone, of a model with [flow].
void begin_flow(const Model& model, const BlockSet& blocks, Attached& attached);
/// Water in joints follows their motion and its own levels at so many steps.
inline constexpr std::uint64_t steps_between_flows = 50;
/// Solves the flow of water through the joints as they are now, of a model with [flow]. Where that
/// is not steady, puts the water that there is on their walls.
void update_flow(Simulation& sim);
/// From now on the water in joints has the time of SlowLoading::flow that passes.
void begin_timed_flow(Simulation& sim);
/// Solves for the water in joints at the end of a step that has been made under its pressures at
/// the beginning, and changes the forces so that it can be made again under those at its end.
void flow_within_step(Simulation& sim, double h_old);

/// Loads the outer faces with the initial stress, on boundaries too; at creation.
void load_boundaries_with_initial_stress(Simulation& sim);
/// Gives the contacts the forces that are in equilibrium with the initial stress; at creation.
void load_contacts_with_initial_stress(Simulation& sim, FaceStates& states);
/// The rock that was in openings from the start on holds their walls, and is to let go from now on
/// (Loads::remaining). Returns whether there is any, and an initial stress.
bool hold_walls_of_openings(Simulation& sim);

}  // namespace edda
