#include "model/keys.hpp"

#include <array>

#include "model/keys_geometry.hpp"
#include "model/rules.hpp"
#include "model/slots.hpp"

namespace edda {
namespace {

using namespace rules;
using namespace geometry_keys;

constexpr Range friction = from_below(0.0, 90.0);

// clang-format off
constexpr std::array root_keys{
    Key{"title", at<&Model::title>, text, initial, "What the pictures and tables are headed with."},
    Key{"gravity", at<&Model::gravity>, shape(Kind::point, D::acceleration), initial, "Acceleration of gravity, x and y."},
    Key{"plane", at<&Model::plane>, choice, initial, "Plane strain, or plane stress (a thin plate)."},
    Key{"thickness", at<&Model::thickness>, number(D::length, above(0)), initial, "Thickness out of plane that forces and masses are given for."},
};

constexpr std::array material_keys{
    Key{"density", at<&Material::density>, number(D::density, above(0)), otherwise("unit_weight / |gravity|"), "Mass per volume; either this or unit_weight must be given."},
    Key{"unit_weight", nullptr, number(D::unit_weight, above(0)), otherwise("density * |gravity|"), "Weight per volume, in place of density; divided by |gravity|, or by 9.81 m/s2 where that is zero."},
    Key{"young", at<&Material::young>, number(D::stress, above(0)), required, "Young's modulus."},
    Key{"poisson", at<&Material::poisson>, number(D::plain, between(-1, 0.5)), required, "Poisson's ratio."},
};

constexpr std::array strength_keys{
    Key{"friction_angle", at<&Strength::friction_angle>, number(D::angle, friction), otherwise("the joint's friction_angle"), "Friction angle after failure."},
    Key{"cohesion", at<&Strength::cohesion>, number(D::stress, from(0)), initial, "Cohesion after failure."},
    Key{"tensile_strength", at<&Strength::tensile_strength>, number(D::stress, from(0)), initial, "Tensile strength after failure."},
};

constexpr std::array joint_keys{
    Key{"type", at<&JointLaw::type>, choice, initial, "Coulomb friction with cohesion and tension, or glued: never opens or slides."},
    Key{"friction_angle", at<&JointLaw::peak, &Strength::friction_angle>, number(D::angle, friction), otherwise("required unless type is \"glued\""), "Friction angle until failure."},
    Key{"cohesion", at<&JointLaw::peak, &Strength::cohesion>, number(D::stress, from(0)), initial, "Cohesion until failure."},
    Key{"tensile_strength", at<&JointLaw::peak, &Strength::tensile_strength>, number(D::stress, from(0)), initial, "Tensile strength until failure."},
    Key{"residual", at<&JointLaw::residual>, table, otherwise("same friction angle, no cohesion, no tension"), "Strength after failure, and of contacts that were not closed at the start."},
    Key{"kn", at<&JointLaw::kn>, number(D::joint_stiffness, above(0)), otherwise("contact.normal_stiffness, as a spring per contact"), "Normal stiffness of the joint; the spring is kn times the length the contact stands for."},
    Key{"ks", at<&JointLaw::ks>, number(D::joint_stiffness, above(0)), otherwise("0.4 kn"), "Shear stiffness of the joint."},
};

constexpr std::array contact_keys{
    Key{"normal_stiffness", at<&ContactDefaults::normal_stiffness>, number(D::stiffness, above(0)), otherwise("10 x the largest young"), "Normal spring per contact where the joint has no kn."},
    Key{"shear_stiffness", at<&ContactDefaults::shear_stiffness>, number(D::stiffness, above(0)), otherwise("normal_stiffness"), "Shear spring per contact where the joint has no ks."},
    Key{"joint", at<&ContactDefaults::joint>, joint, otherwise(if_one), "Law of contacts whose edges name none."},
};

constexpr std::array block_keys{
    Key{"name", at<&BlockInput::name>, naming, otherwise("none"), "What --set and messages call the block."},
    Key{"polygon", at<&BlockInput::polygon>, polygon, required, "Corners in order, either way round, convex or not."},
    Key{"material", at<&BlockInput::material>, material, otherwise(if_one), "Material of the block."},
    Key{"joint", at<&BlockInput::joint>, joint, otherwise("contact.joint"), "Law of the block's edges."},
    Key{"fixed", at<&BlockInput::fixed>, flag, initial, "Whether all nodes of the block are held."},
    Key{"velocity", at<&BlockInput::velocity>, shape(Kind::point, D::velocity), initial, "Velocity at the start."},
    Key{"angular_velocity", at<&BlockInput::angular_velocity>, number(D::angular_velocity), initial, "Rate of rotation at the start, counter-clockwise."},
};

constexpr std::array boundary_keys{
    Key{"name", at<&Boundary::name>, naming, otherwise("none"), "What --set and messages call the boundary."},
    Key{"sides", at<&Boundary::sides>, words_of(side_names), otherwise("none; either this or along"), "Sides of the box round the model."},
    Key{"along", at<&Boundary::along>, polyline, otherwise("none; either this or sides"), "The polyline that the boundary follows."},
    Key{"type", at<&Boundary::type>, choice, initial, "Springs in x and y, or only across the line (roller), on each block vertex on it."},
    Key{"stiffness", at<&Boundary::stiffness>, number(D::stiffness, above(0)), otherwise("contact.normal_stiffness"), "Spring per block vertex."},
};

constexpr std::array load_keys{
    Key{"name", at<&Load::name>, naming, otherwise("none"), "What --set, stages and messages call the load."},
    Key{"point", at<&Load::point>, point, otherwise("none; either this or along"), "The point of a block that the force acts on, and moves with."},
    Key{"along", at<&Load::along>, polyline, otherwise("none; either this or point"), "The line whose edges carry a traction or a pressure."},
    Key{"force", at<&Load::force>, shape(Kind::point, D::load), otherwise("none; either this or pressure"), "Force at the point (N), or traction along the line (Pa), of constant direction."},
    Key{"pressure", at<&Load::pressure>, number(D::stress), otherwise("none; either this or force"), "Pressure across the edges along the line; turns with them."},
    Key{"history", at<&Load::history>, file, otherwise("constant from the start"), "CSV file of time and factor, linear between its rows."},
};

constexpr std::array water_keys{
    Key{"name", at<&Water::name>, naming, otherwise("none"), "What --set, stages and messages call the water."},
    Key{"table", at<&Water::table>, polyline, required, "Its level from left to right; joints and faces below carry its pressure, what lies beyond its ends is dry."},
    Key{"flooded", at<&Water::flooded>, name_list, initial, "Names of the openings that are full of water, too; the others are dry."},
    Key{"unit_weight", at<&Water::unit_weight>, number(D::unit_weight, above(0)), initial, "Weight of water per volume."},
    Key{"history", at<&Water::history>, file, otherwise("constant from the start"), "CSV file of time and rise of the table (m), linear between its rows."},
};

constexpr std::array monitor_keys{
    Key{"name", at<&Monitor::name>, naming, required, "What the columns of history.csv are called."},
    Key{"point", at<&Monitor::point>, point, required, "A material point of the block that holds it at the start."},
};

constexpr std::array damping_keys{
    Key{"mass", at<&Damping::mass>, number(D::rate, from(0)), initial, "Mass-proportional damping."},
    Key{"local", at<&Damping::local>, number(D::plain, from_below(0, 1)), initial, "Local damping (Cundall), a fraction of the unbalanced force."},
    Key{"contact", at<&Damping::contact>, number(D::plain, from(0)), initial, "Viscous damping at contacts, a fraction of critical."},
};

constexpr std::array stage_keys{
    Key{"name", at<&Stage::name>, naming, otherwise("none"), "What messages, stages.csv and --set call the stage."},
    Key{"until", at<&Stage::until>, choice, initial, "Whether it ends at its duration (time) or as soon as all is at rest (equilibrium)."},
    Key{"ratio", at<&Stage::ratio>, number(D::plain, above_to(0, 1)), initial, "Equilibrium: mean resultant force of the blocks over the mean contact force."},
    Key{"duration", at<&Stage::duration>, number(D::time, above(0)), otherwise("required until \"time\"; 10 s until \"equilibrium\""), "Length of the stage; until equilibrium the longest it may take."},
    Key{"reset_displacements", at<&Stage::reset_displacements>, flag, initial, "Whether displacements count from the start of this stage."},
    Key{"damping", at<&Stage::damping>, table, otherwise("solver.damping; until equilibrium local = 0.8"), "Damping while the stage lasts."},
};

constexpr std::array solver_keys{
    Key{"method", at<&Solver::method>, choice, initial, "Explicit (edda), or implicit with one global solve (dda)."},
    Key{"mass", at<&Solver::mass>, choice, initial, "How a block's mass sits on its nodes."},
    Key{"switching", at<&Solver::switching>, choice, initial, "Method edda: how contacts open and close, keeping the energy (exact) or as in the paper (plain)."},
    Key{"duration", at<&Solver::duration>, number(D::time, above(0)), otherwise("required unless there are stages: their durations together"), "Time to simulate."},
    Key{"time_step", at<&Solver::time_step>, number_or("auto", D::time, above(0)), otherwise("\"auto\""), "Time step; above the critical step it is refused."},
    Key{"allow_unstable", at<&Solver::allow_unstable>, flag, initial, "Method edda: whether a time step above the critical one is run all the same."},
    Key{"safety", at<&Solver::safety>, number(D::plain, above_to(0, 1)), initial, "Method edda: part of the critical step that is taken when time_step is \"auto\"."},
    Key{"dynamic", at<&Solver::dynamic>, flag, initial, "Method dda: whether velocities carry over from step to step, or are dropped (for the state at rest)."},
    Key{"max_displacement_ratio", at<&Solver::max_displacement_ratio>, number(D::plain, above_to(0, 1)), initial, "Largest displacement in one step, of the model's half-height."},
    Key{"mass_scaling", at<&Solver::mass_scaling>, number(D::time, from(0)), initial, "Method edda: the inertia of the few blocks that hold the step below this is raised until they do not (their weight stays); 0: off."},
    Key{"damping", at<&Solver::damping>, table, initial, "Damping of the motion."},
};

constexpr std::array output_keys{
    Key{"every", at<&Output::every>, number(D::time, above(0)), otherwise("solver.duration / 20"), "Time between pictures of all blocks."},
    Key{"history_every", at<&Output::history_every>, number(D::time, above(0)), otherwise("solver.duration / 200"), "Time between rows of history.csv."},
    Key{"checkpoint_every", at<&Output::checkpoint_every>, number(D::plain, above(0)), initial, "Minutes of wall time between checkpoints."},
};

constexpr Section root_section{"", Shape::root, false, root_keys, "The model as a whole.",
    [](const Model&) { return std::size_t{1}; }, [](Model& m) -> void* { return &m; },
    [](Model& m, std::size_t) -> void* { return &m; }, nullptr, nullptr};

constexpr std::array all_sections{
    root_section,
    section<&Model::materials>("materials", Shape::named, material_keys, "Elastic rock."),
    section<&Model::joints>("joints", Shape::named, joint_keys, "The contact law of a joint."),
    section<&Model::contact>("contact", Shape::table, contact_keys, "What holds for contacts whose joint says nothing else."),
    section<&Model::blocks>("block", Shape::list, block_keys, "A block given as it is."),
    section<&Model::domain>("domain", Shape::table, domain_keys, "A region that joint sets, traces and openings cut into blocks."),
    section<&Model::slope>("slope", Shape::table, slope_keys, "An outline by a few numbers: ground that rises to the right."),
    section<&Model::section>("section", Shape::table, cross_section_keys, "How the model's plane lies in the ground."),
    section<&Model::joint_sets>("joint_set", Shape::list, joint_set_keys, "Parallel, straight joints."),
    section<&Model::traces>("trace", Shape::list, trace_keys, "A single joint."),
    section<&Model::networks>("fracture_network", Shape::list, network_keys, "Independent fractures."),
    section<&Model::voronoi>("voronoi", Shape::table, voronoi_keys, "The domain as Voronoi polygons."),
    section<&Model::imports>("import", Shape::list, import_keys, "Lines from a file."),
    section<&Model::openings>("opening", Shape::list, opening_keys, "A part of the domain that is taken out."),
    section<&Model::regions>("region", Shape::list, region_keys, "Another material inside a polygon."),
    section<&Model::held>("held", Shape::list, held_keys, "A cut block that does not move."),
    section<&Model::walls>("brick_wall", Shape::list, wall_keys, "Bricks in running bond, half bricks closing the odd rows."),
    section<&Model::arches>("arch", Shape::list, arch_keys, "Voussoirs."),
    section<&Model::quality>("quality", Shape::table, quality_keys, "Which cut blocks are too small or too thin, and what becomes of them."),
    section<&Model::pairs>("contact_pair", Shape::list, pair_keys, "The law where two joints or two materials meet."),
    section<&Model::boundaries>("boundary", Shape::list, boundary_keys, "Springs that hold the model at a line."),
    section<&Model::loads>("load", Shape::list, load_keys, "A force at a point, or a traction or pressure along a line."),
    section<&Model::waters>("water", Shape::list, water_keys, "Water in joints and on faces below a table."),
    section<&Model::monitors>("monitor", Shape::list, monitor_keys, "A point whose history is written."),
    section<&Model::stages>("stage", Shape::list, stage_keys, "A part of the run, one after the other."),
    section<&Model::solver>("solver", Shape::table, solver_keys, "How the motion is computed."),
    section<&Model::output>("output", Shape::table, output_keys, "What is written, and how often."),
};
// clang-format on

}  // namespace

std::span<const Key> keys_of(const Strength&) {
  return strength_keys;
}
std::span<const Key> keys_of(const Damping&) {
  return damping_keys;
}
std::span<const Key> keys_of(const Deviation&) {
  return deviation_keys;
}
std::span<const Key> keys_of(const AngleSpread&) {
  return angle_spread_keys;
}
std::span<const Key> keys_of(const LengthSpread&) {
  return length_spread_keys;
}
std::span<const Key> keys_of(const OpeningShape&) {
  return shape_keys;
}

std::span<const Section> sections() {
  return all_sections;
}

const Section* find_section(std::string_view name) {
  for (const Section& s : all_sections) {
    if (s.shape != Shape::root && s.name == name) return &s;
  }
  return nullptr;
}

const Key* find_key(std::span<const Key> keys, std::string_view name) {
  for (const Key& key : keys) {
    if (key.name == name) return &key;
  }
  return nullptr;
}

std::vector<std::string_view> key_names(std::span<const Key> keys) {
  std::vector<std::string_view> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}

}  // namespace edda
