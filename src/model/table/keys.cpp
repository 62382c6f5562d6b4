#include "model/table/keys.hpp"

#include <array>

#include "model/table/keys_geometry.hpp"
#include "model/table/rules.hpp"
#include "model/table/slots.hpp"

namespace edda {
namespace {

using namespace rules;
using namespace geometry_keys;

constexpr Range friction = from_below(0.0, 90.0);

// clang-format off
constexpr std::array root_keys{
    Key{"title", at<&Model::title>, text, initial, "Title of pictures and tables."},
    Key{"gravity", at<&Model::gravity>, shape(Kind::point, D::acceleration), initial, "Acceleration of gravity, x and y."},
    Key{"plane", at<&Model::plane>, choice, initial, "Plane strain, or plane stress (a thin plate)."},
    Key{"deformation", at<&Model::deformation>, choice, initial, "How blocks deform. Corners: the corners of a block deviate from its mean strain, so that the block bends (with contact.model faces; a triangle has one strain in any case). Uniform: each has one strain, and is too stiff in bending. Zones: each is a mesh of triangles. Auto: zones with [zones], else corners. materials.NAME.deformation goes first."},
    Key{"thickness", at<&Model::thickness>, number(D::length, above(0)), initial, "Thickness out of plane for which forces and masses are given."},
};

constexpr std::array material_keys{
    Key{"density", at<&Material::density>, number(D::density, above(0)), otherwise("unit_weight / |gravity|"), "Mass per volume; either this or unit_weight must be given."},
    Key{"unit_weight", nullptr, number(D::unit_weight, above(0)), otherwise("density * |gravity|"), "Weight per volume, in place of density; divided by |gravity|, or by 9.81 m/s2 where that is zero."},
    Key{"young", at<&Material::young>, number(D::stress, above(0)), required, "Young's modulus."},
    Key{"poisson", at<&Material::poisson>, number(D::plain, between(-1, 0.5)), required, "Poisson's ratio."},
    Key{"damping", at<&Material::damping>, number(D::plain, from(0)), initial, "Viscous damping of the strain of a block, as a fraction of critical damping of its lowest natural frequency; it hardly affects motion far below that frequency. 0: none. Linings have it at the highest frequency of a piece by itself, but not with adaptive damping; other meshed blocks do not have it."},
    Key{"rayleigh", at<&Material::rayleigh>, table, otherwise("solver.damping.rayleigh, else damping"), "Damping of its blocks in proportion to mass and stiffness, least at one frequency (Rayleigh), in place of damping and of the rayleigh of solver.damping or of a stage; not in stages with adaptive damping (those until equilibrium)."},
    Key{"deformation", at<&Material::deformation>, choice, initial, "How blocks of this material deform: corners, uniform or zones; auto: zones with a yield or foliation table, else as the model says."},
    Key{"zone_size", at<&Material::zone_size>, number(D::length, above(0)), otherwise("zones.size"), "Length of the edges of zones in this material, in place of zones.size."},
    Key{"pore_pressure", at<&Material::pore_pressure>, flag, initial, "Whether the water of [[water]] is in the pores of its zones, too, whose strength is then one of effective stresses; false: a strength of total stresses (undrained clay), or rock without pores."},
    Key{"yield", at<&Material::yield>, table, otherwise("none: the rock stays elastic"), "Where the rock of zones yields: after Mohr and Coulomb (friction_angle, cohesion) or after Hoek and Brown (ucs with gsi and mi, or with m and s), with a tension cut-off."},
    Key{"foliation", at<&Material::foliation>, table, otherwise("none"), "Planes of weakness of one direction throughout the rock of zones (foliation, bedding, ubiquitous joints): elasticity across them, slip and opening on them."},
    Key{"strength", at<&Material::strength>, table, otherwise("none: overstress is not computed"), "Strength of the intact rock; blocks stay elastic, over-stressed ones are reported."},
};

constexpr std::array yield_keys{
    Key{"friction_angle", at<&Yield::peak, &RockMass::friction_angle>, number(D::angle, friction), otherwise("required of Mohr and Coulomb"), "Friction angle of the rock mass (Mohr and Coulomb)."},
    Key{"cohesion", at<&Yield::peak, &RockMass::cohesion>, number(D::stress, from(0)), otherwise("required of Mohr and Coulomb"), "Its cohesion."},
    Key{"tensile_strength", at<&Yield::peak, &RockMass::tensile_strength>, number(D::stress, from(0)), otherwise("0; of Hoek and Brown s ucs / m"), "Its tensile strength; no more than cohesion / tan(friction_angle), or s ucs / m."},
    Key{"dilation_angle", at<&Yield::peak, &RockMass::dilation_angle>, number(D::angle, from_below(0, 90)), otherwise("0"), "Its dilation angle; no more than friction_angle."},
    Key{"ucs", at<&Yield::peak, &RockMass::ucs>, number(D::stress, above(0)), otherwise("required of Hoek and Brown"), "Uniaxial compressive strength of the intact rock (Hoek and Brown)."},
    Key{"gsi", at<&Yield::peak, &RockMass::gsi>, number(D::plain, from_to(0, 100)), otherwise("none: m and s are given"), "Geological strength index of the rock mass."},
    Key{"mi", at<&Yield::peak, &RockMass::mi>, number(D::plain, above(0)), otherwise("required with gsi"), "Hoek and Brown's m of the intact rock."},
    Key{"disturbance", at<&Yield::peak, &RockMass::disturbance>, number(D::plain, from_to(0, 1)), otherwise("0"), "Disturbance factor D."},
    Key{"m", at<&Yield::peak, &RockMass::m>, number(D::plain, above(0)), otherwise("from gsi, mi and disturbance"), "Hoek and Brown's m of the rock mass, in place of gsi and mi."},
    Key{"s", at<&Yield::peak, &RockMass::s>, number(D::plain, from_to(0, 1)), otherwise("from gsi and disturbance; required with m"), "Hoek and Brown's s of the rock mass."},
    Key{"a", at<&Yield::peak, &RockMass::a>, number(D::plain, between(0, 1)), otherwise("from gsi; 0.5 with m"), "Hoek and Brown's a of the rock mass."},
    Key{"residual", at<&Yield::residual>, table, otherwise("none: the strength does not fall"), "Strength to which the rock softens as it shears; what it leaves out is as at the peak."},
    Key{"slip_distance", at<&Yield::slip_distance>, number(D::length, from(0)), otherwise("required with residual"), "Slip of a band of rock over which the strength falls to the residual one, whatever the size of the zones; 0: at once."},
};

constexpr std::array rock_mass_keys{
    Key{"friction_angle", at<&RockMass::friction_angle>, number(D::angle, friction), otherwise("as at the peak"), "Friction angle of the rock mass (Mohr and Coulomb)."},
    Key{"cohesion", at<&RockMass::cohesion>, number(D::stress, from(0)), otherwise("as at the peak"), "Its cohesion."},
    Key{"tensile_strength", at<&RockMass::tensile_strength>, number(D::stress, from(0)), otherwise("as at the peak"), "Its tensile strength; no more than cohesion / tan(friction_angle), or s ucs / m."},
    Key{"dilation_angle", at<&RockMass::dilation_angle>, number(D::angle, from_below(0, 90)), otherwise("as at the peak"), "Its dilation angle; no more than friction_angle."},
    Key{"ucs", at<&RockMass::ucs>, number(D::stress, above(0)), otherwise("as at the peak"), "Uniaxial compressive strength of the intact rock (Hoek and Brown)."},
    Key{"gsi", at<&RockMass::gsi>, number(D::plain, from_to(0, 100)), otherwise("as at the peak"), "Geological strength index of the rock mass."},
    Key{"mi", at<&RockMass::mi>, number(D::plain, above(0)), otherwise("as at the peak"), "Hoek and Brown's m of the intact rock."},
    Key{"disturbance", at<&RockMass::disturbance>, number(D::plain, from_to(0, 1)), otherwise("as at the peak"), "Disturbance factor D."},
    Key{"m", at<&RockMass::m>, number(D::plain, above(0)), otherwise("as at the peak"), "Hoek and Brown's m of the rock mass, in place of gsi and mi."},
    Key{"s", at<&RockMass::s>, number(D::plain, from_to(0, 1)), otherwise("as at the peak"), "Hoek and Brown's s of the rock mass."},
    Key{"a", at<&RockMass::a>, number(D::plain, between(0, 1)), otherwise("as at the peak"), "Hoek and Brown's a of the rock mass."},
};

constexpr std::array foliation_keys{
    Key{"angle", at<&FoliationInputs::angle>, number(D::angle, from_to(-180, 180)), required, "Angle of the trace of the planes from +x, counter-clockwise."},
    Key{"young", at<&FoliationInputs::young>, number(D::stress, above(0)), otherwise("the material's"), "Young's modulus across the planes; that of the material is along them."},
    Key{"poisson", at<&FoliationInputs::poisson>, number(D::plain, between(-1, 1)), otherwise("the material's"), "Strain along the planes over strain across them, under a stress across them."},
    Key{"shear_modulus", at<&FoliationInputs::shear_modulus>, number(D::stress, above(0)), otherwise("by Saint-Venant: 1 / (1 / E + (1 + 2 nu') / E')"), "Shear modulus of shear along the planes."},
    Key{"friction_angle", at<&FoliationInputs::friction_angle>, number(D::angle, friction), otherwise("none: the planes do not slip"), "Friction angle of the planes."},
    Key{"cohesion", at<&FoliationInputs::cohesion>, number(D::stress, from(0)), otherwise("0"), "Cohesion of the planes."},
    Key{"tensile_strength", at<&FoliationInputs::tensile_strength>, number(D::stress, from(0)), otherwise("0"), "Tensile strength across the planes; no more than cohesion / tan(friction_angle)."},
    Key{"dilation_angle", at<&FoliationInputs::dilation_angle>, number(D::angle, from_below(0, 90)), otherwise("0"), "Dilation angle of the planes; no more than friction_angle."},
};

constexpr std::array zones_keys{
    Key{"size", at<&ZoneInputs::size>, number_or("auto", D::length, above(0)), otherwise("\"auto\": an eighth of the half-width of the narrowest opening, or else a thirtieth of the width of the model"), "Length of the edges of zones, at openings where there are any. A block has at least two zones across its width."},
    Key{"growth", at<&ZoneInputs::growth>, number(D::plain, from_to(0, 1)), otherwise("0 where a size is given, else 0.15"), "By what that length grows per metre of distance from the nearest opening."},
};

constexpr std::array rock_strength_keys{
    Key{"ucs", at<&RockStrength::ucs>, number(D::stress, above(0)), required, "Uniaxial compressive strength of the intact rock."},
    Key{"tension", at<&RockStrength::tension>, number(D::stress, above(0)), required, "Its tensile strength."},
};

constexpr std::array strength_keys{
    Key{"friction_angle", at<&Strength::friction_angle>, number(D::angle, friction), otherwise("the joint's friction_angle"), "Friction angle after failure."},
    Key{"cohesion", at<&Strength::cohesion>, number(D::stress, from(0)), initial, "Cohesion after failure."},
    Key{"tensile_strength", at<&Strength::tensile_strength>, number(D::stress, from(0)), initial, "Tensile strength after failure."},
};

constexpr std::array joint_keys{
    Key{"type", at<&JointLaw::type>, choice, initial, "Coulomb friction with cohesion and tension; glued: never opens or slides; slip-weakening: from the peak to the residual strength over slip_distance; barton-bandis: by jrc, jcs and residual_angle."},
    Key{"friction_angle", at<&JointLaw::peak, &Strength::friction_angle>, number(D::angle, friction), otherwise("required unless type is \"glued\" or \"barton-bandis\""), "Friction angle until failure."},
    Key{"cohesion", at<&JointLaw::peak, &Strength::cohesion>, number(D::stress, from(0)), initial, "Cohesion until failure."},
    Key{"tensile_strength", at<&JointLaw::peak, &Strength::tensile_strength>, number(D::stress, from(0)), initial, "Tensile strength until failure."},
    Key{"residual", at<&JointLaw::residual>, table, otherwise("same friction angle, no cohesion, no tension"), "Strength after failure, and of contacts that were not closed at the start."},
    Key{"dilation_angle", at<&JointLaw::dilation_angle>, number(D::angle, from_below(0, 90)), otherwise("none"), "Dilation angle: tangent of opening over slip; less than the friction angles of the joint."},
    Key{"slip_distance", at<&JointLaw::slip_distance>, number(D::length, above(0)), otherwise("required of slip-weakening; of Coulomb friction: unlimited"), "Slip from peak to residual strength, at which dilation also ends."},
    Key{"fracture_energy", at<&JointLaw::fracture_energy>, number(D::surface_energy, above(0)), otherwise("none: bonds fail at once"), "Energy that a crack takes in tension, for each area: tensile_strength falls linearly as the joint opens, to 0 at 2 fracture_energy / tensile_strength. Of Coulomb friction, with shear_fracture_energy."},
    Key{"shear_fracture_energy", at<&JointLaw::shear_fracture_energy>, number(D::surface_energy, above(0)), otherwise("required with fracture_energy"), "Energy that a crack takes in shear beside friction, for each area: cohesion falls linearly with slip, to 0 at 2 shear_fracture_energy / cohesion."},
    Key{"decay_time", at<&JointLaw::decay_time>, number(D::time, above(0)), otherwise("none: it does not fall with time"), "Time in which the peak strength falls to 1/e of what it is above the residual one, exponentially, in stages with a duration and in ramps of time."},
    Key{"jrc", at<&JointLaw::jrc>, number(D::plain, from_to(0, 20)), otherwise("required of barton-bandis"), "Joint roughness coefficient, for walls as long as the blocks' edges."},
    Key{"jcs", at<&JointLaw::jcs>, number(D::stress, above(0)), otherwise("required of barton-bandis"), "Compressive strength of the joint's walls."},
    Key{"residual_angle", at<&JointLaw::residual_angle>, number(D::angle, friction), otherwise("required of barton-bandis"), "Residual friction angle of barton-bandis."},
    Key{"kn", at<&JointLaw::kn>, number(D::joint_stiffness, above(0)), otherwise("from the blocks, or contact.normal_stiffness at each end of a face"), "Normal stiffness of the joint: its pressure is kn times its closure."},
    Key{"ks", at<&JointLaw::ks>, number(D::joint_stiffness, above(0)), otherwise("0.4 kn"), "Shear stiffness of the joint."},
    Key{"aperture", at<&JointLaw::aperture>, number(D::length, from(0)), otherwise("required with [flow], unless type is \"glued\""), "Hydraulic aperture of the joint as drawn, from which it opens and closes; 0: it is watertight."},
    Key{"residual_aperture", at<&JointLaw::residual_aperture>, number(D::length, above(0)), otherwise("a tenth of aperture"), "Hydraulic aperture that remains however much the joint closes."},
    Key{"largest_aperture", at<&JointLaw::largest_aperture>, number(D::length, above(0)), otherwise("10 aperture"), "Hydraulic aperture beyond which an opening joint conducts no more water."},
    Key{"restitution", at<&JointLaw::restitution>, number_or("housner", D::plain, from_to(0, 1)), otherwise("what remains with the damping of blocks and contacts"), "Method edda: the part of its velocity with which a block leaves after an impact, flat or on a corner, of any shape and mass (of 0.1 to 0.8 within 3 %, or 0.015; 0 leaves up to 0.09; with a kn as stiff as the rock right for squares alone, and a warning says so), or \"housner\": a rocking block loses at each impact the energy of Housner's assumption. Dashpots in these contacts produce this, and unless kn is given their springs are soft: a thirtieth of the smallest young (below 0.2 a hundredth, housner a fifteenth)."},
};

constexpr std::array contact_keys{
    Key{"model", at<&ContactDefaults::model>, choice, initial, "Contacts are faces: an edge of one block against an opposed edge of another; or points: a vertex on an edge, as in the paper, for comparison only."},
    Key{"normal_stiffness", at<&ContactDefaults::normal_stiffness>, number_or("auto", D::stiffness, above(0)), otherwise("\"auto\": 10 x young between squares; such that joints add a twentieth to the deformation of the rock"), "Normal spring at each end of a face where the joint has no kn."},
    Key{"shear_stiffness", at<&ContactDefaults::shear_stiffness>, number_or("auto", D::stiffness, above(0)), otherwise("\"auto\": as normal_stiffness"), "Shear spring at each end of a face where the joint has no ks."},
    Key{"joint", at<&ContactDefaults::joint>, joint, otherwise(if_one), "Law of contacts whose edges name none."},
    Key{"close_gaps", at<&ContactDefaults::close_gaps>, number(D::length, from(0)), or_none("none are"), "Joints between blocks, walls and drawn blocks that are drawn up to so wide, such as with mortar, are closed: both edges move to the middle between them."},
};

constexpr std::array block_keys{
    Key{"name", at<&BlockInput::name>, naming, otherwise("none"), "What --set and messages call the block."},
    Key{"polygon", at<&BlockInput::polygon>, polygon, required, "Corners in order, either way round, convex or not."},
    Key{"material", at<&BlockInput::material>, material, otherwise(if_one), "Material of the block."},
    Key{"joint", at<&BlockInput::joint>, joint, otherwise("contact.joint"), "Law of the block's edges."},
    Key{"fixed", at<&BlockInput::fixed>, flag, initial, "Whether the block is fixed: it does not move, except with the ground."},
    Key{"velocity", at<&BlockInput::velocity>, shape(Kind::point, D::velocity), initial, "Velocity at the start."},
    Key{"angular_velocity", at<&BlockInput::angular_velocity>, number(D::angular_velocity), initial, "Rate of rotation at the start, counter-clockwise."},
};

constexpr std::array boundary_keys{
    Key{"name", at<&Boundary::name>, naming, otherwise("none"), "What --set and messages call the boundary."},
    Key{"sides", at<&Boundary::sides>, words_of(side_names), otherwise("none; either this or along"), "Sides of the box round the model."},
    Key{"along", at<&Boundary::along>, polyline, otherwise("none; either this or sides"), "The polyline that the boundary follows."},
    Key{"type", at<&Boundary::type>, choice, initial, "Springs in x and y (fixed) or only across the line (roller) on each block vertex on it; springs whose far ends move at a velocity (velocity) or by a displacement (displacement); dashpots that absorb waves (viscous); a traction on the edges (stress); vertical sides that ground motion moves as the ground beyond them (free-field)."},
    Key{"stiffness", at<&Boundary::stiffness>, number(D::stiffness, above(0)), otherwise("the largest kn of the joints of the vertex's block, or where none gives kn that of its penalty, times half of the faces beside the vertex that lie on the line"), "Types fixed, roller, velocity and displacement: spring per block vertex."},
    Key{"traction", at<&Boundary::traction>, shape(Kind::point, D::stress), otherwise("that of [initial_stress]; required by type stress without one"), "Type stress: traction on the edges along the line, of constant direction."},
    Key{"velocity", at<&Boundary::velocity>, shape(Kind::point, D::velocity), otherwise("none; required by type velocity"), "Type velocity: velocity at which the vertices on the line are moved."},
    Key{"displacement", at<&Boundary::displacement>, shape(Kind::point, D::length), otherwise("none; required by type displacement"), "Type displacement: displacement of the support, from where its vertices lie when it begins to act; gradual in a stage until equilibrium."},
    Key{"frictionless", at<&Boundary::frictionless>, flag, initial, "Types velocity and displacement: whether the springs act across the line only, so that vertices slide along it (a smooth platen)."},
    Key{"wave_speeds", at<&Boundary::wave_speeds>, shape(Kind::point, D::velocity, above(0)), otherwise("those of the unjointed rock of each block"), "Types viscous and free-field: speeds of P and S waves in the jointed rock."},
    Key{"history", at<&Boundary::history>, file, otherwise("constant from the start"), "Types stress, velocity and displacement: CSV file of time and factor, linear between its rows."},
};

constexpr std::array initial_stress_keys{
    Key{"stress", at<&InitialStress::stress>, shape(Kind::triple, D::stress), otherwise("none; either this or k0"), "Total stress xx, yy and xy at y = at_y, positive in tension."},
    Key{"at_y", at<&InitialStress::at_y>, number(D::length), otherwise("0"), "Level for which the stress is given."},
    Key{"gradient", at<&InitialStress::gradient>, shape(Kind::triple, D::stress_gradient), otherwise("[0, 0, 0]"), "Increase of xx, yy and xy per metre of y."},
    Key{"k0", at<&InitialStress::k0>, number(D::plain, from(0)), otherwise("none; either this or stress"), "Horizontal over vertical stress, total ones where there is water; the vertical one is the weight of the rock above."},
    Key{"k0_out", at<&InitialStress::k0_out>, number(D::plain, from(0)), otherwise("k0; with stress: zz is nu (xx + yy)"), "Out-of-plane over vertical stress, zz / yy."},
    Key{"surface_y", at<&InitialStress::surface_y>, number(D::length), otherwise("none; k0 requires it, or surface"), "Level of the ground's surface; it may lie above the model."},
    Key{"surface", at<&InitialStress::surface>, choice, initial, "Where the ground ends: at a level (surface_y), or at the upper side of the domain's outline."},
};

constexpr std::array load_keys{
    Key{"name", at<&Load::name>, naming, otherwise("none"), "What --set, stages and messages call the load."},
    Key{"point", at<&Load::point>, point, otherwise("none; either this, along or within"), "The point of a block that the force acts on, and moves with."},
    Key{"along", at<&Load::along>, polyline, otherwise("none; either this, point or within"), "The line whose edges carry a traction or a pressure."},
    Key{"within", at<&Load::within>, polygon, otherwise("none; either this, point or along"), "The polygon whose blocks carry a body force: those with their centroid in it."},
    Key{"force", at<&Load::force>, shape(Kind::point, D::load), otherwise("none; either this, pressure or body_force"), "Force at the point (N), or traction along the line (Pa), of constant direction."},
    Key{"pressure", at<&Load::pressure>, number(D::stress), otherwise("none; either this, force or body_force"), "Pressure normal to the edges along the line; it rotates with them."},
    Key{"body_force", at<&Load::body_force>, shape(Kind::point, D::unit_weight), otherwise("none; belongs to within"), "Force per volume on each block within the polygon, of constant direction."},
    Key{"history", at<&Load::history>, file, otherwise("constant from the start"), "CSV file of time and factor, linear between its rows."},
};

constexpr std::array flow_keys{
    Key{"viscosity", at<&FlowInputs::viscosity>, number(D::viscosity, above(0)), initial, "Dynamic viscosity of the water."},
    Key{"bulk_modulus", at<&FlowInputs::bulk_modulus>, number(D::stress, above(0)), initial, "Bulk modulus of the water, which counts where flow takes its time."},
};

constexpr std::array water_keys{
    Key{"name", at<&Water::name>, naming, otherwise("none"), "What --set, stages and messages call the water."},
    Key{"table", at<&Water::table>, polyline, otherwise("none; either this or level"), "Its level from left to right; joints and faces below carry its pressure; joints and faces beyond its ends are dry. With [flow] only faces outside the joints: ground under open water, walls of flooded openings."},
    Key{"level", at<&Water::level>, number(D::length), otherwise("none; either this or table"), "With [flow]: its level where it acts along a line in the rock alone, such as that of a drain."},
    Key{"rain", at<&Water::rain>, number(D::velocity, above(0)), otherwise("none; in place of table and level"), "With [flow]: rain on the ground under the open sky, such as \"20 mm/h\": joints take it in as far as they can, the rest runs off."},
    Key{"injection", at<&Water::injection>, number(D::discharge, above(0)), otherwise("none; in place of table and level"), "With [flow]: what a borehole injects into the joints, for each metre of thickness."},
    Key{"at", at<&Water::at>, point, otherwise("required with injection"), "Where the injection is; it goes into the crossing or end of joints that conduct water inside the rock nearest to this point, as drawn."},
    Key{"sides", at<&Water::sides>, words_of(side_names), otherwise("none"), "With [flow]: sides of the box round the model along which the rock has its head; there water flows in and out. Sides with a boundary are impermeable otherwise."},
    Key{"along", at<&Water::along>, polyline, otherwise("none"), "With [flow]: a line that has its head where it meets joints, such as a row of drain holes."},
    Key{"flooded", at<&Water::flooded>, name_list, initial, "Names of the openings that are full of water, too; the others are dry."},
    Key{"unit_weight", at<&Water::unit_weight>, number(D::unit_weight, above(0)), initial, "Weight of water per volume."},
    Key{"history", at<&Water::history>, file, otherwise("constant from the start"), "CSV file of time and rise of the table (m), of rain and injections of time and factor, linear between its rows."},
};

constexpr std::array shaking_keys{
    Key{"name", at<&Shaking::name>, naming, otherwise("none"), "What --set, stages and messages call the ground motion."},
    Key{"acceleration", at<&Shaking::acceleration>, source, required, "Acceleration of the ground: a CSV file of time, x and y (m/s2) or of time and one component, a record of PEER (AT2), K-NET, COSMOS, CSMIP, ESM or GeoNet, or a sine as a table."},
    Key{"direction", at<&Shaking::direction>, shape(Kind::point, D::plain), initial, "Direction of the component of a file that has one."},
    Key{"units", at<&Shaking::units>, choice, initial, "Unit of the accelerations in the file. As stated: in its head; a CSV file of two components without one is in m/s2."},
    Key{"component", at<&Shaking::component>, whole(1, 9), initial, "Which component of a record that has several, in the order of the file."},
    Key{"scale", at<&Shaking::scale>, number(D::plain), initial, "Factor on the acceleration."},
    Key{"apply", at<&Shaking::apply>, choice, initial, "Fixed blocks and boundaries move (base), all blocks feel its inertia force (inertia), or it is a wave that enters upwards through a viscous boundary (upgoing)."},
    Key{"boundary", at<&Shaking::boundary>, naming, otherwise("the only viscous one"), "Upgoing: name of the viscous boundary through which the wave enters."},
};

constexpr std::array acceleration_keys{
    Key{"amplitude", at<&Acceleration::amplitude>, number(D::acceleration), required, "Amplitude of the sine."},
    Key{"frequency", at<&Acceleration::frequency>, number(D::frequency, above(0)), required, "Frequency of the sine, which begins at zero: the ground then has a mean velocity of amplitude/(2 pi frequency) which displaces it steadily; docs/pictures.md describes how to subtract this displacement."},
    Key{"direction", at<&Acceleration::direction>, shape(Kind::point, D::plain), initial, "Direction of the sine."},
};

constexpr std::array bond_keys{
    Key{"stiffness", at<&BoltBond::stiffness>, number(D::stress, from(0)), required, "Force per slip and per metre of bolt."},
    Key{"strength", at<&BoltBond::strength>, number(D::line_load, from(0)), required, "Largest force per metre of bolt."},
};

constexpr std::array dowel_keys{
    Key{"stiffness", at<&BoltDowel::stiffness>, number(D::line_load, from(0)), otherwise("as of the bar in its foundation"), "Force across the bolt per relative displacement of the walls of the joint. Either this and strength, or neither: then both follow from diameter, young and yield_stress of the bar, it bends and yields under shear and tension together, and turns into the joint."},
    Key{"strength", at<&BoltDowel::strength>, number(D::force, from(0)), otherwise("as of the bar in its foundation"), "Largest force across the bolt."},
    Key{"bearing_strength", at<&BoltDowel::bearing_strength>, number(D::stress, above(0)), otherwise("ucs of the rock (of materials.NAME.strength or yield)"), "Pressure on the diameter of the bar at which it crushes grout and rock."},
    Key{"foundation_modulus", at<&BoltDowel::foundation_modulus>, number(D::stress, above(0)), otherwise("Young's modulus of the rock"), "Force per metre of bar and metre of its deflection by which grout and rock bear on it."},
};

constexpr std::array bolt_keys{
    Key{"name", at<&Bolt::name>, naming, otherwise("none"), "What --set, stages and tables call the bolt."},
    Key{"from", at<&Bolt::from>, point, required, "Head of the bolt."},
    Key{"to", at<&Bolt::to>, point, required, "Its far end."},
    Key{"type", at<&Bolt::type>, choice, initial, "Grouted along its length, or fixed at its ends (end)."},
    Key{"diameter", at<&Bolt::diameter>, number(D::length, above(0)), required, "Diameter of the steel."},
    Key{"young", at<&Bolt::young>, number(D::stress, above(0)), initial, "Young's modulus of the steel."},
    Key{"yield_stress", at<&Bolt::yield_stress>, number(D::stress, above(0)), otherwise("none: it never yields"), "Stress at which it yields."},
    Key{"rupture_strain", at<&Bolt::rupture_strain>, number(D::plain, above(0)), otherwise("none: it never breaks"), "Strain at which it breaks."},
    Key{"spacing", at<&Bolt::spacing>, number(D::length, above(0)), initial, "Distance from bolt to bolt out of plane."},
    Key{"pretension", at<&Bolt::pretension>, number(D::force, from(0)), initial, "Force in the bolt when it is installed, per bolt."},
    Key{"bond", at<&Bolt::bond>, table, otherwise("none; required by a grouted bolt"), "Stiffness and strength of the grout, per metre of bolt."},
    Key{"dowel", at<&Bolt::dowel>, table, otherwise("no dowel action"), "Stiffness and strength across the bolt where it crosses a joint, per bolt; { } has both follow from the bar and the rock."},
};

constexpr std::array bolt_pattern_keys{
    Key{"name", at<&BoltPattern::name>, naming, otherwise("none"), "What --set, stages and tables call the bolts: with .0, .1 and so on."},
    Key{"opening", at<&BoltPattern::opening>, naming, required, "Name of the opening round which the bolts are placed."},
    Key{"from_angle", at<&BoltPattern::from_angle>, number(D::angle), required, "Direction of the first bolt from the centroid of the opening, counter-clockwise from +x."},
    Key{"to_angle", at<&BoltPattern::to_angle>, number(D::angle), required, "Direction of the last bolt."},
    Key{"count", at<&BoltPattern::count>, whole(1, 1e5), required, "Number of bolts."},
    Key{"length", at<&BoltPattern::length>, number(D::length, above(0)), required, "Length of a bolt from the outline of the opening outwards."},
    Key{"type", at<&BoltPattern::bolt, &Bolt::type>, choice, initial, "As of a bolt."},
    Key{"diameter", at<&BoltPattern::bolt, &Bolt::diameter>, number(D::length, above(0)), required, "As of a bolt."},
    Key{"young", at<&BoltPattern::bolt, &Bolt::young>, number(D::stress, above(0)), initial, "As of a bolt."},
    Key{"yield_stress", at<&BoltPattern::bolt, &Bolt::yield_stress>, number(D::stress, above(0)), otherwise("none: it never yields"), "As of a bolt."},
    Key{"rupture_strain", at<&BoltPattern::bolt, &Bolt::rupture_strain>, number(D::plain, above(0)), otherwise("none: it never breaks"), "As of a bolt."},
    Key{"spacing", at<&BoltPattern::bolt, &Bolt::spacing>, number(D::length, above(0)), initial, "As of a bolt."},
    Key{"pretension", at<&BoltPattern::bolt, &Bolt::pretension>, number(D::force, from(0)), initial, "As of a bolt."},
    Key{"bond", at<&BoltPattern::bolt, &Bolt::bond>, table, otherwise("none; required by grouted bolts"), "As of a bolt."},
    Key{"dowel", at<&BoltPattern::bolt, &Bolt::dowel>, table, otherwise("no dowel action"), "As of a bolt."},
};

constexpr std::array lining_residual_keys{
    Key{"compressive_strength", at<&LiningResidual::compressive_strength>, number(D::stress, above(0)), otherwise("as before it yields"), "Compressive strength of a section that has yielded."},
    Key{"tensile_strength", at<&LiningResidual::tensile_strength>, number(D::stress, from(0)), otherwise("as before it yields"), "Its tensile strength."},
};

constexpr std::array lining_keys{
    Key{"name", at<&Lining::name>, naming, otherwise("none"), "What --set, stages and tables call the lining."},
    Key{"opening", at<&Lining::opening>, naming, otherwise("none; either this, on or along"), "Name of the opening on whose outline the lining is, inside it."},
    Key{"on", at<&Lining::on>, naming, otherwise("none"), "Name of the lining on whose inner side this one is, a further layer."},
    Key{"from_angle", at<&Lining::from_angle>, number(D::angle), otherwise("none: the whole outline"), "Direction of the first end of the lining from the centroid of the opening, counter-clockwise from +x."},
    Key{"to_angle", at<&Lining::to_angle>, number(D::angle), otherwise("none: the whole outline"), "Direction of its other end, counter-clockwise from the first."},
    Key{"along", at<&Lining::along>, polyline, otherwise("none; either this, opening or on"), "Line on whose left the lining is; where it ends at its first point, the lining is a ring inside it."},
    Key{"material", at<&Lining::material>, material, otherwise(if_one), "Material of the lining: its elasticity and density, and its strength unless the lining gives one. A stage may change it (stage.change)."},
    Key{"thickness", at<&Lining::thickness>, number(D::length, above(0)), otherwise("required unless area and inertia are given"), "Thickness of shotcrete or concrete."},
    Key{"area", at<&Lining::area>, number(D::area, above(0)), otherwise("none; with inertia in place of thickness"), "Area of the section of a steel set."},
    Key{"inertia", at<&Lining::inertia>, number(D::second_moment, above(0)), otherwise("none; with area in place of thickness"), "Second moment of area of the section of a steel set."},
    Key{"spacing", at<&Lining::spacing>, number(D::length, above(0)), initial, "Distance from steel set to steel set out of plane."},
    Key{"compressive_strength", at<&Lining::compressive_strength>, number(D::stress, above(0)), otherwise("that of the material (strength.ucs); without either the lining stays elastic"), "Compressive strength, or the yield stress of steel. Where thrust and moment of a section reach what it can carry, it becomes a plastic hinge."},
    Key{"tensile_strength", at<&Lining::tensile_strength>, number(D::stress, from(0)), otherwise("0; of steel sets compressive_strength; strength.tension with the strength of the material"), "Tensile strength."},
    Key{"residual", at<&Lining::residual>, table, otherwise("none: the strength does not fall"), "Strengths of a section once it has yielded, at once and for good (concrete that cracks or is crushed)."},
    Key{"plastic_moment", at<&Lining::plastic_moment>, number(D::moment, above(0)), otherwise("that of a solid section of the same area and inertia"), "Plastic moment of a steel set without thrust."},
    Key{"size", at<&Lining::size>, number_or("auto", D::length, above(0)), otherwise("\"auto\": a 32nd of the length of the lining, or twice its thickness if that is more"), "Length of its pieces, at most. Straight parts of an outline that stands for a curve are best one piece each: where they are divided, the lining bends as the polygon that is drawn."},
    Key{"interface", at<&Lining::interface>, joint, otherwise("that of the wall, or contact.joint"), "Law of the faces between the lining and what it touches: stiffness, friction, adhesion (cohesion and tensile strength)."},
};

constexpr std::array fill_keys{
    Key{"name", at<&Fill::name>, naming, required, "What stages, --set and tables call the fill."},
    Key{"opening", at<&Fill::opening>, naming, otherwise("none; either this or polygon"), "Name of the opening whose room it takes, as the walls have deformed by then."},
    Key{"polygon", at<&Fill::polygon>, polygon, otherwise("none; either this or opening"), "Its corners as drawn. Those on blocks that are there move with them until it is placed."},
    Key{"lift", at<&Fill::lift>, number(D::length, above(0)), otherwise("none: it is one block"), "Height of the layers that it consists of, at right angles to gravity from its lowest corner; each is a block."},
    Key{"material", at<&Fill::material>, material, otherwise(if_one), "Material of the fill, whose zones may yield."},
    Key{"joint", at<&Fill::joint>, joint, otherwise("that of what it touches, or contact.joint"), "Law of the faces of its blocks, between themselves and to what they touch."},
};

constexpr std::array monitor_keys{
    Key{"name", at<&Monitor::name>, naming, required, "What the columns of history.csv are called."},
    Key{"point", at<&Monitor::point>, point, required, "A material point of the block in which it lies at the start."},
};

constexpr std::array measurement_keys{
    Key{"name", at<&Measurement::name>, naming, required, "What the columns of history.csv are called."},
    Key{"polygon", at<&Measurement::polygon>, polygon, required, "Outline of the region at the start; its corners lie in rock."},
};

constexpr std::array convergence_keys{
    Key{"name", at<&Convergence::name>, naming, required, "What the columns of history.csv and stages.csv are called."},
    Key{"between", at<&Convergence::between>, polyline, required, "Two material points; positive when they come nearer to each other."},
};

constexpr std::array rayleigh_keys{
    Key{"fraction", at<&Rayleigh::fraction>, number(D::plain, from(0)), required, "Fraction of critical damping at the frequency, where it is least."},
    Key{"frequency", at<&Rayleigh::frequency>, number(D::frequency, above(0)), required, "The frequency."},
};

constexpr std::array damping_keys{
    Key{"mass", at<&Damping::mass>, number(D::rate, from(0)), initial, "Mass-proportional damping."},
    Key{"local", at<&Damping::local>, number(D::plain, from_below(0, 1)), initial, "Local damping (Cundall), a fraction of the unbalanced force: for stages that seek equilibrium only, since it slows down free fall and all other motion."},
    Key{"contact", at<&Damping::contact>, number(D::plain, from(0)), initial, "Viscous damping at contacts, a fraction of critical."},
    Key{"adaptive", at<&Damping::adaptive>, number(D::plain, from_to(0, 1)), initial, "Method edda: viscous damping in proportion to mass, a fraction of critical at the frequency with which the model moves at present (Rayleigh's quotient); it brings a model to equilibrium and falsifies all other motion."},
    Key{"rayleigh", at<&Damping::rayleigh>, table, otherwise("none: materials.X.damping"), "Damping in proportion to mass and stiffness, least at one frequency (Rayleigh), in place of materials.X.damping; of materials with a rayleigh of their own that goes first. A stage until equilibrium with adaptive damping has only what it gives itself."},
};

constexpr std::array ramp_keys{
    Key{"kh", at<&Ramp::what>, varied(D::plain), otherwise("none; one of these must be given"), "Horizontal seismic coefficient: a force on each block of that part of its weight, to the right."},
    Key{"kv", at<&Ramp::what>, varied(D::plain), otherwise("none"), "Vertical seismic coefficient: such a force upwards."},
    Key{"tilt", at<&Ramp::what>, varied(D::angle), otherwise("none"), "Angle by which the ground is tilted so that blocks lean to the right (a tilting table)."},
    Key{"gravity", at<&Ramp::what>, varied(D::plain), otherwise("none"), "Multiplier of the weight."},
    Key{"strength", at<&Ramp::what>, varied(D::plain), otherwise("none"), "Divisor of the strength of all joints, in place of strength_factor."},
    Key{"load:NAME", at<&Ramp::what>, varied(D::plain), otherwise("none"), "Multiplier of the load of that name (a quoted key); until its first ramp it has the multiplier with which that begins."},
    Key{"water:NAME", at<&Ramp::what>, varied(D::plain), otherwise("none"), "Multiplier of the pressure of that water."},
    Key{"flow", at<&Ramp::what>, varied(D::time), otherwise("none"), "With [flow]: time in which the water flows, such as [\"0 h\", \"48 h\"], in increments; it has its own clock. Joints store water meanwhile, and what the stage changes at its start meets water that has had no time to flow."},
    Key{"change", at<&Ramp::what>, varied(D::plain), otherwise("none"), "Part of the change of joints of this stage that has happened, such as [0, 1]: strength and stiffness lie between those of the old and the new law."},
    Key{"time", at<&Ramp::what>, varied(D::time), otherwise("none"), "Time in which joints with a decay_time lose strength, such as [\"0 d\", \"100 d\"]; it goes on from stage to stage."},
    Key{"boundary:NAME", at<&Ramp::what>, varied(D::plain), otherwise("none"), "Multiplier of the displacement, or of the traction, of that boundary."},
    Key{"hold", at<&Ramp::hold>, choice, initial, "What each value is held for."},
    Key{"steps", at<&Ramp::steps>, whole(1, 100000), initial, "Number of increments, and so the accuracy of a collapse load."},
};

constexpr std::array change_keys{
    Key{"joints", at<&PropertyChange::joints>, joint, otherwise("none; this or material"), "Law of the joints that change."},
    Key{"material", at<&PropertyChange::material>, material, otherwise("none; this or joints"), "Material of what changes: of rock the strength in zones; of linings that are there elasticity and strength, as concrete hardens."},
    Key{"to", at<&PropertyChange::to>, naming, required, "The law, or the material, that they have from then on. Forces and stresses go on from what they are."},
    Key{"set", at<&PropertyChange::set>, naming, otherwise("all"), "Only joints that the joint set, or the fracture network, of this name has cut."},
    Key{"region", at<&PropertyChange::region>, polygon, otherwise("the whole model"), "Only edges whose middle, or blocks and linings whose centroid, lies in this polygon, as drawn."},
    Key{"around", at<&PropertyChange::around>, naming, otherwise("none"), "Only those within `distance` of the outline of this opening, as drawn."},
    Key{"distance", at<&PropertyChange::distance>, number(D::length, above(0)), or_none("required with around"), "How far from that opening."},
    Key{"over", at<&PropertyChange::over>, number(D::time, above(0)), or_none("at once"), "In a stage with a duration: time from its start in which strength and stiffness of the joints go from the old law to the new one."},
};

constexpr std::array stage_keys{
    Key{"name", at<&Stage::name>, naming, otherwise("none"), "What messages, stages.csv and --set call the stage."},
    Key{"until", at<&Stage::until>, choice, otherwise("`\"time\"`; `\"equilibrium\"` with a ramp"), "Whether it ends at its duration (time) or as soon as the model is in equilibrium (equilibrium); with a ramp, whose end is to be reached in equilibrium (equilibrium) or before which the model is to fail (collapse)."},
    Key{"ratio", at<&Stage::ratio>, number(D::plain, above_to(0, 1)), initial, "Equilibrium: mean resultant force of the blocks over the mean normal force at the ends of the contacts."},
    Key{"duration", at<&Stage::duration>, number(D::time, above(0)), otherwise("required until \"time\"; 10 s until \"equilibrium\", or the time in which waves cross the model 200 times, 1000 s with a ramp or a boundary of type \"displacement\""), "Length of the stage; until equilibrium the longest it may take, with a ramp for each of its values on average."},
    Key{"excavate", at<&Stage::excavate>, name_list, otherwise("none"), "Openings, and fills of earlier stages, that are excavated at the start of the stage."},
    Key{"relax", at<&Stage::relax>, numbers_of_names(from_to(0, 1)), otherwise("all, when an opening is excavated"), "Part of the wall forces of the excavated rock that has been released by then, all stages together, by opening; the rest remains on the walls, like the support of a nearby face."},
    Key{"install", at<&Stage::install>, name_list, otherwise("bolts and linings that no stage names are there from the start"), "Bolts, patterns of bolts and linings installed at the start of the stage, in the rock as deformed by then."},
    Key{"fill", at<&Stage::fill>, name_list, otherwise("none"), "Fills that are placed at the start of the stage, without stress, between the blocks as they are by then. Their weight is applied gradually where the stage lasts until equilibrium."},
    Key{"change", at<&Stage::change>, tables, otherwise("none"), "Joints, rock and linings that have other properties from the start of the stage on, one change after the other."},
    Key{"activate", at<&Stage::activate>, name_list, otherwise("what no stage names acts from the start"), "Loads, waters, boundaries and ground motions that act from the start of the stage on; their histories count time from then."},
    Key{"deactivate", at<&Stage::deactivate>, name_list, otherwise("none"), "Those that no longer act. A boundary that takes over from another carries the forces of that one."},
    Key{"reset_displacements", at<&Stage::reset_displacements>, flag, initial, "Whether displacements count from the start of this stage."},
    Key{"strength_factor", at<&Stage::strength_factor>, number(D::plain, above(0)), initial, "Divisor of cohesion, tangent of the friction angle and tensile strength of all joints during the stage."},
    Key{"damping", at<&Stage::damping>, table, otherwise("solver.damping; until equilibrium adaptive = 0.8 (method edda)"), "Damping during the stage."},
    Key{"joints", at<&Stage::joints>, choice, initial, "Joints as given, or glued: those whose edges lie against each other neither open nor slide during the stage."},
    Key{"masses", at<&Stage::masses>, choice, otherwise("\"scaled\" until equilibrium (method edda), else \"as given\""), "Masses as given, or scaled: inertia raised so that all blocks allow one time step, weights unchanged."},
    Key{"otherwise", at<&Stage::otherwise>, choice, initial, "Until equilibrium: where blocks have come loose or fall freely while all others are in equilibrium: the run continues without them (go on) or ends there as collapsed (stop)."},
    Key{"ramp", at<&Stage::ramp>, table, otherwise("none"), "Something that is varied in increments during the stage, each held until the model is in equilibrium under it (pushover)."},
    Key{"detached", at<&Stage::falling>, choice, initial, "Equilibrium is found although blocks fall freely (report), or waits for them (wait)."},
};

constexpr std::array solver_keys{
    Key{"method", at<&Solver::method>, choice, initial, "Explicit (edda), or implicit with one global solve (dda)."},
    Key{"mass", at<&Solver::mass>, choice, initial, "How the mass of a block is distributed to its nodes."},
    Key{"switching", at<&Solver::switching>, choice, otherwise("\"exact\"; \"plain\" with contact.model = \"points\""), "Method edda: how contacts open and close, keeping the energy (exact) or as in the paper (plain)."},
    Key{"duration", at<&Solver::duration>, number(D::time, above(0)), or_none("required of a run without stages; else the sum of their durations"), "Time to simulate."},
    Key{"time_step", at<&Solver::time_step>, number_or("auto", D::time, above(0)), otherwise("\"auto\""), "Time step; above the critical step it is refused."},
    Key{"allow_unstable", at<&Solver::allow_unstable>, flag, initial, "Method edda: whether a time step above the critical one is run all the same."},
    Key{"safety", at<&Solver::safety>, number(D::plain, above_to(0, 1)), initial, "Method edda: part of the critical step that is taken when time_step is \"auto\"."},
    Key{"dynamic", at<&Solver::dynamic>, flag, initial, "Method dda: whether velocities carry over from step to step, or are dropped (for equilibrium alone)."},
    Key{"max_displacement_ratio", at<&Solver::max_displacement_ratio>, number(D::plain, above_to(0, 1)), initial, "Largest displacement in one step, over half the least width of the model in any direction (of a slope, half its height)."},
    Key{"mass_scaling", at<&Solver::mass_scaling>, number(D::time, from(0)), initial, "Method edda: the inertia of the few blocks whose critical step is below this is raised until it is not (their weight stays); 0: off."},
    Key{"damping", at<&Solver::damping>, table, initial, "Damping of the motion."},
};

constexpr std::array output_keys{
    Key{"every", at<&Output::every>, number(D::time, above(0)), or_none("solver.duration / 20, or of the stages that have one"), "Time between frames (the state of all blocks)."},
    Key{"history_every", at<&Output::history_every>, number_or("record", D::time, above(0)), or_none("a tenth of that of every, or the interval of a record, or a twentieth of a sine's period"), "Time between rows of history.csv; \"record\": the interval of the ground motion's record, the shortest where there are several."},
    Key{"settling", at<&Output::settling>, flag, otherwise("true where neither every nor history_every is given"), "In stages until equilibrium, whose length is not known in advance: additional rows and frames, at intervals that grow with time."},
    Key{"checkpoint_every", at<&Output::checkpoint_every>, number(D::plain, above(0)), initial, "Minutes of wall time between checkpoints."},
    Key{"stages", at<&Output::stages>, flag, initial, "With stages: whether joints_N.csv and checkpoint_N.h5 are written at the end of each."},
};

constexpr std::array fos_fails_keys{
    Key{"displacement", at<&FosFails::displacement>, number(D::length, above(0)), otherwise("a hundredth of the mean size of the blocks, a tenth where rigid blocks are in equilibrium"), "A trial fails where a corner of a block moves further than this."},
    Key{"velocity", at<&FosFails::velocity>, number(D::velocity, above(0)), otherwise("displacement over ten times the length of a trial"), "A trial fails where a corner still moves faster than this at its end."},
};

constexpr std::array fos_keys{
    Key{"stage", at<&Fos::stage>, naming, otherwise("the last one; without stages, the model in equilibrium"), "The stage from whose end the trials begin."},
    Key{"vary", at<&Fos::vary>, naming, initial, "What the factor acts on: \"strength\" (divided by it), \"load:NAME\", \"shaking:NAME\", \"water:NAME\" (the pressure of that water) or \"boundary:NAME\" (its displacement or traction), multiplied by it; \"gravity\" (the weight), multiplied by it; \"kh\" or \"kv\", a seismic coefficient: a force on each block of that part of its weight, to the right or upwards; \"tilt\", the angle in degrees by which the ground is tilted so that blocks lean to the right; \"-kh\", \"-kv\" and \"-tilt\" are the same to the left or downwards."},
    Key{"bracket", at<&Fos::bracket>, shape(Kind::point, D::plain, above(0)), initial, "Two factors, the lower one expected to hold and the upper one to fail; widened where they do not."},
    Key{"tolerance", at<&Fos::tolerance>, number(D::plain, above_to(0, 0.5)), initial, "The search ends when the bracket is no wider than this part of its lower factor."},
    Key{"exclude", at<&Fos::exclude>, name_list, initial, "Joints that keep their strength."},
    Key{"least_area", at<&Fos::least_area>, number(D::area, from(0)), initial, "Mechanisms that move blocks of a smaller area in all are left out, and reported."},
    Key{"rigid_proof", at<&Fos::rigid_proof>, flag, initial, "Whether a trial ends where rigid blocks have no equilibrium in their present places; without, it is followed until blocks have moved."},
    Key{"fails", at<&Fos::fails>, table, otherwise("by the size of the blocks and gravity"), "When a trial counts as failed."},
};

constexpr std::array limit_keys{
    Key{"crushing", at<&Limit::crushing>, flag, initial, "Whether joints are crushed where the thrust comes near an edge: they have the compressive strength materials.X.strength.ucs of the weaker rock beside them."},
};

constexpr std::array all_sections{
    root_section(root_keys, "The model as a whole."),
    section<&Model::materials>("materials", Shape::named, material_keys, "Elastic rock."),
    section<&Model::joints>("joints", Shape::named, joint_keys, "The contact law of a joint."),
    section<&Model::contact>("contact", Shape::table, contact_keys, "Properties of contacts whose joint does not give them."),
    section<&Model::blocks>("block", Shape::list, block_keys, "A block given by its polygon."),
    section<&Model::domain>("domain", Shape::table, domain_keys, "A region that joint sets, traces and openings cut into blocks."),
    section<&Model::slope>("slope", Shape::table, slope_keys, "An outline by a few numbers: ground that rises to the right."),
    section<&Model::section>("section", Shape::table, cross_section_keys, "Orientation of the model's plane in the ground."),
    section<&Model::joint_sets>("joint_set", Shape::list, joint_set_keys, "Parallel, straight joints."),
    section<&Model::traces>("trace", Shape::list, trace_keys, "A single joint."),
    section<&Model::networks>("fracture_network", Shape::list, network_keys, "Independent fractures."),
    section<&Model::voronoi>("voronoi", Shape::table, voronoi_keys, "The domain as Voronoi polygons."),
    section<&Model::imports>("import", Shape::list, import_keys, "Lines from a file."),
    section<&Model::openings>("opening", Shape::list, opening_keys, "A part of the domain that is excavated, before the run or by a stage."),
    section<&Model::regions>("region", Shape::list, region_keys, "Another material inside a polygon."),
    section<&Model::fixed>("fixed", Shape::list, fixed_keys, "A fixed block among the cut blocks."),
    section<&Model::walls>("brick_wall", Shape::list, wall_keys, "Bricks in running bond, half bricks closing the odd rows."),
    section<&Model::arches>("arch", Shape::list, arch_keys, "Voussoirs."),
    section<&Model::quality>("quality", Shape::table, quality_keys, "Which cut blocks are too small or too thin, and what becomes of them."),
    section<&Model::zones>("zones", Shape::table, zones_keys, "The mesh of blocks that are meshed."),
    section<&Model::pairs>("contact_pair", Shape::list, pair_keys, "The law where two joints or two materials meet."),
    section<&Model::initial_stress>("initial_stress", Shape::table, initial_stress_keys, "Stress in the rock at the start, in blocks and contacts."),
    section<&Model::boundaries>("boundary", Shape::list, boundary_keys, "Support, motion, load or wave absorption along a line."),
    section<&Model::loads>("load", Shape::list, load_keys, "A force at a point, or a traction or pressure along a line."),
    section<&Model::waters>("water", Shape::list, water_keys, "Water in joints and on faces below a table."),
    section<&Model::flow>("flow", Shape::table, flow_keys, "Water that flows through the joints."),
    section<&Model::shakings>("shaking", Shape::list, shaking_keys, "Ground motion (seismic loading)."),
    section<&Model::bolts>("bolt", Shape::list, bolt_keys, "A rock bolt."),
    section<&Model::bolt_patterns>("bolt_pattern", Shape::list, bolt_pattern_keys, "Bolts round an opening."),
    section<&Model::linings>("lining", Shape::list, lining_keys, "Shotcrete, concrete or steel sets along a wall."),
    section<&Model::fills>("fill", Shape::list, fill_keys, "Blocks that a stage places: paste fill, rock fill, lifts of a dam, courses of masonry."),
    section<&Model::monitors>("monitor", Shape::list, monitor_keys, "A point whose history is written."),
    section<&Model::convergences>("convergence", Shape::list, convergence_keys, "Two points whose convergence is written."),
    section<&Model::measurements>("measurement", Shape::list, measurement_keys, "A region whose mean stress and strain are written."),
    section<&Model::stages>("stage", Shape::list, stage_keys, "A part of the run, one after the other."),
    section<&Model::solver>("solver", Shape::table, solver_keys, "How the motion is computed."),
    section<&Model::output>("output", Shape::table, output_keys, "What is written, and how often."),
    section<&Model::fos>("fos", Shape::table, fos_keys, "The factor of safety (edda fos), and what edda limit varies."),
    section<&Model::limit>("limit", Shape::table, limit_keys, "Rigid limit analysis (edda limit)."),
};
// clang-format on

}  // namespace

std::span<const Key> keys_of(const Strength&) {
  return strength_keys;
}
std::span<const Key> keys_of(const Yield&) {
  return yield_keys;
}
std::span<const Key> keys_of(const RockMass&) {
  return rock_mass_keys;
}
std::span<const Key> keys_of(const FoliationInputs&) {
  return foliation_keys;
}
std::span<const Key> keys_of(const RockStrength&) {
  return rock_strength_keys;
}
std::span<const Key> keys_of(const Damping&) {
  return damping_keys;
}
std::span<const Key> keys_of(const LiningResidual&) {
  return lining_residual_keys;
}
std::span<const Key> keys_of(const Rayleigh&) {
  return rayleigh_keys;
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
std::span<const Key> keys_of(const Acceleration&) {
  return acceleration_keys;
}
std::span<const Key> keys_of(const BoltBond&) {
  return bond_keys;
}
std::span<const Key> keys_of(const BoltDowel&) {
  return dowel_keys;
}

std::span<const Key> keys_of(const FosFails&) {
  return fos_fails_keys;
}

std::span<const Key> keys_of(const Ramp&) {
  return ramp_keys;
}
std::span<const Key> keys_of(const PropertyChange&) {
  return change_keys;
}

std::span<const Key> inner_keys_of(const Slot& slot) {
  if (const auto* one = std::get_if<SubTable>(&slot)) return one->keys;
  if (const auto* many = std::get_if<TableList>(&slot)) return many->keys;
  return {};
}

std::span<const Section> sections() {
  return all_sections;
}

const Section* find_section(std::string_view name, std::span<const Section> among) {
  for (const Section& s : among) {
    if (s.shape != Shape::root && s.name == name) return &s;
  }
  return nullptr;
}

const Key* find_key(std::span<const Key> keys, std::string_view name) {
  for (const Key& key : keys) {
    const std::size_t colon = key.name.find(":NAME");
    const bool named = colon != std::string_view::npos && name.size() > colon + 1 &&
                       name.substr(0, colon + 1) == key.name.substr(0, colon + 1);
    if (key.name == name || named) return &key;
  }
  return nullptr;
}

std::vector<std::string_view> key_names(std::span<const Key> keys) {
  std::vector<std::string_view> names;
  for (const Key& key : keys) names.push_back(key.name);
  return names;
}

}  // namespace edda
