// Rock bolts against closed-form solutions: pulled out of two blocks, sheared at a joint, and
// carrying a suspended block.
#include <algorithm>

#include "step/energy_balance.hpp"
#include "verification/record.hpp"
#include "verification/scene.hpp"

namespace edda::bolt_bar_test {
namespace {

// Rock so stiff that only the bolt deforms; 2 m of bolt on either side of the joint at y = 0.
constexpr double length = 2.0, diameter = 0.025, young = 200e9;
constexpr double bond = 1e9, bond_strength = 400e3;

double area() {
  return 0.25 * std::numbers::pi * diameter * diameter;
}

std::string two_blocks(const std::string& more, const std::string& solver) {
  return "gravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = 1e12\npoisson = 0.0\n"
         "[joints.j]\nfriction_angle = 30\n[contact]\nnormal_stiffness = 1e11\n"
         "[[block]]\nname = 'lower'\nfixed = true\npolygon = " +
         rectangle(-2, -4, 2, 0) +
         "\n[[block]]\nname = 'upper'\npolygon = " + rectangle(-2, 0, 2, 4) + "\n" + more +
         "[output]\nhistory_every = 0.001\n[solver]\n" + solver;
}

const std::string grouted =
    "[[bolt]]\nname = 'B'\nfrom = [0, -2]\nto = [0, 2]\ndiameter = 0.025\nyoung = 200e9\n"
    "bond = { stiffness = 1e9, strength = 400e3 }\n";

/// Moves the upper block and computes the equilibrium of the bolt there.
void shift_upper(Simulation& sim, Vec2 by) {
  for (std::size_t k = 0; k < 3; ++k) {
    sim.motion.state.position.x[k][1] += by.x;
    sim.motion.state.position.y[k][1] += by.y;
  }
  update_bolts(sim.attached.bolts, sim.scene->blocks, sim.motion.state);
}

/// Force of the bolts on the upper block, N.
Vec2 on_upper(const Simulation& sim) {
  BlockForces f{sim.scene->blocks, 1};
  add_bolts(f, sim.attached.bolts);
  return resultant(f.sum.nodes);
}

/// Opens the joint in small steps until `until` is true. Returns the force across the joint and its
/// opening at that point.
struct Pull {
  double force, opening;
};
template <class Until>
Pull pull(Simulation& sim, double step, double opening, Until until) {
  while (!until()) {
    shift_upper(sim, {0.0, step});
    opening += step;
    if (opening > 0.1) break;
  }
  return {-on_upper(sim).y, opening};
}

/// Half of the bolt against a rigid joint plane: N(x) falls off as sinh(lambda (L - x)), first slip
/// where K u = strength; after that the bond yields from the joint inwards.
TEST(Bolt, PulledOutOfItsGrout) {
  Simulation sim = scene(two_blocks(grouted, "duration = 1.0\n"));
  const double steel = young * area(), lambda = std::sqrt(bond / steel);
  const double stiffness = std::sqrt(bond * steel) * std::tanh(lambda * length);
  // Elastic, far below slip: force over opening, both halves in a row.
  shift_upper(sim, {0.0, 1e-5});
  expect_relative({33, "", "elastic force over opening", "N/m"}, -on_upper(sim).y / 1e-5,
                  0.5 * stiffness, 1e-2);
  // N along the bolt: P sinh(lambda (L - x))/sinh(lambda L).
  const double force = -on_upper(sim).y;
  for (std::size_t k = 0; k + 1 < sim.attached.bolts.size(); ++k) {
    const double middle =
        sim.attached.bolts.distance[k] + 0.5 * sim.attached.bolts.length[k] - length;
    const double exact =
        force * std::sinh(lambda * (length - std::abs(middle))) / std::sinh(lambda * length);
    EXPECT_NEAR(sim.attached.bolts.bars.force[k], exact, 1e-2 * force) << middle;
  }
  const auto first_slip = [&] {
    const auto& y = sim.attached.bolts.bonds.yielded;
    return std::find(y.begin(), y.end(), 1) != y.end();
  };
  const auto all_slip = [&] {
    const auto& y = sim.attached.bolts.bonds.yielded;
    return std::count(y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2), y.end(), 1) ==
               static_cast<std::ptrdiff_t>(y.size() / 2) ||
           std::count(y.begin(), y.begin() + static_cast<std::ptrdiff_t>(y.size() / 2), 1) ==
               static_cast<std::ptrdiff_t>(y.size() / 2);
  };
  const Pull first = pull(sim, 1e-6, 1e-5, first_slip);
  expect_relative({33, "", "force at first slip", "N"}, first.force,
                  bond_strength / bond * stiffness, 1e-2);
  expect_relative({33, "", "opening at first slip", "m"}, first.opening, 2.0 * bond_strength / bond,
                  1e-2);
  const Pull last = pull(sim, 1e-5, first.opening, all_slip);
  expect_relative({33, "", "force at full slip", "N"}, last.force, bond_strength * length, 1e-2);
  expect_relative({33, "", "opening at full slip", "m"}, last.opening,
                  2.0 * (bond_strength / bond + bond_strength * length * length / (2.0 * steel)),
                  1e-2);
  // The force does not increase further; unloading has the initial stiffness.
  for (int n = 0; n < 200; ++n) shift_upper(sim, {0.0, n < 100 ? 1e-5 : 1e-8});
  EXPECT_NEAR(-on_upper(sim).y, bond_strength * length, 1e-3 * bond_strength * length);
  const double before = -on_upper(sim).y;
  shift_upper(sim, {0.0, -1e-6});
  EXPECT_NEAR((before + on_upper(sim).y) / 1e-6, 0.5 * stiffness, 1e-2 * stiffness);
}

/// The steel yields at the joint before the grout slips, and ruptures.
TEST(Bolt, YieldsAndBreaks) {
  Simulation sim = scene(
      two_blocks(grouted + "yield_stress = 500e6\nrupture_strain = 0.08\n", "duration = 1.0\n"));
  const double yield = 500e6 * area();
  double largest = 0.0, opening = 0.0, broke_at = 0.0;
  while (opening < 0.05) {
    shift_upper(sim, {0.0, 1e-5});
    opening += 1e-5;
    largest = std::max(largest, -on_upper(sim).y);
    if (broke_at == 0.0 && largest > 0.9 * yield && -on_upper(sim).y < 0.5 * yield)
      broke_at = opening;
  }
  EXPECT_NEAR(largest / yield, 1.0, 1e-3);
  EXPECT_NEAR(on_upper(sim).y, 0.0, 1e-6);
  // The plastic elongation is spread over ten diameters; both halves of the bolt add their elastic
  // one.
  const double plastic = (0.08 - 500e6 / young) * 10.0 * diameter;
  EXPECT_GT(broke_at, plastic);
  EXPECT_LT(broke_at, plastic + 3e-3);
}

/// Elastic energy of bonds, bars and dowels, J.
double elastic_energy(const Bolts& bolts) {
  double stored = 0.0;
  for (const BoltSprings* s : {&bolts.bonds, &bolts.bars, &bolts.dowels}) {
    for (std::size_t k = 0; k < bolts.size(); ++k) {
      if (s->stiffness[k] > 0.0) stored += 0.5 * s->force[k] * s->force[k] / s->stiffness[k];
    }
  }
  return stored;
}

/// Energy: the work of the pull is stored, or dissipated by slip and yield.
TEST(Bolt, ClosesTheEnergyBalance) {
  Simulation sim = scene(two_blocks(grouted + "yield_stress = 500e6\nrupture_strain = 0.08\n"
                                              "dowel = { stiffness = 1e8, strength = 1e5 }\n",
                                    "duration = 1.0\n"));
  double work = 0.0;
  Vec2 before = on_upper(sim);
  for (int n = 0; n < 20000; ++n) {
    const double turn = n < 3000 ? 1.0 : n < 3400 ? -1.0 : 1.0;
    const Vec2 by = turn * Vec2{3e-7, 1e-6};
    shift_upper(sim, by);
    work -= 0.5 * dot(before + on_upper(sim), by);
    before = on_upper(sim);
  }
  const double stored = elastic_energy(sim.attached.bolts);
  EXPECT_GT(sim.attached.bolts.slipped, 100.0);
  const Bolts& b = sim.attached.bolts;
  const double spent = b.slipped + b.pending_friction + b.fractured + b.pending_fracture;
  EXPECT_NEAR((stored + spent) / work, 1.0, 1e-5);
}

/// Forces are gradients of the energy, for any rotation and deformation of the hosts.
TEST(Bolt, ForcesAreGradients) {
  Simulation sim = scene(
      "gravity = [0, 0]\n[materials.rock]\ndensity = 2500.0\nyoung = 1e9\npoisson = 0.2\n"
      "[joints.j]\nfriction_angle = 30\n[[block]]\npolygon = " +
      rectangle(-2, -2, 2, 0) + "\n[[block]]\npolygon = " + rectangle(-2, 0.5, 2, 2) +
      "\n[[bolt]]\nfrom = [-1, -1.9]\nto = [0.5, 1.5]\ndiameter = 0.03\npretension = 1e4\nbond = { "
      "stiffness = 1e8, strength = 1e9 }\ndowel = { stiffness = 1e7, strength = 1e9 }\n"
      "[[bolt]]\ntype = 'end'\nfrom = [1, -1]\nto = [0.5, 1.5]\ndiameter = 0.03\npretension = 1e5\n"
      "[solver]\nduration = 1.0\n");
  // A rotation and deformation that is nearly the same in both blocks.
  const double angle[2] = {0.5, 0.53};
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec2 p = rotated(
          {1.001 * sim.motion.state.position.x[k][i], sim.motion.state.position.y[k][i]}, angle[i]);
      sim.motion.state.position.x[k][i] = p.x + 0.01 * static_cast<double>(i);
      sim.motion.state.position.y[k][i] = p.y + 0.02 * static_cast<double>(i);
    }
  }
  const auto energy = [&] {
    update_bolts(sim.attached.bolts, sim.scene->blocks, sim.motion.state);
    return elastic_energy(sim.attached.bolts);
  };
  energy();
  std::array<NodeVectors, 2> f{};
  for (std::size_t i = 0; i < 2; ++i) {
    BlockForces on{sim.scene->blocks, i};
    add_bolts(on, sim.attached.bolts);
    f[i] = on.sum.nodes;
  }
  double scale = 0.0, torque = 0.0;
  Vec2 sum;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      scale = std::max(scale, norm(f[i][k]));
      sum += f[i][k];
      torque +=
          cross({sim.motion.state.position.x[k][i], sim.motion.state.position.y[k][i]}, f[i][k]);
    }
  }
  EXPECT_GT(scale, 1e4);
  EXPECT_LT(norm(sum), 1e-9 * scale);
  EXPECT_LT(std::abs(torque), 1e-8 * scale);
  const double d = 1e-6;
  for (std::size_t i = 0; i < 2; ++i) {
    for (std::size_t k = 0; k < 3; ++k) {
      for (auto* place : {&sim.motion.state.position.x[k][i], &sim.motion.state.position.y[k][i]}) {
        const double at = *place;
        *place = at + d;
        const double more = energy();
        *place = at - d;
        const double less = energy();
        *place = at;
        const double force = place == &sim.motion.state.position.x[k][i] ? f[i][k].x : f[i][k].y;
        EXPECT_NEAR((less - more) / (2.0 * d), force, 1e-5 * scale);
      }
    }
  }
}

/// A joint under weight, sheared: friction and the dowel, up to its strength. A moving boundary
/// pulls the block slowly.
TEST(Bolt, DowelsAJoint) {
  const double stiffness = 5e7, strength = 1.5e5, spacing = 1.5;
  Simulation sim = scene(two_blocks(
      grouted + "spacing = 1.5\ndowel = { stiffness = 5e7, strength = 1.5e5 }\n"
                "[[boundary]]\nname = 'pull'\nalong = [[2, 0.0], [2, 4]]\ntype = 'velocity'\n"
                "velocity = [0.02, 0]\nstiffness = 1e9\n",
      "duration = 0.3\ndamping = { contact = 0.2, mass = 50.0 }\n"));
  // Gravity may act at once: the pulled side prevents the block from tilting.
  sim.scene.edit().model.gravity = {0.0, -9.81};
  double error = 0.0, at_half = 0.0;
  const auto shear = [&] { return -on_upper(sim).x; };
  run(sim, [&](Simulation& s) {
    keep_largest(error, account_energy(s).error);
    const double u = displacement(s, 1).x;
    if (u < 0.5 * strength / stiffness && u > 0.1 * strength / stiffness) at_half = shear() / u;
  });
  expect_relative({34, "", "shear stiffness of the bolted joint, less friction", "N/m"}, at_half,
                  stiffness / spacing, 1e-2);
  expect_relative({34, "", "shear strength that the bolt adds", "N"}, shear(), strength / spacing,
                  1e-2);
  EXPECT_LT(error, 1e-4);
}

const double plastic_moment = 500e6 * std::pow(diameter, 3) / 6.0;

/// The same with a dowel that follows from the bar.
TEST(Bolt, DowelsAJointByItsBar) {
  const double modulus = 15e9, pressure = 50e6;
  Simulation sim = scene(two_blocks(
      grouted + "spacing = 1.5\nyield_stress = 500e6\n"
                "dowel = { bearing_strength = 50e6, foundation_modulus = 15e9 }\n"
                "[[boundary]]\nname = 'pull'\nalong = [[2, 0.0], [2, 4]]\ntype = 'velocity'\n"
                "velocity = [0.02, 0]\nstiffness = 1e9\n",
      "duration = 0.08\ndamping = { contact = 0.2, mass = 50.0 }\n"));
  sim.scene.edit().model.gravity = {0.0, -9.81};
  const double bending = young * std::numbers::pi * std::pow(diameter, 4) / 64.0;
  const double beta = std::pow(modulus / (4.0 * bending), 0.25);
  const double stiffness = bending * std::pow(beta, 3),
               strength = std::sqrt(2.0 * plastic_moment * pressure * diameter);
  double error = 0.0, at_half = 0.0;
  const auto shear = [&] { return -on_upper(sim).x; };
  run(sim, [&](Simulation& s) {
    keep_largest(error, account_energy(s).error);
    const double u = displacement(s, 1).x;
    if (u < 0.5 * strength / stiffness && u > 0.1 * strength / stiffness) at_half = shear() / u;
  });
  expect_relative({99, "", "shear stiffness of the bolted joint, less friction", "N/m"}, at_half,
                  stiffness / 1.5, 1e-2);
  expect_relative({99, "", "shear strength that the bolt adds", "N"}, shear(), strength / 1.5,
                  1e-2);
  EXPECT_LT(error, 1e-4);
}

/// A joint with friction of 30 degrees, sheared until its bolt at `angle` from the normal breaks.
struct ShearTest {
  double resistance = 0.0;    ///< less the joint's own, over the tensile strength of the bolt
  double displacement = 0.0;  ///< when it breaks, in diameters of the bolt
};

ShearTest shear_test(double angle, double ucs) {
  const Vec2 along = rotated({0.0, 1.5}, -radians(angle));
  Simulation sim = scene(
      two_blocks("[[bolt]]\nfrom = [" + number(-along.x) + ", " + number(-along.y) + "]\nto = [" +
                     number(along.x) + ", " + number(along.y) +
                     "]\ndiameter = 0.025\nyield_stress = 500e6\nrupture_strain = 0.05\n"
                     "bond = { stiffness = 3e9, strength = 1e6 }\ndowel = { bearing_strength = " +
                     number(1e6 * ucs) + ", foundation_modulus = " + number(3e8 * ucs) + " }\n",
                 "duration = 1.0\n"));
  ShearTest test;
  for (int n = 1; n < 4000; ++n) {
    shift_upper(sim, {2e-5, 0.0});
    const Vec2 f = -1.0 * on_upper(sim);
    if (norm(f) < 1.0) {
      test.displacement = n * 2e-5 / diameter;
      break;
    }
    test.resistance =
        std::max(test.resistance, (f.x + f.y * std::tan(radians(30.0))) / (500e6 * area()));
  }
  return test;
}

/// The formulas of Spang and Egger (1990), where the one for the displacement is positive.
TEST(Bolt, ResistsAsInShearTests) {
  for (const double ucs : {40.0, 60.0, 80.0}) {
    for (const double angle : {0.0, 15.0, 30.0}) {
      const double sine = std::sin(radians(angle)), cosine = std::cos(radians(angle));
      const double resistance = (1.55 + 0.011 * std::pow(ucs, 1.07) * sine * sine) *
                                std::pow(ucs, -0.14) * (0.85 + 0.45 * std::tan(radians(30.0)));
      const double displacement =
          (15.2 - 55.2 * std::pow(ucs, -0.14) + 56.2 * std::pow(ucs, -0.28)) *
          (1.0 - sine / cosine * std::pow(70.0 / ucs, 0.125) / std::sqrt(cosine));
      const ShearTest test = shear_test(angle, ucs);
      const std::string which = brief(ucs) + " MPa, " + brief(angle) + " deg";
      expect_relative({100, which, "shear resistance over tensile strength of the bolt", ""},
                      test.resistance, resistance, 0.1);
      expect_relative({100, which, "displacement at rupture over diameter of the bolt", ""},
                      test.displacement, displacement, 0.25);
    }
  }
}

/// A block is suspended from an end-anchored bolt: in equilibrium the elongation of the bolt is
/// that of the weight less the pretension.
TEST(Bolt, HoldsABlockUp) {
  for (const double pretension : {0.0, 40e3}) {
    Simulation sim = scene(
        "[materials.rock]\ndensity = 2000.0\nyoung = 50e9\npoisson = 0.2\n[joints.j]\n"
        "friction_angle = 30\n[[block]]\nfixed = true\npolygon = " +
        rectangle(-1, 3, 1, 4) + "\n[[block]]\npolygon = " + rectangle(-1, 0, 1, 2) +
        "\n[[bolt]]\ntype = 'end'\nfrom = [0, 0]\nto = [0, 4]\ndiameter = 0.03\npretension = " +
        number(pretension) +
        "\nyield_stress = 500e6\nspacing = 2.0\n[output]\nhistory_every = 0.05\n[solver]\n"
        "duration = 3.0\ndamping = { mass = 8.0 }\n");
    double error = 0.0;
    run(sim, [&](Simulation& s) { keep_largest(error, account_energy(s).error); });
    const double weight = 2000.0 * 9.81 * 4.0, steel = young * std::numbers::pi * 2.25e-4 / 2.0;
    const double longer = (weight - 0.5 * pretension) * 4.0 / steel;
    const Vec2 lower_end = node_place(sim.attached.bolts, sim.scene->blocks, sim.motion.state, 0) +
                           sim.scene->blocks.origin;
    expect_relative({35, brief(1e-3 * pretension) + " kN", "elongation of the bolt", "m"},
                    -lower_end.y, longer, 1e-3);
    EXPECT_NEAR(sim.attached.bolts.bars.force[0] / weight, 1.0, 1e-3);
    EXPECT_LT(error, 1e-5);
  }
}

/// A block falls on grouted bolts that slip and yield: the energy balance closes, and the
/// frictional dissipation never decreases.
TEST(Bolt, EnergyBalanceClosesWhileBoltsYield) {
  Simulation sim = scene(
      "[materials.rock]\ndensity = 2500.0\nyoung = 5e9\npoisson = 0.2\n[joints.j]\n"
      "friction_angle = 30\n[[block]]\nfixed = true\npolygon = " +
      rectangle(-2, 2, 2, 5) +
      "\n[[block]]\npolygon = [[-1.5, 0], [1.5, 0], [2, 2], [-2, 2]]\n"
      "[[bolt]]\nfrom = [-1, 0]\nto = [-1.2, 4]\ndiameter = 0.02\nyield_stress = 400e6\nbond = { "
      "stiffness = 5e8, strength = 60e3 }\ndowel = { stiffness = 1e7, strength = 2e4 }\n"
      "[[bolt]]\nfrom = [0.8, 0]\nto = [1.3, 4]\ndiameter = 0.02\nyield_stress = 400e6\nbond = { "
      "stiffness = 5e8, strength = 200e3 }\ndowel = { stiffness = 1e7, strength = 2e4 }\n"
      "[output]\nhistory_every = 0.005\n[solver]\nduration = 0.4\n");
  double error = 0.0, friction = 0.0;
  run(sim, [&](Simulation& s) {
    const EnergyBalance l = account_energy(s);
    keep_largest(error, l.error);
    EXPECT_GE(l.friction, friction - 1e-9 * l.scale());
    friction = std::max(friction, l.friction);
  });
  const auto& slipped = sim.attached.bolts.bonds.yielded;
  EXPECT_GT(std::count(slipped.begin(), slipped.end(), 1), 5);
  EXPECT_GT(sim.attached.bolts.slipped, 100.0);
  EXPECT_LT(error, 1e-5);
}

}  // namespace
}  // namespace edda::bolt_bar_test
