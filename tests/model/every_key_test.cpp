// A model of every key, read, written and read again.
#include <gtest/gtest.h>

#include <cmath>
#include <string>
#include <vector>

#include "model/every_key.hpp"
#include "model/read_or_fail.hpp"
#include "model/write_model.hpp"

namespace edda::every_key_test {
namespace {

using testing::every_key;
using testing::read_or_fail;

/// What is recorded of points and regions.
void expect_every_gauge_key(const Model& m) {
  ASSERT_EQ(m.measurements.size(), 1U);
  EXPECT_EQ(m.measurements[0].name, "roof");
  EXPECT_EQ(m.measurements[0].polygon, (Ring{{11, 5}, {19, 5}, {15, 8}}));
  ASSERT_EQ(m.convergences.size(), 1U);
  EXPECT_EQ(m.convergences[0].name, "H1");
  EXPECT_EQ(m.convergences[0].between, (Ring{{11, 5}, {19, 5}}));
}

void expect_every_key(const Model& m) {
  EXPECT_EQ(m.title, "Every \"key\"\t\\ \u00e9");
  EXPECT_EQ(m.gravity, (Vec2{1, -9.8}));
  EXPECT_EQ(m.plane, Plane::stress);
  EXPECT_EQ(m.thickness, 0.5);
  ASSERT_EQ(m.materials.size(), 2U);
  EXPECT_EQ(m.materials[0].name, "rock");
  EXPECT_EQ(m.materials[0].density, 2750.0);
  EXPECT_EQ(m.materials[0].young, 20e9);
  EXPECT_EQ(m.materials[0].poisson, 0.25);
  EXPECT_EQ(m.materials[1].name, "soft clay");
  EXPECT_EQ(m.materials[1].density, 20e3 / norm(Vec2{1, -9.8}));
  EXPECT_EQ(m.materials[1].poisson, 0.4);
  ASSERT_TRUE(m.materials[0].strength);
  EXPECT_EQ(m.materials[0].strength->ucs, 90e6);
  EXPECT_EQ(m.materials[0].strength->tension, 6e6);
  EXPECT_FALSE(m.materials[1].strength);
  ASSERT_TRUE(m.initial_stress);
  EXPECT_EQ(m.initial_stress->stress, (Triple{-24e6, -20e6, 0.5}));
  EXPECT_EQ(m.initial_stress->at_y, 2.0);
  EXPECT_EQ(m.initial_stress->gradient, (Triple{1e4, 27e3, 2.0}));
  EXPECT_EQ(m.initial_stress->k0_out, 0.75);
  EXPECT_FALSE(m.initial_stress->k0);
  expect_every_gauge_key(m);
  // The last is one that changes over a time.
  ASSERT_EQ(m.joints.size(), 7U);
  EXPECT_EQ(m.joints[5].decay_time, 30.0 * 86400.0);
  EXPECT_TRUE(m.joints[6].change);
  EXPECT_EQ(m.joints[0].type, LawType::glued);
  const JointLaw& law = m.joints[1];
  EXPECT_EQ(law.name, "rough");
  EXPECT_EQ(law.type, LawType::coulomb);
  EXPECT_NEAR(law.peak.friction_angle, 28.64788975654116, 1e-13);
  EXPECT_EQ(law.peak.cohesion, 50e3);
  EXPECT_EQ(law.peak.tensile_strength, 1e3);
  EXPECT_EQ(law.residual.friction_angle, 12.0);
  EXPECT_EQ(law.residual.cohesion, 1e3);
  EXPECT_EQ(law.residual.tensile_strength, 2.5);
  EXPECT_EQ(law.kn, 20e9);
  EXPECT_EQ(law.ks, 9e9);
  const JointLaw& weak = m.joints[2];
  EXPECT_EQ(weak.type, LawType::slip_weakening);
  EXPECT_EQ(weak.dilation_angle, 4.0);
  EXPECT_EQ(weak.slip_distance, 0.005);
  EXPECT_EQ(weak.residual.friction_angle, 25.0);
  const JointLaw& tough = m.joints[3];
  EXPECT_EQ(tough.fracture_energy, 40.0);
  EXPECT_EQ(tough.shear_fracture_energy, 400.0);
  const JointLaw& barton = m.joints[4];
  EXPECT_EQ(barton.type, LawType::barton_bandis);
  EXPECT_EQ(barton.jrc, 9.0);
  EXPECT_EQ(barton.jcs, 80e6);
  EXPECT_EQ(barton.residual_angle, 28.0);
  EXPECT_EQ(barton.peak.friction_angle, 28.0);
  EXPECT_FALSE(barton.dilation_angle);
  EXPECT_EQ(m.contact.normal_stiffness, 2e8);
  EXPECT_EQ(m.contact.shear_stiffness, 1e8);
  EXPECT_EQ(m.contact.joint, 1);
  EXPECT_EQ(m.contact.close_gaps, 0.015);
}

void expect_every_part(const Model& m) {
  ASSERT_EQ(m.blocks.size(), 2U);
  EXPECT_EQ(m.blocks[0].name, "slider");
  EXPECT_EQ(m.blocks[0].polygon, (Ring{{0, 0}, {0, 0.1}, {1, 1}, {2, 0}}));
  EXPECT_TRUE(std::signbit(m.blocks[0].polygon[3].y));
  EXPECT_EQ(m.blocks[0].material, 1);
  EXPECT_EQ(m.blocks[0].joint, 0);
  EXPECT_FALSE(m.blocks[0].fixed);
  EXPECT_EQ(m.blocks[0].velocity, (Vec2{0.001, -0.1}));
  EXPECT_EQ(m.blocks[0].angular_velocity, 0.3);
  EXPECT_TRUE(m.blocks[1].fixed);
  EXPECT_EQ(m.blocks[1].joint, none);
  ASSERT_TRUE(m.domain);
  EXPECT_EQ(m.domain->outline.size(), 4U);
  EXPECT_EQ(m.domain->material, 0);
  EXPECT_EQ(m.domain->joint, 1);
  EXPECT_EQ(m.domain->snap, 1e-6);
  EXPECT_EQ(m.domain->max_blocks, 2000000000);
  ASSERT_EQ(m.joint_sets.size(), 3U);
  EXPECT_EQ(m.joint_sets[0].name, "bedding");
  EXPECT_EQ(m.joint_sets[0].angle, -400.5);
  EXPECT_EQ(m.joint_sets[0].spacing, 0.7);
  EXPECT_EQ(m.joint_sets[0].origin, (Vec2{0.1, 0.2}));
  EXPECT_EQ(m.joint_sets[0].joint, 0);
  EXPECT_EQ(m.joint_sets[0].region, (Ring{{11, 1}, {19, 1}, {15, 9}}));
  ASSERT_EQ(m.traces.size(), 1U);
  EXPECT_EQ(m.traces[0].points, (Ring{{11, 1}, {12, 5}, {13, 5}}));
  EXPECT_EQ(m.traces[0].joint, 1);
  ASSERT_EQ(m.openings.size(), 2U);
  EXPECT_EQ(m.openings[0].name, "cavern");
  EXPECT_EQ(m.openings[0].polygon.size(), 4U);
  EXPECT_EQ(m.openings[0].joint, 0);
  ASSERT_EQ(m.fixed.size(), 2U);
  EXPECT_EQ(m.fixed[1].point, (Vec2{15, 2}));
  ASSERT_EQ(m.walls.size(), 1U);
  EXPECT_EQ(m.walls[0].origin, (Vec2{30, 1}));
  EXPECT_EQ(m.walls[0].columns, 4);
  EXPECT_EQ(m.walls[0].rows, 3);
  EXPECT_EQ(m.walls[0].brick, (Vec2{1, 0.5}));
  EXPECT_EQ(m.walls[0].material, 0);
  EXPECT_EQ(m.walls[0].joint, 1);
}

/// The section, joint sets, fracture networks and Voronoi cells.
void expect_every_joint_key(const Model& m) {
  EXPECT_EQ(m.section->azimuth, 75.0);
  const JointSet& set = m.joint_sets[0];
  EXPECT_EQ(set.trace_length, 3.0);
  EXPECT_EQ(set.gap, 0.25);
  EXPECT_EQ(set.deviation.angle, 3.0);
  EXPECT_EQ(set.deviation.spacing, 0.1);
  EXPECT_EQ(set.deviation.trace_length, 1.0);
  EXPECT_EQ(set.deviation.gap, 0.2);
  EXPECT_EQ(set.deviation.distribution, JointSpread::normal);
  EXPECT_EQ(set.seed, 7);
  EXPECT_EQ(set.stagger, -0.5);
  EXPECT_EQ(m.joint_sets[2].bounded_by, "beds");
  EXPECT_EQ(m.joint_sets[2].beds, 1);
  EXPECT_EQ(m.joint_sets[1].dip, 60.0);
  EXPECT_EQ(m.joint_sets[1].dip_direction, 300.0);
  EXPECT_EQ(m.joint_sets[1].given_spacing, 4.0);
  ASSERT_EQ(m.networks.size(), 3U);
  EXPECT_EQ(m.networks[2].model, NetworkModel::veneziano);
  EXPECT_EQ(m.networks[2].persistence, 0.6);
  EXPECT_EQ(m.networks[2].length.distribution, LengthKind::exponential);
  const FractureNetwork& f = m.networks[0];
  EXPECT_EQ(f.name, "f");
  EXPECT_EQ(f.p21, 1.2);
  EXPECT_FALSE(f.count);
  EXPECT_EQ(f.angle.mean, 30.0);
  EXPECT_EQ(f.angle.deviation, 4.0);
  EXPECT_EQ(f.angle.distribution, Spread::uniform);
  EXPECT_EQ(f.length.mean, 3.0);
  EXPECT_EQ(f.length.deviation, 1.0);
  EXPECT_EQ(f.joint, 0);
  EXPECT_EQ(f.region.size(), 3U);
  EXPECT_EQ(f.seed, 8);
  EXPECT_EQ(m.networks[1].count, 9);
  EXPECT_EQ(m.networks[1].length.distribution, LengthKind::power);
  EXPECT_EQ(m.networks[1].length.exponent, 2.5);
  EXPECT_EQ(m.networks[1].length.max, 4.0);
  EXPECT_EQ(m.voronoi->size, 2.0);
  EXPECT_EQ(m.voronoi->smoothing, 3);
  EXPECT_EQ(m.voronoi->min_edge, 0.5);
  EXPECT_EQ(m.voronoi->joint, 0);
  EXPECT_EQ(m.voronoi->region.size(), 3U);
  EXPECT_EQ(m.voronoi->seed, 9);
}

/// Imports, shapes of openings, regions, arches, quality and pairs of materials.
void expect_every_shape_key(const Model& m) {
  ASSERT_EQ(m.imports.size(), 2U);
  EXPECT_EQ(m.imports[0].as, ImportAs::lines);
  EXPECT_EQ(m.imports[1].as, ImportAs::blocks);
  EXPECT_EQ(m.imports[1].material, 0);
  EXPECT_EQ(m.imports[1].materials, (JointMap{{"STONE", 1}}));
  EXPECT_EQ(m.imports[1].fixed, (std::vector<std::string>{"BASE"}));
  ASSERT_TRUE(m.limit);
  EXPECT_TRUE(m.limit->crushing);
  EXPECT_TRUE(m.imports[0].file.ends_with("/t.csv"));
  EXPECT_EQ(m.imports[0].units, LengthUnit::cm);
  EXPECT_EQ(m.imports[0].scale, 2.0);
  EXPECT_EQ(m.imports[0].shift, (Vec2{1, 2}));
  EXPECT_EQ(m.imports[0].layers, (JointMap{{"J 1", 0}, {"b", 1}}));
  EXPECT_EQ(m.imports[0].joint, 0);
  EXPECT_EQ(m.imports[0].snap, 0.002);
  EXPECT_EQ(m.openings[1].shape->kind, ShapeKind::horseshoe);
  EXPECT_EQ(m.openings[1].shape->at, (Vec2{12, 7}));
  EXPECT_EQ(m.openings[1].shape->width, 2.0);
  EXPECT_EQ(m.openings[1].shape->height, 1.5);
  EXPECT_EQ(m.openings[1].shape->segments, 24);
  EXPECT_GT(m.openings[1].polygon.size(), 12U);
  ASSERT_EQ(m.regions.size(), 1U);
  EXPECT_EQ(m.regions[0].material, 1);
  EXPECT_EQ(m.regions[0].joint, 0);
  ASSERT_EQ(m.arches.size(), 1U);
  EXPECT_EQ(m.arches[0].centre, (Vec2{50, 1}));
  EXPECT_EQ(m.arches[0].radius, 5.0);
  EXPECT_EQ(m.arches[0].thickness, 0.5);
  EXPECT_EQ(m.arches[0].count, 7);
  EXPECT_EQ(m.arches[0].from_angle, 10.0);
  EXPECT_EQ(m.arches[0].to_angle, 170.0);
  EXPECT_EQ(m.arches[0].joint, 1);
  EXPECT_EQ(m.quality.min_area, 0.01);
  EXPECT_EQ(m.quality.min_edge, 0.05);
  EXPECT_EQ(m.quality.min_angle, 2.0);
  EXPECT_EQ(m.quality.action, QualityAction::report);
  ASSERT_EQ(m.pairs.size(), 1U);
  EXPECT_EQ(m.pairs[0].between, (std::vector<std::string>{"rock", "soft clay"}));
  EXPECT_EQ(m.pairs[0].materials[1], 1);
  EXPECT_EQ(m.pairs[0].joints[0], none);
  EXPECT_EQ(m.pairs[0].joint, 0);
}

void expect_every_geometry_key(const Model& m) {
  expect_every_joint_key(m);
  expect_every_shape_key(m);
}

/// Boundaries and ground motion ([[shaking]]).
void expect_every_boundary_key(const Model& m) {
  ASSERT_EQ(m.boundaries.size(), 6U);
  EXPECT_EQ(m.boundaries[0].name, "base");
  EXPECT_EQ(m.boundaries[0].sides, (std::vector<std::string>{"bottom", "left"}));
  EXPECT_EQ(m.boundaries[0].type, BoundaryType::roller);
  EXPECT_EQ(m.boundaries[0].stiffness, 2e11);
  EXPECT_EQ(m.boundaries[1].along.size(), 3U);
  EXPECT_TRUE(m.boundaries[1].sides.empty());
  EXPECT_FALSE(m.boundaries[1].stiffness);
  EXPECT_EQ(m.boundaries[2].type, BoundaryType::viscous);
  EXPECT_EQ(m.boundaries[2].wave_speeds, (Vec2{3000, 1500}));
  EXPECT_EQ(m.boundaries[3].type, BoundaryType::stress);
  EXPECT_EQ(m.boundaries[3].traction, (Vec2{0.5, -1e5}));
  EXPECT_EQ(m.boundaries[3].factor.value, (std::vector<double>{0.0, 2.5}));
  EXPECT_EQ(m.boundaries[4].type, BoundaryType::velocity);
  EXPECT_EQ(m.boundaries[4].velocity, (Vec2{0.001, -0.5}));
  EXPECT_TRUE(m.boundaries[4].frictionless);
  EXPECT_EQ(m.boundaries[5].type, BoundaryType::displacement);
  EXPECT_EQ(m.boundaries[5].displacement, (Vec2{0.001, -0.02}));
  ASSERT_EQ(m.shakings.size(), 2U);
  EXPECT_EQ(m.shakings[0].name, "quake");
  EXPECT_EQ(m.shakings[0].direction, (Vec2{0, 2}));
  EXPECT_EQ(m.shakings[0].units, AccelerationUnit::g);
  EXPECT_EQ(m.shakings[0].component, 2);
  EXPECT_EQ(m.shakings[0].scale, -0.5);
  EXPECT_EQ(m.shakings[0].apply, ShakingKind::inertia);
  ASSERT_EQ(m.shakings[0].record.acceleration.size(), 5U);
  EXPECT_EQ(m.shakings[0].record.acceleration[1], (Vec2{0.0, 0.1 * 9.80665}));
  EXPECT_EQ(m.shakings[1].acceleration.amplitude, 5.0);
  EXPECT_EQ(m.shakings[1].acceleration.frequency, 2.0);
  EXPECT_EQ(m.shakings[1].acceleration.direction, (Vec2{1, 1}));
  EXPECT_EQ(m.shakings[1].apply, ShakingKind::upgoing);
  EXPECT_EQ(m.shakings[1].enters, 2);
}

void expect_every_lining_key(const Model& m) {
  ASSERT_EQ(m.linings.size(), 3U);
  const Lining& shell = m.linings[0];
  EXPECT_EQ(shell.name, "shell");
  EXPECT_EQ(shell.opening, "cavern");
  EXPECT_EQ(shell.from_angle, -10.0);
  EXPECT_EQ(shell.to_angle, 190.0);
  EXPECT_EQ(m.materials[static_cast<std::size_t>(shell.material)].name, "rock");
  EXPECT_EQ(shell.thickness, 0.15);
  EXPECT_EQ(shell.drawn_thickness(), 0.15);
  EXPECT_EQ(shell.solidity(), 1.0);
  EXPECT_EQ(shell.compressive_strength, 20e6);
  EXPECT_EQ(shell.tensile_strength, 2e6);
  EXPECT_EQ(shell.residual->compressive_strength, 12e6);
  EXPECT_EQ(shell.residual->tensile_strength, 0.3e6);
  EXPECT_EQ(shell.size, 0.4);
  EXPECT_EQ(m.joints[static_cast<std::size_t>(shell.interface)].name, "rough");
  const Lining& sets = m.linings[1];
  EXPECT_EQ(sets.on, "shell");
  EXPECT_DOUBLE_EQ(*sets.area, 40e-4);
  EXPECT_DOUBLE_EQ(*sets.inertia, 573e-8);
  EXPECT_EQ(sets.spacing, 1.2);
  EXPECT_EQ(sets.plastic_moment, 30e3);
  // The solid section of the same area and inertia, over the spacing of the sets.
  EXPECT_DOUBLE_EQ(sets.drawn_thickness(), std::sqrt(12.0 * 573e-8 / 40e-4));
  EXPECT_DOUBLE_EQ(sets.solidity() * sets.drawn_thickness(), 40e-4 / 1.2);
  EXPECT_EQ(m.linings[2].along, (std::vector<Vec2>{{0, 0}, {5, 0}, {5, 0.5}}));
}

void expect_every_fill_key(const Model& m) {
  ASSERT_EQ(m.fills.size(), 2U);
  EXPECT_EQ(m.fills[0].name, "paste");
  EXPECT_EQ(m.fills[0].opening, "cavern");
  EXPECT_EQ(m.fills[0].lift, 2.0);
  EXPECT_EQ(m.materials[static_cast<std::size_t>(m.fills[0].material)].name, "soft clay");
  EXPECT_EQ(m.joints[static_cast<std::size_t>(m.fills[0].joint)].name, "rough");
  EXPECT_EQ(m.fills[1].polygon, (Ring{{0, 0}, {5, 0}, {5, 0.5}}));
  EXPECT_EQ(m.stages[1].fill, (std::vector<std::string>{"paste", "bund"}));
}

void expect_every_bolt_key(const Model& m) {
  ASSERT_EQ(m.bolts.size(), 1U);
  const Bolt& bolt = m.bolts[0];
  EXPECT_EQ(bolt.name, "crown");
  EXPECT_EQ(bolt.to, (Vec2{15, 9}));
  EXPECT_EQ(bolt.type, BoltType::end);
  EXPECT_EQ(bolt.diameter, 0.025);
  EXPECT_EQ(bolt.young, 210e9);
  EXPECT_EQ(bolt.yield_stress, 500e6);
  EXPECT_EQ(bolt.rupture_strain, 0.08);
  EXPECT_EQ(bolt.spacing, 1.5);
  EXPECT_EQ(bolt.pretension, 30e3);
  ASSERT_EQ(m.bolt_patterns.size(), 2U);
  const BoltPattern& pattern = m.bolt_patterns[0];
  EXPECT_EQ(pattern.opening, "cavern");
  EXPECT_EQ(pattern.from_angle, 10.0);
  EXPECT_EQ(pattern.to_angle, 170.0);
  EXPECT_EQ(pattern.count, 9);
  EXPECT_EQ(pattern.length, 2.0);
  EXPECT_EQ(pattern.bolt.yield_stress, 4e8);
  EXPECT_EQ(pattern.bolt.bond.stiffness, 1e9);
  EXPECT_EQ(pattern.bolt.bond.strength, 4e5);
  EXPECT_EQ(pattern.bolt.dowel->stiffness, 1e8);
  EXPECT_EQ(pattern.bolt.dowel->strength, 1.5e5);
  EXPECT_FALSE(pattern.bolt.dowel->of_bar());
  EXPECT_FALSE(bolt.dowel);
  const BoltDowel& of_bar = *m.bolt_patterns[1].bolt.dowel;
  EXPECT_TRUE(of_bar.of_bar());
  EXPECT_EQ(of_bar.bearing_strength, 60e6);
  EXPECT_EQ(of_bar.foundation_modulus, 20e9);
}

/// Loads, water and monitors.
void expect_every_load_key(const Model& m) {
  ASSERT_EQ(m.loads.size(), 3U);
  EXPECT_EQ(m.loads[0].name, "axle");
  EXPECT_EQ(m.loads[0].point, (Vec2{15, 10}));
  EXPECT_EQ(m.loads[0].force, (Vec2{2000, -1e5}));
  EXPECT_FALSE(m.loads[0].pressure);
  EXPECT_EQ(m.loads[1].along.size(), 2U);
  EXPECT_EQ(m.loads[1].pressure, 3000.0);
  EXPECT_EQ(m.loads[1].factor.value, (std::vector<double>{0.0, 2.5}));
  EXPECT_EQ(m.loads[2].within.size(), 3U);
  EXPECT_EQ(m.loads[2].body_force, (Vec2{1e3, -5.0}));
  ASSERT_EQ(m.waters.size(), 5U);
  EXPECT_NEAR(*m.waters[3].rain, 1e-5, 1e-20);
  EXPECT_EQ(m.waters[4].injection, 2e-4);
  EXPECT_EQ(m.waters[4].at, (Vec2{15, 2}));
  EXPECT_EQ(m.waters[1].level, 3.0);
  EXPECT_EQ(m.waters[1].along, (std::vector<Vec2>{{0, 0}, {0, 9}}));
  EXPECT_EQ(m.waters[2].sides, std::vector<std::string>{"left"});
  ASSERT_TRUE(m.flow);
  EXPECT_EQ(m.flow->viscosity, 1.3e-3);
  EXPECT_EQ(m.flow->bulk_modulus, 2e9);
  EXPECT_EQ(m.joints[1].aperture, 2e-4);
  EXPECT_EQ(m.joints[1].residual_aperture, 3e-5);
  EXPECT_EQ(m.joints[1].largest_aperture, 1e-3);
  EXPECT_EQ(m.waters[0].table[1], (Vec2{30, 5}));
  EXPECT_EQ(m.waters[0].flooded, (std::vector<std::string>{"cavern"}));
  EXPECT_EQ(m.waters[0].unit_weight, 1e4);
  EXPECT_EQ(m.waters[0].rise.time, (std::vector<double>{0.0, 1.0}));
  ASSERT_EQ(m.monitors.size(), 1U);
  EXPECT_EQ(m.monitors[0].name, "P1");
  EXPECT_EQ(m.monitors[0].point, (Vec2{15, 9}));
}

void expect_every_stage_key(const Model& m) {
  ASSERT_EQ(m.stages.size(), 3U);
  EXPECT_EQ(m.stages[0].name, "settle");
  EXPECT_EQ(m.stages[0].until, StageEnd::equilibrium);
  EXPECT_EQ(m.stages[0].ratio, 1e-4);
  EXPECT_EQ(m.stages[0].duration, 60.0);
  EXPECT_EQ(m.stages[0].damping.mass, 2.0);
  EXPECT_EQ(m.solver.damping.rayleigh->fraction, 0.05);
  EXPECT_FALSE(m.stages[0].damping.rayleigh);  // it has adaptive damping
  EXPECT_EQ(m.materials[0].damping, 0.2);
  EXPECT_EQ(m.materials[0].rayleigh->fraction, 0.03);
  EXPECT_EQ(m.materials[0].rayleigh->frequency, 2.0);
  EXPECT_EQ(m.stages[0].damping.local, 0.0);
  EXPECT_EQ(m.stages[0].damping.adaptive, 0.8);
  EXPECT_EQ(m.stages[0].damping.contact, 0.2);
  EXPECT_FALSE(m.stages[0].reset_displacements);
  EXPECT_EQ(m.stages[2].until, StageEnd::collapse);
  ASSERT_TRUE(m.stages[2].ramp);
  EXPECT_EQ(m.stages[2].ramp->what.vary, "load:axle");
  EXPECT_EQ(m.stages[2].ramp->what.range, (Vec2{0.0, 2.5}));
  EXPECT_EQ(m.stages[2].ramp->varied, Varied::load);
  EXPECT_EQ(m.stages[2].ramp->target, 0);
  EXPECT_EQ(m.stages[2].ramp->steps, 50);
  EXPECT_FALSE(m.stages[1].ramp);
  EXPECT_EQ(m.stages[1].until, StageEnd::time);
  EXPECT_EQ(m.stages[1].damping.local, 0.1);
  EXPECT_TRUE(m.stages[1].reset_displacements);
  EXPECT_EQ(m.stages[0].strength_factor, 1.0);
  EXPECT_EQ(m.stages[1].strength_factor, 1.25);
  EXPECT_EQ(m.stages[1].excavate, std::vector<std::string>{"cavern"});
  ASSERT_EQ(m.stages[1].change.size(), 2U);
  EXPECT_EQ(m.stages[1].change[1].set, "bedding");
  EXPECT_EQ(m.stages[1].change[1].over, 2.0);
  const PropertyChange& joints = m.stages[1].change[0];
  EXPECT_EQ(m.joints[static_cast<std::size_t>(joints.joints)].name, "rough");
  EXPECT_EQ(m.joints[static_cast<std::size_t>(joints.row)].name, "weak");
  EXPECT_EQ(joints.material, none);
  EXPECT_EQ(joints.region.size(), 3U);
  EXPECT_EQ(joints.opening, 0);
  EXPECT_EQ(joints.distance, 2.0);
  EXPECT_EQ(m.stages[1].relax, (NumberMap{{"cavern", 0.6}}));
  EXPECT_EQ(m.stages[0].joints, StageJoints::glued);
  EXPECT_EQ(m.stages[0].falling, FallingBlocks::wait);
  EXPECT_EQ(m.stages[0].masses, StageMasses::as_given) << "the model gives a time step";
  EXPECT_EQ(m.stages[0].deactivate, std::vector<std::string>{"wet"});
  EXPECT_EQ(m.stages[1].install, (std::vector<std::string>{"round", "shell", "second"}));
  EXPECT_EQ(m.stages[1].activate, (std::vector<std::string>{"axle", "wet"}));
  EXPECT_EQ(m.stages[1].joints, StageJoints::as_given);
  EXPECT_EQ(m.stages[1].falling, FallingBlocks::report);
  EXPECT_TRUE(m.openings[0].staged);
  EXPECT_FALSE(m.openings[1].staged);
}

/// The solver, the output and the factor of safety.
void expect_every_solver_key(const Model& m) {
  EXPECT_EQ(m.solver.mass, MassKind::covering);
  EXPECT_EQ(m.solver.switching, Switching::plain);
  EXPECT_EQ(m.solver.duration, 125.1);
  EXPECT_EQ(m.solver.time_step, 1e-5);
  EXPECT_TRUE(m.solver.allow_unstable);
  EXPECT_EQ(m.solver.safety, 0.7);
  EXPECT_EQ(m.solver.max_displacement_ratio, 0.02);
  EXPECT_EQ(m.solver.mass_scaling, 3e-6);
  EXPECT_EQ(m.solver.damping.mass, 2.0);
  EXPECT_EQ(m.solver.damping.local, 0.1);
  EXPECT_EQ(m.solver.damping.contact, 0.3);
  EXPECT_EQ(m.output.every, 0.3);
  EXPECT_EQ(m.output.history_every, 0.07);
  EXPECT_EQ(m.output.checkpoint_every, 2.5);
  ASSERT_TRUE(m.fos);
  EXPECT_EQ(m.fos->stage, "settle");
  EXPECT_EQ(m.fos->vary, "water:wet");
  EXPECT_EQ(m.fos->varied, Varied::water);
  EXPECT_EQ(m.fos->target, 0);
  EXPECT_EQ(m.fos->bracket, (Vec2{0.7, 2.0}));
  EXPECT_EQ(m.fos->tolerance, 0.02);
  EXPECT_EQ(m.fos->exclude, std::vector<std::string>{"glue"});
  EXPECT_EQ(m.fos->least_area, 0.25);
  EXPECT_FALSE(m.fos->rigid_proof);
  EXPECT_EQ(m.fos->fails.displacement, 0.01);
  EXPECT_EQ(m.fos->fails.velocity, 0.002);
  EXPECT_FALSE(m.output.stages);
}

void expect_every_run_key(const Model& m) {
  expect_every_boundary_key(m);
  expect_every_bolt_key(m);
  expect_every_lining_key(m);
  expect_every_fill_key(m);
  expect_every_load_key(m);
  expect_every_stage_key(m);
  expect_every_solver_key(m);
}

TEST(WriteModel, EveryKeyIsReadAndComesBack) {
  const Model first = read_or_fail(every_key);
  expect_every_key(first);
  expect_every_part(first);
  expect_every_geometry_key(first);
  expect_every_run_key(first);
  const std::string written = to_toml(first);
  const Model second = read_or_fail(written);
  expect_every_key(second);
  expect_every_part(second);
  expect_every_geometry_key(second);
  expect_every_run_key(second);
  EXPECT_EQ(first.joints[1].peak.friction_angle, second.joints[1].peak.friction_angle);
  EXPECT_EQ(to_toml(second), written);
}

TEST(WriteModel, ADowelThatIsAllOfItsBarComesBack) {
  const Model first =
      read_or_fail(std::string(every_key) +
                   "[[bolt]]\nfrom = [15, 6]\nto = [15, 9]\ndiameter = 0.025\n"
                   "yield_stress = 5e8\nbond = { stiffness = 1e9, strength = 4e5 }\n"
                   "dowel = {}\n");
  ASSERT_TRUE(first.bolts.back().dowel);
  EXPECT_TRUE(first.bolts.back().dowel->of_bar());
  EXPECT_TRUE(read_or_fail(to_toml(first)).bolts.back().dowel);
}

}  // namespace
}  // namespace edda::every_key_test
