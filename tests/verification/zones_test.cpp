// Blocks that are meshed, against beams, pendulums, holes and balances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <string>

#include "run/prepared.hpp"
#include "step/energy_balance.hpp"
#include "step/step.hpp"
#include "verification/models.hpp"
#include "verification/record.hpp"

namespace edda::zones_test {
namespace {

using testing::ran;
using testing::Ran;

const std::string rock = R"([materials.rock]
density = 2600
young = 2e10
poisson = 0.2
)";
const std::string joint = "[joints.j]\nfriction_angle = 60\n";

std::string zones(double size, double growth = 0.0) {
  return "[zones]\nsize = " + number(size) + "\ngrowth = " + number(growth) + "\n";
}

/// Deflection of a cantilever of one block, 10 x 1 m, held at its left end, under a traction at its
/// right end.
double deflection(double size) {
  const Ran r = ran("gravity = [0, 0]\n" + rock + joint + zones(size) + R"([[block]]
polygon = [[0, 0], [10, 0], [10, 1], [0, 1]]
[[boundary]]
along = [[0, 0], [0, 1]]
type = 'fixed'
stiffness = '1e12 N/m'
[[load]]
along = [[10, 0], [10, 1]]
force = [0, -1e4]
[[stage]]
until = 'equilibrium'
)");
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.largest_energy_error, 1e-7);
  const Simulation& sim = r.ready.sim;
  const BlockSet& b = sim.scene->blocks;
  double lowest = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v)
    lowest = std::min(lowest, sim.motion.pose.y[v] - b.vertex_y[v]);
  return -lowest;
}

/// To that of a beam with shear, by the square of the zones' size.
TEST(Zones, ACantileverConvergesToABeam) {
  const double p = 1e4, l = 10.0, young = 20e9 / 0.96, shear = 20e9 / 2.4;
  const double exact = p * (l * l * l / (3.0 * young / 12.0) + 1.2 * l / shear);
  const double coarse = deflection(0.5) / exact - 1.0, fine = deflection(0.25) / exact - 1.0;
  EXPECT_GT(coarse, -0.2);
  expect_relative({72, "cantilever in zones of 0.25 m", "deflection", "m"}, (1.0 + fine) * exact,
                  exact, -0.07, 0.0);
  EXPECT_GT(coarse / fine, 2.8);
}

/// A tilted block of 1 x 4 m falls back until it is upright: a pendulum of exact inertia, whatever
/// its mesh. Time over the exact one.
double quarter_period(double size) {
  const double alpha = std::atan2(1.0, 4.0), theta0 = 0.5 * alpha;
  std::string polygon = "[";
  for (const Vec2 p : {Vec2{0, 0}, Vec2{1, 0}, Vec2{1, 4}, Vec2{0, 4}}) {
    const double c = std::cos(theta0), s = std::sin(theta0);
    const Vec2 arm = p - Vec2{1, 0};
    polygon +=
        "[" + number(1.0 + c * arm.x + s * arm.y) + "," + number(c * arm.y - s * arm.x) + "],";
  }
  Simulation sim = scene(rock + joint + zones(size) + R"([[block]]
fixed = true
polygon = [[-3, -1], [4, -1], [4, 0], [-3, 0]]
[[block]]
polygon = )" + polygon + "]\n[solver]\nduration = 0.72\n[output]\nhistory_every = 0.001\n");
  EXPECT_TRUE(sim.scene->blocks.is_meshed(1));
  double upright = 0.0, before = 0.0, angle_before = 0.0, drift = 0.0;
  run(sim, [&](Simulation& s) {
    const Rotation r = rotation(deformation(s.scene->blocks, s.motion.state.position, 1));
    const double angle = theta0 - std::atan2(r.s, r.c);
    if (upright == 0.0) keep_largest(drift, account_energy(s).error);
    if (upright == 0.0 && angle < 0.0)
      upright = before + 0.001 * angle_before / (angle_before - angle);
    before = s.motion.state.time;
    angle_before = angle;
  });
  EXPECT_LT(drift, 5e-6);
  return upright / 0.698343;  // by Runge and Kutta's method
}

TEST(Zones, ABlockRocksAsAPendulumWhateverItsMesh) {
  for (const double size : {2.0, 0.25}) {
    expect_relative(
        {72, "rocking block in zones of " + number(size) + " m", "time to upright", "s"},
        0.698343 * quarter_period(size), 0.698343, 2e-4);
  }
}

/// It spins and flies as a rigid body, and keeps its energy.
TEST(Zones, AFreeBlockSpinsWithTheRightInertia) {
  for (const double size : {2.0, 0.4}) {
    Simulation sim = scene("gravity = [0, 0]\n" + rock + joint + zones(size) + R"([[block]]
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
angular_velocity = 2.0
velocity = [1.0, 0.5]
[solver]
duration = 1.5
[output]
history_every = 0.1
)");
    double drift = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(drift, account_energy(s).error); });
    const BlockSet& b = sim.scene->blocks;
    const Rotation r = rotation(deformation(b, sim.motion.state.position, 0));
    EXPECT_NEAR(std::atan2(r.s, r.c), 3.0, 1e-4);
    EXPECT_LT(drift, 1e-7);
    EXPECT_NEAR(norm(displacement(sim, 0) - Vec2{1.5, 0.75}), 0.0, 1e-6);
    EXPECT_LT(mean_deviation(b, sim.motion.state.position, 0), 1e-6);
  }
}

/// Highest angular frequency of a block by itself, by power iteration.
double highest_frequency(Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  State s = sim.motion.state;
  Zones z = sim.motion.zones;
  BodyVector v = vector_of(b, s.position, 0);
  for (std::size_t j = 0; j < v.count; ++j)
    v.modes.set(j,
                {std::sin(17.0 * static_cast<double>(j)), std::cos(5.0 * static_cast<double>(j))});
  const auto forces = [&](double step) {
    s.position = sim.motion.state.position;
    add(step * v, b, s.position, 0);
    evaluate_zones(sim.scene->zones, b, s, {}, 0.0, z);
    BodyVectors f = zero_vectors(b);
    set_zone_forces(sim.scene->zones, b, z, {}, f, 0, 1);
    Bolts bolts = sim.attached.bolts;
    update_bolts(bolts, b, s);
    BlockForces all{b, 0, vector_of(b, f, 0)};
    add_bolts(all, bolts);
    return all.sum;
  };
  double square = 0.0;
  for (int round = 0; round < 300; ++round) {
    v = v / std::sqrt(mass_product(sim.motion.masses, b, 0, v, v));
    const double step = 1e-6 * std::sqrt(b.mass[0]);
    const BodyVector a =
        accelerations(sim.motion.masses, b, 0, (forces(step) - forces(-step)) / (2.0 * step));
    square = -mass_product(sim.motion.masses, b, 0, a, v);
    v = -1.0 * a;
  }
  return std::sqrt(square);
}

/// The critical step is that of the fastest motion of the mesh or shorter, but not much.
TEST(Zones, TheCriticalStepIsSafeAndSharp) {
  for (const auto& [size, corner] :
       {std::pair{1.0, "[3, 1]"}, {0.3, "[3, 1]"}, {0.4, "[3, 0.3]"}}) {
    Simulation sim = scene(rock + joint + zones(size) + "[[block]]\npolygon = [[0, 0], [2, 0], " +
                           corner + ", [0, 2]]\n[solver]\nduration = 1\n");
    const double exact = 2.0 / highest_frequency(sim);
    EXPECT_LE(sim.control.bound.critical_step, exact * (1.0 + 1e-3)) << size;
    const double own =
        *std::max_element(sim.scene->zones.square.begin(), sim.scene->zones.square.end());
    EXPECT_GT(2.0 / std::sqrt(own), 0.7 * exact) << size;
    const StepBound& bound = sim.control.bound;
    EXPECT_EQ(bound.block, 0u);
    EXPECT_NEAR(bound.elastic_part + bound.contact_part, 1.0, 1e-12);
  }
}

/// The same with bolts so stiff that they determine it.
TEST(Zones, TheCriticalStepIsSafeWithStiffBolts) {
  for (const char* bolt : {"bond = { stiffness = 1e13, strength = 1e12 }\ndiameter = 0.3\n",
                           "type = 'end'\nyoung = 1e15\ndiameter = 0.1\npretension = 1e3\n"}) {
    Simulation sim = scene(rock + joint + zones(0.4) + R"([[block]]
polygon = [[0, 0], [2, 0], [3, 1], [0, 2]]
[[bolt]]
from = [0.3, 0.4]
to = [2.0, 0.9]
)" + bolt + "[solver]\nduration = 1\n");
    const double exact = 2.0 / highest_frequency(sim);
    const StepBound& bound = sim.control.bound;
    EXPECT_GT(bound.bolt_part, 0.5);
    EXPECT_NEAR(bound.elastic_part + bound.contact_part + bound.bolt_part, 1.0, 1e-12);
    EXPECT_LE(bound.critical_step, exact * (1.0 + 1e-3)) << bolt;
    EXPECT_GT(bound.critical_step, 0.2 * exact) << bolt;
  }
}

/// Momentum, and the moment of it about the origin, of a block and its mesh.
struct Momentum {
  Vec2 linear;
  double angular = 0.0;
};
Momentum momentum_of(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  const State& s = sim.motion.state;
  BodyVector slide = vector_of(b, s.position, 0), turn = slide;
  Momentum p;
  // What a rigid motion with unit velocity or spin has in common with the motion.
  const BodyVector v = vector_of(b, s.velocity, 0);
  // Velocities are those half a step before the positions.
  BodyVector at = slide - (0.5 * sim.control.step_before) * v;
  turn = rigid_velocities(at, {}, {}, 1.0);
  p.angular = mass_product(sim.motion.masses, b, 0, turn, v);
  slide = rigid_velocities(at, {}, {1.0, 0.0}, 0.0);
  p.linear.x = mass_product(sim.motion.masses, b, 0, slide, v);
  slide = rigid_velocities(at, {}, {0.0, 1.0}, 0.0);
  p.linear.y = mass_product(sim.motion.masses, b, 0, slide, v);
  return p;
}

/// A block flies and spins while the bolts in it, just tensioned, make it vibrate: nothing is lost
/// or gained but by the grout, which slips.
TEST(Zones, ABlockKeepsItsMomentumAndEnergyWithBolts) {
  Simulation sim = scene("gravity = [0, 0]\n" + rock + joint + zones(0.4) + R"([[block]]
polygon = [[0, 0], [4, 0], [4, 1], [0, 1]]
angular_velocity = 2.0
velocity = [1.0, 0.5]
[[bolt]]
from = [0.2, 0.3]
to = [3.8, 0.9]
diameter = 0.04
pretension = 1e6
bond = { stiffness = 2e9, strength = 1e6 }
[[bolt]]
type = 'end'
from = [0.3, 0.9]
to = [3.0, 0.1]
diameter = 0.05
pretension = 2e6
[solver]
duration = 0.3
[output]
history_every = 0.01
)");
  ASSERT_TRUE(sim.scene->blocks.is_meshed(0));
  const Bolts& bolts = sim.attached.bolts;
  double drift = 0.0, slipped = 0.0, vibrates = 0.0;
  std::optional<Momentum> first;
  run(sim, [&](Simulation& s) {
    keep_largest(drift, account_energy(s).error);
    const Momentum p = momentum_of(s);
    if (!first) first = p;
    EXPECT_LT(norm(p.linear - first->linear), 1e-8 * norm(first->linear));
    EXPECT_NEAR(p.angular, first->angular, 1e-6 * std::abs(first->angular));
    EXPECT_GE(bolts.slipped, slipped);
    slipped = bolts.slipped;
    vibrates = std::max(vibrates, mean_deviation(s.scene->blocks, s.motion.state.position, 0));
  });
  EXPECT_GT(slipped, 0.1);
  EXPECT_GT(vibrates, 1e-6);
  EXPECT_LT(drift, 1e-6);
}

/// Meshed and bending blocks in a bond, between rollers, under a uniform traction: the stress is
/// uniform but for what joints and bending blocks make of it.
TEST(Zones, UniformStressIsUniformAcrossJoints) {
  std::string text = "gravity = [0, 0]\n" + rock + "zone_size = 0.3\ndeformation = 'zones'\n" +
                     "[materials.other]\ndensity = 2600\nyoung = 2e10\npoisson = 0.2\n" +
                     "[joints.j]\ntype = 'glued'\n[contact]\njoint = 'j'\n";
  const auto block = [&](double x0, double y0, double x1, double y1, const char* material) {
    text += "[[block]]\nmaterial = '" + std::string(material) +
            "'\npolygon = " + rectangle(x0, y0, x1, y1) + "\n";
  };
  block(0, 0, 2, 1, "rock");
  block(2, 0, 3, 1, "other");
  block(0, 1, 1.3, 2, "other");
  block(1.3, 1, 3, 2, "rock");
  text += R"([[boundary]]
sides = ['left', 'bottom', 'right']
type = 'roller'
[[boundary]]
sides = ['top']
type = 'stress'
traction = [0, -1e6]
[[stage]]
until = 'equilibrium'
ratio = 1e-8
)";
  const Ran r = ran(text);
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  const Simulation& sim = r.ready.sim;
  ASSERT_TRUE(sim.scene->blocks.meshes.any() && sim.scene->blocks.bending.any());
  // Joints that give way do not fit together where three of them meet.
  for (const auto& s : sim.motion.zones.stress) {
    EXPECT_NEAR(s[1], -1e6, 1.5e-2 * 1e6);
    EXPECT_NEAR(s[3], 0.0, 1.5e-2 * 1e6);
  }
  for (const std::size_t i : {0u, 3u}) {
    const auto mean = mean_stress(sim.scene->blocks, sim.scene->zones, sim.motion.zones, i);
    EXPECT_NEAR(mean[1], -1e6, 2e-3 * 1e6) << i;
  }
}

/// Ground in its initial stress, which grows with depth, stays as it is.
TEST(Zones, GroundInItsInitialStressStays) {
  const Ran r = ran(R"([materials.rock]
density = 2600
young = 10e9
poisson = 0.25
[joints.j]
friction_angle = 40
[domain]
outline = [[0, 0], [10, 0], [10, 10], [0, 10]]
joint = 'j'
[[trace]]
points = [[0, 3], [10, 6]]
[initial_stress]
k0 = 0.6
surface_y = 30
[[boundary]]
sides = ['left', 'right', 'bottom']
type = 'roller'
[[boundary]]
sides = ['top']
type = 'stress'
[[stage]]
duration = 0.02
[zones]
size = 1.5
)");
  const Simulation& sim = r.ready.sim;
  const BlockSet& b = sim.scene->blocks;
  double most = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v)
    most = std::max(most, std::hypot(sim.motion.pose.x[v] - b.vertex_x[v],
                                     sim.motion.pose.y[v] - b.vertex_y[v]));
  EXPECT_LT(most, 1e-7);
}

/// A circular opening of radius 1 m in one block, 2 half m wide, on rollers.
std::string opening(double half, double size, const std::string& material, double px, double py) {
  return "gravity = [0, 0]\n" + material + joint +
         "[domain]\noutline = " + rectangle(-half, -half, half, half) +
         "\n[[opening]]\nname = 'hole'\nshape = { kind = 'circle', at = [0, 0], width = 2, "
         "segments = 64 }\n[initial_stress]\nstress = [" +
         number(-px) + ", " + number(-py) + ", 0]\nk0_out = " + number(px / py) +
         "\n[[boundary]]\nsides = ['left', 'right', 'bottom', 'top']\ntype = 'roller'\n[[stage]]\n"
         "until = 'equilibrium'\n" +
         zones(size, 0.15);
}

/// Inward displacement of the wall: its mean, and its part in cos 2t.
struct Closure {
  double mean = 0.0, second = 0.0;
};
Closure closure_of(const Simulation& sim) {
  const BlockSet& b = sim.scene->blocks;
  Closure c;
  double count = 0.0;
  for (std::size_t v = 0; v < b.vertex_count(); ++v) {
    const Vec2 p = b.vertex(v) + b.origin;
    if (norm(p) > 1.0001) continue;
    const Vec2 u{sim.motion.pose.x[v] - b.vertex_x[v], sim.motion.pose.y[v] - b.vertex_y[v]};
    const double inward = -dot(u, p) / norm(p);
    c.mean += inward;
    c.second += 2.0 * inward * std::cos(2.0 * std::atan2(p.y, p.x));
    count += 1.0;
  }
  return {c.mean / count, c.second / count};
}

/// Kirsch (1898), 30 radii from the rollers.
TEST(Zones, AnOpeningInElasticRock) {
  const double px = 10e6, py = 20e6, young = 20e9, nu = 0.2;
  const Ran r = ran(opening(30.0, 0.06, rock, px, py));
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
  const double shear = young / (2.0 * (1.0 + nu)), p = 0.5 * (px + py), d = 0.5 * (px - py);
  const Closure c = closure_of(r.ready.sim);
  expect_relative({72, "opening", "mean closure", "m"}, c.mean, p / (2.0 * shear), 1e-2);
  expect_relative({72, "opening", "closure in cos 2t", "m"}, c.second,
                  d * (3.0 - 4.0 * nu) / (2.0 * shear), 2e-2);
  // Hoop stress beside the wall, zone by zone.
  const Simulation& sim = r.ready.sim;
  const Meshes& m = sim.scene->blocks.meshes;
  double error = 0.0, count = 0.0;
  for (std::size_t z = 0; z < m.zone.size(); ++z) {
    Vec2 at;
    for (const std::uint32_t j : m.zone[z]) at += Vec2{m.arm_x[j], m.arm_y[j]} / 3.0;
    at += Vec2{sim.scene->blocks.centroid_x[0], sim.scene->blocks.centroid_y[0]} +
          sim.scene->blocks.origin;
    const double radius = norm(at);
    if (radius > 2.0) continue;
    const double t = std::atan2(at.y, at.x), q = 1.0 / (radius * radius);
    const double exact = -(p * (1.0 + q) - d * (1.0 + 3.0 * q * q) * std::cos(2.0 * t));
    const auto& s = sim.motion.zones.stress[z];
    const double cosine = std::cos(t), sine = std::sin(t);
    const double hoop = s[0] * sine * sine + s[1] * cosine * cosine - 2.0 * s[3] * sine * cosine;
    error += hoop / exact - 1.0;
    count += 1.0;
  }
  EXPECT_NEAR(error / count, 0.0, 0.02);
}

/// Forces in the bars between `count` nodes, equally far apart, of a bolt of length l that is
/// bonded to rock which moves by u(x) along it: EA U'' = K (U - u), no force at the ends; by
/// elimination.
template <class Motion>
std::vector<double> forces_in_moving_rock(double steel, double bond, double l, std::size_t count,
                                          Motion u) {
  const double h = l / static_cast<double>(count - 1), bar = steel / h;
  std::vector<double> diagonal(count), place(count), force(count - 1);
  for (std::size_t k = 0; k < count; ++k) {
    const bool end = k == 0 || k + 1 == count;
    const double grip = (end ? 0.5 : 1.0) * bond * h;
    diagonal[k] = grip + (end ? 1.0 : 2.0) * bar;
    place[k] = grip * u(static_cast<double>(k) * h);
  }
  for (std::size_t k = 1; k < count; ++k) {
    diagonal[k] -= bar * bar / diagonal[k - 1];
    place[k] += bar / diagonal[k - 1] * place[k - 1];
  }
  place[count - 1] /= diagonal[count - 1];
  for (std::size_t k = count - 1; k-- > 0;)
    place[k] = (place[k] + bar * place[k + 1]) / diagonal[k];
  for (std::size_t k = 0; k + 1 < count; ++k) force[k] = bar * (place[k + 1] - place[k]);
  return force;
}

/// A bolt at the wall of an opening in one block, so weak that the rock moves as without it: by
/// p a^2/(2 G r).
TEST(Zones, ABoltAtAnOpeningInOneBlock) {
  const double p = 10e6, young = 20e9, nu = 0.2, length = 2.0, bond = 2e8;
  const Ran r = ran(opening(15.0, 0.1, rock, p, p) +
                    "[[bolt]]\nfrom = [1.0, 0]\nto = [3.0, 0]\ndiameter = 0.02\n"
                    "bond = { stiffness = 2e8, strength = 1e7 }\n");
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.largest_energy_error, 1e-6);
  const Bolts& bolts = r.ready.sim.attached.bolts;
  const double shear = young / (2.0 * (1.0 + nu)),
               steel = 200e9 * 0.25 * std::numbers::pi * 0.02 * 0.02;
  const auto inward = [&](double x) { return -p / (2.0 * shear * (1.0 + x)); };
  constexpr std::size_t pieces = 2000;
  const std::vector<double> exact = forces_in_moving_rock(steel, bond, length, pieces + 1, inward);
  const double largest = *std::max_element(exact.begin(), exact.end());
  double error = 0.0;
  for (std::size_t k = 0; k + 1 < bolts.size(); ++k) {
    const double middle = bolts.distance[k] + 0.5 * bolts.length[k];
    const auto at = std::min(pieces - 1, static_cast<std::size_t>(middle / length * pieces));
    error = std::max(error, std::abs(bolts.bars.force[k] - exact[at]));
  }
  EXPECT_GT(largest, 1e3);
  EXPECT_LT(error, 0.025 * largest);
}

/// Salencon (1969): an opening in rock that yields, without dilation.
TEST(Zones, AnOpeningInRockThatYields) {
  const double shear = 2.8e9, bulk = 3.9e9, p0 = 30e6, c = 3.45e6, kp = 3.0, ks = 1.0;
  const double young = 9.0 * bulk * shear / (3.0 * bulk + shear),
               nu = (3.0 * bulk - 2.0 * shear) / (2.0 * (3.0 * bulk + shear));
  const Ran r = ran(opening(20.0, 0.1,
                            "[materials.rock]\ndensity = 2500\nyoung = " + number(young) +
                                "\npoisson = " + number(nu) +
                                "\nyield = { friction_angle = 30, cohesion = 3.45e6, "
                                "tensile_strength = 5e6 }\n",
                            p0, p0));
  EXPECT_EQ(r.outcome.status, Status::equilibrium) << r.outcome.message;
  EXPECT_LT(r.outcome.largest_energy_error, 2e-5);
  const double q = 2.0 * c * std::sqrt(kp), whole = q / (kp - 1.0);
  const double edge = std::pow(2.0 / (kp + 1.0) * (p0 + whole) / whole, 1.0 / (kp - 1.0));
  const double chi = (2.0 * nu - 1.0) * (p0 + whole) +
                     (1.0 - nu) * (kp * kp - 1.0) / (kp + ks) * whole * std::pow(edge, kp + ks) +
                     ((1.0 - nu) * (kp * ks + 1.0) / (kp + ks) - nu) * whole;
  EXPECT_NEAR(closure_of(r.ready.sim).mean / (chi / (2.0 * shear)), 1.0, 0.04);
}

}  // namespace
}  // namespace edda::zones_test
